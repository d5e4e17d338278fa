// Drives the page in Chromium: node test.mjs PAGE PROGRAMS SCENES, by `cargo xtask page --test`.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const [file, programs, scenes, ...only] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'page-'));
const work = join(folder, 'work');
execFileSync('cp', ['-r', scenes, work]);

/** Scenes of the table of times, sizes, and bounds of the median in milliseconds, of two workers. */
const SPEED = [
  ...['town.ug', 'street.ug', 'lattice.ug', 'stars.csv', 'teapot.ug', 'tunnel.ug', 'ship.ug', 'traffic.ug', 'cubes.ug', 'mesh.obj']
    .map(name => [name, '640 360', 33]),
  ['mirrors.ug', '480 270', 33], ['shadow.ug', '480 270', 33],
];
const FRAMES = 300;

const failures = [];
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
  { cwd: work, env: { PATH: `${programs}:/usr/bin:/bin` }, stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1e8 });

/** Waits for the full picture, or for a message. */
async function settled() {
  await page.waitForTimeout(60);
  await page.waitForFunction(() => !drafts.some(studio => studio.isBusy) && !full.isBusy && (state.drawn === state.turn || !$('message').hidden),
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

/** A file that the page saves, and the picture that ugfilm draws of the flight in it. */
async function flownBytes(title) {
  const scene = await saved('#record');
  const name = await page.evaluate(() => fileName());
  writeFileSync(join(work, name), scene);
  const bytes = await saved('#png');
  assert.equal(await settled(), '', title);
  const line = await page.textContent('#shell');
  shell(line);
  const output = line.split(' ').at(-1);
  assert.ok(bytes.equals(readFileSync(join(work, output))), `${title}: ${line}`);
  // The same by ugfilm, as a film of one frame.
  const time = await page.evaluate(() => own);
  const [film] = (await page.textContent('#film')).split('\n');
  const size = await page.inputValue('#size');
  const frame = film.replace(/-frames \d+/, '-frames 1').replace(/-ti \S+/, `-ti ${time}`).replace(/-sz \d+ \d+/, `-sz ${size}`).replace(/-fo \S+/, '-fo film_%d.png');
  shell(frame);
  const [n_other, n_all] = await page.evaluate(async files => {
    const pictures = await Promise.all(files.map(async text => {
      const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(text), c => c.charCodeAt(0))]), { colorSpaceConversion: 'none' });
      const { width, height } = bitmap;
      const context = new OffscreenCanvas(width, height).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      return context.getImageData(0, 0, width, height).data;
    }));
    return [pictures[0].filter((part, k) => part !== pictures[1][k]).length, pictures[1].length];
  }, ['film_1.png', output].map(name => readFileSync(join(work, name)).toString('base64')));
  assert.equal(n_other, 0, `${title}: ${frame}`);
  assert.equal(n_all, size.split(' ').reduce((a, b) => a * b, 4));
  console.log(`same bytes: ${title}: ${frame}`);
}

