// Two gears with their gap, moved by a trajectory. The gap is drawn as wide as the teeth permit; all
// angles are enlarged by the same factor, so that swing and gap are in proportion.
import { short } from './numbers';
import type { ShownMotion } from './replies';

/** A motion with its points, time and position from the reference by turns. */
export type Moving = Omit<ShownMotion, 'load' | 'motor'> & { load: Float64Array; motor: Float64Array };

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
  private motion: Moving | null = null;
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
    return this.motion?.load.at(-2) ?? 0;
  }

  /** Null: there is no motion. */
  take(motion: Moving | null): void {
    const share = this.endTime > 0 ? this.time / this.endTime : 0;
    this.motion = motion;
    const isEmpty = !motion || motion.load.length === 0;
    for (const part of [this.parts.play, this.parts.back, this.parts.on, this.parts.slider]) part.disabled = isEmpty;
    if (isEmpty) {
      this.pause();
      this.parts.words.textContent = motion?.reason ? `Not drawn: ${motion.reason}` : '';
      return;
    }
    this.show(share * this.endTime);
  }

  play(): void {
    if (this.endTime === 0) return;
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
    const times = (this.motion?.events ?? []).map(({ time }) => time);
    const tiny = 1e-9 * this.endTime;
    const next = direction > 0 ? times.find((time) => time > this.time + tiny) : times.findLast((time) => time < this.time - tiny);
    this.show(next ?? (direction > 0 ? this.endTime : 0));
  }

  private show(time: number): void {
    const motion = this.motion;
    if (!motion || motion.load.length === 0) return;
    this.time = time;
    const [load, motor] = [at(motion.load, time), at(motion.motor, time)];
    const scale = drawnGap / (motion.gap > 0 ? motion.gap : swing(motion.load) || 1);
    const degrees = (angle: number): string => ((angle * scale * 180) / Math.PI).toFixed(3);
    this.motor.setAttribute('transform', `translate(-${radius} 0) rotate(${degrees(motor)})`);
    this.load.setAttribute('transform', `translate(${radius} 0) scale(-1 1) rotate(${degrees(load)})`);
    this.parts.slider.value = String(time / (this.endTime || 1));
    this.parts.slider.setAttribute('aria-valuetext', `${short(time, 3)} ${motion.time_unit}`);
    const event = motion.events.findLast((one) => one.time <= time * (1 + 1e-12));
    const gap = motion.gap > 0 ? `The motor is at ${Math.round(100 * ((motor - load) / motion.gap + 0.5))} % of the gap.` : 'There is no backlash.';
    this.parts.words.textContent = `${short(time, 3)} ${motion.time_unit}: ${event ? `${event.what}; then ${event.mode_after || 'in contact'}` : 'start'}. ${gap}`;
    this.moved(time);
  }
}

/** The largest distance from the reference. */
const swing = (curve: Float64Array): number => curve.reduce((largest, value, i) => (i % 2 ? Math.max(largest, Math.abs(value)) : largest), 0);

/** The position at a time, between the points before and after it. */
function at(curve: Float64Array, time: number): number {
  let low = 0;
  let high = curve.length / 2 - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (curve[2 * middle]! <= time) low = middle;
    else high = middle - 1;
  }
  const next = Math.min(low + 1, curve.length / 2 - 1);
  const span = curve[2 * next]! - curve[2 * low]!;
  const share = span > 0 ? (time - curve[2 * low]!) / span : 0;
  return curve[2 * low + 1]! + share * (curve[2 * next + 1]! - curve[2 * low + 1]!);
}
