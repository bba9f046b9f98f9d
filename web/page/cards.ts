// The pictures in their cards, with buttons that save them.
import { csv, save, savePng, svgFile } from './downloads';
import { addButton } from './elements';
import { draw, moveMark, type Place, type Plot } from './plot';

/** The curves of a picture as a table: panel and name of the curve, x, y. */
function curvesOf(plot: Plot): string {
  const [curves, x, y]: [string[], number[], number[]] = [[], [], []];
  const quoted = (text: string): string => `"${text.replaceAll('"', "'")}"`;
  for (const panel of plot.columns.flat()) {
    for (const [i, { kind, name, points }] of panel.layers.entries()) {
      if (kind === 'area') continue;
      for (let at = 0; at + 1 < points.length; at += 2) {
        if (!Number.isFinite(points[at]!)) continue;
        curves.push(quoted(`${panel.y.name ?? ''}: ${name ?? i + 1}`));
        x.push(points[at]!);
        y.push(points[at + 1]!);
      }
    }
  }
  return csv(['curve', quoted(plot.columns[0]![0]!.x.name ?? ''), 'value'], [curves, x, y]);
}

export class Cards {
  private readonly plots = new Map<string, Plot>();
  private readonly widths = new Map<string, number>();

  constructor(
    private readonly fileName: () => string,
    private readonly tell: (error: unknown) => void,
  ) {
    addEventListener('resize', () => this.widths.clear());
  }

  /** Shows the picture. */
  put(name: string, plot: Plot): void {
    this.plots.set(name, plot);
    this.addButtons(name);
    const place = this.place(name);
    place.classList.remove('stale');
    place.innerHTML = draw(plot, { width: this.widthOf(name), isMarkApart: true });
  }

  /** Moves the mark of a picture. */
  move(name: string, to: Place): void {
    const plot = this.plots.get(name);
    if (!plot) return;
    plot.moving = to;
    moveMark(this.place(name), plot, to);
  }

  /** Words in place of the picture. */
  blank(name: string, why: string): void {
    this.plots.delete(name);
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

  private addButtons(name: string): void {
    const article = document.getElementById(`card-${name}`)!;
    if (article.querySelector('.buttons')) return;
    const line = document.createElement('p');
    line.className = 'buttons';
    const add = (kind: string, does: (plot: Plot, file: string) => void): void => {
      const button = addButton(line, kind, () => does(this.plots.get(name)!, `${this.fileName()}-${name}.${kind.toLowerCase()}`));
      button.setAttribute('aria-label', `${article.querySelector('h2')?.textContent || 'Figure'} as ${kind}`);
    };
    add('SVG', (plot, file) => save(file, svgFile(plot), 'image/svg+xml'));
    add('PNG', (plot, file) => void savePng(file, plot).catch(this.tell));
    add('CSV', (plot, file) => save(file, curvesOf(plot), 'text/csv'));
    article.append(line);
  }
}
