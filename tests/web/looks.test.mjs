// How the page looks and is used: axe-core finds nothing, and it fits from phone to wide screen.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { idle, open, requireOfPage, settled, shots, visit } from './browser.mjs';

const axe = readFileSync(requireOfPage.resolve('axe-core/axe.min.js'), 'utf8');
const both = visit();

async function findings(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run());
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(' ')).join('; ')}`);
}

for (const theme of ['light', 'dark']) {
  for (const [name, hash] of Object.entries({ explore: 'example=normalized', searched: 'example=first-servo', story: 'view=story&step=3', thesis: 'view=thesis&figure=7' })) {
    test(`axe-core finds nothing: ${name}, ${theme}`, async () => {
      const tab = await open(both.browser, `${both.server.url}#${hash}`, { colorScheme: theme });
      if (name === 'thesis') await tab.page.locator('#card-figure svg').waitFor();
      else await idle(tab.page);
      assert.deepEqual(await findings(tab.page), []);
      assert.deepEqual(tab.complaints, []);
      await tab.close();
    });
  }
}

test('axe-core finds nothing where a value is at fault', async () => {
  const tab = await open(both.browser, `${both.server.url}#example=normalized&set=servo.damping=-1`);
  await tab.page.waitForFunction(() => document.getElementById('faults').textContent + document.getElementById('message').textContent !== '');
  assert.deepEqual(await findings(tab.page), []);
  await tab.close();
});

for (const [name, width, height] of [['phone', 360, 740], ['tablet', 820, 1100], ['wide', 1920, 1080]]) {
  test(`it fits a ${name}`, async () => {
    for (const [view, hash] of Object.entries({ explore: 'example=elinco-fd162', story: 'view=story&step=4', thesis: 'view=thesis&figure=7' })) {
      const tab = await open(both.browser, `${both.server.url}#${hash}`, { viewport: { width, height } });
      if (view === 'thesis') await tab.page.locator('#card-figure svg').waitFor();
      else await idle(tab.page);
      const wider = await tab.page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.equal(wider, 0, `${view} scrolls sideways`);
      await tab.page.screenshot({ path: join(shots, `${view}-${name}.png`), fullPage: true });
      await tab.close();
    }
  });
}

test('it is used by keys alone', async () => {
  const tab = await open(both.browser, `${both.server.url}#example=normalized`);
  const { page } = tab;
  await settled(page);
  const reached = new Set();
  for (let i = 0; i < 75; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement?.id || document.activeElement?.textContent));
  }
  for (const id of ['normalized', 'file', 'field-servo-damping', 'gear-play', 'gear-on', 'map-x', 'save-toml', 'command', 'report']) assert.ok(reached.has(id), id);
  await tab.close();
});
