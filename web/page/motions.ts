// The motions of an answer: in the phase plane, over time, and as two gears.
import type { Cards } from './cards';
import { byId } from './elements';
import { GearView, type Moving } from './gears';
import { plotOf } from './pictures';
import { type AnswerReply, column, type Replied, type ShownMotion } from './replies';

const none = 'There is no motion to draw: it is proved without following one.';

export class Motions {
  private answer: Replied<AnswerReply> | null = null;
  private readonly list = byId<HTMLSelectElement>('gear-motion');
  private readonly title = byId('time-title');
  private readonly gears: GearView;

  constructor(private readonly cards: Cards) {
    const part = <T extends Element>(name: string): T => byId<T>(`gear-${name}`);
    this.gears = new GearView(
      { picture: part('picture'), play: part('play'), back: part('back'), on: part('on'), slider: part('time'), words: part('words') },
      (time) => this.cards.move('time', { x: time }),
    );
    this.list.onchange = () => this.follow();
  }

  show(answer: Replied<AnswerReply>): void {
    this.answer = answer;
    const { phase, motions } = answer.reply;
    this.listMotions(motions.map(({ name }) => name));
    if (phase) this.cards.put('phase', plotOf(phase, answer.numbers));
    else this.cards.blank('phase', none);
    this.follow();
  }

  /** Gears and traces follow the chosen motion. */
  follow(): void {
    if (!this.answer) return;
    const { reply, numbers } = this.answer;
    const motion = reply.motions[this.list.selectedIndex];
    this.title.textContent = motion ? `${motion.name}: ${motion.plot.subtitles[0] ?? ''}` : none;
    if (motion && !motion.reason) this.cards.put('time', plotOf(motion.plot, numbers, { x: 0 }));
    else this.cards.blank('time', motion ? `Not drawn: ${motion.reason}` : '');
    this.gears.take(motion ? this.movingOf(motion, numbers) : null);
  }

  private movingOf(motion: ShownMotion, numbers: Float64Array): Moving {
    return { ...motion, load: column(numbers, motion.load), motor: column(numbers, motion.motor) };
  }

  private listMotions(names: string[]): void {
    if (Array.from(this.list.options, (option) => option.text).join('|') === names.join('|')) return;
    const chosen = Math.max(0, this.list.selectedIndex);
    this.list.textContent = '';
    names.forEach((name, i) => this.list.add(new Option(name, String(i))));
    this.list.selectedIndex = Math.min(chosen, names.length - 1);
  }
}
