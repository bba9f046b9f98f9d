// Two gears with their gap, moved by a trajectory. The gap is drawn as wide as the teeth permit; all
// angles are enlarged by the same factor, so that swing and gap are in proportion.
import { short } from './numbers';
import type { Traces } from './pictures';

const teeth = 14;
const pitch = (2 * Math.PI) / teeth;
const drawnGap = 0.3 * pitch; // radians, face to face
const radius = 100;
const depth = 13;
/** Seconds that the motion takes on the screen. */
const shownDuration = 24;

const point = (angle: number, distance: number): string =>
  `${(distance * Math.cos(angle)).toFixed(2)} ${(distance * Math.sin(angle)).toFixed(2)}`;

/** The outline of a gear with a tooth, or a space, towards angle 0. */
function outline(isToothAtZero: boolean): string {
  const half = (pitch / 2 - drawnGap / 2) / 2; // of a tooth on the pitch circle
  const flank = 0.07;
  let path = '';
  for (let i = 0; i < teeth; ++i) {
    const middle = i * pitch + (isToothAtZero ? 0 : pitch / 2);
    const corners: [number, number][] = [
      [middle - half - flank, radius - depth], [middle - half + flank, radius + depth - 2],
      [middle + half - flank, radius + depth - 2], [middle + half + flank, radius - depth],
    ];
    for (const [angle, distance] of corners) path += `${path ? 'L' : 'M'}${point(angle, distance)}`;
  }
  return `${path}Z`;
}

export class GearView {
  private traces: Traces | null = null;
  private time = 0;
  private isPlaying = false;
  private before = 0;
  private readonly stillness = matchMedia('(prefers-reduced-motion: reduce)');
  private readonly motor: SVGGElement;
  private readonly load: SVGGElement;

  constructor(
    private readonly parts: {
      picture: SVGSVGElement;
      play: HTMLButtonElement;
      back: HTMLButtonElement;
      on: HTMLButtonElement;
      slider: HTMLInputElement;
      words: HTMLElement;
    },
    private readonly moved: (time: number) => void,
  ) {
    const group = (name: string): SVGGElement => parts.picture.querySelector(`.${name}`) as SVGGElement;
    this.motor = group('motor-gear');
    this.load = group('load-gear');
    this.motor.querySelector('path')!.setAttribute('d', outline(true));
    this.load.querySelector('path')!.setAttribute('d', outline(false));
    parts.play.onclick = () => (this.isPlaying ? this.pause() : this.play());
    parts.back.onclick = () => this.step(-1);
    parts.on.onclick = () => this.step(1);
    parts.slider.oninput = () => {
      this.pause();
      this.show(Number(parts.slider.value) * this.endTime);
    };
  }

  private get endTime(): number {
    const time = this.traces?.time;
    return time && time.length > 0 ? time[time.length - 1]! : 0;
  }

  take(traces: Traces): void {
    const share = this.endTime > 0 ? this.time / this.endTime : 0;
    this.traces = traces;
    const isEmpty = traces.time.length === 0;
    for (const part of [this.parts.play, this.parts.back, this.parts.on, this.parts.slider]) part.disabled = isEmpty;
    if (isEmpty) {
      this.pause();
      this.parts.words.textContent = traces.reason ? `Not drawn: ${traces.reason}` : '';
      return;
    }
    this.show(share * this.endTime);
  }

  /** Without a motion. */
  clear(): void {
    this.traces = null;
    this.pause();
    for (const part of [this.parts.play, this.parts.back, this.parts.on, this.parts.slider]) part.disabled = true;
    this.parts.words.textContent = '';
  }

  play(): void {
    if (!this.traces || this.endTime === 0) return;
    if (this.stillness.matches) return this.step(1);
    if (this.time >= this.endTime) this.time = 0;
    this.isPlaying = true;
    this.parts.play.textContent = 'Pause';
    this.before = performance.now();
    requestAnimationFrame((now) => this.frame(now));
  }

  pause(): void {
    this.isPlaying = false;
    this.parts.play.textContent = this.stillness.matches ? 'Next event' : 'Play slowly';
  }

  private frame(now: number): void {
    if (!this.isPlaying) return;
    const on = this.time + ((now - this.before) / 1000) * (this.endTime / shownDuration);
    this.before = now;
    this.show(Math.min(on, this.endTime));
    if (on >= this.endTime) return this.pause();
    requestAnimationFrame((next) => this.frame(next));
  }

  /** To the next event, or the one before. */
  private step(direction: 1 | -1): void {
    this.pause();
    const times = (this.traces?.events ?? []).map(([time]) => time);
    const tiny = 1e-9 * this.endTime;
    const next = direction > 0 ? times.find((time) => time > this.time + tiny) : times.findLast((time) => time < this.time - tiny);
    this.show(next ?? (direction > 0 ? this.endTime : 0));
  }

  private show(time: number): void {
    const traces = this.traces;
    if (!traces || traces.time.length === 0) return;
    this.time = time;
    const at = this.placeOf(time);
    const load = this.between(traces.load, at, time);
    const motor = this.between(traces.motor, at, time);
    const reference = this.between(traces.reference, at, time);
    const scale = drawnGap / (traces.gap > 0 ? traces.gap : this.swing() || 1);
    const degrees = (angle: number): string => ((angle * scale * 180) / Math.PI).toFixed(3);
    this.motor.setAttribute('transform', `translate(-${radius} 0) rotate(${degrees(motor - reference)})`);
    this.load.setAttribute('transform', `translate(${radius} 0) scale(-1 1) rotate(${degrees(load - reference)})`);
    this.parts.slider.value = String(time / (this.endTime || 1));
    this.parts.slider.setAttribute('aria-valuetext', `${short(time, 3)} ${traces.timeUnit}`);
    const event = traces.events.findLast(([when]) => when <= time * (1 + 1e-12));
    const gap = traces.gap > 0 ? `The motor is at ${Math.round(100 * ((motor - load) / traces.gap + 0.5))} % of the gap.` : 'There is no backlash.';
    this.parts.words.textContent = `${short(time, 3)} ${traces.timeUnit}: ${event ? `${event[1]}; then ${event[2] || 'in contact'}` : 'start'}. ${gap}`;
    this.moved(time);
  }

  /** The largest distance of the load from the reference. */
  private swing(): number {
    const { load, reference } = this.traces!;
    return load.reduce((largest, position, i) => Math.max(largest, Math.abs(position - reference[i]!)), 0);
  }

  /** The last index whose time is not after `time`. */
  private placeOf(time: number): number {
    const times = this.traces!.time;
    let low = 0;
    let high = times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle]! <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  private between(values: Float64Array, at: number, time: number): number {
    const times = this.traces!.time;
    const next = Math.min(at + 1, times.length - 1);
    const span = times[next]! - times[at]!;
    const share = span > 0 ? (time - times[at]!) / span : 0;
    return values[at]! + share * (values[next]! - values[at]!);
  }
}
