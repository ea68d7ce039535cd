// Every kind of report, opened from disk as a reader would.
import assert from 'node:assert/strict';
import {existsSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {pathToFileURL} from 'node:url';
import {emptyPlots, faintTexts, headlineFigures, placeToHover} from './page_checks.mjs';
import {makeRuns, out, pageOf, recordOf} from './runs.mjs';

const {chromium} = await import(pathToFileURL(join(process.env.HOPLAB_PLAYWRIGHT, 'index.mjs')));

// The unit that the first plot names under the pointer, and whether there is a leg to move.
const kinds = {
  check: {moves: false}, // tables alone
  fit: {hover: /\b(mm?|s)\b/, moves: true},
  diagnose: {hover: /\b(mm?|s)\b/, moves: true},
  discover: {hover: /\b(N|mm?|s)\b/, moves: false},
  design: {hover: /\b(deg|m|m\/s)\b/, moves: false},
  gait: {hover: /per hop|m\/s|\bm\b/, moves: true},
  optimize: {hover: /\bdeg\b/, moves: true},
  sweep: {hover: /\b(s|GPa)\b/, moves: false},
  simulate: {hover: /\b(m|s)\b/, moves: true},
  report: {hover: /GPa|N s\/m/, moves: false},
  reproduce: {hover: /\bs\b|%|\bdeg\b/, moves: true},
};

const unitFactors = {GPa: 1e9, MPa: 1e6, kPa: 1e3, mm: 1e-3, um: 1e-6, ms: 1e-3, us: 1e-6, mN: 1e-3, kN: 1e3, mJ: 1e-3, '%': 1e-2};

function atPointer(record, pointer) {
  return pointer.split('/').slice(1).reduce((value, key) => value?.[key.replaceAll('~1', '/').replaceAll('~0', '~')], record);
}

let browser;
before(async () => {
  makeRuns();
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync),
    args: ['--no-sandbox', '--disable-gpu'], // software drawing: the same everywhere
  });
});
after(() => browser?.close());

const ready = (page) => page.waitForFunction(() => document.body.dataset.ready === 'yes', undefined, {timeout: 120000});
const picture = (page, name) => page.screenshot({path: join(out, `${name}.png`), fullPage: true});

