// Draws charts as SVG: axes, curves, areas, marks and a legend.
import { escapeText, logarithmicTics, short, tics } from './numbers';

export interface Theme {
  ink: string;
  faint: string;
  grid: string;
  paper: string;
  load: string;
  motor: string;
  gap: string;
  accent: string;
  stop: string;
  good: string;
}

// Colours that colour-blind readers distinguish (Okabe and Ito), with enough contrast for text.
export const light: Theme = {
  ink: '#1c2430', faint: '#5a6472', grid: '#e3e7ec', paper: '#ffffff', load: '#0067a5', motor: '#c04f00',
  gap: '#f3d9a4', accent: '#7a3f8f', stop: '#a40000', good: '#00705a',
};
export const dark: Theme = {
  ink: '#e9edf2', faint: '#a5b0bd', grid: '#343d49', paper: '#171c23', load: '#5cb8f0', motor: '#ff9d57',
  gap: '#5b4a26', accent: '#d7a3e8', stop: '#ff8f8f', good: '#57d0ae',
};

export interface PlotAxis {
  label: string;
  low: number;
  high: number;
  logarithmic?: boolean;
  tics?: [string, number][];
}

/** x and y by turns; NaN interrupts a line. */
export type Points = ArrayLike<number>;

export type Layer =
  | { kind: 'line'; points: Points; colour: string; width?: number; dash?: string; fill?: string; closed?: boolean }
  | { kind: 'marks'; points: Points; colour: string; size?: number; open?: boolean; shape?: 'circle' | 'cross' }
  /** The one mark that moves: see moveMark(). */
  | { kind: 'moving'; at: [number, number]; colour: string }
  /** Across the whole height. */
  | { kind: 'band'; from: number; to: number; fill: string }
  | { kind: 'rule'; at: number; colour: string; dash?: string; text?: string; row?: number }
  | { kind: 'text'; x: number; y: number; text: string; colour: string };

export interface LegendEntry {
  name: string;
  colour: string;
  dash?: string;
  width?: number;
  mark?: 'circle' | 'open' | 'cross' | 'diamond' | 'area' | 'hatched';
}

export interface Plot {
  title: string;
  subtitle?: string;
  /** For readers that do not see the picture. */
  description: string;
  x: PlotAxis;
  y: PlotAxis;
  layers: Layer[];
  legend: LegendEntry[];
}

const frame = { left: 74, right: 14, top: 12 };
const letter = 7.2;

type Scale = (value: number) => number;

function scale(axis: PlotAxis, from: number, to: number): Scale {
  const map = axis.logarithmic ? Math.log : (value: number) => value;
  const low = map(axis.low);
  const span = map(axis.high) - low || 1;
  return (value) => from + ((map(value) - low) / span) * (to - from);
}

const at = (value: number): string => (Math.round(value * 100) / 100).toString();

function pathOf(points: Points, x: Scale, y: Scale, closed: boolean): string {
  const visible = 0.3; // px: points that are nearer to the last one are left out
  let path = '';
  let isDrawing = false;
  let [lastRight, lastDown] = [Infinity, Infinity];
  for (let i = 0; i + 1 < points.length; i += 2) {
    const right = x(points[i]!);
    const down = y(points[i + 1]!);
    if (!Number.isFinite(right) || !Number.isFinite(down)) {
      isDrawing = false;
      continue;
    }
    const isLast = i + 3 >= points.length || !Number.isFinite(points[i + 2]!);
    if (isDrawing && !isLast && Math.abs(right - lastRight) < visible && Math.abs(down - lastDown) < visible) continue;
    [lastRight, lastDown] = [right, down];
    // Far outside, an SVG reader loses digits.
    path += `${isDrawing ? 'L' : 'M'}${at(Math.max(-1e5, Math.min(1e5, right)))} ${at(Math.max(-1e5, Math.min(1e5, down)))}`;
    isDrawing = true;
  }
  return closed && path ? `${path}Z` : path;
}

function mark(shape: string, right: number, down: number, size: number, colour: string, open: boolean): string {
  const style = open ? `fill="none" stroke="${colour}" stroke-width="1.5"` : `fill="${colour}"`;
  if (shape === 'cross') {
    return `<path d="M${at(right - size)} ${at(down - size)}l${2 * size} ${2 * size}m0 ${-2 * size}l${-2 * size} ${2 * size}" stroke="${colour}" stroke-width="1.6"/>`;
  }
  if (shape === 'diamond') {
    return `<path d="M${at(right)} ${at(down - size)}l${size} ${size}l${-size} ${size}l${-size} ${-size}z" ${style}/>`;
  }
  return `<circle cx="${at(right)}" cy="${at(down)}" r="${size}" ${style}/>`;
}

