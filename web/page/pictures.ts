// The pictures of an answer: what the core replied, as charts.
import { short } from './numbers';
import type { Layer, LegendEntry, Plot, PlotAxis, Theme } from './plot';
import type { ChartAxis, ChartReply, Column, FigureReply, MapReply, MotionCurve, MotionPicture } from './replies';
import { column } from './replies';

interface Range {
  low: number;
  high: number;
}

const nothing = (): Range => ({ low: Infinity, high: -Infinity });

function include(range: Range, values: ArrayLike<number>): void {
  for (let i = 0; i < values.length; ++i) {
    const value = values[i]!;
    if (value < range.low) range.low = value;
    if (value > range.high) range.high = value;
  }
}

/** With a margin, and never empty. */
function widened(range: Range, margin: number): Range {
  if (!(range.high >= range.low)) return { low: -1, high: 1 };
  const size = range.high - range.low || Math.max(Math.abs(range.high), 1e-12);
  return { low: range.low - margin * size, high: range.high + margin * size };
}

// ---- the phase plane ----------------------------------------------------------------------------

/** A shaft's position from the reference and its speed, by turns. */
function trajectory(motion: MotionCurve, numbers: Float64Array, shaft: 'load' | 'motor'): Float64Array {
  const columns = motion.columns!;
  const position = column(numbers, columns[shaft]);
  const speed = column(numbers, columns[`${shaft}_speed`]);
  const reference = column(numbers, columns.reference);
  const points = new Float64Array(2 * position.length);
  for (let i = 0; i < position.length; ++i) {
    points[2 * i] = position[i]! - reference[i]!;
    points[2 * i + 1] = speed[i]!;
  }
  return points;
}

/** Where the speed leaps from one piece to the next: the ends of the leaps, interrupted by NaN. */
function leaps(motion: MotionCurve, points: Float64Array): number[] {
  let fastest = 0;
  for (let i = 1; i < points.length; i += 2) fastest = Math.max(fastest, Math.abs(points[i]!));
  const found: number[] = [];
  let at = 0;
  for (const [count] of motion.pieces!) {
    if (at > 0 && Math.abs(points[at + 1]! - points[at - 1]!) > 1e-3 * fastest) {
      found.push(points[at - 2]!, points[at - 1]!, points[at]!, points[at + 1]!, NaN, NaN);
    }
    at += 2 * count;
  }
  return found;
}

/** The line without its leaps. */
function continuous(motion: MotionCurve, points: Float64Array, leaping: number[]): Float64Array {
  if (leaping.length === 0) return points;
  const result: number[] = [];
  let at = 0;
  let next = 0;
  for (const [count] of motion.pieces!) {
    if (at > 0 && points[at - 2] === leaping[next] && points[at - 1] === leaping[next + 1]) {
      result.push(NaN, NaN);
      next += 6;
    }
    for (let i = at; i < at + 2 * count; ++i) result.push(points[i]!);
    at += 2 * count;
  }
  return Float64Array.from(result);
}

/** Places at which an impact ends a piece. */
function impacts(motion: MotionCurve, points: Float64Array): number[] {
  const marks: number[] = [];
  let at = 0;
  for (const [count, , , endsWithImpact] of motion.pieces!) {
    at += 2 * count;
    if (endsWithImpact) marks.push(points[at - 2]!, points[at - 1]!);
  }
  return marks;
}

/** The area between both shafts while the faces are apart. */
function apartAreas(motion: MotionCurve, load: Float64Array, motor: Float64Array): number[][] {
  const areas: number[][] = [];
  let at = 0;
  for (const [count, isApart, isBounce] of motion.pieces!) {
    if (isApart && !isBounce && count > 1) {
      const area: number[] = [];
      for (let i = 0; i < count; ++i) area.push(load[at + 2 * i]!, load[at + 2 * i + 1]!);
      for (let i = count - 1; i >= 0; --i) area.push(motor[at + 2 * i]!, motor[at + 2 * i + 1]!);
      areas.push(area);
    }
    at += 2 * count;
  }
  return areas;
}

interface Line {
  colour: string;
  dash?: string;
  width: number;
}

function thinLine(role: string, theme: Theme): Line {
  if (role === 'to rest') return { colour: theme.good, dash: '3 3', width: 1 };
  if (role === 'to hunting') return { colour: theme.faint, width: 1 };
  if (role === 'running away') return { colour: theme.stop, dash: '10 3 3 3', width: 1 };
  return { colour: theme.faint, dash: '1 4', width: 1 };
}

