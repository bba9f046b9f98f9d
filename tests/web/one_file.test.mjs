// The page that `gearlash explore` writes: opened from a file, without a network, with the drive.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { assertSameReport, example, gearlash, launch, open, root, settled, temporaryFolder, tool } from './browser.mjs';

let browser;
let place;
before(async () => {
  browser = await launch();
  place = temporaryFolder();
});
after(async () => {
  await browser.close();
  place.remove();
});

async function opened(file, work) {
  const tab = await open(browser, pathToFileURL(file).href, { offline: true });
  try {
    await settled(tab.page);
    await work(tab.page);
    assert.deepEqual(tab.complaints, []);
  } finally {
    await tab.close();
  }
}

test('it has the drive with its settings and its tables, and the same answer; text of the drive cannot end the page', async () => {
  const toml = `# </script><script>document.title = "taken"</script>\n${example('elinco-fd162.toml')}\n[reference]\nkind = "table"\nfile = "steps.csv"\n`;
  writeFileSync(join(place.folder, 'steps.csv'), 'time (s), position (rad)\n0, 0\n1, 0.2\n2, 0.2\n');
  writeFileSync(join(place.folder, 'followed.toml'), toml);
  const words = ['followed.toml', '--set', 'gearbox.backlash=12 arcmin'];
  gearlash(['explore', ...words, '--output', 'followed.html'], place.folder);
  const file = join(place.folder, 'followed.html');
  assert.ok(statSync(file).size < 3_000_000);
  await opened(file, async (page) => {
    assert.match(await page.inputValue('#command'), /followed\.toml --set 'gearbox\.backlash=12 arcmin'/);
    assert.match(await page.title(), /^Gearlash/);
    await assertSameReport(page, ['limit-cycle', ...words], place.folder);
  });
});

test('a normal form by options is a drive too', async () => {
  const file = join(place.folder, 'form.html');
  gearlash(['explore', '--damping', '0.1', '--inertia-ratio', '1', '--friction-ratio', '0.2', '--backlash', '0.3', '--output', file]);
  await opened(file, async (page) => assert.match(await page.textContent('#headline'), /±0\.497 rad/));
});

test('bad input is refused as by every command', () => {
  const run = spawnSync(tool, ['explore', 'examples/normalized.toml', '--set', 'servo.damping=-1', '--output', 'x.txt'], { cwd: root, encoding: 'utf8' });
  assert.equal(run.status, 2);
  assert.match(run.stderr, /--output = x\.txt: must end in \.html/);
  assert.match(run.stderr, /servo\.damping/);
});
