// What the tests of the page share: a server on loopback, a browser, the command line.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';

/** What web/package.json lists. */
export const requireOfPage = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium } = requireOfPage('playwright-core');

export const root = fileURLToPath(new URL('../../', import.meta.url));
export const site = process.env.GEARLASH_SITE ?? join(root, 'build/web/site');
export const tool = process.env.GEARLASH_TOOL ?? join(root, 'build/release/gearlash');
/** Pictures of the page, to be looked at. */
export const shots = process.env.GEARLASH_SHOTS ?? join(root, 'build/web/shots');
mkdirSync(shots, { recursive: true });

const kinds = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

export async function serve() {
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname));
    const file = join(site, path.endsWith('/') ? `${path}index.html` : path);
    try {
      const bytes = readFileSync(file);
      response.writeHead(200, { 'content-type': kinds[extname(file)] ?? 'text/plain' }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  }).listen(0, '127.0.0.1');
  await new Promise((resolve) => server.once('listening', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    // The sandbox needs another user than root.
    args: [...(process.getuid() === 0 ? ['--no-sandbox'] : []), '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });

const usual = { width: 1300, height: 900 };

/** A page that must not complain: `complaints` are the errors on its console. */
export async function open(browser, address, options = {}) {
  const context = await browser.newContext({ viewport: usual, acceptDownloads: true, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && complaints.push(message.text()));
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.goto(address);
  return { page, context, complaints, close: () => context.close() };
}

/**
 * Leads the page to another link, as its address bar does: its core stays loaded. `settled` then
 * waits for the answer of the new drive: the page has begun with it when it forgets the map, and
 * takes no older answer from then on.
 */
const follow = (page, hash) =>
  page.evaluate(
    (address) =>
      new Promise((resolve, reject) => {
        setTimeout(() => reject(new Error(`the page did not follow ${address}`)), 20_000);
        const words = document.getElementById('map-words');
        words.textContent = 'of the link before';
        new MutationObserver((_, observer) => {
          if (words.textContent !== '') return;
          observer.disconnect();
          document.getElementById('level').textContent = '';
          resolve();
        }).observe(words, { childList: true });
        location.hash = address;
      }),
    hash,
  );

/**
 * A server, a browser and one page for all tests of a file. `at` leads the page to a link, works
 * there, and wants its console silent. A page on which a test failed is left to no other.
 */
export function visit() {
  const all = { tab: null };
  before(async () => {
    all.server = await serve();
    all.browser = await launch();
  });
  after(async () => {
    await all.browser.close();
    all.server.close();
  });
  all.at = async (hash, work, viewport = usual) => {
    try {
      await all.tab?.page.setViewportSize(viewport);
      if (all.tab) await follow(all.tab.page, hash);
      else all.tab = await open(all.browser, `${all.server.url}#${hash}`, { viewport });
      await work(all.tab.page, all.tab);
      assert.deepEqual(all.tab.complaints, []);
    } catch (error) {
      await all.tab?.close();
      all.tab = null;
      throw error;
    }
  };
  return all;
}

/** Waits for the fine answer of the present drive. */
export async function settled(page, timeout = 60_000) {
  await page.waitForFunction(() => /^Fine/.test(document.getElementById('level').textContent), null, { timeout });
}

/** Waits until nothing is computed any more. */
export async function idle(page, timeout = 90_000) {
  await settled(page, timeout);
  await page.waitForFunction(() => !/Computing|Searching/.test(document.getElementById('map-words').textContent + document.getElementById('changes-words').textContent), null, { timeout });
}

/** What the command line prints; words are as typed after "gearlash". */
export const gearlash = (words, folder = root) => execFileSync(tool, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

/** The words of a shell command with single quotes. */
export const wordsOf = (command) => [...command.matchAll(/(?:'([^']*)'|[^\s'])+/g)].map(([word]) => word.replaceAll("'", ''));

export function temporaryFolder() {
  const folder = mkdtempSync(join(tmpdir(), 'gearlash-web-'));
  return { folder, remove: () => rmSync(folder, { recursive: true, force: true }) };
}

export const example = (name) => readFileSync(join(root, 'examples', name), 'utf8');

/** The report that the page shows, and the command line's, which must agree to the last digit. */
export async function assertSameReport(page, words, folder) {
  const shown = await page.textContent('#report');
  const printed = gearlash(words, folder);
  assert.equal(shown.trim(), printed.trim());
}

/** Types a value into the field of a parameter. */
export async function type(page, path, text) {
  const field = page.locator(`#field-${path.replace(/[^\w]/g, '-')}`);
  await field.evaluate((element) => {
    for (let details = element.closest('details'); details; details = details.parentElement.closest('details')) details.open = true;
  });
  if ((await field.evaluate((element) => element.tagName)) === 'SELECT') await field.selectOption(text);
  else {
    await field.fill(text);
    await field.press('Enter');
  }
}
