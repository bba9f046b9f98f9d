// The pictures in their cards: read and narrowed by the pointer, with buttons that save them.
import { csv, save, savePng, svgFile } from './downloads';
import { addButton, made } from './elements';
import { draw, moveMark, type Place, type Plot } from './plot';
import type { PlotAxis } from './records';
import { isOfTime, narrowed, type Pointed, readingsAt, type Spot, spotAt, spotOfTime } from './reading';

/** The curves of a picture as a table: panel and name of the curve, x, y. */
function curvesOf(plot: Plot): string {
  const [curves, x, y]: [string[], number[], number[]] = [[], [], []];
  const quoted = (text: string): string => `"${text.replaceAll('"', "'")}"`;
  const inUnit = ({ name, unit }: PlotAxis): string => `${name ?? ''}${unit ? ` (${unit})` : ''}`;
  for (const panel of plot.columns.flat()) {
    for (const [i, { kind, name, points }] of panel.layers.entries()) {
      if (kind === 'area') continue;
      for (let at = 0; at + 1 < points.length; at += 2) {
        if (!Number.isFinite(points[at]!)) continue;
        curves.push(quoted(`${inUnit(panel.y)}: ${name || i + 1}`));
        x.push(points[at]!);
        y.push(points[at + 1]!);
      }
    }
  }
  return csv(['curve', quoted(inUnit(plot.columns[0]![0]!.x)), 'value'], [curves, x, y]);
}

/** Pixels of a picture: less is a click. */
const leastDrag = 5;

const bandText = ({ right, top, bottom }: Pointed, to: Pointed): string =>
  `<rect class="band" x="${Math.min(right, to.right)}" y="${top}" width="${Math.abs(to.right - right)}" height="${bottom - top}"/>`;

export class Cards {
  /** As they are shown. */
  private readonly plots = new Map<string, Plot>();
  /** Of those that show a part of the time. */
  private readonly wholes = new Map<string, Plot>();
  private readonly widths = new Map<string, number>();

  constructor(
    private readonly fileName: () => string,
    private readonly tell: (error: unknown) => void,
  ) {
    addEventListener('resize', () => this.widths.clear());
    addEventListener('keydown', ({ key }) => key === 'Escape' && this.wholes.forEach((_, name) => this.widen(name)));
  }

  /** Shows the picture. */
  put(name: string, plot: Plot): void {
    this.wholes.delete(name);
    this.addButtons(name);
    this.place(name).classList.remove('stale');
    this.show(name, plot);
    this.tellReadings(name, null);
  }

  /** Moves the mark of a picture. */
  move(name: string, to: Place): void {
    const plot = this.plots.get(name);
    if (!plot) return;
    plot.moving = to;
    moveMark(this.place(name), plot, to);
    if (to.y === undefined) this.tellReadings(name, spotOfTime(plot, to.x));
  }

  /** Words in place of the picture. */
  blank(name: string, why: string): void {
    this.plots.delete(name);
    this.wholes.delete(name);
    const place = this.place(name);
    place.classList.remove('stale');
    place.textContent = why;
    document.querySelector(`#card-${name} .buttons`)?.remove();
  }

  /** Marks the picture as that of another drive, until the next one. */
  fade(name: string): void {
    this.place(name).classList.add('stale');
  }

  /** Asking the browser for a width makes it lay out the page. */
  private widthOf(name: string): number {
    const known = this.widths.get(name);
    if (known) return known;
    const width = this.place(name).clientWidth;
    this.widths.set(name, width);
    return width;
  }

  private place(name: string): HTMLElement {
    return document.querySelector<HTMLElement>(`#card-${name} .picture`)!;
  }

  private show(name: string, plot: Plot): void {
    this.plots.set(name, plot);
    this.place(name).innerHTML = draw(plot, { width: this.widthOf(name), isMarkApart: true });
  }

  private tellReadings(name: string, spot: Spot | null): void {
    const words = document.querySelector(`#card-${name} .readings`);
    if (words) words.textContent = spot ? readingsAt(this.plots.get(name)!, spot) : '';
  }

  private narrow(name: string, column: number, from: number, to: number): void {
    const plot = this.plots.get(name)!;
    if (!this.wholes.has(name)) this.wholes.set(name, plot);
    this.show(name, narrowed(plot, column, Math.min(from, to), Math.max(from, to)));
  }

  private widen(name: string): void {
    const whole = this.wholes.get(name);
    if (whole) this.show(name, { ...whole, moving: this.plots.get(name)!.moving });
    this.wholes.delete(name);
  }

  /** The pointer reads the curves; dragged along a time it narrows it, and a double click widens it again. */
  private listen(name: string): void {
    const place = this.place(name);
    const spotOf = (clientX: number, clientY: number): Pointed | null => {
      const [plot, svg] = [this.plots.get(name), place.querySelector('svg')];
      if (!plot || !svg) return null; // words are in its place
      const point = new DOMPoint(clientX, clientY).matrixTransform(svg.getScreenCTM()!.inverse());
      return spotAt(plot, svg.viewBox.baseVal.width, point);
    };
    let begun: { spot: Pointed; clientY: number } | null = null;
    const spotOfDrag = ({ clientX, clientY }: PointerEvent): Pointed | null => spotOf(clientX, begun?.clientY ?? clientY);
    const end = (): void => {
      begun = null;
      place.querySelector('.band')?.remove();
    };
    place.onpointerdown = (event) => {
      const spot = spotOf(event.clientX, event.clientY);
      if (event.button !== 0 || !spot || !isOfTime(spot.panel)) return;
      begun = { spot, clientY: event.clientY };
      place.setPointerCapture(event.pointerId);
    };
    place.onpointermove = (event) => {
      const spot = spotOfDrag(event);
      this.tellReadings(name, spot);
      place.querySelector('.band')?.remove();
      if (begun && spot) place.querySelector('svg')!.insertAdjacentHTML('beforeend', bandText(begun.spot, spot));
    };
    place.onpointerup = (event) => {
      const [from, to] = [begun?.spot, spotOfDrag(event)];
      end();
      if (from && to && Math.abs(to.right - from.right) > leastDrag) this.narrow(name, from.column, from.x, to.x);
    };
    place.onpointercancel = end;
    place.ondblclick = () => this.widen(name);
  }

  private addButtons(name: string): void {
    const article = document.getElementById(`card-${name}`)!;
    if (article.querySelector('.buttons')) return;
    const line = made('p', { className: 'buttons' });
    const add = (kind: string, does: (plot: Plot, file: string) => void): void => {
      const button = addButton(line, kind, () => does(this.plots.get(name)!, `${this.fileName()}-${name}.${kind.toLowerCase()}`));
      button.setAttribute('aria-label', `${article.querySelector('h2')?.textContent || 'Figure'} as ${kind}`);
    };
    add('SVG', (plot, file) => save(file, svgFile(plot), 'image/svg+xml'));
    add('PNG', (plot, file) => void savePng(file, plot).catch(this.tell));
    add('CSV', (plot, file) => save(file, curvesOf(plot), 'text/csv'));
    line.append(made('span', { className: 'readings' }));
    article.append(line);
    this.listen(name);
  }
}
