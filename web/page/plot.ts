// Draws charts as SVG: axes, curves, areas, marks and a legend.
import { escapeText, short, tics } from './numbers';

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
  /** Default: round numbers. Without a text: a short mark. */
  tics?: [string, number][];
}

/** x and y by turns; NaN interrupts a line. */
export type Points = ArrayLike<number>;

/** As the core has them, and two of the page. */
export type Layer =
  | {
      kind: 'line' | 'area' | 'marks' | 'hatching';
      /** In the legend, which each name enters once. */
      name?: string;
      colour: string;
      points: Points;
      width?: number;
      dashes?: string;
      mark?: string;
      /** Of a mark; 1 is about the height of a letter. */
      size?: number;
    }
  /** The one mark that moves: see moveMark(). */
  | { kind: 'moving'; name: string; at: [number, number]; colour: string }
  /** Across the whole height. */
  | { kind: 'rule'; at: number; colour: string };

export interface PlotText {
  x: number;
  y: number;
  text: string;
  colour: string;
}

export interface Plot {
  title: string;
  subtitle?: string;
  /** For readers that do not see the picture. */
  description: string;
  x: PlotAxis;
  y: PlotAxis;
  layers: Layer[];
  texts?: PlotText[];
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
  return closed && path ? `${path.replaceAll('M', 'ZM').slice(1)}Z` : path;
}

/** Corners of marks that are polygons, in half their size. */
const corners: Record<string, [number, number][]> = {
  square: [[-1, -1], [1, -1], [1, 1], [-1, 1]],
  triangle: [[0, -1.2], [1.1, 0.8], [-1.1, 0.8]],
  wedge: [[0, 1.2], [1.1, -0.8], [-1.1, -0.8]],
  diamond: [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]],
  pentagon: [[0, -1.2], [1.14, -0.37], [0.7, 0.97], [-0.7, 0.97], [-1.14, -0.37]],
};
/** Strokes of those that are not. */
const strokes: Record<string, string> = { plus: 'M-1 0H1M0-1V1', cross: 'M-1-1L1 1M1-1L-1 1', star: 'M-1 0H1M0-1V1M-.8-.8L.8.8M.8-.8L-.8.8' };

function mark(shape: string, right: number, down: number, size: number, colour: string): string {
  const isOpen = shape.startsWith('open_') || shape === 'circle';
  const style = isOpen ? `fill="none" stroke="${colour}" stroke-width="1.5"` : `fill="${colour}"`;
  const polygon = corners[shape.replace('open_', '')];
  if (polygon) return `<polygon points="${polygon.map(([x, y]) => `${at(right + size * x)},${at(down + size * y)}`).join(' ')}" ${style}/>`;
  if (strokes[shape]) return `<path transform="translate(${at(right)} ${at(down)}) scale(${at(size)})" d="${strokes[shape]}" stroke="${colour}" stroke-width="${at(1.5 / size)}"/>`;
  return `<circle cx="${at(right)}" cy="${at(down)}" r="${at(size)}" ${style}/>`;
}

const radius = (size: number | undefined): number => 5 * (size ?? 0.7);

/** The stroke of a line, or of hatching. */
function strokeOf(layer: Layer & { dashes?: string; width?: number }): string {
  const width = layer.kind === 'hatching' ? 0.6 : (layer.width ?? 1.8);
  const dashes = layer.dashes?.split(',').map((length) => at(Number(length) * Math.max(0.8, width) * 0.7)).join(' ');
  return `fill="none" stroke="${layer.colour}" stroke-width="${width}"${dashes ? ` stroke-dasharray="${dashes}"` : ''}`;
}

function layerText(layer: Layer, x: Scale, y: Scale, bottom: number): string {
  switch (layer.kind) {
    case 'line':
    case 'hatching':
      return `<path d="${pathOf(layer.points, x, y, false)}" ${strokeOf(layer)} stroke-linejoin="round"/>`;
    case 'area':
      return `<path d="${pathOf(layer.points, x, y, true)}" fill="${layer.colour}"/>`;
    case 'marks': {
      let text = '';
      for (let i = 0; i + 1 < layer.points.length; i += 2) {
        const right = x(layer.points[i]!);
        const down = y(layer.points[i + 1]!);
        if (Number.isFinite(right) && Number.isFinite(down)) text += mark(layer.mark ?? 'disc', right, down, radius(layer.size), layer.colour);
      }
      return text;
    }
    case 'moving':
      return `<g class="moving" transform="translate(${at(x(layer.at[0]))} ${at(y(layer.at[1]))})">${mark('diamond', 0, 0, 6, layer.colour)}</g>`;
    case 'rule':
      return `<line x1="${at(x(layer.at))}" x2="${at(x(layer.at))}" y1="${frame.top}" y2="${bottom}" stroke="${layer.colour}" stroke-width="1.2"/>`;
  }
}

const ticsOf = (axis: PlotAxis, most: number): [string, number][] =>
  axis.tics ?? tics(axis.low, axis.high, most).map((value) => [short(value, 6), value]);

