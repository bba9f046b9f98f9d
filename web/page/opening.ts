// Files that are opened, or dropped on the page.
import { short } from './numbers';
import type { DriveText } from './replies';
import { plainName } from './state';

const mebibyte = 1024 * 1024;
/** Bytes; those of the core's reader. */
const largestDrive = mebibyte;
const largestTable = 64 * mebibyte;

/**
 * The drive of the files: a drive's file with the tables that it names, or a table of the present
 * drive. A sentence if they are too large.
 */
export async function driveIn(list: FileList, present: DriveText): Promise<DriveText | string> {
  const all = Array.from(list);
  if (all.filter((file) => file.name.endsWith('.toml')).length > 1) return 'These are several drives. Open one TOML file, with the tables that it names.';
  const most = (file: File): number => (isDrive(file, all, present) ? largestDrive : largestTable);
  const large = all.find((file) => file.size > most(file));
  if (large) return `${large.name} has ${short(large.size / mebibyte, 3)} MiB; permitted are ${most(large) / mebibyte} MiB. The drive stays as it was.`;
  const main = all.find((file) => isDrive(file, all, present));
  const files: Record<string, string> = main ? {} : { ...present.files };
  for (const file of all) if (file !== main) files[file.name] = await file.text();
  return main ? { toml: await main.text(), name: plainName(main.name), settings: [], files } : { ...present, files };
}

/** A TOML file; a single file of another name, unless the present drive names it as a table. */
const isDrive = (file: File, all: File[], present: DriveText): boolean =>
  file.name.endsWith('.toml') || (all.length === 1 && !present.toml.includes(file.name));

/** Calls `opened` for files that are chosen, and for files that are dropped anywhere. */
export function listenToFiles(input: HTMLInputElement, dropping: HTMLElement, opened: (list: FileList) => void): void {
  const open = (list: FileList | null | undefined): void => {
    if (list && list.length > 0) opened(list);
  };
  input.onchange = () => {
    open(input.files);
  };
  // So that the same file, edited, can be opened again.
  input.onclick = () => (input.value = '');
  const hasFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  document.addEventListener('dragenter', (event) => {
    if (hasFiles(event)) dropping.hidden = false;
  });
  document.addEventListener('dragover', (event) => event.preventDefault());
  document.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) dropping.hidden = true;
  });
  document.addEventListener('drop', (event) => {
    event.preventDefault();
    dropping.hidden = true;
    open(event.dataTransfer?.files);
  });
}
