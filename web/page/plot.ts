// Draws the core's plots as SVG: panels below each other, with axes, curves, areas, marks and a legend.
import { escapeText } from './numbers';
import type * as core from './records';

/** On white, as it is printed; a dark page inverts the whole picture. With enough contrast for text. */
const theme = { ink: '#1c2430', faint: '#5a6472', grid: '#e3e7ec', paper: '#ffffff', accent: '#7a3f8f' };

/** With its points: x and y by turns; NaN interrupts a line. */
export type Layer = Omit<core.Layer, 'points'> & { points: Float64Array };
export type Panel = Omit<core.Panel, 'layers'> & { layers: Layer[] };

/** A plot with its points, its axes as they are drawn, and a mark that moves: see moveMark(). */
export interface Plot {
  title: string;
  subtitle: string;
  /** For readers that do not see the picture. */
  description: string;
  columns: Panel[][];
  /** A named place, or an x alone across all panels. */
  moving: Place | null;
}

export interface Place {
  x: number;
  y?: number;
}

export const frame = { left: 74, right: 14, top: 12, between: 10, title: 22, bottom: 48 };
const letter = 7.2;

type Scale = (value: number) => number;

function scale(axis: core.PlotAxis, from: number, to: number): Scale {
  const map = axis.logarithmic ? Math.log : (value: number) => value;
  const low = map(axis.low!);
  const span = map(axis.high!) - low || 1;
  return (value) => from + ((map(value) - low) / span) * (to - from);
}

/** A panel in its place on the picture. */
interface Placed {
  panel: Panel;
  left: number;
  top: number;
  bottom: number;
  x: Scale;
  y: Scale;
  isLast: boolean;
}

/** All panels below each other; a column's last one has the numbers of its x axis. */
export function placed(plot: Plot, width: number): Placed[] {
  const usual = width * (width < 460 ? 0.8 : 0.66) - frame.top - frame.bottom;
  const least = 90; // px: room for the name of its axis
  const longest = Math.max(...plot.columns.flat().flatMap((panel) => panel.y.tics.map(({ text }) => text?.length ?? 0)));
  const left = Math.max(frame.left, Math.min(0.5 * width, 36 + letter * longest));
  let top = frame.top;
  return plot.columns.flatMap((column) =>
    column.map((panel, i) => {
      const isLast = i === column.length - 1;
      if (panel.title) top += frame.title;
      const place = { panel, left, top, bottom: Math.round(top + Math.max(least, (usual * panel.height) / 480)), isLast };
      top = place.bottom + (isLast ? frame.bottom : frame.between);
      return { ...place, x: scale(panel.x, left, width - frame.right), y: scale(panel.y, place.bottom, place.top) };
    }),
  );
}

const at = (value: number): string => (Math.round(value * 100) / 100).toString();