/** A mesh of 2n(n − 1) triangles. */
function bumpySphere(n) {
  const lines = [];
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const [a, b] = [Math.PI * i / (n - 1), 2 * Math.PI * j / n];
      const r = 1 + .1 * Math.sin(7 * a) * Math.sin(9 * b);
      lines.push(`v ${[Math.sin(a) * Math.cos(b), Math.sin(a) * Math.sin(b), Math.cos(a)].map(x => (r * x).toFixed(6)).join(' ')}`);
    }
  }
  for (let i = 0; i + 1 < n; i++) {
    for (let j = 0; j < n; j++) {
      const [p, q, s, t] = [[i, j], [i, (j + 1) % n], [i + 1, (j + 1) % n], [i + 1, j]].map(([row, column]) => row * n + column + 1);
      lines.push(`f ${p} ${q} ${s}`, `f ${p} ${s} ${t}`);
    }
  }
  return Buffer.from(lines.join('\n'));
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
    const names = await page.evaluate(() => Object.keys(bundled).filter(name => !/png$/.test(name)));
    assert.ok(names.length > 45, `${names.length} scenes`);
    for (const name of names) {
      await page.selectOption('#scene', name);
      await page.selectOption('#size', '480 270');
      await page.waitForTimeout(50);
      await compare(name);
      assert.ok(await page.isVisible('#lesson'), `${name} has no lesson`);
      assert.ok((await page.textContent('#answer')).length > 1, name);
    }
    await page.selectOption('#scene', 'town.ug');
    await settled();
    await shot('town');
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

  /** Ten seconds by keys; the flight is a scene, of which ugfilm draws the same picture. */
  async flight() {
    for (const [name, size] of [['town.ug', '640 360'], ['house.ug', '480 270'], ['stars.csv', '480 270']]) {
      await page.selectOption('#scene', name);
      await page.selectOption('#size', size);
      assert.equal(await settled(), '');
      const instruments = () => page.textContent('#instruments');
      await page.focus('#picture');
      const hold = async (key, ms) => {
        await page.keyboard.down(key);
        await page.waitForTimeout(ms);
        await page.keyboard.up(key);
      };
      const [long, short] = name === 'town.ug' ? [4000, 1000] : [500, 200];
      await hold('w', long);
      const fast = await instruments();
      for (const key of ['a', 'e', 'r', 'ArrowUp', 's', 'd']) await hold(key, short);
      await page.keyboard.press(' ');
      assert.equal(await settled(), '', name);
      assert.notEqual(await instruments(), fast);
      const end = await page.evaluate(() => craft.end);
      await dragPicture(60, 20);
      assert.equal(await settled(), '');
      assert.ok(await page.evaluate(() => craft.end) > end, 'a turn while time stands still');
      await shot(`flight-${name.replace(/\..*/, '')}`);
      await flownBytes(name);
      await page.click('#replay');
      await page.waitForTimeout(400);
      await page.click('#replay');
      assert.equal(await settled(), '');
      await flownBytes(`${name}, replayed in part`);
      await page.click('#home');
      assert.equal(await settled(), '');
      assert.match(await instruments(), /own time0/);
      await page.click('#fly');
      await compare(`${name} after the flight`);
    }
  },

  /** A link has all that is set. */
  async links() {
    const open = async link => {
      await page.goto('about:blank');
      await page.goto(link);
      await page.waitForFunction(() => state.name !== '', null, { timeout: 60000 });
      assert.equal(await settled(), '');
    };
    await page.selectOption('#scene', 'street.ug');
    await page.check('[name=look][value=shape]');
    await page.check('#noTime');
    await page.check('#lg');
    await page.fill('#more', "-cap 'Two words' -bg .5");
    await page.selectOption('#compare', 'rest');
    await page.press('#speed', 'ArrowLeft');
    await dragPicture(40, 10);
    await settled();
    const line = await page.textContent('#shell');
    const link = page.url();
    assert.ok(link.split('#')[1].length < 150, link);
    await open(link);
    assert.equal(await page.textContent('#shell'), line);
    assert.equal(await page.inputValue('#compare'), 'rest');
    await page.click('#linker');
    assert.equal(await page.locator('#code svg').count(), 1);
    await shot('link');
    await page.click('dialog .main');
    // Of a flight, the camera.
    await page.selectOption('#scene', 'house.ug');
    await settled();
    await page.focus('#picture');
    await page.keyboard.down('w');
    await page.waitForTimeout(300);
    await page.keyboard.up('w');
    await page.keyboard.press(' ');
    await settled();
    const flown = await page.textContent('#instruments');
    await open(page.url());
    const speed = text => text.match(/speed([\d.]+)/)[1];
    assert.equal(speed(await page.textContent('#instruments')), speed(flown));
    // Files that people dropped are named as missing.
    await page.click('#fly');
    shell('cp house.ug home.ug');
    await drop(['home.ug', readFileSync(join(work, 'house.ug'))]);
    await settled();
    const dropped = page.url();
    await page.goto('about:blank');
    await page.goto(dropped);
    await page.waitForFunction(() => !$('message').hidden, null, { timeout: 60000 });
    assert.match(await page.textContent('#message'), /home\.ug/);
    await drop(['home.ug', readFileSync(join(work, 'house.ug'))]);
    await compare('the file of a link');
  },

  /** Two pictures, and effects that are left out. */
  async comparisons() {
    await page.selectOption('#scene', 'house.ug');
    await page.selectOption('#size', '480 360');
    await page.check('[name=look][value=light]');
    const pixels = id => page.evaluate(id => [...new Uint32Array($(id).getContext('2d').getImageData(0, 0, $(id).width, $(id).height).data.buffer)], id);
    for (const kind of ['rest', 'speed', 'time', 'contraction', 'doppler', 'flux', 'map']) {
      await page.selectOption('#compare', kind);
      assert.equal(await settled(), '', kind);
      const [left, right] = [await pixels('picture'), await pixels('beside')];
      assert.equal(left.length, right.length);
      const n = left.filter((pixel, k) => pixel !== right[k]).length;
      assert.ok(n > 300, `${kind}: ${n} pixels differ`);
    }
    await shot('beside');
    await page.selectOption('#compare', 'rest');
    await page.check('#wiper');
    await settled();
    await shot('wiper');
    await page.selectOption('#compare', '');
    for (const id of ['noTime', 'noContraction', 'noDoppler', 'noFlux', 'map']) {
      await page.check(`#${id}`);
      await compare(id);
      await page.uncheck(`#${id}`);
    }
  },

  /** Signs of work, and errors in one line. */
  async signs() {
    await page.selectOption('#scene', 'house.ug');
    await settled();
    const signs = page.evaluate(() => new Promise(resolve => {
      const begun = performance.now();
      const look = () => {
        const after = performance.now() - begun;
        if (!$('work').hidden) resolve({ after, isOld: $('stage').classList.contains('old') });
        else if (after > 3000) resolve(null);
        else setTimeout(look, 10);
      };
      look();
    }));
    await page.fill('#more', '-aa 16');
    await page.selectOption('#scene', 'water.ug');
    const sign = await signs;
    assert.ok(sign && sign.after < 700, JSON.stringify(sign));
    await shot('work');
    if (await page.isVisible('#stop')) await page.click('#stop');
    await page.waitForTimeout(300);
    assert.ok(await page.isHidden('#work'));
    await drop(['wrong.ug', Buffer.from('v a 0 0 0 ;\n' + 'f (a b c) ;\n'.repeat(30))]);
    assert.match(await settled(), /error/);
    const lines = (await page.innerText('#message > span')).split('\n').length;
    assert.equal(lines, 1);
    await shot('error');
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

  /** The times of pictures in a flight. */
  async speed() {
    const rows = [];
    for (const [name, size, bound] of SPEED) {
      if (name === 'mesh.obj') await drop([name, bumpySphere(72)]);
      else await page.selectOption('#scene', name);
      await page.selectOption('#size', size);
      assert.equal(await settled(), '', name);
      await page.click('#fly');
      // Every picture has all pixels.
      const times = await page.evaluate(async most => {
        const times = [];
        const size = sides();
        const all = performance.now();
        while (times.length < most && performance.now() - all < 20000) {
          const begun = performance.now();
          craft.step(.02 * pace(), new Float64Array([.3, 0, 0]), new Float64Array([0, 0, .1]));
          own = craft.end;
          await Promise.all(drafts.slice(0, 2).map(studio =>
            studio.run('draw', commands(controls(), { size, isDraft: true, pose: flying.pose() }))));
          times.push((performance.now() - begun) / 2);
        }
        return times.sort((a, b) => a - b);
      }, FRAMES / 2);
      const [median, most] = [times[times.length >> 1], times[Math.floor(times.length * .95)]];
      rows.push({ scene: name, size: size.replace(' ', ' x '), pictures: 2 * times.length, median: +median.toFixed(1), '95 %': +most.toFixed(1), bound });
      await page.click('#fly');
    }
    console.table(rows);
    const slow = rows.filter(row => row.median > 1.5 * row.bound || row['95 %'] > 1.5 * (row.bound + 17));
    if (slow.length) failures.push(`slower than 1.5 times the bounds: ${slow.map(row => row.scene).join(', ')}`);
  },

  async shapes() {
    await page.emulateMedia({ colorScheme: 'dark' });
    await shot('dark');
    await page.emulateMedia({ colorScheme: 'light' });
    await page.click('#projector');
    await shot('projector');
    await page.click('#projector');
    await page.emulateMedia({ media: 'print' });
    await shot('print');
    await page.emulateMedia({ media: 'screen' });
    await page.click('#screen');
    await page.waitForTimeout(400);
    await shot('full-screen');
    await page.evaluate(() => document.exitFullscreen());
    await page.waitForTimeout(200);
    await page.setViewportSize({ width: 390, height: 844 });
    await shot('phone');
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 390, `${width} pixels wide on a phone`);
    const unlabelled = await page.evaluate(() => [...document.querySelectorAll('input:not([hidden]), select')]
      .filter(element => !element.labels.length && !element.ariaLabel).map(element => element.id));
    assert.deepEqual(unlabelled, []);
    // In a frame of another page.
    await page.setViewportSize({ width: 700, height: 600 });
    const outer = join(folder, 'outer.html');
    writeFileSync(outer, `<p>A page</p><iframe width="480" height="400" src="${pathToFileURL(file)}?embed#s=house.ug&w=480%20360"></iframe>`);
    await page.goto(pathToFileURL(outer).href);
    const frame = page.frameLocator('iframe');
    await frame.locator('#status').filter({ hasText: '480 × 360' }).waitFor({ timeout: 60000 });
    assert.ok(await frame.locator('#controls').isHidden());
    await frame.locator('[data-click=fly]').click();
    await frame.locator('#flown').waitFor();
    await shot('embedded');
  },
};

try {
  await page.goto(pathToFileURL(file).href);
  await page.waitForFunction(() => state.name !== '', null, { timeout: 60000 });
  for (const [name, test] of Object.entries(tests)) {
    if (only.length && !only.includes(name)) continue;
    console.log(`-- ${name}`);
    await test();
  }
  assert.deepEqual(failures, []);
  assert.deepEqual(errors, []);
  assert.deepEqual(requests.filter(url => !/^(file|blob|data):/.test(url)), []);
} catch (error) {
  await shot('failed');
  throw error;
} finally {
  await context.close();
  rmSync(folder, { recursive: true });
}
