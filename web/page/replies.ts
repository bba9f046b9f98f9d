// What the core replies: by records.ts, which the build makes from web/core, with numbers beside it.
import type { Column } from './records';

export type { AnswerReply, DriveReply, MarginsReply, ParameterReply as Parameter, PictureReply, Plot as PlotReply, ShownFault as Fault, ShownMotion, Slider } from './records';

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
