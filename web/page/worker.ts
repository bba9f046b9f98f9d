// Loads the core and answers the page's requests, one at a time.
import loadCore from 'core';

interface CoreModule {
  lengthBytesUTF8(text: string): number;
  stringToUTF8(text: string, to: number, room: number): void;
  UTF8ToString(from: number): string;
  _malloc(bytes: number): number;
  _free(at: number): void;
  _gearlash_ask(request: number): void;
  _gearlash_reply(): number;
  _gearlash_numbers(): number;
  _gearlash_number_count(): number;
  HEAPF64: Float64Array;
  FS: { mkdirTree(path: string): void; writeFile(path: string, text: string): void };
}

/** Where the core looks for the tables that a drive names. */
const folder = '/tables';

let core: Promise<CoreModule>;
let current = 0;

/** Names with ".." would leave the folder, so they are left out, and the core does not find them. */
function writeTables(module: CoreModule, files: Record<string, string>): void {
  for (const [name, text] of Object.entries(files)) {
    const path = `${folder}/${name}`;
    if (name.split('/').includes('..')) continue;
    module.FS.mkdirTree(path.slice(0, path.lastIndexOf('/')));
    module.FS.writeFile(path, text);
  }
}

/** JSON has infinity as a text. */
function parsed(json: string): unknown {
  if (!json.includes('"inf"') && !json.includes('"-inf"')) return JSON.parse(json);
  return JSON.parse(json, (_, value) => (value === 'inf' ? Infinity : value === '-inf' ? -Infinity : value));
}

function ask(module: CoreModule, request: unknown): { reply: unknown; numbers: Float64Array } {
  const text = JSON.stringify(request);
  const room = module.lengthBytesUTF8(text) + 1;
  const at = module._malloc(room);
  module.stringToUTF8(text, at, room);
  module._gearlash_ask(at);
  module._free(at);
  const from = module._gearlash_numbers() / Float64Array.BYTES_PER_ELEMENT;
  return {
    reply: parsed(module.UTF8ToString(module._gearlash_reply())),
    numbers: module.HEAPF64.slice(from, from + module._gearlash_number_count()),
  };
}

self.onmessage = async (message: MessageEvent) => {
  if (message.data.wasm) {
    core = loadCore({
      report: (share: number) => self.postMessage({ id: current, share }),
      instantiateWasm: (imports: WebAssembly.Imports, done: (i: WebAssembly.Instance) => void) => {
        WebAssembly.instantiate(message.data.wasm as WebAssembly.Module, imports).then(done, (error) =>
          self.postMessage({ id: 0, broken: String(error) }),
        );
        return {};
      },
    }) as Promise<CoreModule>;
    return;
  }
  const { id, request } = message.data;
  try {
    const module = await core;
    current = id;
    writeTables(module, request.drive?.files ?? {});
    const { reply, numbers } = ask(module, request);
    self.postMessage({ id, reply, numbers }, { transfer: [numbers.buffer] });
  } catch (error) {
    self.postMessage({ id, broken: String(error) });
  }
};