const wordsOfRole: Record<string, string> = {
  'to rest': 'on its way to rest',
  'to hunting': 'on its way to hunting',
  'running away': 'running away',
  'not known': 'end not known',
};

export function phasePlane(picture: MotionPicture, numbers: Float64Array, theme: Theme): Plot {
  const layers: Layer[] = [];
  const lines: Layer[] = [];
  const marks: Layer[] = [];
  const legend: LegendEntry[] = [];
  const name = (entry: LegendEntry): void => {
    if (!legend.some((other) => other.name === entry.name)) legend.push(entry);
  };
  const positions = nothing();
  const speeds = nothing();
  for (const motion of picture.motions) {
    if (!motion.columns) continue;
    const load = trajectory(motion, numbers, 'load');
    const motor = trajectory(motion, numbers, 'motor');
    const isThin = !['subject', 'background', 'unstable'].includes(motion.role);
    if (isThin) {
      const line = thinLine(motion.role, theme);
      lines.push({ kind: 'line', points: picture.window?.is_of_motor ? motor : load, ...line });
      name({ name: wordsOfRole[motion.role] ?? motion.role, ...line });
      continue;
    }
    for (const points of [load, motor]) {
      include(positions, points.filter((_, i) => i % 2 === 0));
      include(speeds, points.filter((_, i) => i % 2 === 1));
    }
    if (motion.role === 'subject') {
      for (const area of apartAreas(motion, load, motor)) {
        layers.push({ kind: 'line', points: area, colour: theme.gap, width: 0, fill: theme.gap, closed: true });
        name({ name: 'faces apart', colour: theme.gap, mark: 'area' });
      }
    }
    const isUnstable = motion.role === 'unstable';
    const thick = motion.role === 'background' ? 1 : motion.is_cycle ? 2.6 : 1.8;
    const of = motion.name ? `, ${motion.name}` : '';
    const loadLine: Line = { colour: isUnstable ? theme.ink : theme.load, width: thick, ...(isUnstable ? { dash: '2 3' } : {}) };
    const motorLine: Line = { colour: isUnstable ? theme.faint : theme.motor, width: 0.8 * thick, dash: isUnstable ? '6 3 1 3' : '8 4' };
    for (const [points, line] of [[load, loadLine], [motor, motorLine]] as const) {
      const leaping = leaps(motion, points);
      lines.push({ kind: 'line', points: continuous(motion, points, leaping), ...line });
      if (leaping.length > 0) lines.push({ kind: 'line', points: leaping, colour: line.colour, width: 0.9, dash: '1 3' });
    }
    name({ name: `load${of}`, ...loadLine });
    name({ name: `motor${motion.name_of_motor ? `, ${motion.name_of_motor}` : ''}`, ...motorLine });
    if (motion.role === 'subject') {
      const places = [...impacts(motion, load), ...impacts(motion, motor)];
      if (places.length > 0 && places.length < 400) {
        marks.push({ kind: 'marks', points: places, colour: theme.ink, size: 3 });
        name({ name: 'impact', colour: theme.ink, mark: 'circle' });
      }
    }
  }
  for (const border of picture.window?.borders ?? []) {
    lines.push({ kind: 'line', points: column(numbers, border), colour: theme.stop, width: 2 });
    name({ name: 'border between starts', colour: theme.stop });
  }
  const window = picture.window;
  const x = window ? { low: window.positions[0], high: window.positions[1] } : widened(positions, 0.05);
  const y = window ? { low: window.speeds[0], high: window.speeds[1] } : widened(speeds, 0.05);
  return {
    title: picture.title,
    subtitle: picture.numbers,
    description: `Speed over position, relative to the reference. ${picture.motions.filter((m) => m.is_cycle).length} cycles are drawn.`,
    x: { label: `position from the reference (${picture.unit})`, ...x },
    y: { label: `speed (${picture.speed_unit})`, ...y },
    layers: [...layers, ...lines, ...marks],
    legend,
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
  const range = nothing();
  for (const values of [traces.load, traces.motor, traces.reference]) include(range, values);
  const line = (values: Float64Array, colour: string, width: number, dash?: string): Layer => ({
    kind: 'line', points: paired(traces.time, values), colour, width, ...(dash ? { dash } : {}),
  });
  const layers = [line(traces.reference, theme.faint, 1, '5 4')];
  const legend: LegendEntry[] = [
    { name: 'load', colour: theme.load },
    { name: 'motor', colour: theme.motor, dash: '8 4' },
    { name: 'reference', colour: theme.faint, dash: '5 4' },
  ];
  if (traces.encoder) {
    layers.push(line(traces.encoder, theme.accent, 1));
    legend.push({ name: 'encoder', colour: theme.accent });
  }
  layers.push(line(traces.load, theme.load, 2), line(traces.motor, theme.motor, 1.5, '8 4'));
  return {
    title: traces.title,
    description: 'Positions of both shafts over time.',
    x: { label: `time (${traces.timeUnit})`, low: 0, high: traces.time[traces.time.length - 1] || 1 },
    y: { label: `position (${traces.unit})`, ...widened(range, 0.05) },
    layers,
    legend,
  };
}

// ---- maps, charts and the figures of 1960 -------------------------------------------------------

function plotAxis(axis: ChartAxis, range?: Range): PlotAxis {
  return {
    label: axis.label,
    low: axis.low ?? range?.low ?? 0,
    high: axis.high ?? range?.high ?? 1,
    logarithmic: axis.logarithmic,
    tics: axis.tics,
  };
}

/** Colours of the regions on dark paper; the core's are for white paper. */
const darkRegions: Record<string, string> = {
  'comes to rest': '#1d3324', 'hunts if disturbed': '#453a12', hunts: '#4d2c14', 'runs away': '#4a1f31', 'not known': '#3a3a3a',
};

export function contourMap(map: MapReply, numbers: Float64Array, theme: Theme, here: [number, number] | null): Plot {
  const layers: Layer[] = [];
  const legend: LegendEntry[] = [];
  const isDark = theme.paper !== '#ffffff';
  for (const region of map.regions) {
    const colour = isDark ? (darkRegions[region.meaning] ?? '#3a3a3a') : region.colour;
    for (const outline of region.outlines) {
      layers.push({ kind: 'line', points: column(numbers, outline), colour, width: 0, fill: colour, closed: true });
    }
    if (region.outlines.length > 0) legend.push({ name: region.meaning, colour, mark: 'area' });
  }
  for (const hatch of map.hatching) layers.push({ kind: 'line', points: column(numbers, hatch), colour: theme.faint, width: 0.7 });
  for (const hatch of map.inner_hatching) layers.push({ kind: 'line', points: column(numbers, hatch), colour: theme.faint, width: 0.5, dash: '2 2' });
  const labels: Layer[] = [];
  for (const contour of map.contours) {
    for (const place of contour.curves) {
      const points = column(numbers, place);
      layers.push({ kind: 'line', points, colour: theme.load, width: 1.3 });
      const middle = 2 * Math.floor(points.length / 4);
      if (points.length >= 8) labels.push({ kind: 'text', x: points[middle]!, y: points[middle + 1]!, text: short(contour.level, 3), colour: theme.load });
    }
  }
  for (const border of map.boundary) layers.push({ kind: 'line', points: column(numbers, border), colour: theme.stop, width: 2.6 });
  for (const border of map.inner_boundary) layers.push({ kind: 'line', points: column(numbers, border), colour: theme.faint, width: 1.4, dash: '6 4' });
  layers.push(...labels);
  if (map.contours.length > 0) legend.push({ name: map.title.replace(/ \(.*/, '').toLowerCase(), colour: theme.load });
  if (map.boundary.length > 0) legend.push({ name: map.boundary_meaning, colour: theme.stop });
  if (map.hatching.length > 0) legend.push({ name: map.hatching_meaning, colour: theme.faint, mark: 'hatched' });
  if (map.inner_boundary.length > 0) legend.push({ name: map.inner_meaning, colour: theme.faint, dash: '6 4' });
  if (here) {
    layers.push({ kind: 'moving', at: here, colour: theme.accent });
    legend.push({ name: 'you are here', colour: theme.accent, mark: 'diamond' });
  }
  return {
    title: map.title,
    subtitle: map.subtitle,
    description: here ? `You are at ${short(here[0])}, ${short(here[1])}.` : '',
    x: plotAxis(map.x),
    y: plotAxis(map.y),
    layers,
    legend,
  };
}

export function branchChart(chart: ChartReply, numbers: Float64Array, theme: Theme, here: [number, number] | null): Plot {
  const layers: Layer[] = [];
  const legend: LegendEntry[] = [];
  const range = { low: 0, high: 0 };
  const positive = nothing();
  const name = (entry: LegendEntry): void => {
    if (!legend.some((other) => other.name === entry.name)) legend.push(entry);
  };
  for (const [from, to] of chart.rests) {
    layers.push({ kind: 'band', from, to, fill: theme.grid });
    name({ name: 'starts come to rest', colour: theme.grid, mark: 'area' });
  }
  for (const branch of chart.branches) {
    const points = column(numbers, branch.line);
    const amplitudes = points.filter((_, i) => i % 2 === 1);
    include(range, amplitudes);
    include(positive, amplitudes.filter((amplitude) => amplitude > 0));
    const isStable = branch.stability !== 'unstable';
    const style = { colour: isStable ? theme.load : theme.ink, ...(isStable ? {} : { dash: '4 4' }) };
    if (points.length > 2) layers.push({ kind: 'line', points, width: isStable ? 2.4 : 1.5, ...style });
    else layers.push({ kind: 'marks', points, colour: style.colour, size: 3, open: !isStable });
    name({ name: `${branch.stability} cycle`, ...style });
  }
  const irregular = column(numbers, chart.irregular);
  if (irregular.length > 0) {
    include(range, irregular.filter((_, i) => i % 2 === 1));
    layers.push({ kind: 'marks', points: irregular, colour: theme.motor, shape: 'cross', size: 4 });
    name({ name: 'did not repeat', colour: theme.motor, mark: 'cross' });
  }
  chart.borders.forEach((border, i) => {
    layers.push({ kind: 'rule', at: border.at, colour: theme.stop, dash: '4 3', text: border.word, row: i % 4 });
  });
  if (here) include(range, [here[1]]);
  // As the command line draws it: by ratio where amplitudes differ by more than a factor of 30.
  const isWide = positive.high > 30 * positive.low;
  const y = isWide
    ? { low: positive.low / 1.5, high: positive.high * 1.5, logarithmic: true }
    : { low: 0, high: range.high > 0 ? 1.08 * range.high : 1 };
  if (here) {
    layers.push({ kind: 'rule', at: here[0], colour: theme.accent });
    layers.push({ kind: 'moving', at: [here[0], isWide ? Math.max(here[1], y.low) : here[1]], colour: theme.accent });
    name({ name: 'you are here', colour: theme.accent, mark: 'diamond' });
  }
  return {
    title: `Amplitude over ${chart.x.label}`,
    subtitle: `${chart.searched} drives were analysed${chart.is_complete ? '' : '; stopped before the end'}`,
    description: `${chart.branches.length} branches of cycles, ${chart.borders.length} borders.`,
    x: { label: chart.x.label, low: chart.low, high: chart.high, logarithmic: chart.x.logarithmic },
    y: { label: chart.y_label, ...y },
    layers,
    legend,
  };
}

const dashes = ['', '8 4', '3 3', '10 3 3 3', '1 4', '14 4'];

export function figurePlot(figure: FigureReply, numbers: Float64Array, theme: Theme): Plot {
  const colours = [theme.load, theme.motor, theme.good, theme.accent, theme.ink, theme.stop];
  const layers: Layer[] = [];
  const legend: LegendEntry[] = [];
  const x = nothing();
  const y = nothing();
  figure.curves.forEach((curve, i) => {
    const colour = colours[i % colours.length]!;
    const dash = dashes[i % dashes.length]!;
    const line = column(numbers, curve.line);
    const marks = column(numbers, curve.marks);
    for (const points of [line, marks]) {
      include(x, points.filter((_, j) => j % 2 === 0));
      include(y, points.filter((_, j) => j % 2 === 1));
    }
    layers.push({ kind: 'line', points: line, colour, width: 1.8, ...(dash ? { dash } : {}) });
    layers.push({ kind: 'marks', points: marks, colour, size: 3 });
    layers.push({ kind: 'marks', points: column(numbers, curve.ends), colour, size: 4.5, open: true });
    legend.push({ name: curve.name, colour, ...(dash ? { dash } : {}) });
  });
  const kinds: [string, 'circle' | 'open'][] = [[figure.mark_meaning, 'circle'], [figure.end_meaning, 'open']];
  for (const [meaning, mark] of kinds) if (meaning) legend.push({ name: meaning, colour: theme.faint, mark });
  return {
    title: figure.title,
    subtitle: figure.subtitle,
    description: `${figure.curves.length} curves: ${figure.line_meaning}; points: ${figure.mark_meaning}.`,
    x: plotAxis(figure.x, widened(x, 0.03)),
    y: plotAxis(figure.y, widened(y, 0.05)),
    layers,
    legend,
  };
}
