// What the core replies: web/core writes these, in the same words.

/** A column of numbers beside the JSON of a reply. */
export interface Column {
  at: number;
  count: number;
}

export interface Fault {
  path: string;
  /** Whether the path is that of a parameter, which can be typed. */
  is_parameter: boolean;
  value: string;
  permitted: string;
  where: string;
}

export interface Slider {
  low: number;
  high: number;
  logarithmic: boolean;
}

type Value = number | string | null | Value[];

export interface Parameter {
  path: string;
  kind: 'number' | 'choice' | 'list' | 'matrix' | 'file';
  meaning: string;
  value: Value;
  is_default: boolean;
  is_usual: boolean;
  is_required: boolean;
  choices?: string[];
  unit?: string;
  unit_in_si?: number;
  slider?: Slider;
}

export interface DriveReply {
  parameters: Parameter[];
  absent: { name: string; contents: string }[];
  is_normal_form: boolean;
  is_searched: boolean;
}

/** One motion: columns of all its points. */
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

/** The output of `gearlash limit-cycle --format json`, as far as the page reads it. */
interface Answer {
  certainty: { verdict: string };
  growth_at_rest: number | 'inf' | null;
  ceiling: null | {
    value: number | null;
    reason: string | null;
    /** Motion that reaches the torque limit ever again is not bounded. */
    below_limit: boolean;
  };
  cycles: { stability: string; amplitude: number }[];
}

export interface AnswerReply {
  level: 'coarse' | 'fine';
  means: 'closed form' | 'proof by energy' | 'followed' | 'one start' | 'search';
  is_complete: boolean;
  headline: string;
  report: string | null;
  answer: Answer;
  unit: string;
  unit_in_si: number;
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

export interface MarginsReply {
  hunts: boolean;
  is_known: boolean;
  texts: {
    parameter: string;
    description: string;
    /** Whether it is a parameter of the drive, which can be set. */
    is_setting: boolean;
    is_certified: boolean;
    present: string;
    below: string | null;
    above: string | null;
    searched: string;
    choices: string[];
  }[];
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
