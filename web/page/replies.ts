// What the core replies: pictures here, all else by records.ts, which the build makes from web/core.
import type { AnswerReply as AnswerNumbers } from './records';

export type { DriveReply, MarginsReply, ParameterReply as Parameter, ShownFault as Fault, Slider } from './records';

/** A column of numbers beside the JSON of a reply. */
export interface Column {
  at: number;
  count: number;
}

/** One motion: columns of all its points, and its pieces between events. */
export interface MotionCurve {
  name: string;
  /** Why it is not drawn. */
  reason?: string;
  columns?: Record<'time' | 'load' | 'motor' | 'torque' | 'reference', Column> & {
    encoder?: Column;
  };
  /** Time, what happened, the mode after it. */
  events?: [number, string, string][];
}

export interface MotionPicture {
  subtitle: string;
  unit: string;
  /** 1/ω_n for a normal form without a natural frequency; so the next. */
  time_unit: string;
  torque_unit: string;
  gap: number;
  torque_limit: number | null;
  motions: MotionCurve[];
}

export interface AnswerReply extends AnswerNumbers {
  response?: MotionPicture;
  /** The cycles. */
  cycles?: MotionPicture;
  phase?: PlotReply | null;
}

interface AxisFacts {
  path: string;
  label: string;
  logarithmic: boolean;
  unit_in_si: number;
}

interface LayerReply {
  kind: 'line' | 'area' | 'marks' | 'hatching';
  name: string;
  colour: string;
  width: number;
  dashes: string;
  mark: string;
  size: number;
  points: Column;
}

interface AxisReply {
  label: string;
  logarithmic: boolean;
  low: number;
  high: number;
  tics: [string, number][];
}

interface PanelReply {
  title: string;
  x: AxisReply;
  y: AxisReply;
  layers: LayerReply[];
  texts: { x: number; y: number; text: string; colour: string }[];
}

/** A picture as the core decides it. */
export interface PlotReply {
  title: string;
  subtitles: string[];
  /** Side by side; the panels of one below each other. */
  columns: PanelReply[][];
}

/** A map over two axes, or branches of cycles over one. */
export interface MapReply {
  plot: PlotReply;
  axes: { x: AxisFacts; y?: AxisFacts };
  is_complete: boolean;
}

/** A drive as the page holds it. */
export interface DriveText {
  toml: string;
  name: string;
  settings: [string, string][];
  /** Tables that it names, by name. */
  files?: Record<string, string>;
}

/** A reply with its numbers. */
export interface Replied<T> {
  reply: T;
  numbers: Float64Array;
}

export const column = (numbers: Float64Array, place: Column): Float64Array =>
  numbers.subarray(place.at, place.at + place.count);
