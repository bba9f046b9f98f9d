// Reads the curves of a plot at a place, and narrows its time.
import { short, typed } from './numbers';
import { frame, type Panel, placed, type Plot } from './plot';
import type * as core from './records';

export const isOfTime = ({ x }: Panel): boolean => /^time\b/.test(x.name ?? '');

/** A place in a panel, in the panel's units. */
export interface Spot {
  column: number;
  panel: Panel;
  x: number;
  /** NaN: x alone. */
  y: number;
}

/** A spot at a point of the picture, with the ends of its panel there. */
export interface Pointed extends Spot {
  right: number;
  top: number;
  bottom: number;
}

const along = (axis: core.PlotAxis, share: number): number =>
  axis.logarithmic ? axis.low! * (axis.high! / axis.low!) ** share : axis.low! + (axis.high! - axis.low!) * share;

/** Beside a panel it is the panel's end; above and below there is none. */
export function spotAt(plot: Plot, width: number, point: { x: number; y: number }): Pointed | null {
  const pointed = placed(plot, width).find(({ top, bottom }) => point.y >= top && point.y <= bottom);
  if (!pointed) return null;
  const { panel, left, top, bottom } = pointed;
  const end = width - frame.right;
  const right = Math.max(left, Math.min(end, point.x));
  return {
    column: plot.columns.findIndex((column) => column.includes(panel)),
    panel, right, top, bottom,
    x: along(panel.x, (right - left) / (end - left)),
    y: along(panel.y, (bottom - point.y) / (bottom - top)),
  };
}

/** In the first column that has this time. */
export function spotOfTime(plot: Plot, x: number): Spot | null {
  const column = plot.columns.findIndex(([panel]) => x >= panel!.x.low! && x <= panel!.x.high!);
  return column < 0 ? null : { column, panel: plot.columns[column]![0]!, x, y: NaN };
}

/** The heights of named lines at x, and first that of a line over time that only its axis names; of several the one next to `near`. */
function valuesAt(panel: Panel, x: number, near: number): Map<string, number> {
  const values = new Map([['', NaN]]);
  for (const { kind, name, points } of panel.layers) {
    if (kind !== 'line' || !(name || isOfTime(panel))) continue;
    for (let i = 0; i + 3 < points.length; i += 2) {
      const share = (x - points[i]!) / (points[i + 2]! - points[i]!);
      if (!(share >= 0 && share <= 1)) continue;
      const value = points[i + 1]! + share * (points[i + 3]! - points[i + 1]!);
      const known = values.get(name ?? '') ?? NaN;
      if (!(Math.abs(known - near) <= Math.abs(value - near))) values.set(name ?? '', value);
    }
  }
  return values;
}

/** The power of ten that the axis' label has and its numbers lack. */
function powerOf({ tics }: core.PlotAxis): number {
  const tic = tics.find(({ at, text }) => Number(text) / at > 0);
  return tic ? 10 ** Math.round(Math.log10(Number(tic.text) / tic.at)) : 1;
}

/** What the axes and lines of a column read, in the units of the labels. */
export function readingsAt(plot: Plot, { column, panel: pointed, x, y }: Spot): string {
  const panels = plot.columns[column]!;
  const axis = panels[0]!.x;
  const readings = panels.map((panel) => {
    const values = [...valuesAt(panel, x, panel === pointed ? y : NaN)].filter(([, value]) => Number.isFinite(value));
    // "its limit, ±144 N m" names a value itself.
    const words = values.map(([name, value]) => `${name.replace(/, ±.*/, '')} ${short(value * powerOf(panel.y))}`.trim());
    return words.length > 0 ? `${panel.y.label}: ${words.join(', ')}` : '';
  });
  return [`${axis.label}: ${short(x * powerOf(axis))}`, ...readings].filter(Boolean).join('; ');
}

/** The axis over another range, with round numbers; the same for a range that rounding would fill. */
function over(axis: core.PlotAxis, low: number, high: number): core.PlotAxis {
  if (!(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)))) return axis;
  const most = 6;
  const power = 10 ** Math.floor(Math.log10((high - low) / most));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((one) => (high - low) / one <= most)!;
  const tics: core.Tic[] = [];
  for (let i = Math.ceil(low / step); i * step <= high; ++i) tics.push({ at: i * step, text: typed(i * step * powerOf(axis), 9) });
  return { ...axis, low, high, tics };
}

/** The y axis about what lines have between two x. */
function fitted({ y, layers }: Panel, from: number, to: number): core.PlotAxis {
  let [low, high] = [Infinity, -Infinity];
  for (const { kind, points } of layers) {
    for (let i = 0; kind === 'line' && i + 3 < points.length; i += 2) {
      const [begin, end] = [points[i + 1]!, points[i + 3]!];
      if (!(points[i]! <= to && points[i + 2]! >= from) || !Number.isFinite(begin + end)) continue;
      low = Math.min(low, begin, end);
      high = Math.max(high, begin, end);
    }
  }
  const margin = 0.05 * (high - low);
  return over(y, Math.max(y.low!, low - margin), Math.min(y.high!, high + margin));
}

/** The plot with a column over a part of its time. */
export function narrowed(plot: Plot, column: number, from: number, to: number): Plot {
  const part = (panel: Panel): Panel => ({ ...panel, x: over(panel.x, from, to), y: fitted(panel, from, to) });
  return { ...plot, columns: plot.columns.map((panels, i) => (i === column ? panels.map(part) : panels)) };
}
