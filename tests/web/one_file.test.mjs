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

test('it has the drive with its settings, and the same answer', async () => {
  const file = join(place.folder, 'drive.html');
  gearlash(['explore', 'examples/first-servo.toml', '--set', 'gearbox.backlash=12 arcmin', '--output', file]);
  assert.ok(statSync(file).size < 3_000_000);
  await opened(file, async (page) => {
    assert.match(await page.inputValue('#command'), /first-servo\.toml --set 'gearbox\.backlash=12 arcmin'/);
    await assertSameReport(page, ['limit-cycle', 'examples/first-servo.toml', '--set', 'gearbox.backlash=12 arcmin']);
  });
});

test('a normal form by options is a drive too', async () => {
  const file = join(place.folder, 'form.html');
  gearlash(['explore', '--damping', '0.1', '--inertia-ratio', '1', '--friction-ratio', '0.2', '--backlash', '0.3', '--output', file]);
  await opened(file, async (page) => assert.match(await page.textContent('#headline'), /±0\.497 rad/));
});

test('the tables that a drive names go with it', async () => {
  const table = 'time (s), position (rad)\n0, 0\n1, 0.2\n2, 0.2\n';
  writeFileSync(join(place.folder, 'steps.csv'), table);
  const toml = `${example('first-servo.toml')}\n[reference]\nkind = "table"\nfile = "steps.csv"\n`;
  writeFileSync(join(place.folder, 'followed.toml'), toml);
  const printed = spawnSync(tool, ['limit-cycle', 'followed.toml'], { cwd: place.folder, encoding: 'utf8' });
  assert.equal(printed.status, 0, printed.stderr);
  gearlash(['explore', 'followed.toml', '--output', 'followed.html'], place.folder);
  await opened(join(place.folder, 'followed.html'), (page) => assertSameReport(page, ['limit-cycle', 'followed.toml'], place.folder));
});

test('text of the drive cannot end the page', async () => {
  const toml = `# </script><script>document.title = "taken"</script>\n${example('normalized.toml')}`;
  writeFileSync(join(place.folder, 'sly.toml'), toml);
  gearlash(['explore', 'sly.toml', '--output', 'sly.html'], place.folder);
  await opened(join(place.folder, 'sly.html'), async (page) => assert.match(await page.title(), /^Gearlash/));
});

test('bad input is refused as by every command', () => {
  const run = spawnSync(tool, ['explore', 'examples/normalized.toml', '--set', 'servo.damping=-1', '--output', 'x.txt'], { cwd: root, encoding: 'utf8' });
  assert.equal(run.status, 2);
  assert.match(run.stderr, /--output = x\.txt: must end in \.html/);
  assert.match(run.stderr, /servo\.damping/);
});