function pathOf(points: Float64Array, x: Scale, y: Scale, closed: boolean): string {
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

const radius = (size: number): number => 5 * size;

function strokeOf({ colour, width, dashes }: Layer): string {
  const lengths = dashes?.split(',').map((length) => at(Number(length) * Math.max(0.8, width) * 0.7)).join(' ');
  return `fill="none" stroke="${colour}" stroke-width="${width}"${lengths ? ` stroke-dasharray="${lengths}"` : ''}`;
}

function layerText(layer: Layer, x: Scale, y: Scale): string {
  if (layer.kind === 'area') return `<path d="${pathOf(layer.points, x, y, true)}" fill="${layer.colour}"/>`;
  if (layer.kind === 'line') return `<path d="${pathOf(layer.points, x, y, false)}" ${strokeOf(layer)} stroke-linejoin="round"/>`;
  let marks = '';
  for (let i = 0; i + 1 < layer.points.length; i += 2) {
    const [right, down] = [x(layer.points[i]!), y(layer.points[i + 1]!)];
    if (Number.isFinite(right) && Number.isFinite(down)) marks += mark(layer.mark, right, down, radius(layer.size), layer.colour);
  }
  return marks;
}

function axesText({ panel, left, top, bottom, x, y, isLast }: Placed, width: number): string {
  const right = width - frame.right;
  const half = (letter * (panel.x.label?.length ?? 0)) / 2;
  const [middle, centre] = [Math.min((left + right) / 2, Math.max(width / 2, width - half)), (top + bottom) / 2];
  let text = panel.title ? `<text x="${middle}" y="${top - 7}" text-anchor="middle" fill="${theme.faint}" font-size="12.5">${escapeText(panel.title)}</text>` : '';
  for (const tic of panel.x.tics) {
    const place = at(x(tic.at));
    if (tic.text && panel.x.has_grid) text += `<path d="M${place} ${top}V${bottom}" stroke="${theme.grid}"/>`;
    if (tic.text && isLast) text += `<text x="${place}" y="${bottom + 17}" text-anchor="middle" fill="${theme.faint}" font-size="12">${escapeText(tic.text)}</text>`;
  }
  for (const tic of panel.y.tics) {
    const place = at(y(tic.at));
    if (tic.text && panel.y.has_grid) text += `<path d="M${left} ${place}H${right}" stroke="${theme.grid}"/>`;
    if (tic.text) text += `<text x="${left - 7}" y="${Number(place) + 4}" text-anchor="end" fill="${theme.faint}" font-size="12">${escapeText(tic.text)}</text>`;
  }
  if (isLast) text += `<text x="${middle}" y="${bottom + 36}" text-anchor="middle" fill="${theme.ink}" font-size="13">${escapeText(panel.x.label ?? '')}</text>`;
  return text + `<text x="16" y="${centre}" text-anchor="middle" fill="${theme.ink}" font-size="13" transform="rotate(-90 16 ${centre})">${escapeText(panel.y.label ?? '')}</text>`;
}

let clips = 0;

/** A panel with all that is in it. Marks at the end of an axis are drawn whole, others outside not at all. */
function panelText(one: Placed, width: number): string {
  const { panel, left, top, bottom, x, y } = one;
  const clip = `clip${++clips}`;
  const rectangle = (margin: number, style = ''): string =>
    `<rect x="${left - margin}" y="${top - margin}" width="${width - left - frame.right + 2 * margin}" height="${bottom - top + 2 * margin}" ${style}/>`;
  const text = (isOf: (layer: Layer) => boolean): string => panel.layers.filter(isOf).map((layer) => layerText(layer, x, y)).join('');
  const words = panel.texts
    .map((word) => {
      const [right, down] = [at(x(word.at.x)), at(y(word.at.y))];
      return `<text transform="translate(${right} ${down}) rotate(${-word.slope})" y="4" fill="${word.colour}" font-size="${at(14 * word.size)}" font-weight="${word.is_bold ? 700 : 400}" text-anchor="middle" paint-order="stroke" stroke="${theme.paper}" stroke-width="3">${escapeText(word.text)}</text>`;
    })
    .join('');
  return (
    `<clipPath id="${clip}">${rectangle(0)}</clipPath><clipPath id="${clip}m">${rectangle(7)}</clipPath>${axesText(one, width)}` +
    `<g clip-path="url(#${clip})">${text((layer) => layer.kind !== 'marks')}${words}</g>${rectangle(0, `fill="none" stroke="${theme.faint}"`)}` +
    `<g clip-path="url(#${clip}m)">${text((layer) => layer.kind === 'marks')}</g>`
  );
}

/** Where a mark stands; one beside the panel is not shown. */
function placeOf({ panel, x, y }: Placed, to: Place): { transform: string; visibility: string } {
  const up = to.y !== undefined && panel.y.logarithmic ? Math.max(to.y, panel.y.low!) : to.y;
  const isBeside = to.x < panel.x.low! || to.x > panel.x.high!;
  return { transform: `translate(${at(x(to.x))} ${up === undefined ? 0 : at(y(up))})`, visibility: isBeside ? 'hidden' : 'visible' };
}

/** The mark that moves: a diamond, or a line across each panel. */
const movingText = (panels: Placed[], place: Place): string =>
  panels
    .map((one) => {
      const shape = place.y === undefined ? `<path d="M0 ${one.top}V${one.bottom}" stroke="${theme.accent}"/>` : mark('diamond', 0, 0, 6, theme.accent);
      const { transform, visibility } = placeOf(one, place);
      return `<g class="moving" transform="${transform}" visibility="${visibility}">${shape}</g>`;
    })
    .join('');

/** Moves the mark of a picture. */
export function moveMark(picture: Element, plot: Plot, to: Place): void {
  const panels = placed(plot, picture.querySelector('svg')?.viewBox.baseVal.width ?? 0);
  picture.querySelectorAll('.moving').forEach((element, i) => {
    for (const [name, value] of Object.entries(placeOf(panels[i]!, to))) element.setAttribute(name, value);
  });
}

/** The names of layers, each with a sample. */
function legendOf(plot: Plot): Map<string, (right: number, middle: number) => string> {
  const samples = new Map<string, (right: number, middle: number) => string>();
  for (const layer of plot.columns.flat().flatMap((panel) => panel.layers)) {
    if (!layer.in_legend || !layer.name) continue;
    samples.set(layer.name, (right, middle) => {
      if (layer.kind === 'area') return `<rect x="${right}" y="${middle - 6}" width="22" height="12" fill="${layer.colour}" stroke="${theme.faint}" stroke-width="0.5"/>`;
      if (layer.kind === 'marks') return mark(layer.mark, right + 11, middle, radius(layer.size), layer.colour);
      return `<path d="M${right} ${middle}h22" ${strokeOf(layer)}/>`;
    });
  }
  if (plot.moving?.y !== undefined) samples.set('you are here', (right, middle) => mark('diamond', right + 11, middle, 5, theme.accent));
  return samples;
}

/** The entries in lines, and the height that they take. */
function legendText(plot: Plot, top: number, width: number): { text: string; height: number } {
  const line = 20;
  let text = '';
  let right = frame.left;
  let down = top;
  const entries = legendOf(plot);
  for (const [name, sample] of entries) {
    const length = 30 + name.length * letter + 16;
    if (right > frame.left && right + length > width) {
      right = frame.left;
      down += line;
    }
    text += `${sample(right, down - 4)}<text x="${right + 28}" y="${down}" fill="${theme.ink}" font-size="12.5">${escapeText(name)}</text>`;
    right += length;
  }
  return { text, height: entries.size > 0 ? down - top + line : 0 };
}

export interface Size {
  /** Of the place on the screen, px: letters keep their size. */
  width?: number;
  /** With its title in it, as a file needs it. */
  isTitled?: boolean;
  /** With the moving mark in a picture of its own, so that its move does not paint the other again. */
  isMarkApart?: boolean;
}

/** The picture as SVG. */
export function draw(plot: Plot, size: Size = {}): string {
  const width = Math.max(320, Math.min(640, size.width || 640));
  const panels = placed(plot, width);
  const height = panels.at(-1)!.bottom + frame.bottom;
  const heading = size.isTitled ? (plot.subtitle ? 50 : 30) : 0;
  const legend = legendText(plot, height + 6, width);
  const total = height + legend.height + heading;
  const title = size.isTitled
    ? `<text x="${frame.left}" y="20" fill="${theme.ink}" font-size="15" font-weight="600">${escapeText(plot.title)}</text>` +
      `<text x="${frame.left}" y="40" fill="${theme.faint}" font-size="12.5">${escapeText(plot.subtitle)}</text>`
    : '';
  const isTime = plot.moving?.y === undefined; // which files do not show
  const moving = plot.moving && (size.isMarkApart || !isTime) ? movingText(panels, plot.moving) : '';
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${total}" role="img" aria-label="${escapeText(`${plot.title}. ${plot.description}`)}" font-family="system-ui, sans-serif">` +
    `<rect width="${width}" height="${total}" fill="${theme.paper}"/>${title}` +
    `<g transform="translate(0 ${heading})">${panels.map((one) => panelText(one, width)).join('')}${size.isMarkApart ? '' : moving}${legend.text}</g></svg>` +
    (size.isMarkApart && moving ? `<svg class="overlay" viewBox="0 0 ${width} ${total}" aria-hidden="true">${moving}</svg>` : '')
  );
}