for (const [kind, expected] of Object.entries(kinds)) {
  describe(`report of ${kind}`, () => {
    const complaints = [];
    let page;

    before(async () => {
      page = await browser.newPage({viewport: {width: 1100, height: 900}, colorScheme: 'light'});
      page.on('console', (message) => { if (message.type() === 'error') complaints.push(message.text()); });
      page.on('pageerror', (error) => complaints.push(error.stack));
      page.on('request', (request) => {
        if (request.url() !== pageOf(kind) && !/^(data|blob):/.test(request.url())) complaints.push(`asks for ${request.url()}`);
      });
      await page.goto(pageOf(kind), {timeout: 120000});
      await ready(page);
    });
    after(async () => page.close());

    test('its headline is that of run.json', async () => {
      const record = recordOf(kind);
      const figures = await page.evaluate(headlineFigures);
      assert.equal(figures.length, 3);
      for (const figure of figures) {
        const value = atPointer(record, figure.pointer);
        assert.notEqual(value, undefined, figure.pointer);
        if (typeof value !== 'number') continue;
        assert.equal(Number(figure.value), value, figure.pointer);
        const shown = Number(figure.number) * (unitFactors[figure.unit] ?? 1);
        assert.ok(Math.abs(shown - value) <= 6e-3 * Math.abs(value), `${figure.pointer}: ${figure.number} ${figure.unit} for ${value}`);
      }
      const sentence = await page.textContent('h1');
      assert.ok(sentence.trim().length > 10);
      if (record.sentence) assert.equal(sentence.replaceAll('\u00a0', ' '), record.sentence);
    });

    test('every plot has data', async () => {
      assert.equal(await page.evaluate(() => document.querySelectorAll('.plot').length) >= 1, expected.hover !== undefined);
      assert.deepEqual(await page.evaluate(emptyPlots), []);
    });

    if (expected.hover) test('the pointer over a plot shows a number with its unit', async () => {
      const place = await page.evaluate(placeToHover, 0);
      assert.ok(place);
      await page.mouse.move(place.x - 3, place.y);
      await page.mouse.move(place.x, place.y, {steps: 2});
      const label = await page.waitForSelector('.hoverlayer .hovertext', {timeout: 30000});
      const lines = await label.$$eval('text, tspan', (all) => all.map((line) => line.textContent).join(' '));
      assert.match(lines, expected.hover, place.caption);
      await page.mouse.move(2, 2);
    });

    if (expected.moves) {
      test('the leg moves when played and where it is scrubbed to', async () => {
        const legs = () => page.$$eval('.animation:first-of-type .leg', (all) => all.map((leg) => leg.getAttribute('points')));
        const time = () => page.$eval('.animation', (a) => Number(a.dataset.time));
        await page.$eval('.animation', (a) => a.scrollIntoView({block: 'center', behavior: 'instant'}));
        const [first, begin] = [await legs(), await time()];
        assert.ok(first.length >= 1 && first.every((points) => !points.includes('NaN')));
        await page.click('.animation .play');
        await page.waitForFunction((t) => Number(document.querySelector('.animation').dataset.time) > t, begin, {timeout: 30000});
        await page.click('.animation .play');
        assert.notDeepEqual(await legs(), first);
        const stopped = await time();
        await page.waitForTimeout(150);
        assert.equal(await time(), stopped);
        await page.$eval('.animation input[type=range]', (slider) => {
          slider.value = '0';
          slider.dispatchEvent(new Event('input'));
        });
        assert.ok((await time()) <= stopped);
        assert.equal(await page.$eval('.animation .leg', (leg) => leg.dataset.mode), 'flight');
      });
    }

    test('light, dark and narrow windows are readable', async () => {
      assert.deepEqual(await page.evaluate(faintTexts), [], 'light');
      await picture(page, `${kind}-light`);
      await page.emulateMedia({colorScheme: 'dark'});
      await page.waitForFunction(() => document.body.dataset.ready && document.body.dataset.scheme === 'dark');
      assert.deepEqual(await page.evaluate(faintTexts), [], 'dark');
      await picture(page, `${kind}-dark`);
      await page.setViewportSize({width: 400, height: 800});
      await page.waitForFunction(() => [...document.querySelectorAll('.plot')].every((p) => !p._fullLayout || p._fullLayout.width <= p.clientWidth));
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert.ok(wide <= 0, `wider than the window by ${wide} px`);
      assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll('.plot')].filter((p) => p.scrollWidth > p.clientWidth + 1).map((p) => p.getAttribute('aria-label'))), []);
      await picture(page, `${kind}-400px`);
    });

    test('it opened without an error or a request', () => {
      assert.deepEqual(complaints, []);
    });
  });
}

test('on a touch screen no tools lie over a plot', async () => {
  const context = await browser.newContext({viewport: {width: 800, height: 1000}, hasTouch: true, isMobile: true});
  const page = await context.newPage();
  await page.goto(pageOf('fit'), {timeout: 120000});
  await ready(page);
  assert.equal(await page.evaluate(() => matchMedia('(hover: hover)').matches), false);
  assert.ok(await page.$$eval('.plot', (plots) => plots.length) > 0);
  assert.equal(await page.$$eval('.modebar-btn', (buttons) => buttons.filter((b) => b.checkVisibility()).length), 0);
  await context.close();
});

test('a report prints with everything unfolded but what words mean', async () => {
  const page = await browser.newPage({colorScheme: 'dark'});
  await page.goto(pageOf('fit'), {timeout: 120000});
  await ready(page);
  await page.evaluate(() => addEventListener('beforeprint', () => {
    window.folded = document.querySelectorAll('section details:not([open]):not(.words)').length;
  }));
  const pdf = await page.pdf({path: join(out, 'fit.pdf'), format: 'A4'});
  assert.ok(pdf.length > 20000);
  assert.equal(await page.evaluate(() => window.folded), 0);
  await page.close();
});
