// The page in a real browser: each input, each output, and the same answers as the command line.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { assertSameReport, example, gearlash, idle, open, root, settled, temporaryFolder, type, visit, wordsOf } from './browser.mjs';

const both = visit();

/** A test with a page of its own, whose console must stay silent. */
const onPage = (name, hash, work, options = {}) =>
  test(name, { timeout: 180_000 }, async () => {
    const tab = await open(both.browser, `${both.server.url}#${hash}`, options);
    try {
      await work(tab.page, tab);
      assert.deepEqual(tab.complaints, []);
    } finally {
      await tab.close();
    }
  });

for (const name of ['normalized', 'elinco-fd162', 'camera-head', 'antenna-field-controlled', 'instrument-two-phase', 'first-servo', 'telescope-axis', 'dynamixel-joint']) {
  onPage(`${name} has the report of the command line, to the last digit`, `example=${name}`, async (page) => {
    await settled(page);
    await assertSameReport(page, ['limit-cycle', `examples/${name}.toml`]);
    assert.equal((await page.textContent('#headline')).toLowerCase(), gearlash(['limit-cycle', `examples/${name}.toml`, '--brief']).trim().toLowerCase());
  });
}

onPage('irregular motion agrees within its spread', 'example=robot-joint', async (page) => {
  await settled(page);
  const report = await page.textContent('#report');
  const printed = JSON.parse(gearlash(['limit-cycle', 'examples/robot-joint.toml', '--format', 'json'])).irregular[0];
  const number = (name) => Number(new RegExp(`${name} +[±]?[\\d.e-]+ deg \\(([\\d.e-]+) rad\\)|${name} +([\\d.e-]+) s`).exec(report).slice(1).find(Boolean));
  assert.ok(Math.abs(number('mean amplitude') - printed.mean_amplitude) <= printed.amplitude_deviation, 'mean amplitude');
  assert.ok(Math.abs(number('mean period') - printed.mean_period) <= printed.period_deviation, 'mean period');
  assert.match(await page.textContent('#headline'), /motor within the gap/);
});

onPage('every number of a normal form changes the answer as --set does', 'example=normalized', async (page) => {
  await settled(page);
  const values = { 'servo.damping': '0.12', 'servo.inertia_ratio': '3.5', 'servo.friction_ratio': '0.25', 'servo.backlash': '20 arcmin', 'servo.natural_frequency': '3 Hz', 'contact.restitution': '0.3' };
  for (const [path, text] of Object.entries(values)) {
    await type(page, path, text);
    await page.waitForFunction((set) => document.getElementById('command').value.includes(set), path);
    await settled(page);
  }
  await idle(page);
  const words = wordsOf(await page.inputValue('#command')).slice(1);
  assert.equal(words.filter((word) => word === '--set').length, Object.keys(values).length);
  await assertSameReport(page, words, join(root, 'examples'));
});

onPage('a general drive takes numbers, words and units, and reports as the command line does', 'example=first-servo', async (page) => {
  await settled(page);
  for (const [path, text] of Object.entries({ 'motor.inertia': '0.2 kg cm2', 'load.inertia': '0.08 kg m2', 'load.coulomb': '10 mN m', 'gearbox.backlash': '12 arcmin', 'sensor.position': 'both', 'controller.derivative': '0.9 N m s/rad' })) {
    await type(page, path, text);
    await page.waitForFunction((set) => document.getElementById('command').value.includes(set), path);
    await page.waitForTimeout(300);
    await settled(page);
  }
  const words = wordsOf(await page.inputValue('#command')).slice(1);
  await assertSameReport(page, words, join(root, 'examples'));
});

onPage('a slider answers coarse while it moves and fine at rest', 'example=first-servo', async (page) => {
  await settled(page);
  const levels = await page.evaluate(
    () =>
      new Promise((resolve) => {
        const level = document.getElementById('level');
        const seen = [];
        new MutationObserver(() => {
          seen.push(level.textContent);
          if (seen.some((text) => text.startsWith('Coarse')) && level.textContent.startsWith('Fine')) resolve(seen);
        }).observe(level, { childList: true });
        const slider = document.querySelector('#field-gearbox-backlash').parentElement.querySelector('input[type=range]');
        slider.value = '260';
        slider.dispatchEvent(new Event('input'));
      }),
  );
  assert.ok(levels.some((text) => /^Coarse, while you change it/.test(text)));
  await assertSameReport(page, wordsOf(await page.inputValue('#command')).slice(1), join(root, 'examples'));
});

