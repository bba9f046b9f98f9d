// Files that the page gives: pictures, data and drives.
import { made } from './elements';
import { draw, type Plot } from './plot';

export function save(name: string, content: Blob | string, type = 'text/plain'): void {
  const blob = typeof content === 'string' ? new Blob([content], { type }) : content;
  const link = made('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The picture as it is printed: on white, with its title. */
export const svgFile = (plot: Plot): string => `<?xml version="1.0" encoding="UTF-8"?>\n${draw(plot, { isTitled: true })}\n`;

export async function savePng(name: string, plot: Plot): Promise<void> {
  const svg = draw(plot, { isTitled: true });
  const [, wide, high] = /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(svg)!;
  const image = new Image();
  image.src = URL.createObjectURL(new Blob([svg.replace('<svg ', `<svg width="${wide}" height="${high}" `)], { type: 'image/svg+xml' }));
  await image.decode();
  const sharpness = 3; // of print
  const canvas = made('canvas', { width: Number(wide) * sharpness, height: Number(high) * sharpness });
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (!blob) throw new Error('the browser could not make a PNG of this size');
  save(name, blob);
}

/** A table with a header, as spreadsheets, pandas and gnuplot read it. */
export function csv(header: string[], columns: ArrayLike<number | string>[]): string {
  const lines = [header.join(',')];
  const rows = columns[0]?.length ?? 0;
  for (let i = 0; i < rows; ++i) lines.push(columns.map((column) => String(column[i])).join(','));
  return `${lines.join('\n')}\n`;
}
