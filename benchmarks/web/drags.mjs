// How fast the page answers while a slider is dragged, how much is fetched first, and how large the
// parts are. Run by `make web-bench`, in a browser on one core of an idle machine.
import { execFileSync } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';

import { launch, open, serve, settled, site } from '../../tests/web/browser.mjs';

const drags = 120;

/** Milliseconds from each movement of the slider to the pictures of its answer, before they are painted. */
async function dragging(page, path) {
  return page.evaluate(
    async ([field, count]) => {
      const slider = document.querySelector(`#field-${field.replace(/[^\w]/g, '-')} ~ input[type=range]`);
      const middle = Number(slider.value);
      const times = [];
      for (let i = 0; i < count; ++i) {
        performance.clearMeasures();
        slider.value = String(middle + Math.round(60 * Math.sin(i / 6)) + (i % 2));
        const shown = new Promise((resolve) => {
          new PerformanceObserver((list, observer) => {
            observer.disconnect();
            resolve(list.getEntries()[0].duration);
          }).observe({ type: 'measure' });
        });
        slider.dispatchEvent(new Event('input'));
        times.push(await shown);
        // A hand moves on when it sees the pictures: after the frame in which they are painted.
        await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      }
      return times;
    },
    [path, drags],
  );
}

const share = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))].toFixed(1);
const packed = (file) => brotliCompressSync(readFileSync(join(site, file)), { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } }).length;
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(0)} kB`;

const server = await serve();
const browser = await launch();
console.log('A drag, from the slider to the pictures of the answer (ms)');
console.log('                                             median   90 %   worst');
for (const [name, example, path] of [
  ['servo, normal form', 'normalized', 'servo.damping'],
  ['servo, data sheet', 'elinco-fd162', 'gearbox.backlash'],
  ['continuous PD drive', 'first-servo', 'controller.derivative'],
  ['continuous PID drive', 'first-servo&set=controller.kind%3DPID&set=controller.integral%3D50 N m/(rad s)&set=controller.filter%3D2 ms', 'controller.integral'],
  ['continuous cascade, encoder', 'telescope-axis', 'gearbox.backlash'],
  ['sampled PID drive, encoder', 'robot-joint', 'controller.proportional'],
]) {
  const { page, close } = await open(browser, `${server.url}#example=${example}`);
  await settled(page);
  await page.waitForTimeout(500);
  await page.evaluate(() => document.getElementById('stop').click());
  const times = (await dragging(page, path)).sort((a, b) => a - b);
  console.log(`  ${name.padEnd(30)}${path.padEnd(24)}`.slice(0, 43).padEnd(43), share(times, 0.5).padStart(7), share(times, 0.9).padStart(7), share(times, 1).padStart(7));
  await close();
}
await browser.close();
server.close();

const parts = ['index.html', 'page.js', 'page.css', 'worker.js', 'core.wasm'];
console.log('\nSizes (brotli)');
for (const part of parts) console.log(`  ${part.padEnd(41)}${kilobytes(packed(part)).padStart(9)}`);
console.log(`  ${'first load'.padEnd(41)}${kilobytes(parts.reduce((sum, part) => sum + packed(part), 0)).padStart(9)}`);
console.log(`  ${'explorer.html, one file, as it is'.padEnd(41)}${kilobytes(statSync(join(site, 'explorer.html')).size).padStart(9)}`);
console.log(`\n${execFileSync('/usr/bin/chromium', ['--version'], { encoding: 'utf8' }).trim()}, Node.js ${process.version}`);
