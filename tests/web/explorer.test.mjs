// The page in a real browser: each input, each output, and the same answers as the command line.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

import { assertSameReport, example, gearlash, idle, open, root, settled, temporaryFolder, type, visit, wordsOf } from './browser.mjs';

const all = visit();

/** A test on the page that all share, led to an address. */
const onPage = (name, hash, work) => test(name, { timeout: 180_000 }, () => all.at(hash, work));

/** Waits for the command of the drive, which the page shows once it has read it. */
const commandIs = (page, command) => page.waitForFunction((text) => document.getElementById('command').value === text, command);

/** The report is that of the command that the page shows. */
const assertAsItsCommand = async (page, folder = join(root, 'examples')) => assertSameReport(page, wordsOf(await page.inputValue('#command')).slice(1), folder);

/** Types values into their fields, one after the other, and waits for the answer with all of them. */
async function typeAll(page, values) {
  for (const [path, text] of Object.entries(values)) {
    await type(page, path, text);
    await page.waitForFunction((set) => document.getElementById('command').value.includes(set), path);
  }
  await settled(page);
}

// The first, so that a link that cannot be read is what the page begins with.
onPage('a link that was cut off is said in words', 'drive=abc!!&name=x.toml', async (page) => {
  await page.waitForFunction(() => /cut off/.test(document.getElementById('message').textContent));
  await settled(page);
});

// A normal form, a data sheet, and drives that are searched: plain, with a proved ceiling under a
// torque limit, and with a firmware's registers.
for (const name of ['normalized', 'elinco-fd162', 'first-servo', 'telescope-axis', 'dynamixel-joint']) {
  onPage(`${name} has the report of the command line, to the last digit`, `example=${name}`, async (page) => {
    await settled(page);
    await assertSameReport(page, ['limit-cycle', `examples/${name}.toml`]);
    assert.equal((await page.textContent('#headline')).toLowerCase(), gearlash(['limit-cycle', `examples/${name}.toml`, '--brief']).trim().toLowerCase());
    if (name === 'telescope-axis') assert.match(await page.textContent('#ceiling'), /in the end .* as long as the torque stays below its limit/);
  });
}

onPage('irregular motion agrees within its spread', 'example=robot-joint', async (page) => {
  await settled(page);
  const numbers = (text) => /±([\d.]+) deg at ([\d.]+) Hz/.exec(text).slice(1).map(Number);
  const shown = numbers(await page.textContent('#headline'));
  const { mean_period: period, period_deviation: deviation } = JSON.parse(gearlash(['limit-cycle', 'examples/robot-joint.toml', '--format', 'json'])).irregular[0];
  numbers(gearlash(['limit-cycle', 'examples/robot-joint.toml', '--brief'])).forEach((printed, i) => assert.ok(Math.abs(shown[i] / printed - 1) <= deviation / period, `${shown[i]} beside ${printed}`));
  assert.match(await page.textContent('#headline'), /motor within the gap/);
});

onPage('every number of a normal form changes the answer as --set does', 'example=normalized', async (page) => {
  await settled(page);
  const values = { 'servo.damping': '0.12', 'servo.inertia_ratio': '3.5', 'servo.friction_ratio': '0.25', 'servo.backlash': '20 arcmin', 'servo.natural_frequency': '3 Hz', 'contact.restitution': '0.3' };
  await typeAll(page, values);
  assert.equal((await page.inputValue('#command')).match(/--set/g).length, Object.keys(values).length);
  await assertAsItsCommand(page);
});

