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

/** Tics of a logarithmic axis: 1, 2 and 5 of each power of ten, or powers alone if there are many. */
export function logarithmicTics(low: number, high: number, most: number): number[] {
  const decades = Math.log10(high / low);
  const factors = decades * 3 <= most ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(decades / most));
  const values: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power += 1) {
    if (factors.length === 1 && power % every !== 0) continue;
    for (const factor of factors) {
      const value = Number((factor * 10 ** power).toPrecision(12));
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) values.push(value);
    }
  }
  return values.length > 1 ? values : tics(low, high, most);
}

/** "gearbox.backlash" as words. */
export const inWords = (path: string): string => (path.split('.')[1] ?? path).replaceAll('_', ' ');

export const escapeText = (text: string): string =>
  text.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c] ?? c);
