// The motions of an answer: in the phase plane, over time, and as two gears.
import type { Cards } from './cards';
import { csv } from './downloads';
import { GearView } from './gears';
import { plotOf, positionsOverTime, tracesOf, type Traces } from './pictures';
import type { Theme } from './plot';
import type { AnswerReply, MotionCurve, MotionPicture, Replied } from './replies';
import { TraceView } from './traces';

const byId = (id: string): unknown => document.getElementById(id);
const none = 'There is no motion to draw: it is proved without following one.';

/** Cycles whose points are known, with their places in the picture. */
const cyclesOf = (picture: MotionPicture | undefined): [MotionCurve, number][] =>
  (picture?.motions ?? []).map((motion, i): [MotionCurve, number] => [motion, i]).filter(([motion]) => motion.columns);

/** The columns of a motion as a table. */
function tracesData(traces: Traces): string {
  const { unit } = traces;
  const header = [`time_${traces.timeUnit}`, `load_${unit}`, `motor_${unit}`, `reference_${unit}`, `motor_torque_${traces.torqueUnit.replace(' ', '_')}`];
  const columns = [traces.time, traces.load, traces.motor, traces.reference, traces.torque];
  if (traces.encoder) {
    header.push(`encoder_${unit}`);
    columns.push(traces.encoder);
  }
  return csv(header, columns);
}

export class Motions {
  private answer: Replied<AnswerReply> | null = null;
  private readonly list = byId('gear-motion') as HTMLSelectElement;
  private readonly title = byId('time-title') as HTMLElement;
  private readonly gears: GearView;
  private readonly traces: TraceView;

  constructor(
    private readonly cards: Cards,
    private readonly theme: () => Theme,
  ) {
    this.traces = new TraceView(byId('traces') as HTMLElement);
    const part = <T>(name: string): T => byId(`gear-${name}`) as T;
    this.gears = new GearView(
      { picture: part('picture'), play: part('play'), back: part('back'), on: part('on'), slider: part('time'), words: part('words') },
      (time) => this.traces.point(time),
    );
    this.list.onchange = () => this.follow();
  }

  show(answer: Replied<AnswerReply>): void {
    this.answer = answer;
    const { phase } = answer.reply;
    this.listMotions();
    if (phase) this.cards.put('phase', { plot: (theme) => plotOf(phase, answer.numbers, theme) }, this.theme());
    else this.cards.blank('phase', none);
    this.follow();
  }

  /** Gears and traces follow the chosen motion. */
  follow(): void {
    if (!this.answer) return;
    const traces = this.chosen(this.answer);
    if (!traces) {
      this.title.textContent = none;
      this.traces.clear();
      this.gears.clear();
      this.cards.blank('time', '');
      return;
    }
    this.title.textContent = [this.list.selectedOptions[0]?.text, traces.title].filter(Boolean).join(': ');
    this.traces.show(traces, this.theme());
    this.gears.take(traces);
    this.cards.keep('time', { plot: (theme) => positionsOverTime(traces, theme), data: () => tracesData(traces) });
  }

  private listMotions(): void {
    const names = ['the way there', ...cyclesOf(this.answer!.reply.cycles).map(([motion]) => motion.name || 'cycle')];
    if (Array.from(this.list.options, (option) => option.text).join('|') === names.join('|')) return;
    const chosen = Math.max(0, this.list.selectedIndex);
    this.list.textContent = '';
    names.forEach((name, i) => this.list.add(new Option(name, String(i))));
    this.list.selectedIndex = Math.min(chosen, names.length - 1);
  }

  private chosen({ reply, numbers }: Replied<AnswerReply>): Traces | null {
    const cycle = cyclesOf(reply.cycles)[this.list.selectedIndex - 1];
    if (cycle && reply.cycles) return { ...tracesOf(reply.cycles, numbers, cycle[1]), title: cycle[0].name };
    return reply.response ? tracesOf(reply.response, numbers) : null;
  }
}
