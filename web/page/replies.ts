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
