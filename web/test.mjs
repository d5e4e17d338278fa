// Drives the page in Chromium: node test.mjs PAGE PROGRAMS SCENES, by `cargo xtask page --test`.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const [file, programs, scenes] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'page-'));
const work = join(folder, 'work');
execFileSync('cp', ['-r', scenes, work]);

const context = await chromium.launchPersistentContext(join(folder, 'profile'), {
  executablePath: '/usr/bin/chromium', args: ['--no-sandbox'], offline: true, viewport: { width: 1280, height: 860 },
});
const page = context.pages()[0] ?? await context.newPage();
const errors = [];
const requests = [];
page.on('pageerror', error => errors.push(error.message));
page.on('console', message => { if (message.type() === 'error') errors.push(message.text()); });
page.on('request', request => requests.push(request.url()));

/** Runs a line of a shell in the folder of scenes. */
const shell = line => execFileSync('bash', ['-e', '-o', 'pipefail', '-c', line],
  { cwd: work, env: { PATH: `${programs}:/usr/bin:/bin` }, stdio: ['ignore', 'pipe', 'pipe'] });

/** Waits for the full picture, or for a message. */
async function settled() {
  await page.waitForTimeout(60);
  await page.waitForFunction(() => !draft.isBusy && !full.isBusy && (state.drawn === state.turn || !$('message').hidden),
    null, { timeout: 120000 });
  return page.evaluate(() => $('message').hidden ? '' : $('message').textContent);
}

async function saved(button) {
  const [download] = await Promise.all([page.waitForEvent('download', { timeout: 120000 }), page.click(button)]);
  const path = join(folder, download.suggestedFilename());
  await download.saveAs(path);
  return readFileSync(path);
}

/** What the page saves is what the shown line writes. */
async function compare(title, button = '#png') {
  assert.equal(await settled(), '', title);
  const bytes = await saved(button);
  await settled();
  const line = await page.textContent('#shell');
  shell(line);
  const written = readFileSync(join(work, line.split(' ').at(-1).replaceAll("'", '')));
  assert.ok(bytes.equals(written), `${title}: ${line}: ${bytes.length} and ${written.length} bytes`);
  console.log(`same bytes: ${title}: ${line}`);
}

/** Drops files, of names and bytes. */
async function drop(...files) {
  const data = files.map(([name, bytes]) => [name, [...bytes]]);
  await page.evaluate(data => {
    const transfer = new DataTransfer();
    data.forEach(([name, bytes]) => transfer.items.add(new File([new Uint8Array(bytes)], name)));
    dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, cancelable: true }));
  }, data);
  await page.waitForTimeout(150);
}

async function dragPicture(x, y) {
  const box = await page.locator('#picture').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  for (let step = 1; step <= 5; step++) {
    await page.mouse.move(box.x + box.width / 2 + x * step / 5, box.y + box.height / 2 + y * step / 5);
  }
  await page.mouse.up();
}

const shot = name => page.screenshot({ path: join(dirname(file), `${name}.png`) });

