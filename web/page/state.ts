// The whole state of the page, in its address.
import type { DriveText } from './replies';

export interface State {
  drive: DriveText;
  /** The example that the drive is from, or ''. */
  example: string;
  view: 'explore' | 'story' | 'thesis';
  /** Of the story, from 1. */
  step: number;
  /** Of the thesis. */
  figure: number;
  /** Parameters on the axes of the map; '' for none. */
  x: string;
  y: string;
}

const toText = (bytes: Uint8Array): string =>
  btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join('')).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');

function fromText(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
  return Uint8Array.from(binary, (c) => c.charCodeAt(0));
}

async function through(bytes: Uint8Array<ArrayBuffer>, stream: ReadableWritablePair<BufferSource | Uint8Array, BufferSource>): Promise<Uint8Array<ArrayBuffer>> {
  const piped = new Blob([bytes]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

/** The part of the address after #. A drive that is no example travels packed. */
export async function addressOf(state: State): Promise<string> {
  const parts = new URLSearchParams();
  if (state.view !== 'explore') parts.set('view', state.view);
  if (state.view === 'story') parts.set('step', String(state.step));
  if (state.view === 'thesis') parts.set('figure', String(state.figure));
  if (state.example) {
    parts.set('example', state.example);
  } else {
    const { toml, files } = state.drive;
    const bytes = new TextEncoder().encode(files && Object.keys(files).length > 0 ? JSON.stringify({ toml, files }) : toml);
    parts.set('drive', toText(await through(bytes, new CompressionStream('deflate-raw'))));
    parts.set('name', state.drive.name);
  }
  for (const [path, text] of state.drive.settings) parts.append('set', `${path}=${text}`);
  if (state.x) parts.set('x', state.x);
  if (state.y) parts.set('y', state.y);
  return parts.toString();
}

/** The state that an address has; `examples` are the texts by name. Throws an Error in words. */
export async function stateOf(address: string, start: State, examples: Map<string, string>): Promise<State> {
  const parts = new URLSearchParams(address.replace(/^#/, ''));
  const isNew = parts.has('example') || parts.has('drive');
  const state: State = { ...start, drive: { ...start.drive, settings: isNew ? [] : [...start.drive.settings] }, x: parts.get('x') ?? '', y: parts.get('y') ?? '' };
  const view = parts.get('view');
  state.view = view === 'story' || view === 'thesis' ? view : 'explore';
  const whole = (name: string, least: number, most: number): number => {
    const number = Number(parts.get(name));
    return Number.isInteger(number) && number >= least && number <= most ? number : least;
  };
  state.step = whole('step', 1, 7);
  state.figure = whole('figure', 2, 15);
  const example = parts.get('example');
  const packed = parts.get('drive');
  if (example !== null) {
    const toml = examples.get(example);
    if (toml === undefined) throw new Error(`The link names the example “${example}”, which this page does not have.`);
    state.example = example;
    state.drive = { toml, name: `${example}.toml`, settings: [] };
  } else if (packed !== null) {
    try {
      const bytes = await through(fromText(packed), new DecompressionStream('deflate-raw'));
      const text = new TextDecoder('utf-8', { fatal: true }).decode(bytes);
      const more = text.startsWith('{') ? (JSON.parse(text) as { toml: string; files: Record<string, string> }) : { toml: text };
      state.drive = { ...more, name: plainName(parts.get('name') ?? 'drive.toml'), settings: [] };
      state.example = '';
    } catch {
      throw new Error('The drive in the link cannot be read: the link may have been cut off.');
    }
  }
  for (const setting of parts.getAll('set')) {
    const equal = setting.indexOf('=');
    if (equal > 0) state.drive.settings.push([setting.slice(0, equal), setting.slice(equal + 1)]);
  }
  return state;
}

/** The settings with one replaced or added. */
export function withSetting(drive: DriveText, path: string, text: string): DriveText {
  const settings = drive.settings.filter(([other]) => other !== path);
  return { ...drive, settings: [...settings, [path, text]] };
}

/** A file's name in one line, which is no option of a command. */
export const plainName = (name: string): string => name.replace(/[\u0000-\u001f\u007f]/g, '').replace(/^-/, './-') || 'drive.toml';

/** For a shell. */
export const quoted = (text: string): string => (/^[\w./:=+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

/** The settings as options of the command line. */
export const setOptions = (drive: DriveText): string =>
  drive.settings.map(([path, text]) => ` --set ${quoted(`${path}=${text}`)}`).join('');

/** The command that gives the same answer. */
export const commandOf = (drive: DriveText): string => `gearlash limit-cycle ${quoted(drive.name)}${setOptions(drive)}`;
