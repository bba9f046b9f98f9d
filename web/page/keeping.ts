// What the user keeps: the drive as a file, the link, and the choice of light or dark.
import type { Lane } from './core';
import { save } from './downloads';
import type { DriveText } from './replies';

const saved = (sentence: string): void => {
  document.getElementById('saved')!.textContent = sentence;
};

/** All numbers of the drive as a file that reads back exactly. */
export async function saveDrive(lane: Lane, drive: DriveText): Promise<void> {
  const { reply } = await lane.ask<{ toml: string }>({ ask: 'file', drive });
  const name = drive.name.endsWith('.toml') ? drive.name : `${drive.name}.toml`;
  save(name, `# gearlash limit-cycle ${name}\n\n${reply.toml}`);
  saved(`Saved ${name} with all its numbers. gearlash limit-cycle ${name} gives the same answer.`);
}

export async function copyLink(): Promise<void> {
  try {
    await navigator.clipboard.writeText(location.href);
    saved('The link is copied: it holds the drive and this view.');
  } catch {
    saved('The browser does not let the page copy. The link is in its address bar.');
  }
}

/** Pages from a file or in a private window may have no storage. */
export function keptTheme(): string | null {
  try {
    return localStorage.getItem('gearlash-theme');
  } catch {
    return null;
  }
}

export function keepTheme(name: string): void {
  try {
    localStorage.setItem('gearlash-theme', name);
  } catch {
    // kept for this visit alone
  }
}
