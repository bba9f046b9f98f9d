// Where the core and the worker come from: files beside the page, or the page itself if it is one
// file.
import type { DriveText } from './replies';

/** Bytes of base64 text. */
function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const embedded = (id: string): string | null => document.getElementById(id)?.textContent?.trim() || null;

async function unpacked(bytes: Uint8Array<ArrayBuffer>): Promise<ArrayBuffer> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

/** What a worker is made of. It is fetched once, so that new workers need no network. */
export interface Parts {
  wasm: WebAssembly.Module;
  startWorker: () => Worker;
}

async function fetched(name: string): Promise<Response> {
  const response = await fetch(name);
  if (!response.ok) throw new Error(`${name}: ${response.status} ${response.statusText}`);
  return response;
}

async function workerSource(): Promise<string> {
  const packed = embedded('worker-source');
  return packed ? new TextDecoder().decode(bytesOf(packed)) : (await fetched('worker.js')).text();
}

async function coreBytes(): Promise<ArrayBuffer> {
  const packed = embedded('core-wasm');
  return packed ? unpacked(bytesOf(packed)) : (await fetched('core.wasm')).arrayBuffer();
}

/** Throws an Error whose words are for the user. */
export async function loadedParts(): Promise<Parts> {
  try {
    const [bytes, source] = await Promise.all([coreBytes(), workerSource()]);
    const address = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
    return { wasm: await WebAssembly.compile(bytes), startWorker: () => new Worker(address) };
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    throw new Error(`The numerical core of this page could not be loaded (${why}). Reload the page; it needs WebAssembly with exceptions and vectors, as browsers have had it since 2023.`);
  }
}

/** The drive of a page that `gearlash explore` wrote. */
export function embeddedDrive(): DriveText | null {
  const text = embedded('user-drive');
  return text ? (JSON.parse(text) as DriveText) : null;
}