const tests = {
  async controls() {
    await compare('as it begins');
    await shot('wide');
    for (let press = 0; press < 3; press++) await page.press('#speed', 'ArrowLeft');
    await page.press('#dial', 'ArrowLeft');
    await page.press('#dial', 'ArrowUp');
    await compare('keys for the motion');
    await dragPicture(90, -30);
    await page.press('#picture', '+');
    await compare('camera');
    await page.click('#dial', { position: { x: 60, y: 20 } });
    await page.check('#lg');
    await page.check('#dl');
    await page.check('[name=look][value=light]');
    await compare('arrow, legend, outline and light');
    await compare('vector graphics', '#svg');
    await page.check('[name=look][value="1988"]');
    await page.uncheck('#in');
    await page.fill('#more', "-bg .5 -cap 'It'\"'\"'s 1988'");
    await page.selectOption('#size', '480 360');
    await compare('1988 with a caption');
    await page.fill('#more', '--nonsense');
    assert.match(await settled(), /nonsense/);
    await page.fill('#more', '');
    await compare('after a message');
  },

  async scenes() {
    for (const name of ['house.ug', 'street.ug', 'houses.ug', 'stars.csv', 'globe.obj', 'mirrors.ug']) {
      await page.selectOption('#scene', name);
      await page.waitForTimeout(50);
      await compare(name);
      await shot(name.replace(/\..*/, ''));
    }
    await page.selectOption('#scene', 'dice.ug');
    await page.selectOption('#rays', 'rays');
    await page.selectOption('#lens', '-fish 180');
    await compare('rays and a lens');
    await page.selectOption('#scene', 'clocks.ug');
    await page.click('#play');
    await page.waitForTimeout(1500);
    await page.click('#play');
    assert.notEqual(await page.inputValue('#time'), '0');
    await compare('time');
  },

  async drops() {
    shell('ugphoton -pan -sz 256 128 -aa 1 street.ug > sky.png; ugmesh house.ug -dt glb > house.glb; ugmesh -dt ply ship.ug > ship.ply');
    shell('ugmesh -dt obj house.ug > home.obj || true');
    for (const name of ['house.glb', 'ship.ply', 'sky.png', 'twins.ug']) {
      await drop([name, readFileSync(join(work, name))]);
      await compare(`drop of ${name}`);
    }
    await drop(['stars.csv', readFileSync(join(work, 'stars.csv'))], ['sky.png', readFileSync(join(work, 'sky.png'))]);
    await page.fill('#more', '--stars stars.csv');
    await dragPicture(120, 40);
    await compare('a panorama with stars');
    await shot('sky');
  },

  async broken() {
    const names = ['house.ug', 'globe.obj', 'house.glb', 'ship.ply', 'sky.png', 'stars.csv'];
    let seed = 1;
    const random = n => { seed = (seed * 48271) % 0x7fffffff; return seed % n; };
    let refused = 0;
    for (let row = 0; row < 54; row++) {
      const name = names[row % names.length];
      const bytes = Buffer.from(readFileSync(join(work, name)));
      for (let change = 0; change < 4; change++) bytes[random(Math.min(bytes.length, 4000))] = random(256);
      await drop([name, row % 3 === 0 ? bytes.subarray(0, random(bytes.length)) : bytes]);
      if (await settled()) refused += 1;
    }
    await drop(['empty.obj', Buffer.alloc(0)]);
    assert.notEqual(await settled(), '');
    await page.selectOption('#scene', 'die.ug');
    await compare(`after ${refused} of 54 broken files were refused`);
    assert.ok(refused > 20);
  },

  async speed() {
    await page.selectOption('#scene', 'teapot.ug');
    await page.selectOption('#size', '480 360');
    await settled();
    const count = await page.evaluate(() => {
      window.shown = [];
      new MutationObserver(() => shown.push($('status').textContent)).observe($('status'), { childList: true });
    });
    const box = await page.locator('#picture').boundingBox();
    const middle = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(...middle);
    await page.mouse.down();
    const begun = Date.now();
    for (let step = 0; Date.now() - begun < 5000; step++) {
      await page.mouse.move(middle[0] + 150 * Math.sin(step / 20), middle[1] + 40 * Math.cos(step / 20));
    }
    const shown = await page.evaluate(() => shown.splice(0));
    await page.mouse.up();
    await settled();
    const last = await page.textContent('#status');
    console.log(`teapot at 480 x 360: ${(shown.length / 5).toFixed(1)} pictures a second while dragging, the last ${shown.at(-1)}; full: ${last}`);
    assert.ok(shown.length > 10, `${count} ${shown}`);
  },

  async shapes() {
    await page.emulateMedia({ colorScheme: 'dark' });
    await shot('dark');
    await page.setViewportSize({ width: 390, height: 844 });
    await shot('phone');
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 390, `${width} pixels wide on a phone`);
    const unlabelled = await page.evaluate(() => [...document.querySelectorAll('input:not([hidden]), select')]
      .filter(element => !element.labels.length).map(element => element.id));
    assert.deepEqual(unlabelled, []);
  },
};

try {
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => state.name !== '', null, { timeout: 60000 });
  for (const [name, test] of Object.entries(tests)) {
    console.log(`-- ${name}`);
    await test();
  }
  assert.deepEqual(errors, []);
  assert.deepEqual(requests.filter(url => !/^(file|blob|data):/.test(url)), []);
} catch (error) {
  await shot('failed');
  throw error;
} finally {
  await context.close();
  rmSync(folder, { recursive: true });
}
