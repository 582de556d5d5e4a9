// A lesson, as a teacher and a pupil have it: from the site's first page to a marked exercise.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { after, before, describe, test } from 'node:test';
import { browse, home, patient, until, violations } from '../view/session.mjs';

const site = path.join(home, 'dist/site');
let browser;
let folder;
before(async () => {
  browser = await browse();
  folder = fs.mkdtempSync(path.join(os.tmpdir(), 'ev3dev-lesson-'));
});
after(async () => {
  await browser?.close();
  fs.rmSync(folder, { recursive: true });
});

/** A page of the site, and what it asks of others. */
async function open(name) {
  const page = patient(await browser.newPage());
  page.asked = [];
  page.errors = [];
  page.on('request', (request) => {
    if (/^https?:/.test(request.url())) page.asked.push(request.url());
  });
  page.on('pageerror', (error) => page.errors.push(error.message));
  await page.goto(name.startsWith('/') ? pathToFileURL(name).href : pathToFileURL(path.join(site, name)).href);
  return page;
}

/** Follows the link with this text. */
async function follow(page, text) {
  const there = await page.$$eval('a', (links, wanted) => links.find((link) => link.textContent.trim() === wanted)?.href, text);
  assert.ok(there, `there is no link ${text}`);
  await page.goto(there);
}

const heading = (page) => page.$eval('h1', (element) => element.firstChild.textContent);

/** Runs the pack's command. */
function ev3dev(...words) {
  try {
    return execFileSync(process.env.SWIPL ?? 'swipl', [path.join(home, 'app/ev3dev.pl'), ...words], { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  } catch (error) {
    return error.stdout + error.stderr;
  }
}

test('a lesson: read, write, try, mark', async () => {
  const page = await open('index.html');
  await follow(page, 'The first afternoon');
  assert.equal(await heading(page), 'The first afternoon');
  const pictures = await page.$$eval('article img', (images) => images.map((image) => image.naturalWidth));
  assert.equal(pictures.length, 12);
  assert.ok(pictures.every((width) => width > 0));
  await follow(page, '3. Obstacles: rules');
  const code = await page.$$eval('article pre', (blocks) => blocks.map((block) => block.textContent));
  const skeleton = code.find((text) => text.includes('behave(['));
  // The pupil tries the skeleton, then writes a rule.
  fs.writeFileSync(path.join(folder, 'mine.pl'), skeleton);
  assert.match(ev3dev('try', '03-obstacles', 'mine.pl'), /touches nothing while it does: not in 3 of 3 runs/);
  fs.mkdirSync(path.join(folder, 'class'));
  fs.writeFileSync(path.join(folder, 'class/anna.pl'), skeleton
    .replace('wander :: true', 'avoid :: us_dist_cm(in1, Cm), Cm < 40 ~> turn(20).\nwander :: true')
    .replace('behave([wander])', 'behave([avoid, wander])'));
  fs.writeFileSync(path.join(folder, 'class/ben.pl'), skeleton);
  fs.writeFileSync(path.join(folder, 'class/carl.pl'), 'start :- a b.\n');
  // The teacher marks the class, and opens the page of who has the fewest points.
  const table = ev3dev('mark', '03-obstacles', 'class', '--seeds', '21-23');
  assert.match(table, /^anna +10 of 10/m);
  const marks = await open(path.join(folder, 'marks/index.html'));
  assert.match(await marks.$eval('table', (element) => element.textContent), /carl0?\s*0\s*10.*Operator expected/s);
  await follow(marks, 'ben');
  const before = await marks.$eval('g.robot', (robot) => robot.getAttribute('transform'));
  await marks.$eval('#moment', (slider) => { slider.value = slider.max; slider.dispatchEvent(new Event('input')); });
  assert.notEqual(await marks.$eval('g.robot', (robot) => robot.getAttribute('transform')), before);
  assert.match(await marks.$eval('body', (body) => body.textContent), /it ran into the (box|wall)/);
  assert.deepEqual([page, marks].flatMap(({ asked, errors }) => [...asked, ...errors]), []);
});

test('the search finds a predicate, from a disk', async () => {
  const page = await open('index.html');
  await page.setViewport({ width: 1400, height: 800 });
  await until(() => page.evaluate(() => typeof document$ !== 'undefined'), 'the scripts of the page');
  await page.focus('.md-search__input');
  await page.keyboard.type('motor_wait');
  await until(() => page.$$eval('.md-search-result__link', (links) => links.some((link) => link.href.includes('reference/'))), 'the results');
  assert.deepEqual(page.asked, []);
});

describe('every page', () => {
  test('has a heading, and asks nobody else for anything', async () => {
    const page = await open('index.html');
    const pages = fs.readdirSync(site, { recursive: true })
      .filter((name) => name.endsWith('.html') && !name.startsWith('playground') && name !== '404.html');
    assert.ok(pages.length > 90);
    for (const name of pages) {
      await page.goto(pathToFileURL(path.join(site, name)).href, { waitUntil: 'domcontentloaded' });
      assert.ok(await page.$('article h1, article h2'), name);
    }
    assert.deepEqual(page.asked, []);
  });
  for (const width of [390, 1300]) {
    test(`is as wide as a screen of ${width}`, async () => {
      const page = await open('index.html');
      await page.setViewport({ width, height: 800 });
      for (const name of ['index.html', 'gallery.html', 'docs/first-afternoon.html', 'reference/motors.html']) {
        await page.goto(pathToFileURL(path.join(site, name)).href);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), name);
      }
    });
  }
});

describe('marks', () => {
  test('are right for axe', async () => {
    fs.writeFileSync(path.join(folder, 'dora.pl'), ':- use_module(library(ev3dev)).\nstart :- set_robot(5.6, 10.6, outB, outC), go(20), wait(3).\n');
    ev3dev('mark', '03-obstacles', 'dora.pl', '--out', 'axe', '--seeds', '1-2');
    for (const name of ['index.html', 'pages/dora.html']) {
      const page = await open(path.join(folder, 'axe', name));
      assert.deepEqual(await violations(page), [], name);
    }
  });
});