function axesText(plot: Plot, x: Scale, y: Scale, width: number, bottom: number, theme: Theme): string {
  let text = '';
  for (const [name, value] of ticsOf(plot.x, width < 460 ? 4 : 7)) {
    const right = at(x(value));
    if (name) text += `<line x1="${right}" x2="${right}" y1="${frame.top}" y2="${bottom}" stroke="${theme.grid}"/>`;
    text += `<text x="${right}" y="${bottom + 17}" text-anchor="middle" fill="${theme.faint}" font-size="12">${name}</text>`;
  }
  for (const [name, value] of ticsOf(plot.y, 6)) {
    const down = at(y(value));
    if (name) text += `<line y1="${down}" y2="${down}" x1="${frame.left}" x2="${width - frame.right}" stroke="${theme.grid}"/>`;
    text += `<text x="${frame.left - 7}" y="${Number(down) + 4}" text-anchor="end" fill="${theme.faint}" font-size="12">${name}</text>`;
  }
  const middle = (frame.left + width - frame.right) / 2;
  text += `<text x="${middle}" y="${bottom + 36}" text-anchor="middle" fill="${theme.ink}" font-size="13">${escapeText(plot.x.label)}</text>`;
  const centre = (frame.top + bottom) / 2;
  text += `<text x="16" y="${centre}" text-anchor="middle" fill="${theme.ink}" font-size="13" transform="rotate(-90 16 ${centre})">${escapeText(plot.y.label)}</text>`;
  return text;
}

/** The layers of the legend: the first of each name. */
const namedLayers = (layers: Layer[]): Layer[] =>
  layers.filter((layer, i) => 'name' in layer && layer.name && layers.findIndex((other) => 'name' in other && other.name === layer.name) === i);

function sampleOf(layer: Layer, right: number, middle: number, theme: Theme): string {
  const [from, to] = [right, right + 22];
  if (layer.kind === 'area') return `<rect x="${from}" y="${middle - 6}" width="22" height="12" fill="${layer.colour}" stroke="${theme.faint}" stroke-width="0.5"/>`;
  if (layer.kind === 'hatching') return `<path d="M${from} ${middle + 6}l6-12m2 12l6-12m2 12l6-12" ${strokeOf(layer)}/>`;
  if (layer.kind === 'marks') return mark(layer.mark ?? 'disc', from + 11, middle, radius(layer.size), layer.colour);
  if (layer.kind === 'moving') return mark('diamond', from + 11, middle, 5, layer.colour);
  return `<path d="M${from} ${middle}H${to}" ${strokeOf(layer)}/>`;
}

/** The entries in lines, and the height that they take. */
function legendText(layers: Layer[], top: number, width: number, theme: Theme): { text: string; height: number } {
  const line = 20;
  let text = '';
  let right = frame.left;
  let down = top;
  for (const layer of layers) {
    const name = 'name' in layer ? (layer.name ?? '') : '';
    const length = 30 + name.length * letter + 16;
    if (right > frame.left && right + length > width) {
      right = frame.left;
      down += line;
    }
    text += `${sampleOf(layer, right, down - 4, theme)}<text x="${right + 28}" y="${down}" fill="${theme.ink}" font-size="12.5">${escapeText(name)}</text>`;
    right += length;
  }
  return { text, height: layers.length > 0 ? down - top + line : 0 };
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
  const up = plot.y.logarithmic ? Math.max(to[1], plot.y.low) : to[1];
  picture.querySelector('.moving')?.setAttribute('transform', `translate(${at(x(to[0]))} ${at(y(up))})`);
}

/** The picture as SVG. */
export function draw(plot: Plot, theme: Theme, size: Size = {}): string {
  const { width, height, bottom, x, y } = layout(plot, size.width);
  const heading = size.isTitled ? (plot.subtitle ? 50 : 30) : 0;
  const legend = legendText(namedLayers(plot.layers), height + 6, width, theme);
  const total = height + legend.height + heading;
  const clip = `clip${++clips}`;
  const text = (layers: Layer[]): string => layers.map((layer) => layerText(layer, x, y, bottom)).join('');
  const words = (plot.texts ?? [])
    .map((one) => `<text x="${at(x(one.x))}" y="${at(y(one.y) + 4)}" fill="${one.colour}" font-size="12" text-anchor="middle" paint-order="stroke" stroke="${theme.paper}" stroke-width="3">${escapeText(one.text)}</text>`)
    .join('');
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
    `<g clip-path="url(#${clip})">${text(plot.layers.filter((layer) => !isMark(layer)))}${words}</g>` +
    `<rect x="${frame.left}" y="${frame.top}" width="${width - frame.left - frame.right}" height="${bottom - frame.top}" fill="none" stroke="${theme.faint}"/>` +
    `<g clip-path="url(#${clip}m)">${text(plot.layers.filter((layer) => isMark(layer) && !isApart(layer)))}</g>` +
    `${legend.text}</g></svg>` +
    (plot.layers.some(isApart) ? `<svg class="overlay" viewBox="0 0 ${width} ${total}" aria-hidden="true">${text(plot.layers.filter(isApart))}</svg>` : '')
  );
}
