// Drives the page in Firefox: node firefox.mjs PAGE PROGRAMS SCENES, by `cargo xtask page --test`.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';

const [file, programs, scenes, executablePath = '/usr/bin/firefox-esr'] = process.argv.slice(2);
if (!existsSync(executablePath)) {
  console.log(`-- no ${executablePath}: not tried in Firefox`);
  process.exit();
}
const work = mkdtempSync(join(tmpdir(), 'page-'));
cpSync(scenes, work, { recursive: true });
const browser = await puppeteer.launch({ browser: 'firefox', protocol: 'webDriverBiDi', executablePath, headless: true, timeout: 120000 });
const errors = [];
try {
  const page = await browser.newPage();
  page.on('pageerror', error => errors.push(error.message));
  await page.setViewport({ width: 1280, height: 860 });
  await page.goto(pathToFileURL(file).href);

  /** What the page saves is what the shown line writes. */
  async function compare(title) {
    await page.waitForFunction(() => state.name !== '' && !drafts.some(studio => studio.isBusy) && !full.isBusy
      && (state.drawn === state.turn || !$('message').hidden), { timeout: 120000, polling: 50 });
    assert.equal(await page.evaluate(() => $('message').hidden ? '' : $('message').textContent), '', title);
    const [line, picture] = await page.evaluate(async () => {
      const { bytes } = await pictureFile('png');
      return [$('shell').textContent, btoa([...bytes].map(byte => String.fromCharCode(byte)).join(''))];
    });
    execFileSync('bash', ['-e', '-o', 'pipefail', '-c', line], { cwd: work, env: { PATH: `${programs}:/usr/bin:/bin` }, stdio: 'ignore' });
    const written = readFileSync(join(work, line.split(' ').at(-1).replaceAll("'", '')));
    assert.ok(Buffer.from(picture, 'base64').equals(written), `${title}: ${line}`);
    console.log(`same bytes in Firefox: ${title}: ${line}`);
  }

  await compare('as it begins');
  for (const name of await page.evaluate(() => SCENES.map(([file]) => file))) {
    await page.select('#scene', name);
    await page.select('#size', '480 270');
    await compare(name);
  }
  await page.select('#scene', 'street.ug');
  await compare('before a flight');
  await page.focus('#picture');
  for (const key of ['w', 'a', 'e']) {
    await page.keyboard.down(key);
    await new Promise(resolve => setTimeout(resolve, 1500));
    await page.keyboard.up(key);
  }
  await page.keyboard.press(' ');
  const [name, text] = await page.evaluate(() => { const [[name, bytes]] = flying.way().files; return [name, new TextDecoder().decode(bytes)]; });
  writeFileSync(join(work, name), text);
  await compare('a flight');
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  rmSync(work, { recursive: true });
}