function layerText(layer: Layer, x: Scale, y: Scale, bottom: number): string {
  switch (layer.kind) {
    case 'line': {
      const dash = layer.dash ? ` stroke-dasharray="${layer.dash}"` : '';
      const stroke = layer.width === 0 ? 'stroke="none"' : `stroke="${layer.colour}" stroke-width="${layer.width ?? 1.8}"${dash}`;
      return `<path d="${pathOf(layer.points, x, y, layer.closed ?? false)}" fill="${layer.fill ?? 'none'}" ${stroke} stroke-linejoin="round"/>`;
    }
    case 'marks': {
      let text = '';
      for (let i = 0; i + 1 < layer.points.length; i += 2) {
        const right = x(layer.points[i]!);
        const down = y(layer.points[i + 1]!);
        if (!Number.isFinite(right) || !Number.isFinite(down)) continue;
        text += mark(layer.shape ?? 'circle', right, down, layer.size ?? 3.5, layer.colour, layer.open ?? false);
      }
      return text;
    }
    case 'moving':
      return `<g class="moving" transform="translate(${at(x(layer.at[0]))} ${at(y(layer.at[1]))})">${mark('diamond', 0, 0, 7, layer.colour, false)}</g>`;
    case 'band': {
      const [from, to] = [x(layer.from), x(layer.to)];
      return `<rect x="${at(Math.min(from, to))}" y="${frame.top}" width="${at(Math.abs(to - from))}" height="${bottom - frame.top}" fill="${layer.fill}"/>`;
    }
    case 'rule': {
      const place = at(x(layer.at));
      const dash = layer.dash ? ` stroke-dasharray="${layer.dash}"` : '';
      const label = layer.text ? `<text x="${at(Number(place) + 4)}" y="${frame.top + 14 + 14 * (layer.row ?? 0)}" fill="${layer.colour}" font-size="12">${escapeText(layer.text)}</text>` : '';
      return `<line x1="${place}" x2="${place}" y1="${frame.top}" y2="${bottom}" stroke="${layer.colour}" stroke-width="1.2"${dash}/>${label}`;
    }
    case 'text':
      return `<text x="${at(x(layer.x))}" y="${at(y(layer.y))}" fill="${layer.colour}" font-size="12" text-anchor="middle" paint-order="stroke" stroke-width="3">${escapeText(layer.text)}</text>`;
  }
}

function ticsOf(axis: PlotAxis, most: number): [string, number][] {
  if (axis.tics && axis.tics.length > 0) return axis.tics;
  const values = axis.logarithmic ? logarithmicTics(axis.low, axis.high, most) : tics(axis.low, axis.high, most);
  return values.map((value) => [short(value, 6), value]);
}

function axesText(plot: Plot, x: Scale, y: Scale, width: number, bottom: number, theme: Theme): string {
  let text = '';
  for (const [name, value] of ticsOf(plot.x, width < 460 ? 4 : 7)) {
    const right = at(x(value));
    text += `<line x1="${right}" x2="${right}" y1="${frame.top}" y2="${bottom}" stroke="${theme.grid}"/>`;
    text += `<text x="${right}" y="${bottom + 17}" text-anchor="middle" fill="${theme.faint}" font-size="12">${name}</text>`;
  }
  for (const [name, value] of ticsOf(plot.y, 6)) {
    const down = at(y(value));
    text += `<line y1="${down}" y2="${down}" x1="${frame.left}" x2="${width - frame.right}" stroke="${theme.grid}"/>`;
    text += `<text x="${frame.left - 7}" y="${Number(down) + 4}" text-anchor="end" fill="${theme.faint}" font-size="12">${name}</text>`;
  }
  const middle = (frame.left + width - frame.right) / 2;
  text += `<text x="${middle}" y="${bottom + 36}" text-anchor="middle" fill="${theme.ink}" font-size="13">${escapeText(plot.x.label)}</text>`;
  const centre = (frame.top + bottom) / 2;
  text += `<text x="16" y="${centre}" text-anchor="middle" fill="${theme.ink}" font-size="13" transform="rotate(-90 16 ${centre})">${escapeText(plot.y.label)}</text>`;
  return text;
}

