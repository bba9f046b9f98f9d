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

export async function compiledCore(): Promise<WebAssembly.Module> {
  const packed = embedded('core-wasm');
  if (packed) return WebAssembly.compile(await unpacked(bytesOf(packed)));
  const response = await fetch('core.wasm');
  if (!response.ok) throw new Error(`core.wasm: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

let address: string | null = null;

export function startWorker(): Worker {
  const source = embedded('worker-source');
  if (!source) return new Worker('worker.js');
  address ??= URL.createObjectURL(new Blob([new TextDecoder().decode(bytesOf(source))], { type: 'text/javascript' }));
  return new Worker(address);
}

/** The drive of a page that `gearlash explore` wrote. */
export function embeddedDrive(): DriveText | null {
  const text = embedded('user-drive');
  return text ? (JSON.parse(text) as DriveText) : null;
}
