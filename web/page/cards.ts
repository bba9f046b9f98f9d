// The pictures in their cards, with buttons that save them.
import { csv, save, savePng, svgFile } from './downloads';
import { draw, moveMark, type Plot, type Theme } from './plot';

/** What a card shows, made anew for each theme. */
export interface Card {
  plot: (theme: Theme) => Plot;
  /** Its data; default: the curves of its picture. */
  data?: () => string;
}

/** The curves of a picture as a table: number of the curve, x, y. */
function curvesOf(plot: Plot): string {
  const numbers: number[] = [];
  const x: number[] = [];
  const y: number[] = [];
  let curve = 0;
  for (const layer of plot.layers) {
    if (layer.kind !== 'line' && layer.kind !== 'marks') continue;
    ++curve;
    for (let i = 0; i + 1 < layer.points.length; i += 2) {
      if (!Number.isFinite(layer.points[i]!)) continue;
      numbers.push(curve);
      x.push(layer.points[i]!);
      y.push(layer.points[i + 1]!);
    }
  }
  const named = (label: string): string => `"${label.replaceAll('"', "'")}"`;
  return csv(['curve', named(plot.x.label), named(plot.y.label)], [numbers, x, y]);
}

export class Cards {
  private readonly cards = new Map<string, Card>();
  private readonly widths = new Map<string, number>();

  constructor(
    private readonly light: Theme,
    private readonly fileName: () => string,
    private readonly tell: (error: unknown) => void,
  ) {
    addEventListener('resize', () => this.widths.clear());
  }

  /** Shows the card, drawn in `theme`. */
  put(name: string, card: Card, theme: Theme): void {
    this.keep(name, card);
    const place = this.place(name);
    place.classList.remove('stale');
    const isOnPaper = place.classList.contains('for-print');
    place.innerHTML = draw(card.plot(isOnPaper ? this.light : theme), isOnPaper ? this.light : theme, { width: isOnPaper ? 640 : this.widthOf(name), isMarkApart: true });
  }

  /** The same for a card that draws itself. */
  keep(name: string, card: Card): void {
    this.cards.set(name, card);
    this.addButtons(name);
  }

  /** Moves the mark of the card, which was drawn before. `card` draws it with the mark at its new place. */
  move(name: string, card: Card, plot: Plot, to: [number, number]): void {
    this.cards.set(name, card);
    moveMark(this.place(name), plot, to);
  }

  /** Words in place of the picture. */
  blank(name: string, why: string): void {
    this.cards.delete(name);
    const place = this.place(name);
    place.classList.remove('stale');
    place.textContent = why;
    document.querySelector(`#card-${name} .buttons`)?.remove();
  }

  /** Marks the picture as that of another drive, until the next one. */
  fade(name: string): void {
    this.place(name).classList.add('stale');
  }

  /** Pictures on the screen that draw themselves have one for paper beside them. */
  redraw(theme: Theme): void {
    for (const [name, card] of this.cards) {
      const isStale = this.place(name).classList.contains('stale');
      this.put(name, card, theme);
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
    const add = (kind: string, does: (card: Card, file: string) => void): void => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = kind;
      button.setAttribute('aria-label', `${article.querySelector('h2')?.textContent || 'Figure'} as ${kind}`);
      button.onclick = () => does(this.cards.get(name)!, `${this.fileName()}-${name}.${kind.toLowerCase()}`);
      line.append(button);
    };
    add('SVG', (card, file) => save(file, svgFile(card.plot(this.light)), 'image/svg+xml'));
    add('PNG', (card, file) => void savePng(file, card.plot(this.light)).catch(this.tell));
    add('CSV', (card, file) => save(file, card.data ? card.data() : curvesOf(card.plot(this.light)), 'text/csv'));
    article.append(line);
  }
}
