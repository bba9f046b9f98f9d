// Assembles the page from its parts.
//   node build.mjs CORE OUT
// CORE: the folder of core.js and core.wasm, as Emscripten made them. OUT gets index.html, page.js,
// page.css, worker.js and core.wasm, and explorer.html, which is all of it in one file.
import { build } from 'esbuild';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const [core, out] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
mkdirSync(out, { recursive: true });

const common = { bundle: true, minify: true, format: 'esm', target: 'es2022', loader: { '.toml': 'text' }, write: false, outdir: out, charset: 'utf8', legalComments: 'inline', logLevel: 'warning' };
const bundle = async (entry, more = {}) => {
  const result = await build({ ...common, entryPoints: [join(here, 'page', entry)], ...more });
  return Object.fromEntries(result.outputFiles.map((file) => [file.path.endsWith('.css') ? 'css' : 'js', file.text]));
};

const page = await bundle('main.ts');
// A classic worker: pages from a file may start no other kind.
const worker = await bundle('worker.ts', { alias: { core: join(core, 'core.js') }, format: 'iife', define: { 'import.meta.url': '"file:///"' } });
const wasm = readFileSync(join(core, 'core.wasm'));
const html = readFileSync(join(here, 'page', 'index.html'), 'utf8');

const file = (name, content) => writeFileSync(join(out, name), content);
file('page.js', page.js);
file('page.css', page.css);
file('worker.js', worker.js);
file('core.wasm', wasm);
file('index.html', html.replace('<!--style-->', '<link rel="stylesheet" href="page.css">').replace('<!--scripts-->', '<script type="module" src="page.js"></script>'));

// In one file: text between tags must not end them.
const base64 = (bytes) => Buffer.from(bytes).toString('base64');
const one = html
  .replace('<!--style-->', () => `<style>${page.css}</style>`)
  .replace('<!--scripts-->', () =>
    `<script type="application/json" id="user-drive"></script>\n` +
    `<script type="text/plain" id="worker-source">${base64(worker.js)}</script>\n` +
    `<script type="text/plain" id="core-wasm">${base64(gzipSync(wasm, { level: 9 }))}</script>\n` +
    `<script type="module">${page.js.replaceAll('</script', '<\\/script')}</script>`);
file('explorer.html', one);
