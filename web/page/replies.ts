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
  name_of_motor: string;
  role: 'subject' | 'background' | 'unstable' | 'to rest' | 'to hunting' | 'running away' | 'not known';
  is_cycle: boolean;
  /** Why the motion is not drawn. */
  reason?: string;
  columns?: Record<'time' | 'load' | 'load_speed' | 'motor' | 'motor_speed' | 'torque' | 'reference', Column> & {
    encoder?: Column;
  };
  /** Number of points, faces apart, a bounce, ends with an impact. */
  pieces?: [number, boolean, boolean, boolean][];
  /** Time, what happened, the mode after it. */
  events?: [number, string, string][];
}

export interface MotionPicture {
  title: string;
  subtitle: string;
  numbers: string;
  unit: string;
  /** 1/ω_n for a normal form without a natural frequency; so the next two. */
  time_unit: string;
  speed_unit: string;
  torque_unit: string;
  gap: number;
  torque_limit: number | null;
  motions: MotionCurve[];
  window: null | {
    positions: [number, number];
    speeds: [number, number];
    is_of_motor: boolean;
    borders: Column[];
  };
}

export interface AnswerReply extends AnswerNumbers {
  response?: MotionPicture;
  phase?: MotionPicture;
}

interface AxisFacts {
  path: string;
  label: string;
  logarithmic: boolean;
  unit_in_si: number;
}

export interface ChartAxis {
  label: string;
  logarithmic: boolean;
  low: number | null;
  high: number | null;
  tics: [string, number][];
}

export interface MapReply {
  title: string;
  subtitle: string;
  x: ChartAxis;
  y: ChartAxis;
  regions: { meaning: string; colour: string; outlines: Column[] }[];
  contours: { level: number; curves: Column[] }[];
  boundary: Column[];
  hatching: Column[];
  inner_boundary: Column[];
  inner_hatching: Column[];
  boundary_meaning: string;
  hatching_meaning: string;
  inner_meaning: string;
  axes: { x: AxisFacts; y: AxisFacts };
  is_complete: boolean;
}

export interface ChartReply {
  x: AxisFacts;
  low: number;
  high: number;
  y_label: string;
  branches: { stability: string; line: Column }[];
  irregular: Column;
  borders: { at: number; word: string }[];
  rests: [number, number][];
  searched: number;
  is_complete: boolean;
}

export interface FigureReply {
  title: string;
  subtitle: string;
  x: ChartAxis;
  y: ChartAxis;
  curves: { name: string; line: Column; marks: Column; ends: Column }[];
  line_meaning: string;
  mark_meaning: string;
  end_meaning: string;
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