onPage('a general drive takes numbers, words and units, and answers coarse while a slider moves and fine at rest', 'example=first-servo', async (page) => {
  await settled(page);
  await typeAll(page, { 'motor.inertia': '0.2 kg cm2', 'load.inertia': '0.08 kg m2', 'load.coulomb': '10 mN m', 'gearbox.backlash': '12 arcmin', 'sensor.position': 'both', 'controller.derivative': '0.9 N m s/rad' });
  await assertAsItsCommand(page);
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
  await assertAsItsCommand(page);
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

onPage('a link is followed that was opened as the address of the drive before was kept', 'example=normalized', async (page) => {
  await settled(page);
  await page.evaluate(() => {
    const kept = location.hash;
    location.hash = 'example=elinco-fd162';
    history.replaceState(null, '', kept);
  });
  await commandIs(page, 'gearlash limit-cycle elinco-fd162.toml');
  await settled(page);
});

onPage('all answers are there: pictures, gears, map, changes', 'example=normalized', async (page) => {
  await idle(page);
  assert.match(await page.textContent('#ceiling'), /Ceiling, proved: .* ±0\.2563 rad/);
  assert.ok((await page.locator('#card-phase svg path').count()) > 8);
  assert.match(await page.textContent('#card-phase svg'), /faces apart/);
  assert.match(await page.textContent('#card-phase svg'), /impact/);
  const traces = await page.textContent('#card-time svg');
  for (const axis of [/time \(/, /position \(/, /gap \(/, /torque \(/]) assert.match(traces, axis);
  assert.match(await page.textContent('#card-map svg'), /you are here/);
  assert.match(await page.textContent('#card-map svg'), /hunting ends/);
  // It prints on one page.
  const pdf = (await page.pdf({ preferCSSPageSize: true })).toString('latin1');
  assert.equal(pdf.match(/\/Type\s*\/Page\b/g).length, 1);
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
    await page.waitForFunction((old) => document.getElementById('gear-words').textContent !== old, seen.at(-1));
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
  // Who prefers reduced motion gets steps instead.
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const before = await page.inputValue('#gear-time');
  await page.click('#gear-play');
  const stepped = await page.inputValue('#gear-time');
  assert.notEqual(stepped, before);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  assert.equal(await page.inputValue('#gear-time'), stepped);
  await page.emulateMedia({ reducedMotion: null });
});

onPage('a searched drive has a chart over one number, with its border', 'example=first-servo&x=controller.derivative', async (page) => {
  await idle(page);
  const chart = await page.textContent('#card-map svg');
  assert.match(chart, /stable cycle/);
  assert.match(chart, /you are here/);
  assert.match(await page.textContent('#map-words'), /gearlash chart --x 'controller\.derivative=/);
  assert.ok(await page.isVisible('#changes-go'));
});

/** Drops files on the page as a person does. */
const drop = (page, files) =>
  page.evaluate((list) => {
    const data = new DataTransfer();
    for (const { name, text, size } of list) data.items.add(new File([text ?? 'x'.repeat(size)], name));
    document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
  }, files);

onPage('a good file dropped is answered, and a link holds it with the whole state', 'example=normalized', async (page) => {
  await settled(page);
  const toml = example('elinco-fd162.toml').replace('0.1 rad', '0.11 rad');
  const { folder, remove } = temporaryFolder();
  writeFileSync(join(folder, 'mine.toml'), toml);
  await drop(page, [{ name: 'mine.toml', text: toml }]);
  await commandIs(page, 'gearlash limit-cycle mine.toml');
  await settled(page);
  await assertAsItsCommand(page, folder);
  await type(page, 'motor.inertia', '0.7 oz in2');
  await page.selectOption('#map-x', 'load.inertia');
  await idle(page);
  await page.waitForFunction(() => ['drive=', 'set=', 'x=load.inertia'].every((part) => location.hash.includes(part)));
  const state = async () => ({
    ...Object.fromEntries(await Promise.all(['#headline', '#report', '#card-map svg'].map(async (id) => [id, await page.textContent(id)]))),
    ...Object.fromEntries(await Promise.all(['#command', '#map-x'].map(async (id) => [id, await page.inputValue(id)]))),
  });
  const before = await state();
  assert.equal(before['#map-x'], 'load.inertia');
  await page.reload();
  await idle(page);
  assert.deepEqual(await state(), before);
  await assertAsItsCommand(page, folder);
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
  await drop(page, [{ name: 'huge.toml', size: 10_000_000 }]); // refused at once
  await page.waitForFunction(() => /huge\.toml has 9\.5\d MiB; permitted are 1 MiB/.test(document.getElementById('message').textContent));
  assert.equal(await page.inputValue('#command'), 'gearlash limit-cycle normalized.toml');
  await typeAll(page, { 'servo.damping': '0.2' });
  assert.notEqual(await page.textContent('#report'), before);
  assert.equal(await page.textContent('#faults'), '');
  assert.equal(await page.textContent('#message'), '');
});

onPage('a drive with values missing is completed in the page', 'example=normalized', async (page) => {
  await settled(page);
  await drop(page, [{ name: 'part.toml', text: example('elinco-fd162.toml').replace('inertia = "16.4e-6 slug ft2"\n', '') }]);
  const field = page.locator('#faults input[aria-label="load.inertia"]');
  await field.waitFor();
  await field.fill('16.4e-6 slug ft2');
  await field.press('Enter');
  await settled(page);
  const amplitude = (text) => /^ +load +(\S+)/m.exec(text)[1];
  assert.equal(amplitude(await page.textContent('#report')), amplitude(gearlash(['limit-cycle', 'examples/elinco-fd162.toml'])));
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
  await typeAll(page, { 'servo.damping': '0.3' });
  assert.equal(await page.getAttribute('#field-servo-damping', 'aria-invalid'), null);
  await assertAsItsCommand(page);
});

// Of the last drive, whose answers take longest, those of parameters that no drive before it has.
const moved = new Set();
for (const name of ['normalized', 'elinco-fd162', 'first-servo', 'robot-joint']) {
  onPage(`${name}: every slider goes to both its ends, with an answer or a fault in words`, `example=${name}`, async (page) => {
    await settled(page);
    const { bad, paths } = await page.evaluate(async (known) => {
      const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
      const words = () => ['headline', 'level', 'message', 'faults'].map((id) => document.getElementById(id).textContent).join(' ') + [...document.querySelectorAll('#inputs .fault')].map((one) => one.textContent).join(' ');
      const found = [];
      const path = (slider) => slider.parentElement.querySelector('[title]').title.replace(/:.*/s, '');
      const sliders = [...document.querySelectorAll('#inputs input[type=range]')].filter((one) => !one.disabled && !known.includes(path(one)));
      for (const slider of sliders) {
        const before = slider.value;
        for (const end of ['0', before, '400', before]) {
          const start = performance.now();
          slider.value = end;
          slider.dispatchEvent(new Event('input'));
          const isAnswered = () => performance.getEntriesByName('coarse answer').some((one) => one.startTime >= start);
          const isRefused = () => document.querySelector('#inputs [aria-invalid]') !== null || document.getElementById('message').textContent !== '' || document.getElementById('faults').textContent !== '';
          // Back where it was, a fault of the end is gone; what was answered before need not be again.
          const isDone = () => (end === before ? !isRefused() : isAnswered() || isRefused());
          while (!isDone() && performance.now() < start + 15_000) await frame();
          const text = words();
          if (!isDone() || /NaN|undefined|null|\[object|Infinity/.test(text)) found.push([slider.getAttribute('aria-label'), end, text]);
        }
      }
      return { bad: found, paths: sliders.map(path) };
    }, name === 'robot-joint' ? [...moved] : []);
    assert.deepEqual(bad, []);
    assert.ok(paths.length > 3, `${paths}`);
    for (const path of paths) moved.add(path);
    await page.click('[data-example=normalized]');
    await commandIs(page, 'gearlash limit-cycle normalized.toml');
    await settled(page);
    await assertSameReport(page, ['limit-cycle', 'examples/normalized.toml']);
  });
}

onPage('another unit keeps the sections open and the place of the reader', 'example=elinco-fd162', async (page) => {
  await settled(page);
  await typeAll(page, { 'motor.inertia': '0.15 kg cm2' });
  const open = () => page.$$eval('#inputs details', (all) => all.map((one) => `${one.dataset.section} ${one.open}`));
  const before = await open();
  await typeAll(page, { 'motor.inertia': '0.8 oz in2' });
  assert.deepEqual(await open(), before);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'field-motor-inertia');
  const slider = page.locator('#field-motor-inertia ~ input[type=range]');
  assert.match(await slider.getAttribute('aria-valuetext'), /^0\.8 oz in2$/);
});

onPage('one’s own drive is a click away after an example, and after the story', 'example=normalized', async (page) => {
  await settled(page);
  await drop(page, [{ name: 'own.toml', text: example('elinco-fd162.toml') }]);
  await commandIs(page, 'gearlash limit-cycle own.toml');
  await typeAll(page, { 'gearbox.backlash': '9 arcmin' });
  const command = await page.inputValue('#command');
  await page.click('[data-example=normalized]');
  await commandIs(page, 'gearlash limit-cycle normalized.toml');
  await page.click('text=your own.toml');
  await commandIs(page, command);
  await page.click('[data-view=story]');
  await page.locator('#story-title').waitFor();
  await page.waitForFunction((text) => document.getElementById('command').value !== text, command);
  await page.click('[data-view=explore]');
  await commandIs(page, command);
});

onPage('it works offline once it is loaded', 'example=normalized', async (page, { context }) => {
  await settled(page);
  await context.setOffline(true);
  await page.click('[data-example=elinco-fd162]');
  await commandIs(page, 'gearlash limit-cycle elinco-fd162.toml');
  await settled(page);
  await assertSameReport(page, ['limit-cycle', 'examples/elinco-fd162.toml']);
  await page.click('[data-view=thesis]');
  await page.locator('#card-figure svg').waitFor();
  await context.setOffline(false);
});

onPage('a long search can be stopped, or is ended by another example, and the page goes on', 'example=robot-joint', async (page) => {
  await page.locator('#stop').waitFor({ timeout: 60_000 });
  await page.click('#stop');
  await page.waitForFunction(() => /was stopped|Not computed/.test(document.getElementById('level').textContent + document.getElementById('map-words').textContent));
  await page.click('[data-example=robot-joint]');
  await page.waitForFunction(() => document.getElementById('level').textContent.startsWith('Answering'));
  await page.click('[data-example=normalized]');
  await commandIs(page, 'gearlash limit-cycle normalized.toml');
  await settled(page);
  await assertSameReport(page, ['limit-cycle', 'examples/normalized.toml']);
});

onPage('pictures, data and the drive are saved', 'example=elinco-fd162', async (page) => {
  await idle(page);
  const saved = async (selector) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(selector)]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  for (const card of ['phase', 'time', 'map']) {
    const svg = await saved(`#card-${card} .buttons button:text-is("SVG")`);
    assert.equal(svg.name, `elinco-fd162-${card}.svg`);
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
  const [mine, original] = [[toml.name, folder], ['examples/elinco-fd162.toml', root]].map(([file, where]) => JSON.parse(gearlash(['limit-cycle', file, '--format', 'json'], where)));
  assert.deepEqual(mine.cycles, original.cycles);
  remove();
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
  const ids = await page.$$eval('[id]', (all) => all.map((one) => one.id));
  assert.deepEqual(ids.filter((id, i) => ids.indexOf(id) !== i), []);
});

onPage('the charts of 1960 are drawn with the points of their program', 'view=thesis&figure=7', async (page) => {
  for (const figure of [7, 2, 11, 12, 15]) {
    await page.selectOption('#figure', String(figure));
    await page.waitForFunction((number) => document.querySelector('#card-figure svg')?.getAttribute('aria-label').includes(`${number}`), figure, { timeout: 60_000 });
    await page.waitForFunction(() => document.querySelectorAll('#card-figure svg :is(circle, polygon)').length > 8);
  }
});

test('a core that does not load is said in words, and the page lives', async () => {
  const context = await all.browser.newContext({ colorScheme: 'dark' });
  const page = await context.newPage();
  await page.route('**/core.wasm', (route) => route.fulfill({ status: 404 }));
  await page.goto(all.server.url);
  await page.waitForFunction(() => document.getElementById('headline').textContent === 'The core did not load');
  assert.match(await page.textContent('#message'), /core\.wasm: 404/);
  await page.route('**/core.wasm', (route) => route.fulfill({ status: 200, body: 'not wasm' }));
  await page.reload();
  await page.waitForFunction(() => document.getElementById('headline').textContent === 'The core did not load');
  assert.equal(await page.getAttribute('html', 'data-theme'), 'dark'); // as the reader's screen is
  await page.click('#theme');
  assert.equal(await page.getAttribute('html', 'data-theme'), 'light');
  await context.close();
});

onPage('a link that sets what the drive does not take says so, and answers without it', 'example=normalized&set=servo.damping%3D-1', async (page) => {
  await page.reload(); // a page that has a drive marks the value instead
  await page.waitForFunction(() => /left out: --set servo.damping=-1/.test(document.getElementById('message').textContent));
  await settled(page);
  await assertSameReport(page, ['limit-cycle', 'examples/normalized.toml']);
});

onPage('curves are read at the pointer, and a time is narrowed by dragging until it is widened', 'example=normalized', async (page) => {
  await settled(page);
  const picture = page.locator('#card-time svg[role=img]');
  await picture.scrollIntoViewIfNeeded();
  const { x, y, width } = await picture.boundingBox();
  const readings = () => page.textContent('#card-time .readings');
  const pointAt = (share) => page.mouse.move(x + share * width, y + 60);
  const timeAt = async (share) => {
    await pointAt(share);
    return Number(/time \([^)]*\): ([\d.]+)/.exec(await readings())[1]);
  };
  const end = await timeAt(0.99);
  assert.equal(await timeAt(0.01), 0);
  const middle = await timeAt(0.5);
  const number = (name, text) => Number(new RegExp(`${name} (−?[\\d.]+)`).exec(text)[1].replace('−', '-'));
  const text = await readings();
  const gap = number('motor', text) - number('load', text);
  assert.ok(Math.abs(gap - number('gap \\([^)]*\\):', text)) <= 1e-3 * Math.abs(number('load', text)), text);
  assert.match(text, /torque \([^)]*\): motor torque /);
  // By keys: the time of the gears.
  await page.focus('#gear-time');
  await page.keyboard.press('End');
  assert.match(await readings(), new RegExp(`: ${end};`));
  const whole = await picture.textContent();
  for (const widen of [() => page.mouse.dblclick(x + 0.5 * width, y + 60), () => page.keyboard.press('Escape')]) {
    await pointAt(0.5);
    await page.mouse.down();
    await pointAt(0.8);
    assert.equal(await page.locator('#card-time .band').count(), 1);
    await page.mouse.up();
    assert.equal(await page.locator('#card-time .band').count(), 0);
    assert.equal(await timeAt(0.01), middle);
    assert.ok((await timeAt(0.99)) < end);
    assert.notEqual(await picture.textContent(), whole);
    await widen();
    assert.equal(await timeAt(0.99), end);
    assert.equal(await picture.textContent(), whole);
  }
});

onPage('a proof without a motion leaves no motion of the drive before', 'example=normalized', async (page) => {
  await settled(page);
  assert.equal(await page.locator('#card-time svg[role=img]').count(), 1);
  await drop(page, [{ name: 'still.toml', text: example('first-servo.toml').replace('position = "load"', 'position = "motor"') }]);
  await page.waitForFunction(() => /cannot hunt/i.test(document.getElementById('headline').textContent));
  assert.equal(await page.locator('#card-time svg').count(), 0);
  assert.ok(await page.isDisabled('#gear-play'));
});