onPage('sliders move by keys, and say their value', 'example=normalized', async (page) => {
  await settled(page);
  const slider = page.locator('#field-servo-damping ~ input[type=range]');
  const before = await slider.getAttribute('aria-valuetext');
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('PageUp');
  const after = await slider.getAttribute('aria-valuetext');
  assert.ok(Number(after) > Number(before));
  assert.equal(await page.inputValue('#field-servo-damping'), after);
});

onPage('all answers are there: pictures, gears, map, changes', 'example=normalized', async (page) => {
  await idle(page);
  assert.match(await page.textContent('#ceiling'), /Ceiling, proved: .* ±0\.2563 rad/);
  assert.ok((await page.locator('#card-phase svg path').count()) > 8);
  assert.match(await page.textContent('#card-phase svg'), /faces apart/);
  assert.match(await page.textContent('#card-phase svg'), /impact/);
  assert.equal(await page.locator('#traces canvas').count(), 2);
  assert.match(await page.textContent('#card-map svg'), /you are here/);
  assert.match(await page.textContent('#card-map svg'), /hunting ends/);
  // The border: hunting ends where the change says that it does.
  const damping = await page.textContent('#changes tr:has-text("servo damping") td:last-child');
  const bound = Number(damping.trim());
  const at = (value) => JSON.parse(gearlash(['limit-cycle', 'examples/normalized.toml', '--set', `servo.damping=${value}`, '--format', 'json'])).verdict;
  assert.equal(at(bound * 0.999), 'hunts');
  assert.equal(at(bound * 1.001), 'cannot hunt');
  // Trying it brings the drive there.
  await page.click('#changes tr:has-text("servo damping") td:last-child button');
  await page.waitForFunction(() => /cannot hunt|comes to rest/i.test(document.getElementById('headline').textContent));
});

onPage('the gears step from event to event and follow either motion', 'example=normalized', async (page) => {
  await settled(page);
  const words = () => page.textContent('#gear-words');
  const seen = [await words()];
  for (let i = 0; i < 4; ++i) {
    await page.click('#gear-on');
    seen.push(await words());
  }
  assert.equal(new Set(seen).size, 5);
  assert.ok(seen.some((text) => /impact/.test(text)) && seen.some((text) => /faces part/.test(text)));
  await page.click('#gear-back');
  assert.equal(await words(), seen[3]);
  await page.selectOption('#gear-motion', { index: 1 });
  assert.match(await page.textContent('#time-title'), /limit cycle/);
  await page.click('#gear-play');
  const from = await page.inputValue('#gear-time');
  await page.waitForFunction((value) => document.getElementById('gear-time').value !== value, from);
  await page.click('#gear-play');
});

onPage('who prefers reduced motion gets steps instead', 'example=normalized', async (page) => {
  await settled(page);
  const before = await page.inputValue('#gear-time');
  await page.click('#gear-play');
  const stepped = await page.inputValue('#gear-time');
  assert.notEqual(stepped, before);
  await page.waitForTimeout(300);
  assert.equal(await page.inputValue('#gear-time'), stepped);
}, { reducedMotion: 'reduce' });