/** The entries in lines, and the height that they take. */
function legendText(entries: LegendEntry[], top: number, width: number, theme: Theme): { text: string; height: number } {
  const line = 20;
  let text = '';
  let right = frame.left;
  let down = top;
  for (const entry of entries) {
    const length = 30 + entry.name.length * letter + 16;
    if (right > frame.left && right + length > width) {
      right = frame.left;
      down += line;
    }
    const middle = down - 4;
    if (entry.mark === 'area') text += `<rect x="${right}" y="${middle - 6}" width="22" height="12" fill="${entry.colour}"/>`;
    else if (entry.mark === 'hatched') text += `<path d="M${right} ${middle + 6}v-12h22v12zl11 -12m0 12l11 -12" fill="none" stroke="${entry.colour}" stroke-width="0.8"/>`;
    else if (entry.mark) text += mark(entry.mark === 'open' ? 'circle' : entry.mark, right + 11, middle, 4, entry.colour, entry.mark === 'open');
    else text += `<line x1="${right}" x2="${right + 22}" y1="${middle}" y2="${middle}" stroke="${entry.colour}" stroke-width="${entry.width ?? 2.4}"${entry.dash ? ` stroke-dasharray="${entry.dash}"` : ''}/>`;
    text += `<text x="${right + 28}" y="${down}" fill="${theme.ink}" font-size="12.5">${escapeText(entry.name)}</text>`;
    right += length;
  }
  return { text, height: entries.length > 0 ? down - top + line : 0 };
}

let clips = 0;

export interface Size {
  /** Of the place on the screen, px: letters keep their size. */
  width?: number;
  /** With its title in it, as a file needs it. */
  isTitled?: boolean;
  /** With the moving mark in a picture of its own, so that its move does not paint the other again. */
  isMarkApart?: boolean;
}

function layout(plot: Plot, place: number | undefined): { width: number; height: number; bottom: number; x: Scale; y: Scale } {
  const width = Math.max(320, Math.min(640, place || 640));
  const height = Math.round(width * (width < 460 ? 0.8 : 0.66));
  const bottom = height - 48;
  return { width, height, bottom, x: scale(plot.x, frame.left, width - frame.right), y: scale(plot.y, bottom, frame.top) };
}

/** Moves the mark of a picture. */
export function moveMark(picture: Element, plot: Plot, to: [number, number]): void {
  const { x, y } = layout(plot, picture.querySelector('svg')?.viewBox.baseVal.width);
  picture.querySelector('.moving')?.setAttribute('transform', `translate(${at(x(to[0]))} ${at(y(to[1]))})`);
}

/** The picture as SVG. */
export function draw(plot: Plot, theme: Theme, size: Size = {}): string {
  const { width, height, bottom, x, y } = layout(plot, size.width);
  const heading = size.isTitled ? (plot.subtitle ? 50 : 30) : 0;
  const legend = legendText(plot.legend, height + 6, width, theme);
  const total = height + legend.height + heading;
  const clip = `clip${++clips}`;
  const text = (layers: Layer[]): string =>
    layers
      .map((layer) => layerText(layer, x, y, bottom)).join('')
      .replaceAll('paint-order="stroke"', `paint-order="stroke" stroke="${theme.paper}"`);
  // Marks at the end of an axis are drawn whole, others outside not at all.
  const isMark = (layer: Layer): boolean => layer.kind === 'marks' || layer.kind === 'moving';
  const isApart = (layer: Layer): boolean => (size.isMarkApart ?? false) && layer.kind === 'moving';
  const rectangle = (margin: number): string =>
    `<rect x="${frame.left - margin}" y="${frame.top - margin}" width="${width - frame.left - frame.right + 2 * margin}" height="${bottom - frame.top + 2 * margin}"/>`;
  const title = size.isTitled
    ? `<text x="${frame.left}" y="20" fill="${theme.ink}" font-size="15" font-weight="600">${escapeText(plot.title)}</text>` +
      (plot.subtitle ? `<text x="${frame.left}" y="40" fill="${theme.faint}" font-size="12.5">${escapeText(plot.subtitle)}</text>` : '')
    : '';
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${total}" role="img" aria-label="${escapeText(`${plot.title}. ${plot.description}`)}" font-family="system-ui, sans-serif">` +
    `<rect width="${width}" height="${total}" fill="${theme.paper}"/>${title}` +
    `<g transform="translate(0 ${heading})"><clipPath id="${clip}">${rectangle(0)}</clipPath><clipPath id="${clip}m">${rectangle(7)}</clipPath>` +
    axesText(plot, x, y, width, bottom, theme) +
    `<g clip-path="url(#${clip})">${text(plot.layers.filter((layer) => !isMark(layer)))}</g>` +
    `<rect x="${frame.left}" y="${frame.top}" width="${width - frame.left - frame.right}" height="${bottom - frame.top}" fill="none" stroke="${theme.faint}"/>` +
    `<g clip-path="url(#${clip}m)">${text(plot.layers.filter((layer) => isMark(layer) && !isApart(layer)))}</g>` +
    `${legend.text}</g></svg>` +
    (plot.layers.some(isApart) ? `<svg class="overlay" viewBox="0 0 ${width} ${total}" aria-hidden="true">${text(plot.layers.filter(isApart))}</svg>` : '')
  );
}
