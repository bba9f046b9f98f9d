// The figures of the thesis: points of the program of 1960 over the exact curves.
import type { Cards } from './cards';
import { type Lane, Overtaken } from './core';
import { byId } from './elements';
import { plotOf } from './pictures';
import type { PlotReply } from './replies';
import { wordsOf } from './words';

const figures = { first: 2, last: 15 };

export class Thesis {
  constructor(
    private readonly lane: Lane,
    private readonly cards: Cards,
    chosen: (figure: number) => void,
  ) {
    const list = byId<HTMLSelectElement>('figure');
    for (let number = figures.first; number <= figures.last; ++number) list.add(new Option(`figure ${number}`, String(number)));
    list.onchange = () => chosen(Number(list.value));
  }

  async show(figure: number): Promise<void> {
    byId<HTMLSelectElement>('figure').value = String(figure);
    this.cards.fade('figure');
    try {
      const { reply, numbers } = await this.lane.ask<PlotReply>({ ask: 'thesis', figure });
      byId('figure-title').textContent = reply.title;
      byId('figure-words').textContent = reply.subtitles.join('; ');
      this.cards.put('figure', plotOf(reply, numbers));
    } catch (error) {
      if (!(error instanceof Overtaken)) this.cards.blank('figure', wordsOf(error));
    }
  }
}
