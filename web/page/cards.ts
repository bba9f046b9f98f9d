// The pictures in their cards, with buttons that save them.
import { csv, save, savePng, svgFile } from './downloads';
import { draw, moveMark, type Place, type Plot, type Theme } from './plot';

/** What a card shows, made anew for each theme. */
export type Picture = (theme: Theme) => Plot;

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
  private readonly cards = new Map<string, Picture>();
  /** The plots on the page, whose marks can be moved. */
  private readonly shown = new Map<string, Plot>();
  private readonly widths = new Map<string, number>();

  constructor(
    private readonly light: Theme,
    private readonly fileName: () => string,
    private readonly tell: (error: unknown) => void,
  ) {
    addEventListener('resize', () => this.widths.clear());
  }

  /** Shows the picture, drawn in `theme`. */
  put(name: string, picture: Picture, theme: Theme): void {
    this.cards.set(name, picture);
    this.addButtons(name);
    const place = this.place(name);
    place.classList.remove('stale');
    const plot = picture(theme);
    this.shown.set(name, plot);
    place.innerHTML = draw(plot, theme, { width: this.widthOf(name), isMarkApart: true });
  }

  /** Moves the mark of a picture; `picture` draws it with the mark at its new place. */
  move(name: string, to: Place, picture?: Picture): void {
    const plot = this.shown.get(name);
    if (!plot) return;
    if (picture) this.cards.set(name, picture);
    moveMark(this.place(name), plot, to);
  }

  /** Words in place of the picture. */
  blank(name: string, why: string): void {
    this.cards.delete(name);
    this.shown.delete(name);
    const place = this.place(name);
    place.classList.remove('stale');
    place.textContent = why;
    document.querySelector(`#card-${name} .buttons`)?.remove();
  }

  /** Marks the picture as that of another drive, until the next one. */
  fade(name: string): void {
    this.place(name).classList.add('stale');
  }

  redraw(theme: Theme): void {
    for (const [name, picture] of this.cards) {
      const isStale = this.place(name).classList.contains('stale');
      this.put(name, picture, theme);
      if (isStale) this.fade(name);
    }
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
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = kind;
      button.setAttribute('aria-label', `${article.querySelector('h2')?.textContent || 'Figure'} as ${kind}`);
      button.onclick = () => does(this.cards.get(name)!(this.light), `${this.fileName()}-${name}.${kind.toLowerCase()}`);
      line.append(button);
    };
    add('SVG', (plot, file) => save(file, svgFile(plot), 'image/svg+xml'));
    add('PNG', (plot, file) => void savePng(file, plot).catch(this.tell));
    add('CSV', (plot, file) => save(file, curvesOf(plot), 'text/csv'));
    article.append(line);
  }
}
