// The pictures of an answer: those that the core decides, and the traces over time.
import { short } from './numbers';
import type { Layer, Plot, Theme } from './plot';
import type { Column, MotionPicture, PlotReply } from './replies';
import { column } from './replies';

/** A colour for white paper, or the same hue for a dark screen. */
function onPaper(colour: string, theme: Theme): string {
  if (theme.paper === '#ffffff') return colour;
  const [red, green, blue] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255) as [number, number, number];
  const [high, low] = [Math.max(red, green, blue), Math.min(red, green, blue)];
  const lightness = (high + low) / 2;
  const spread = high - low;
  const saturation = spread === 0 ? 0 : spread / (1 - Math.abs(2 * lightness - 1));
  const sixth = spread === 0 ? 0 : high === red ? (green - blue) / spread : high === green ? 2 + (blue - red) / spread : 4 + (red - green) / spread;
  const darkest = 0.12;
  return `hsl(${Math.round(60 * sixth)} ${Math.round(80 * saturation)}% ${Math.round(100 * (1 - (1 - darkest) * lightness))}%)`;
}

/** A picture of one panel, with a mark of the present drive. */
export function plotOf(reply: PlotReply, numbers: Float64Array, theme: Theme, here: [number, number] | null = null): Plot {
  const { x, y, layers, texts } = reply.columns[0]![0]!;
  const drawn: Layer[] = layers.map((layer) => ({ ...layer, colour: onPaper(layer.colour, theme), points: column(numbers, layer.points) }));
  const place: [number, number] | null = here && [here[0], y.logarithmic ? Math.max(here[1], y.low) : here[1]];
  if (place) drawn.push({ kind: 'moving', name: 'you are here', at: place, colour: theme.accent });
  return {
    title: reply.title,
    subtitle: reply.subtitles.join('; '),
    description: (place ? `You are at ${short(place[0])}, ${short(place[1])}. ` : '') + [...new Set(layers.map((layer) => layer.name))].filter(Boolean).join(', '),
    x,
    y,
    layers: drawn,
    texts: texts.map((text) => ({ ...text, colour: onPaper(text.colour, theme) })),
  };
}

// ---- over time ----------------------------------------------------------------------------------

/** The columns of the first motion, for traces. */
export interface Traces {
  unit: string;
  timeUnit: string;
  torqueUnit: string;
  time: Float64Array;
  load: Float64Array;
  motor: Float64Array;
  reference: Float64Array;
  torque: Float64Array;
  encoder: Float64Array | null;
  gap: number;
  torqueLimit: number | null;
  events: [number, string, string][];
  /** Why there is nothing to draw. */
  reason: string;
  title: string;
}

export function tracesOf(picture: MotionPicture, numbers: Float64Array, index = 0): Traces {
  const motion = picture.motions[index];
  const of = (place: Column | undefined): Float64Array => (place ? column(numbers, place) : new Float64Array());
  return {
    unit: picture.unit,
    timeUnit: picture.time_unit,
    torqueUnit: picture.torque_unit,
    time: of(motion?.columns?.time),
    load: of(motion?.columns?.load),
    motor: of(motion?.columns?.motor),
    reference: of(motion?.columns?.reference),
    torque: of(motion?.columns?.torque),
    encoder: motion?.columns?.encoder ? of(motion.columns.encoder) : null,
    gap: picture.gap,
    torqueLimit: picture.torque_limit,
    events: motion?.events ?? [],
    reason: motion?.reason ?? (motion ? '' : 'there is no motion to draw'),
    title: picture.subtitle || 'after a step of the reference',
  };
}

const paired = (time: Float64Array, values: Float64Array): Float64Array => {
  const points = new Float64Array(2 * time.length);
  for (let i = 0; i < time.length; ++i) {
    points[2 * i] = time[i]!;
    points[2 * i + 1] = values[i]!;
  }
  return points;
};

export function positionsOverTime(traces: Traces, theme: Theme): Plot {
  const line = (name: string, values: Float64Array, colour: string, width: number, dashes = ''): Layer => ({
    kind: 'line', name, points: paired(traces.time, values), colour, width, dashes,
  });
  const shown = [traces.load, traces.motor, traces.reference];
  const low = Math.min(...shown.map((values) => values.reduce((least, value) => Math.min(least, value), Infinity)));
  const high = Math.max(...shown.map((values) => values.reduce((most, value) => Math.max(most, value), -Infinity)));
  const room = 0.05 * (high - low || Math.max(Math.abs(high), 1e-12));
  const encoder = traces.encoder ? [line('encoder', traces.encoder, theme.accent, 1)] : [];
  return {
    title: traces.title,
    description: 'Positions of both shafts over time.',
    x: { label: `time (${traces.timeUnit})`, low: 0, high: traces.time[traces.time.length - 1] || 1 },
    y: { label: `position (${traces.unit})`, low: low - room, high: high + room },
    layers: [
      line('reference', traces.reference, theme.faint, 1, '5,4'),
      ...encoder,
      line('load', traces.load, theme.load, 2),
      line('motor', traces.motor, theme.motor, 1.5, '8,4'),
    ],
  };
}