onPage('a searched drive has a chart over one number, with its border', 'example=first-servo&x=controller.derivative', async (page) => {
  await idle(page);
  const chart = await page.textContent('#card-map svg');
  assert.match(chart, /stable cycle/);
  assert.match(chart, /you are here/);
  assert.match(await page.textContent('#map-words'), /gearlash chart --x 'controller\.derivative=/);
  assert.ok(await page.isVisible('#changes-go'));
});

onPage('a link holds the whole state', 'example=first-servo', async (page) => {
  await settled(page);
  await type(page, 'gearbox.backlash', '9 arcmin');
  await page.selectOption('#map-x', 'load.inertia');
  await page.waitForTimeout(400);
  await idle(page);
  await page.waitForFunction(() => location.hash.includes('set=') && location.hash.includes('x=load.inertia'));
  const again = await open(both.browser, page.url());
  await idle(again.page);
  for (const id of ['#headline', '#report', '#card-map svg']) assert.equal(await again.page.textContent(id), await page.textContent(id));
  assert.equal(await again.page.inputValue('#command'), await page.inputValue('#command'));
  assert.equal(await again.page.inputValue('#map-x'), 'load.inertia');
  assert.deepEqual(again.complaints, []);
  await again.close();
});

/** Drops files on the page as a person does. */
const drop = (page, files) =>
  page.evaluate((list) => {
    const data = new DataTransfer();
    for (const { name, text, size } of list) data.items.add(new File([text ?? 'x'.repeat(size)], name));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
  }, files);

onPage('a good file dropped is answered, and its link carries it', 'example=normalized', async (page) => {
  await settled(page);
  const toml = example('first-servo.toml').replace('30 arcmin', '11 arcmin');
  await drop(page, [{ name: 'mine.toml', text: toml }]);
  await page.waitForFunction(() => document.getElementById('command').value === 'gearlash limit-cycle mine.toml');
  await page.waitForTimeout(300);
  await settled(page);
  const { folder, remove } = temporaryFolder();
  writeFileSync(join(folder, 'mine.toml'), toml);
  await assertSameReport(page, ['limit-cycle', 'mine.toml'], folder);
  await page.waitForFunction(() => location.hash.includes('drive='));
  const again = await open(both.browser, page.url());
  await settled(again.page);
  await assertSameReport(again.page, ['limit-cycle', 'mine.toml'], folder);
  await again.close();
  remove();
});

onPage('a bad file is refused in words, with places; the drive before stays', 'example=normalized', async (page) => {
  await settled(page);
  const before = await page.textContent('#report');
  await drop(page, [{ name: 'bad.toml', text: '[motor]\nkind = ' }]);
  await page.waitForFunction(() => document.getElementById('message').textContent.includes('bad.toml'));
  await drop(page, [{ name: 'picture.toml', text: '\u0000\u0001PNG' }]);
  await page.waitForFunction(() => document.getElementById('message').textContent.includes('picture.toml'));
  await drop(page, [{ name: 'slip.toml', text: example('first-servo.toml').replace('[load]', '[load]\nmass = "1 kg"') }]);
  await page.waitForFunction(() => /slip\.toml.*mass/s.test(document.getElementById('message').textContent));
  assert.equal(await page.locator('#faults input').count(), 0); // nothing to type would help
  assert.equal(await page.inputValue('#command'), 'gearlash limit-cycle normalized.toml');
  await type(page, 'servo.damping', '0.2');
  await settled(page);
  assert.notEqual(await page.textContent('#report'), before);
  assert.equal(await page.textContent('#faults'), '');
  assert.equal(await page.textContent('#message'), '');
});

onPage('a file of 10 MB is refused at once', 'example=normalized', async (page) => {
  await settled(page);
  await drop(page, [{ name: 'huge.toml', size: 10_000_000 }]);
  await page.waitForFunction(() => /huge\.toml has 9\.5\d MiB; permitted are 1 MiB/.test(document.getElementById('message').textContent));
  await type(page, 'servo.damping', '0.25');
  await page.waitForFunction(() => document.getElementById('level').textContent.startsWith('Fine'));
});

onPage('a drive with values missing is completed in the page', 'example=normalized', async (page) => {
  await settled(page);
  await drop(page, [{ name: 'part.toml', text: example('first-servo.toml').replace('inertia = "0.05 kg m2"\n', '') }]);
  const field = page.locator('#faults input[aria-label="load.inertia"]');
  await field.waitFor();
  await field.fill('0.05 kg m2');
  await field.press('Enter');
  await page.waitForTimeout(300);
  await settled(page);
  const { folder, remove } = temporaryFolder();
  writeFileSync(join(folder, 'first-servo.toml'), example('first-servo.toml'));
  const amplitude = (text) => /amplitude, load +(\S+)/.exec(text)[1];
  assert.equal(amplitude(await page.textContent('#report')), amplitude(gearlash(['limit-cycle', 'first-servo.toml'], folder)));
  remove();
});

onPage('a value that is not permitted is marked in its field; the answer stays', 'example=normalized', async (page) => {
  await settled(page);
  const before = await page.textContent('#headline');
  await type(page, 'servo.damping', '-3');
  await page.waitForFunction(() => document.getElementById('field-servo-damping').getAttribute('aria-invalid') === 'true');
  assert.match(await page.textContent('#field-servo-damping-fault'), /must be/);
  assert.equal(await page.textContent('#headline'), before);
  await type(page, 'servo.damping', '1e400');
  await page.waitForFunction(() => document.getElementById('field-servo-damping').getAttribute('aria-invalid') === 'true');
  await type(page, 'servo.damping', '0.3');
  await page.waitForFunction(() => !document.getElementById('field-servo-damping').hasAttribute('aria-invalid'));
  await settled(page);
  await assertSameReport(page, wordsOf(await page.inputValue('#command')).slice(1), join(root, 'examples'));
});

for (const name of ['normalized', 'elinco-fd162', 'first-servo', 'robot-joint']) {
  onPage(`${name}: every slider goes to both its ends, with an answer or a fault in words`, `example=${name}`, async (page) => {
    await settled(page);
    const bad = await page.evaluate(async () => {
      const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
      const words = () => ['headline', 'level', 'message', 'faults'].map((id) => document.getElementById(id).textContent).join(' ') + [...document.querySelectorAll('#inputs .fault')].map((one) => one.textContent).join(' ');
      const found = [];
      for (const slider of [...document.querySelectorAll('#inputs input[type=range]')].filter((one) => !one.disabled)) {
        const before = slider.value;
        for (const end of ['0', before, '400', before]) {
          const start = performance.now();
          slider.value = end;
          slider.dispatchEvent(new Event('input'));
          const isAnswered = () => performance.getEntriesByName('coarse answer').some((one) => one.startTime >= start);
          const isRefused = () => document.querySelector('#inputs [aria-invalid]') !== null || document.getElementById('message').textContent !== '' || document.getElementById('faults').textContent !== '';
          // Back where it was, a fault of the end is gone; what was answered before need not be again.
          const isDone = () => (end === before ? !isRefused() : isAnswered() || isRefused());
          for (let i = 0; i < 1500 && !isDone(); ++i) await wait(10);
          const text = words();
          if (!isDone() || /NaN|undefined|null|\[object|Infinity/.test(text)) found.push([slider.getAttribute('aria-label'), end, text]);
        }
      }
      return found;
    });
    assert.deepEqual(bad, []);
    await page.click('[data-example=normalized]');
    await page.waitForFunction(() => document.getElementById('command').value === 'gearlash limit-cycle normalized.toml');
    await page.waitForTimeout(300);
    await settled(page);
    await assertSameReport(page, ['limit-cycle', 'examples/normalized.toml']);
  });
}

onPage('another unit keeps the sections open and the place of the reader', 'example=first-servo', async (page) => {
  await settled(page);
  await type(page, 'motor.inertia', '0.15 kg cm2');
  await page.waitForFunction(() => document.getElementById('command').value.includes('0.15 kg cm2'));
  await settled(page);
  const open = () => page.$$eval('#inputs details', (all) => all.map((one) => `${one.dataset.section} ${one.open}`));
  const before = await open();
  await type(page, 'motor.inertia', '0.8 oz in2');
  await page.waitForFunction(() => document.getElementById('command').value.includes('0.8 oz in2'));
  await page.waitForTimeout(300);
  await settled(page);
  assert.deepEqual(await open(), before);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'field-motor-inertia');
  const slider = page.locator('#field-motor-inertia ~ input[type=range]');
  assert.match(await slider.getAttribute('aria-valuetext'), /^0\.8 oz in2$/);
});

onPage('one’s own drive is a click away after an example', 'example=normalized', async (page) => {
  await settled(page);
  await drop(page, [{ name: 'mine.toml', text: example('first-servo.toml') }]);
  await page.waitForFunction(() => document.getElementById('command').value === 'gearlash limit-cycle mine.toml');
  await type(page, 'gearbox.backlash', '9 arcmin');
  await page.waitForTimeout(300);
  await settled(page);
  const command = await page.inputValue('#command');
  await page.click('[data-example=normalized]');
  await page.waitForFunction(() => document.getElementById('command').value === 'gearlash limit-cycle normalized.toml');
  await page.click('text=your mine.toml');
  await page.waitForFunction((text) => document.getElementById('command').value === text, command);
});

onPage('it works offline once it is loaded', 'example=normalized', async (page, { context }) => {
  await idle(page);
  await context.setOffline(true);
  await page.click('[data-example=first-servo]');
  await page.waitForFunction(() => document.getElementById('command').value.includes('first-servo'));
  await page.waitForTimeout(300);
  await settled(page);
  await assertSameReport(page, ['limit-cycle', 'examples/first-servo.toml']);
  await page.click('[data-view=thesis]');
  await page.locator('#card-figure svg').waitFor();
});

onPage('a long search can be stopped, and the page goes on', 'example=robot-joint', async (page) => {
  await page.locator('#stop').waitFor({ timeout: 60_000 });
  await page.click('#stop');
  await page.waitForFunction(() => /was stopped|Not computed/.test(document.getElementById('level').textContent + document.getElementById('map-words').textContent));
  await page.click('[data-example=normalized]');
  await page.waitForFunction(() => document.getElementById('command').value.includes('normalized'));
  await page.waitForTimeout(300);
  await settled(page);
  await assertSameReport(page, ['limit-cycle', 'examples/normalized.toml']);
});

onPage('pictures, data and the drive are saved', 'example=first-servo', async (page) => {
  await idle(page);
  const saved = async (selector) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(selector)]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  for (const card of ['phase', 'time', 'map']) {
    const svg = await saved(`#card-${card} .buttons button:text-is("SVG")`);
    assert.equal(svg.name, `first-servo-${card}.svg`);
    assert.match(svg.bytes.toString(), /^<\?xml[^]*<svg [^]*<\/svg>\s*$/);
    const png = await saved(`#card-${card} .buttons button:text-is("PNG")`);
    assert.deepEqual([...png.bytes.subarray(1, 4)], [...Buffer.from('PNG')]);
    assert.ok(png.bytes.readUInt32BE(16) >= 1800);
    const csv = (await saved(`#card-${card} .buttons button:text-is("CSV")`)).bytes.toString().trim().split('\n');
    assert.ok(csv.length > 20, card);
    const columns = csv[0].split(',').length;
    for (const line of csv) assert.equal(line.split(/,(?=(?:[^"]*"[^"]*")*[^"]*$)/).length, columns);
  }
  const toml = await saved('#save-toml');
  const { folder, remove } = temporaryFolder();
  writeFileSync(join(folder, toml.name), toml.bytes);
  const [mine, original] = [[toml.name, folder], ['examples/first-servo.toml', root]].map(([file, where]) => JSON.parse(gearlash(['limit-cycle', file, '--format', 'json'], where)));
  assert.deepEqual(mine.cycles, original.cycles);
  remove();
});

onPage('it prints on one page', 'example=normalized', async (page) => {
  await idle(page);
  const pdf = (await page.pdf({ preferCSSPageSize: true })).toString('latin1');
  assert.equal(pdf.match(/\/Type\s*\/Page\b/g).length, 1);
});

onPage('the story has seven steps, each with one control that changes the answer', 'view=story', async (page) => {
  for (let step = 1; step <= 7; ++step) {
    await page.waitForFunction((number) => document.getElementById('story-title').textContent.startsWith(`${number}.`), step);
    await settled(page);
    assert.equal(await page.locator('#story-input .row').count(), 1);
    const sentence = await page.textContent('#story-sentence');
    assert.equal(sentence.match(/[.!?](?= |$)/g).length, 1, sentence);
    if (step === 7) await page.locator('#changes td button').first().waitFor(); // a cure exists
    const before = await page.textContent('#headline');
    const slider = page.locator('#story-input input[type=range]');
    if ((await slider.count()) > 0) {
      await slider.evaluate((element) => {
        element.value = String(Number(element.value) > 200 ? 90 : 330);
        element.dispatchEvent(new Event('input'));
        element.dispatchEvent(new Event('change'));
      });
    } else {
      await page.selectOption('#story-input select', 'motor');
    }
    await page.waitForFunction((text) => document.getElementById('headline').textContent !== text, before, { timeout: 60_000 });
    if (step < 7) await page.click('#story-next');
  }
  await page.click('#story-take');
  await page.locator('#inputs').waitFor();
  await settled(page);
});

onPage('the charts of 1960 are drawn with the points of their program', 'view=thesis&figure=7', async (page) => {
  for (const figure of [7, 2, 11, 12, 15]) {
    await page.selectOption('#figure', String(figure));
    await page.waitForFunction((number) => document.querySelector('#card-figure svg')?.getAttribute('aria-label').includes(`${number}`), figure, { timeout: 60_000 });
    await page.waitForFunction(() => document.querySelectorAll('#card-figure svg circle').length > 8);
  }
});

test('a core that does not load is said in words, and the page lives', async () => {
  const context = await both.browser.newContext();
  const page = await context.newPage();
  await page.route('**/core.wasm', (route) => route.fulfill({ status: 404 }));
  await page.goto(both.server.url);
  await page.waitForFunction(() => document.getElementById('headline').textContent === 'The core did not load');
  assert.match(await page.textContent('#message'), /core\.wasm: 404/);
  await page.route('**/core.wasm', (route) => route.fulfill({ status: 200, body: 'not wasm' }));
  await page.reload();
  await page.waitForFunction(() => document.getElementById('headline').textContent === 'The core did not load');
  await page.click('#theme');
  assert.equal(await page.getAttribute('html', 'data-theme'), 'dark');
  await context.close();
});

onPage('a link that was cut off is said in words', 'drive=abc!!&name=x.toml', async (page) => {
  await page.waitForFunction(() => /cut off/.test(document.getElementById('message').textContent));
  await settled(page);
});

onPage('a link that sets what the drive does not take says so, and answers without it', 'example=normalized&set=servo.damping%3D-1', async (page) => {
  await page.waitForFunction(() => /left out: --set servo.damping=-1/.test(document.getElementById('message').textContent));
  await settled(page);
  await assertSameReport(page, ['limit-cycle', 'examples/normalized.toml']);
});

onPage('the drive that was explored is there again after the story', 'example=first-servo', async (page) => {
  await settled(page);
  await type(page, 'gearbox.backlash', '9 arcmin');
  await page.waitForTimeout(300);
  await settled(page);
  const command = await page.inputValue('#command');
  await page.click('[data-view=story]');
  await page.locator('#story-title').waitFor();
  await page.click('[data-view=explore]');
  await page.waitForFunction((text) => document.getElementById('command').value === text, command);
});

onPage('another example ends a search that is running', 'example=robot-joint', async (page) => {
  await page.waitForFunction(() => document.getElementById('level').textContent.startsWith('Answering'));
  await page.click('[data-example=normalized]');
  await page.waitForFunction(() => document.getElementById('command').value.includes('normalized'));
  await settled(page);
  await assertSameReport(page, ['limit-cycle', 'examples/normalized.toml']);
});

onPage('a proof without a motion leaves no motion of the drive before', 'example=first-servo', async (page) => {
  await settled(page);
  await type(page, 'sensor.position', 'motor');
  await page.waitForFunction(() => /cannot hunt/i.test(document.getElementById('headline').textContent));
  assert.equal(await page.locator('#traces canvas').count(), 0);
  assert.ok(await page.isDisabled('#gear-play'));
});

onPage('a ceiling below the torque limit says its condition', 'example=telescope-axis', async (page) => {
  await settled(page);
  assert.match(await page.textContent('#ceiling'), /in the end .* as long as the torque stays below its limit/);
});
