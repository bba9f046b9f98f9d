// Positions and torque over time: uPlot, with a cursor that both share and with zoom.
import uPlot from 'uplot';

import { short } from './numbers';
import type { Traces } from './pictures';
import type { Theme } from './plot';

const height = { positions: 230, torque: 150 };

export class TraceView {
  private positions: uPlot | null = null;
  private torque: uPlot | null = null;
  private shown: Traces | null = null;
  private shape = '';

  constructor(private readonly place: HTMLElement) {
    new ResizeObserver(() => this.resize()).observe(place);
  }

  show(traces: Traces, theme: Theme): void {
    this.shown = traces;
    if (traces.reason) {
      this.clear();
      this.place.textContent = `Not drawn: ${traces.reason}`;
      return;
    }
    const lines: [number[], number[], number[], number[], (number[] | null)?] = [
      traces.time, traces.reference, traces.load, traces.motor,
    ] as unknown as [number[], number[], number[], number[]];
    if (traces.encoder) lines.push(traces.encoder as unknown as number[]);
    const shape = JSON.stringify([traces.unit, traces.timeUnit, traces.encoder !== null, traces.torqueLimit, theme.paper]);
    if (!this.positions || !this.torque || shape !== this.shape) {
      this.shape = shape;
      this.make(traces, theme, lines as uPlot.AlignedData);
    } else {
      this.positions.setData(lines as uPlot.AlignedData);
      this.torque.setData([traces.time, traces.torque] as unknown as uPlot.AlignedData);
    }
  }

  /** Moves the cursor to a time. */
  point(time: number): void {
    if (!this.positions || !this.shown) return;
    const left = this.positions.valToPos(time, 'x');
    this.positions.setCursor({ left, top: 10 }, false);
    this.torque?.setCursor({ left, top: 10 }, false);
  }

  /** Without a motion. */
  clear(): void {
    this.positions?.destroy();
    this.torque?.destroy();
    this.positions = this.torque = null;
    this.place.textContent = '';
  }

  private make(traces: Traces, theme: Theme, lines: uPlot.AlignedData): void {
    this.clear();
    const time = `time (${traces.timeUnit})`;
    const torque = `torque (${traces.torqueUnit})`;
    const width = Math.max(280, this.place.clientWidth);
    const axis = { stroke: theme.faint, grid: { stroke: theme.grid, width: 1 }, ticks: { stroke: theme.grid } };
    const sync = { key: 'gearlash' };
    const value = (_: uPlot, number: number | null): string => (number === null ? '–' : short(number));
    const common = {
      width,
      cursor: { sync, drag: { x: true, y: false } },
      scales: { x: { time: false } },
    };
    const series: uPlot.Series[] = [
      { label: time, value },
      { label: 'reference', stroke: theme.faint, dash: [5, 4], width: 1, value },
      { label: 'load', stroke: theme.load, width: 2, value },
      { label: 'motor', stroke: theme.motor, dash: [8, 4], width: 1.5, value },
    ];
    if (traces.encoder) series.push({ label: 'encoder', stroke: theme.accent, width: 1, value });
    this.positions = new uPlot(
      { ...common, height: height.positions, series, axes: [{ ...axis, label: time, labelSize: 18 }, { ...axis, size: 64, label: `position (${traces.unit})`, labelSize: 18 }] },
      lines,
      this.place,
    );
    const limit = traces.torqueLimit;
    this.torque = new uPlot(
      {
        ...common,
        height: height.torque,
        series: [{ label: time, value }, { label: limit === null ? torque : `${torque}, limit ±${short(limit)}`, stroke: theme.good, width: 1.5, value }],
        axes: [{ ...axis, label: time, labelSize: 18 }, { ...axis, size: 64, label: torque, labelSize: 18 }],
      },
      [traces.time, traces.torque] as unknown as uPlot.AlignedData,
      this.place,
    );
  }

  private resize(): void {
    const width = Math.max(280, this.place.clientWidth);
    this.positions?.setSize({ width, height: height.positions });
    this.torque?.setSize({ width, height: height.torque });
  }
}
