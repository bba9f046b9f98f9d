// How the page looks and is used: axe-core finds nothing, and it fits from phone to wide screen.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { idle, requireOfPage, settled, shots, type, visit } from './browser.mjs';

const axe = readFileSync(requireOfPage.resolve('axe-core/axe.min.js'), 'utf8');
const all = visit();

async function findings(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join('; ')}`);
}

const views = { explore: 'example=elinco-fd162', searched: 'example=first-servo', story: 'view=story&step=3', thesis: 'view=thesis&figure=7' };
const shown = (page, view) => (view === 'thesis' ? page.locator('#card-figure .picture:not(.stale) svg').waitFor() : idle(page));

for (const [view, hash] of Object.entries(views)) {
  test(`axe-core finds nothing, light or dark: ${view}`, () =>
    all.at(hash, async (page) => {
      await shown(page, view);
      for (const theme of ['light', 'dark']) {
        assert.equal(await page.getAttribute('html', 'data-theme'), theme);
        assert.deepEqual(await findings(page), []);
        await page.click('#theme');
      }
    }));
}

test('axe-core finds nothing where a value is at fault', () =>
  all.at('example=normalized', async (page) => {
    await settled(page);
    await type(page, 'servo.damping', '-1');
    await page.locator('#field-servo-damping[aria-invalid=true]').waitFor();
    assert.deepEqual(await findings(page), []);
  }));

for (const [name, width, height] of [['phone', 360, 740], ['tablet', 820, 1100], ['wide', 1920, 1080]]) {
  test(`it fits a ${name}`, async () => {
    for (const [view, hash] of Object.entries(views).filter(([view]) => view !== 'searched')) {
      const work = async (page) => {
        await shown(page, view);
        const wider = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.equal(wider, 0, `${view} scrolls sideways`);
        await page.screenshot({ path: join(shots, `${view}-${name}.png`), fullPage: true });
      };
      await all.at(hash, work, { width, height });
    }
  });
}

test('it is used by keys alone', () =>
  all.at('example=normalized', async (page) => {
    await settled(page);
    const reached = new Set();
    for (let i = 0; i < 75; ++i) {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() => document.activeElement?.id || document.activeElement?.textContent));
    }
    for (const id of ['normalized', 'file', 'field-servo-damping', 'gear-play', 'gear-on', 'map-x', 'save-toml', 'command', 'report']) assert.ok(reached.has(id), id);
  }));
