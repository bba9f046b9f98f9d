// Numbers as a reader has them. Nothing is computed here but their text.

/** At most `digits` significant digits, without trailing zeros. */
export function short(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return value > 0 ? '∞' : value < 0 ? '−∞' : '–';
  const text = String(Number(value.toPrecision(digits)));
  return text.replace('-', '−');
}

/** The same as a core reads it. */
export const typed = (value: number, digits = 4): string => String(Number(value.toPrecision(digits)));

/** Round tics of an axis: at most `most` steps of 1, 2 or 5 times a power of ten. */
export function tics(low: number, high: number, most: number): number[] {
  const span = high - low;
  if (!(span > 0)) return [low];
  const raw = span / most;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= raw * (1 - 1e-12)) ?? 10);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  const values: number[] = [];
  for (let i = first; i <= last; ++i) values.push(Number((i * step).toPrecision(12)));
  return values;
}

/** "gearbox.backlash" as words. */
export const inWords = (path: string): string => (path.split('.')[1] ?? path).replaceAll('_', ' ');

export const escapeText = (text: string): string =>
  text.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c] ?? c);
