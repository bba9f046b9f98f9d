// Numbers as a reader has them. Nothing is computed here but their text.

/** At most `digits` significant digits, without trailing zeros. */
export function short(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return value > 0 ? '∞' : value < 0 ? '−∞' : '–';
  const text = String(Number(value.toPrecision(digits)));
  return text.replace('-', '−');
}

/** The same as a core reads it. */
export const typed = (value: number, digits = 4): string => String(Number(value.toPrecision(digits)));

/** "gearbox.backlash" as words. */
export const inWords = (path: string): string => (path.split('.')[1] ?? path).replaceAll('_', ' ');

export const escapeText = (text: string): string =>
  text.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c] ?? c);
