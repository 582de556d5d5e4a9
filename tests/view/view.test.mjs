// What a person does with the page, done in a browser. Each group has a
// session of its own.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { Session, browse, drag, home, open, pixel, request, shows, state, until, violations } from './session.mjs';

let browser;
before(async () => { browser = await browse(); });
after(async () => { await browser?.close(); });

const ROOM = ['sim_start(room)', 'set_robot(5.6, 10.6, outB, outC)'];
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance;
const free = (page) => async () => {
  assert.deepEqual(page.said, []);
  await page.close();
};

/** A session with a page, for all tests of a group. */
function group(name, queries, options, tests) {
  describe(name, () => {
    const it = {};
    before(async () => {
      it.session = await Session.start(...queries);
      it.url = await it.session.view(options);
      it.page = await open(browser, it.url);
    });
    after(async () => {
      const said = it.page?.said ?? [];
      await it.page?.close();
      await it.session?.end();
      assert.deepEqual(said, [], 'nothing on the console');
    });
    tests(it);
  });
}

group('a simulated robot', ROOM, '', (it) => {
  test('is drawn where it is', async () => {
    const [x, y, heading] = await it.session.pose();
    const shown = await shows(it.page, (s) => s.robot?.true, 'the robot');
    assert.ok(near(shown.robot.true[0], x, 0.1) && near(shown.robot.true[1], y, 0.1) && near(shown.robot.true[2], heading, 0.1));
    assert.equal(shown.source, 'sim');
    assert.equal(shown.world.name, 'room');
    assert.match(shown.words, /World room, 300 by 250 cm, 3 obstacles\. The robot is at x 40, y 40, heading 40\./);
  });

  test('has its motors and sensors in the list', async () => {
    const ports = await it.page.$$eval('.port', (rows) => rows.map((row) => row.innerText.replace(/\s+/g, ' ')));
    assert.equal(ports.length, 8);
    assert.match(ports[1], /outB large motor.*%/i);
    assert.match(ports[3], /outD nothing plugged in/);
    assert.match(ports[4], /in1 ultrasonic/);
  });

  test('is seen to move, and its trail grows', async () => {
    const before = await state(it.page);
    await it.session.ask('go_cm(40, 20)');
    const after = await shows(it.page, (s) => Math.hypot(s.robot.true[0] - before.robot.true[0], s.robot.true[1] - before.robot.true[1]) > 19, 'the way');
    assert.ok(after.samples > before.samples);
    assert.ok(after.robot.believed, 'it was asked where it is');
    assert.ok(near(after.robot.believed.pose[0], after.robot.true[0], 3));
    assert.ok(after.charts.some((chart) => chart.title === 'speed'));
  });

  test('has its commands in the log', async () => {
    await shows(it.page, (s) => s.log.some((line) => line.kind === 'command' && /^the robot goes 20 cm/.test(line.text)), 'a command');
  });

  test('has one line for what two wheels do in turn, and times in order', async () => {
    await it.session.ask('forall(between(1, 20, I), (motor_run(outB, I), motor_run(outC, I), wait(0.02)))');
    await it.session.ask('forall(between(21, 30, I), (motor_run(outC, I), wait(0.02))), motor_run(outB, 21)');
    await it.session.ask('wait(1), motor_run(outB, 1), wait(1), motor_stop(outB), motor_stop(outC)');
    const { log } = await shows(it.page, (s) => s.log.filter((line) => /^outC .*stop/.test(line.text)).length > 0, 'the stop');
    const rows = await it.page.$$eval('#log li', (all) => all.map((row) => [Number(row.querySelector('time').textContent), row.querySelector('.times').textContent]));
    const times = rows.map(([time]) => time);
    assert.ok(rows.some(([, count]) => /^×30 until /.test(count)) && rows.length < log.length - 40, JSON.stringify(rows));
    assert.deepEqual(times, [...times].sort((a, b) => a - b));
  });

  test('is dragged by a hand', async () => {
    const { robot } = await state(it.page);
    await drag(it.page, robot.true, [250, 200]);
    await shows(it.page, (s) => near(s.robot.true[0], 250, 2) && near(s.robot.true[1], 200, 2), 'the robot over there');
    const [x, y] = await it.session.pose();
    assert.ok(near(x, 250, 2) && near(y, 200, 2));
  });

  test('stays where a hand has put it, though frames of before still come', async () => {
    const page = await open(browser, it.url, { late: 100 });
    await drag(page, [250, 200], [270, 60]);
    const seen = await page.evaluate(async () => {
      const places = [];
      for (const end = performance.now() + 600; performance.now() < end;) {
        places.push(window.ev3view.state().robot.true);
        await new Promise((done) => { setTimeout(done, 2); });
      }
      return places;
    });
    assert.deepEqual(seen.filter(([x, y]) => !(near(x, 270, 2) && near(y, 60, 2))), []);
    await drag(page, [270, 60], [250, 200]);
    await page.close();
    await it.page.bringToFront();
    await until(async () => near((await it.session.pose())[1], 200, 2), 'the robot back');
  });

  test('is not put into a box', async () => {
    const box = (await state(it.page)).world.items.find((item) => item.kind === 'box');
    await shows(it.page, (s) => near(s.robot.true[0], 250, 2), 'the robot');
    await drag(it.page, [250, 200], [box.x, box.y]);
    await shows(it.page, (s) => /inside/.test(s.notice), 'why not');
    await shows(it.page, (s) => near(s.robot.true[0], 250, 2), 'the robot where it was');
  });

  test('shows keys that a hand presses', async () => {
    const key = await it.page.$('[data-key=enter]');
    const box = await key.boundingBox();
    await it.page.mouse.move(box.x + 10, box.y + 10);
    await it.page.mouse.down();
    await shows(it.page, (s) => s.brick.keys?.includes('enter'), 'the key');
    assert.equal(await it.session.ask('button(enter), write(yes)'), 'yes');
    await it.page.mouse.up();
    await shows(it.page, (s) => !s.brick.keys?.length, 'no key');
  });

  test('shows lights and screen', async () => {
    await it.session.ask('led(left, red), led(right, off)');
    await it.session.ask('screen_text(10, 10, hello), screen_show');
    const shown = await shows(it.page, (s) => s.brick.pixels > 0 && s.brick.lights?.left[0] > 0 && s.brick.lights.right[1] === 0, 'lights and screen');
    assert.equal(shown.brick.lights.left[1], 0);
    assert.match(await it.page.$eval('.lights-text', (p) => p.textContent), /left red, right off/);
  });

  test('loses a wire and gets it again', async () => {
    const choose = async (words) => {
      await it.page.click('[data-port=in1] button');
      await it.page.evaluate((text) => [...document.querySelectorAll('.port-menu button')].find((b) => b.textContent === text).click(), words);
    };
    await choose('Pull the wire');
    await shows(it.page, (s) => s.ports.find((p) => p.port === 'in1').kind === 'gone', 'no sensor');
    await choose('Plug in again');
    await shows(it.page, (s) => s.ports.find((p) => p.port === 'in1').kind === 'sensor', 'the sensor');
  });

  test('has a wheel held fast', async () => {
    await it.page.click('[data-port=outB] button');
    await it.page.evaluate(() => [...document.querySelectorAll('.port-menu button')].find((b) => /Hold/.test(b.textContent)).click());
    await shows(it.page, (s) => s.ports[1].held, 'a wheel that is held');
    await it.page.click('[data-port=outB] button');
    await it.page.evaluate(() => [...document.querySelectorAll('.port-menu button')].find((b) => /Let go/.test(b.textContent)).click());
    await shows(it.page, (s) => !s.ports[1].held, 'a wheel that is free');
  });

  test('stands in a world to which boxes are added, moved and removed', async () => {
    const count = (await state(it.page)).world.items.length;
    await it.page.click('#add-box');
    await drag(it.page, [30, 200], [60, 220]);
    const added = await shows(it.page, (s) => s.world.items.length === count + 1, 'one box more');
    const box = added.world.items.find((item) => near(item.x, 45, 2) && near(item.y, 210, 2));
    assert.ok(near(box.w, 30, 1.5) && near(box.d, 20, 1.5));
    await drag(it.page, [45, 210], [45, 180]);
    await shows(it.page, (s) => s.world.items.some((item) => near(item.x, 45, 2) && near(item.y, 180, 2)), 'the box over there');
    const facts = await it.page.evaluate(async () => (await fetch('world.pl')).text());
    assert.match(facts, /bounds\(0/);
    assert.match(facts, /box\(4[3-7]/);
    await it.page.mouse.click(...await pixel(it.page, 45, 180));
    await it.page.waitForSelector('#inspector button');
    await it.page.evaluate(() => [...document.querySelectorAll('#inspector button')].find((b) => b.textContent === 'Remove').click());
    await shows(it.page, (s) => s.world.items.length === count, 'no box');
  });

  test('goes back to a snapshot', async () => {
    const pick = async (pattern) => {
      await it.page.click('#more');
      await it.page.evaluate((source) => [...document.querySelectorAll('#more-menu button')].find((b) => new RegExp(source).test(b.textContent)).click(), pattern);
    };
    const { robot } = await state(it.page);
    await pick('Take a snapshot');
    const saved = await shows(it.page, (s) => s.snapshots.length === 1, 'a snapshot');
    await drag(it.page, robot.true, [250, 50]);
    await until(async () => near((await it.session.pose())[1], 50, 2), 'another place');
    await pick(`Go back to ${saved.snapshots[0]}`);
    // Not a frame of before, which has the old place, too.
    await shows(it.page, (s) => s.age > saved.age && near(s.robot.true[1], robot.true[1], 0.5), 'the old place');
  });

  test('is measured', async () => {
    await it.page.click('#measure');
    await it.page.mouse.click(...await pixel(it.page, 50, 50));
    await it.page.mouse.click(...await pixel(it.page, 150, 50));
    const { measured } = await state(it.page);
    assert.ok(near(measured, 100, 1.5), `${measured}`);
    await it.session.ask('sim_add(box(200, 200, 10, 10, 0))');
    const kept = await shows(it.page, (s) => s.world.items.some((item) => near(item.x, 200, 0.1) && near(item.y, 200, 0.1)), 'the box');
    assert.equal(kept.measured, measured, 'a box more changes nothing that was measured');
    await it.page.click('#measure');
  });

  test('is followed, zoomed and shown whole again', async () => {
    const before = await state(it.page);
    await it.page.click('#follow');
    const after = await state(it.page);
    assert.ok(after.following && after.camera.scale > before.camera.scale);
    await it.page.click('#fit');
    const whole = await state(it.page);
    assert.ok(!whole.following && near(whole.camera.scale, before.camera.scale, 1e-6));
  });

  test('is driven by the arrow keys', async () => {
    const [x, y] = await it.session.pose();
    await it.page.click('#drive');
    await it.page.keyboard.down('ArrowUp');
    await shows(it.page, (s) => Math.hypot(s.robot.true[0] - x, s.robot.true[1] - y) > 5, 'a way');
    await it.page.keyboard.up('ArrowUp');
    await shows(it.page, (s) => s.ports.every((port) => !port.state?.includes('running')), 'motors that stand');
    await it.page.click('#drive');
  });
});

group('time', ROOM, '', (it) => {
  test('stands, goes by steps, and at another pace', async () => {
    it.session.type('go(20)');
    await shows(it.page, (s) => s.ports[1].state?.includes('running'), 'a motor');
    await it.page.click('#pause');
    const paused = await shows(it.page, (s) => s.clock.paused, 'a pause');
    await it.page.click('#step');
    const stepped = await shows(it.page, (s) => s.time > paused.time, 'a step');
    assert.ok(near(stepped.time - paused.time, 0.1, 0.011) || stepped.clock.paused);
    assert.ok(stepped.clock.paused);
    for (const [i, pace] of ['x1', 'x2', 'x10'].entries()) {
      await it.page.evaluate((k) => document.querySelectorAll('#speeds button')[k].click(), i);
      await shows(it.page, (s) => s.clock.pace === pace, pace);
    }
    await it.page.evaluate(() => document.querySelectorAll('#speeds button')[0].click());
    await it.page.focus('#world');
    await it.page.keyboard.press('Space');
    await shows(it.page, (s) => !s.clock.paused && s.time > stepped.time, 'time');
    await it.page.click('#stop');
    await shows(it.page, (s) => !s.ports[1].state?.includes('running'), 'a stop');
  });
});

const LOOPS = {
  'that spins': 'repeat, fail',
  'that drives and never ends': 'repeat, go(20), fail',
  'that polls a sensor': 'repeat, us_dist_cm(_, _), fail',
  'that sleeps': 'repeat, sleep(0.5), fail',
  'that waits for a move': 'go_cm(5, 5000)',
  'that catches everything': 'repeat, catch(( repeat, go(20), fail ), _, true), fail',
  'that waits for a message': 'go(20), thread_get_message(never)',
};

group('STOP', ROOM, '', (it) => {
  for (const [name, goal] of Object.entries(LOOPS)) {
    test(`ends a program ${name}`, async () => {
      await it.session.ask('go(20)');
      it.session.type(goal);
      await shows(it.page, (s) => s.program.state === 'running', 'a program');
      await it.page.keyboard.press('Escape');
      await shows(it.page, (s) => s.program.state === 'idle' && !s.program.latched, 'the prompt');
      await shows(it.page, (s) => s.ports.every((port) => !port.state?.includes('running')), 'motors that stand');
      assert.equal(await it.session.ask('X = 1, write(X)'), '1', 'the prompt answers');
    });
  }

  test('leaves the prompt alone, pressed once or often', async () => {
    for (let i = 0; i < 5; i += 1) await it.page.click('#stop');
    // A query that comes before they have is a program that they end.
    const { frames } = await state(it.page);
    await shows(it.page, (s) => s.frames > frames + 1 && s.program.state === 'idle' && !s.program.latched, 'the end of STOP');
    assert.equal(await it.session.ask('X = 2, write(X)'), '2');
    await it.session.ask('go(20), wait(0.2)');
    await it.page.click('#stop');
    await shows(it.page, (s) => s.ports.every((port) => !port.state?.includes('running')), 'motors that stand');
    assert.equal(await it.session.ask('go_cm(30, 3), write(done)'), 'done', 'motors run again');
  });

  test('is in reach on a phone, wherever one has scrolled', async () => {
    const page = await open(browser, it.url, { width: 390, height: 844, phone: true });
    await page.evaluate(() => window.scrollTo(0, document.body.scrollHeight));
    const box = await (await page.$('#stop')).boundingBox();
    const y = await page.evaluate(() => document.querySelector('#stop').getBoundingClientRect().top);
    assert.ok(y >= 0 && y < 100 && box.height >= 44);
    it.session.type('repeat, go(20), fail');
    await shows(page, (s) => s.program.state === 'running', 'a program');
    await page.tap('#stop');
    await shows(page, (s) => s.program.state === 'idle', 'the prompt');
    await free(page)();
  });
});

group('charts and log', ROOM, '', (it) => {
  test('show what a program names', async () => {
    await it.session.ask('view_watch(\'left wheel\', outB-position), forall(between(1, 20, I), ( V is sin(I), view_value(error, V), wait(0.05) )), view_mark(lap(1))');
    const shown = await shows(it.page, (s) => s.charts.some((c) => c.title === 'error') && s.charts.some((c) => c.title === 'left wheel')
      && s.log.some((line) => line.kind === 'mark' && line.text.includes('lap(1)')), 'two charts and a mark');
    assert.equal(shown.charts.find((c) => c.title === 'left wheel').unit, '°');
    assert.match(await it.page.$eval('#log', (list) => list.textContent), /lap\(1\)/);
  });

  test('are held, read off, and saved', async () => {
    await it.page.click('#chart-pause');
    assert.ok((await state(it.page)).chartHeld);
    await it.page.focus('#charts');
    await it.page.keyboard.press('ArrowLeft');
    assert.match(await it.page.$eval('#charts', (box) => box.getAttribute('aria-label')), /^At .* s: .*error/);
    const csv = await it.page.evaluate(() => window.ev3view.csv());
    const [head, ...rows] = csv.trim().split('\n');
    assert.match(head, /^time,.*outB\.position.*,error$/);
    assert.ok(rows.length > 10 && rows.every((row) => row.split(',').length === head.split(',').length));
    await it.page.click('#chart-pause');
  });

  test('show warnings of the program', async () => {
    await it.session.ask('print_message(warning, format("the battery is ~w", [low]))');
    await shows(it.page, (s) => s.log.some((line) => line.kind === 'warning' && /the battery is low/.test(line.text)), 'the warning');
  });

  test('are without a line for goals, unless that is wished', async () => {
    assert.equal(await it.page.$eval('#goal', (form) => form.hidden), true);
    assert.equal((await state(it.page)).goals, false);
  });
});

group('charts', ['sim_start(line)'], '', (it) => {
  const charts = async () => (await state(it.page)).charts;
  const plot = (i) => it.page.evaluate((n) => {
    const box = document.querySelectorAll('.chart-plot')[n];
    box.scrollIntoView({ block: 'nearest' });
    const { left, top, width, height } = box.getBoundingClientRect();
    return { left, top, width, height };
  }, i);
  /** A stretch of a chart, in parts of its width. */
  const pull = async (i, from, to) => {
    const { left, top, width, height } = await plot(i);
    await it.page.mouse.move(left + width * from, top + height / 2);
    await it.page.mouse.down();
    await it.page.mouse.move(left + width * to, top + height / 2, { steps: 5 });
    await it.page.mouse.up();
  };
  const click = (selector, words) => it.page.evaluate((where, name) => {
    [...document.querySelectorAll(where)].find((each) => each.textContent.includes(name) || each.ariaLabel === name).click();
  }, selector, words);
  const choose = async (i, ...words) => {
    await it.page.evaluate((n) => document.querySelectorAll('.chart-more')[n].click(), i);
    for (const each of words) await click('.series-menu button', each);
    await it.page.keyboard.press('Escape');
    await until(() => it.page.evaluate(() => !document.querySelector('.series-menu')), 'the menu to close');
  };
  const add = async (...words) => {
    await it.page.click('#chart-add');
    for (const each of words) await click('.series-menu button', each);
    await it.page.keyboard.press('Escape');
  };

  test('begin with what the program reads', async () => {
    await it.session.ask('load_files(user:examples/line_following, [])');
    it.session.type('start');
    const shown = await shows(it.page, (s) => s.charts[0]?.title === 'reflected light', 'the light');
    assert.deepEqual(shown.charts.map((chart) => chart.title), ['reflected light', 'speed']);
    assert.deepEqual(shown.charts[0].series.map((each) => each.label), ['in2 reflected light']);
  });

  test('have any series, each with a color and, for another quantity, a scale of its own', async () => {
    await choose(1, 'outB duty cycle', 'in2 reflected light');
    const [, second] = await charts();
    assert.deepEqual(second.series.map((each) => each.label), ['outB speed', 'outC speed', 'outB duty cycle', 'in2 reflected light']);
    assert.equal(new Set(second.series.map((each) => each.scale)).size, 3);
    assert.equal(second.series[0].scale, second.series[1].scale);
    await add('outB position', 'outC position');
    await add('in1', 'heading believed');
    const all = (await charts()).flatMap((chart) => chart.series.map((each) => each.color));
    assert.equal(new Set(all).size, new Set((await charts()).flatMap((chart) => chart.series.map((each) => each.label))).size, all.join());
  });

  test('are never strips: the panel scrolls', async () => {
    for (const words of ['outC duty cycle', 'outC position', 'heading']) await add(words);
    const heights = await it.page.$$eval('.chart-plot', (plots) => plots.map((each) => each.clientHeight));
    assert.ok(heights.length >= 6 && heights.every((each) => each >= 50), heights.join());
    assert.ok(await it.page.$eval('.strips', (box) => box.scrollHeight > box.clientHeight + 50), 'it scrolls');
    assert.deepEqual(await violations(it.page), []);
  });

  test('are made higher by a drag and by keys, and stay so when the page is loaded again', async () => {
    const bar = await it.page.$('.chart .divider');
    await bar.evaluate((each) => each.scrollIntoView());
    const before = (await plot(0)).height;
    const box = await bar.boundingBox();
    await it.page.mouse.move(box.x + 100, box.y + box.height / 2);
    await it.page.mouse.down();
    await it.page.mouse.move(box.x + 100, box.y + box.height / 2 + 60, { steps: 3 });
    await it.page.mouse.up();
    assert.ok(near((await plot(0)).height, before + 60, 2));
    await bar.focus();
    await it.page.keyboard.press('ArrowDown');
    const { height } = await plot(0);
    assert.ok(height > before + 65);
    const titles = (await charts()).map((chart) => chart.title);
    await it.page.reload();
    await shows(it.page, (s) => s.phase === 'live' && s.charts.length === titles.length, 'the charts again');
    assert.deepEqual((await charts()).map((chart) => chart.title), titles);
    assert.ok(near((await plot(0)).height, height, 2));
  });

  test('hide a series, and a chart', async () => {
    const before = await charts();
    await click('.chart .key', 'outC speed');
    assert.ok((await charts())[1].series.find((each) => each.label === 'outC speed').hidden);
    await choose(0, 'Hide this chart');
    await shows(it.page, (s) => s.charts.length === before.length - 1, 'one chart less');
    await click('#series button', before[0].title);
    await shows(it.page, (s) => s.charts.length === before.length, 'the chart');
  });

  test('are zoomed by a drag, and are back by a double click', async () => {
    const { chartRange: [from, to] } = await state(it.page);
    await pull(0, 0.5, 0.75);
    const { chartRange: [low, high], chartHeld } = await state(it.page);
    assert.ok(chartHeld && high - low < (to - from) * 0.4 && low > from, `${low} ${high}`);
    assert.equal(await it.page.$eval('#chart-live', (button) => button.hidden), false);
    const { left, top, width, height } = await plot(0);
    await it.page.mouse.click(left + width / 2, top + height / 2, { clickCount: 2 });
    const back = await state(it.page);
    assert.ok(!back.chartHeld && back.chartRange[1] - back.chartRange[0] > 19.9);
    assert.equal(back.chartMoment, null);
  });

  test('name a moment by a click, and mark the one that is named', async () => {
    const told = it.page.evaluate(() => new Promise((resolve, reject) => { setTimeout(reject, 5000, new Error('no moment')); document.addEventListener('ev3dev-time', (event) => resolve(event.detail.t), { once: true }); }));
    const { left, top, width, height } = await plot(0);
    await it.page.mouse.click(left + width * 0.6, top + height / 2);
    const t = await told;
    const shown = await state(it.page);
    assert.ok(t >= 0 && shown.chartMoment === t);
    const say = (moment) => it.page.evaluate((s) => document.dispatchEvent(new CustomEvent('ev3dev-time', { detail: { t: s } })), moment);
    await say(0.5);
    const { chartMoment, chartRange: [from, to] } = await state(it.page);
    assert.ok(chartMoment === 0.5 && from <= 0.5 && 0.5 <= to);
    await say(null);
    assert.equal((await state(it.page)).chartMoment, null);
  });

  test('are as at first again, when that is wished, and after what nobody wrote', async () => {
    await choose(0, 'All charts as at first');
    await shows(it.page, (s) => s.charts.length === 2 && s.charts[0].title === 'reflected light', 'the first charts');
    for (const odd of ['{', '{"charts":7}', '{"charts":[{"series":[null]}],"known":[]}', '[]']) {
      await it.page.evaluate((words) => localStorage.setItem('ev3dev-charts', words), odd);
      await it.page.reload();
      await shows(it.page, (s) => s.phase === 'live' && s.charts.length === 2, `charts after ${odd}`);
    }
  });
});

group('panels', ROOM, '', (it) => {
  const size = (selector) => it.page.$eval(selector, (box) => [box.offsetWidth, box.offsetHeight]);
  const bar = (words) => it.page.$(`[role=separator][aria-label="${words}"]`);
  const again = async () => {
    await it.page.reload();
    await shows(it.page, (s) => s.phase === 'live' && s.frames > 2, 'the page again');
  };

  test('are made larger by a drag and by keys, and stay so when the page is loaded again', async () => {
    await shows(it.page, (s) => s.charts.length > 0, 'charts');
    const [, before] = await size('.charts-card');
    const box = await (await bar('Height of the charts')).boundingBox();
    await it.page.mouse.move(box.x + 50, box.y + 6);
    await it.page.mouse.down();
    await it.page.mouse.move(box.x + 50, box.y - 94, { steps: 4 });
    await it.page.mouse.up();
    assert.ok(near((await size('.charts-card'))[1], before + 100, 2));
    for (const [words, panel, key] of [['Width of the world', '.world-card', 'ArrowLeft'], ['Width of brick and log', '.side', 'ArrowLeft'], ['Height of the brick', '.brick-card', 'ArrowUp']]) {
      const way = panel === '.brick-card' ? 1 : 0;
      const sign = panel === '.side' ? 1 : -1;
      const old = (await size(panel))[way];
      await (await bar(words)).focus();
      await it.page.keyboard.press(key);
      await it.page.keyboard.press(key);
      assert.ok(near((await size(panel))[way], old + sign * 32, 2), words);
      assert.equal(await (await bar(words)).evaluate((each) => Number(each.ariaValueNow)), (await size(panel))[way]);
    }
    const all = ['.world-card', '.side', '.brick-card', '.charts-card'];
    const sizes = await Promise.all(all.map(size));
    await again();
    assert.deepEqual(await Promise.all(all.map(size)), sizes);
    assert.deepEqual(await violations(it.page), []);
  });

  test('are as before after a double click, and never larger than the screen', async () => {
    await (await bar('Width of the world')).focus();
    await it.page.keyboard.press('End');
    await it.page.setViewport({ width: 1010, height: 700 });
    await until(() => it.page.evaluate(() => document.querySelector('.side').getBoundingClientRect().right <= innerWidth - 8), 'all on the screen');
    await it.page.setViewport({ width: 1280, height: 800 });
    await until(async () => (await size('.world-card'))[0] > 500, 'a wide world');
    await (await bar('Width of the world')).focus();
    await it.page.keyboard.press('Home');
    assert.equal((await size('.world-card'))[0], 300);
    const box = await (await bar('Width of the world')).boundingBox();
    await it.page.mouse.click(box.x + 6, box.y + 60, { clickCount: 2 });
    assert.ok((await size('.world-card'))[0] > 500);
  });

  test('are folded, what they leave is for others, and stay so when the page is loaded again', async () => {
    const fold = (name) => it.page.click(`.${name}-card .fold`);
    const [charts] = await size('.charts-card');
    const [, log] = await size('.log-card');
    await fold('brick');
    assert.ok((await size('.log-card'))[1] > log + 100);
    await fold('log');
    assert.ok((await size('.charts-card'))[0] > charts + 200, 'charts below a folded log');
    await fold('ports');
    assert.ok((await size('.ports-card'))[0] < 60);
    await fold('charts');
    assert.ok((await size('.charts-card'))[1] < 60);
    await fold('world');
    await again();
    assert.deepEqual(await it.page.$$eval('.folded', (cards) => cards.length), 5);
    for (const id of ['world', 'ports', 'charts', 'brick', 'log']) assert.equal(await it.page.$eval(`#${id}`, (part) => part.offsetParent), null, id);
    assert.deepEqual(await violations(it.page), []);
    for (const name of ['world', 'ports', 'charts', 'brick', 'log']) {
      await it.page.focus(`.${name}-card .fold`);
      await it.page.keyboard.press('Enter');
      assert.equal(await it.page.$eval(`.${name}-card .fold`, (button) => button.ariaExpanded), 'true');
    }
    await shows(it.page, (s) => s.camera.pixels[0] > 300, 'the world');
    assert.ok(near((await size('.charts-card'))[0], charts, 2));
  });

  test('are folded on a phone, and come in any shape from the browser\'s memory', async () => {
    for (const odd of ['7', '{"sizes":{"world":"wide","row":-5},"folded":7}', '{"sizes":null,"folded":["moon"]}']) {
      await it.page.evaluate((words) => localStorage.setItem('ev3dev-panels', words), odd);
      await again();
    }
    await it.page.evaluate(() => localStorage.removeItem('ev3dev-panels'));
    const page = await open(browser, it.url, { width: 390, height: 844, phone: true });
    const whole = await page.evaluate(() => document.body.scrollHeight);
    for (const name of ['world', 'ports', 'brick']) await page.tap(`.${name}-card .fold`);
    assert.ok(await page.evaluate(() => document.body.scrollHeight) < whole - 800);
    await page.evaluate(() => localStorage.removeItem('ev3dev-panels'));
    await free(page)();
  });
});

group('goals', ROOM, 'goals(true)', (it) => {
  const ask = async (goal, pattern) => {
    await it.page.type('#goal-text', goal);
    await it.page.keyboard.press('Enter');
    await until(() => it.page.$eval('#log', (list, source) => new RegExp(source).test(list.textContent), pattern), pattern);
  };
  test('are answered as at the toplevel', async () => {
    await shows(it.page, (s) => s.goals, 'goals');
    await ask('X is 6 * 7.', 'X = 42');
    await ask('fail.', 'false\\.');
    await ask('nothing_such.', 'nothing_such/0');
    await ask('member(X, [apple, pear]).', 'X = apple');
    await it.page.evaluate(() => [...document.querySelectorAll('#log button')].find((b) => b.textContent === 'More').click());
    await until(() => it.page.$eval('#log', (list) => /X = pear/.test(list.textContent)), 'the next answer');
  });
});

group('for everybody', [...ROOM, 'go_cm(30, 10)'], 'goals(true)', (it) => {
  for (const scheme of ['light', 'dark']) {
    for (const [name, size] of [['a screen', {}], ['a wide screen', { width: 1920, height: 1080 }], ['a phone', { width: 390, height: 844, phone: true }]]) {
      test(`nothing is wrong for axe on ${name}, ${scheme}`, async () => {
        const page = await open(browser, it.url, { ...size, scheme });
        assert.deepEqual(await violations(page), []);
        await page.click('#layers');
        assert.deepEqual(await violations(page), []);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(wide <= 0, 'nothing sticks out');
        await free(page)();
      });
    }
  }

  test('targets for fingers are 44 pixels on a phone', async () => {
    const page = await open(browser, it.url, { width: 390, height: 844, phone: true });
    const small = await page.$$eval('button', (buttons) => buttons.filter((b) => b.offsetParent && b.closest('main, .top'))
      .map((b) => [b.id || b.textContent, b.getBoundingClientRect()])
      .filter(([, box]) => box.height < 43.5 || box.width < 43.5).map(([name, box]) => `${name} ${box.width} x ${box.height}`));
    assert.deepEqual(small, []);
    await free(page)();
  });

  test('both color schemes have colors of their own', async () => {
    const ground = (scheme) => it.page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }])
      .then(() => it.page.evaluate(() => getComputedStyle(document.body).backgroundColor));
    assert.notEqual(await ground('light'), await ground('dark'));
    await ground('light');
  });

  test('a page that changes its size keeps all in view', async () => {
    const page = await open(browser, it.url);
    for (const [width, height] of [[390, 844], [844, 390], [700, 900], [1024, 768], [2560, 1440], [1280, 800]]) {
      await page.setViewport({ width, height });
      await until(() => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} x ${height} to fit`);
      await until(async () => {
        const [x, y] = await pixel(page, ...(await state(page)).robot.true);
        const box = await (await page.$('#world')).boundingBox();
        return x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height;
      }, `the robot in view at ${width} x ${height}`);
    }
    await free(page)();
  });

  test('the page weighs less than 240 kB and asks nobody else', async () => {
    const page = await open(browser, it.url);
    const origin = new URL(it.url).origin;
    assert.deepEqual(page.requests.filter((url) => !url.startsWith(origin) && !url.startsWith(origin.replace('http', 'ws'))), []);
    assert.ok(!page.url().includes('?'), 'the token left the address');
    const folder = path.join(home, 'prolog/ev3dev/view');
    const size = fs.readdirSync(folder).reduce((sum, file) => sum + fs.statSync(path.join(folder, file)).size, 0);
    assert.ok(size < 240000, `${size} bytes`);
    await free(page)();
  });
});

group('a real robot', [
  'use_module(library(ev3dev/drive))',
  'use_module(\'tests/support/trees\')',
  'set_robot(5.6, 10.6, outB, outC)',
], '', (it) => {
  test('is shown by its files: what it believes, no truth, no hands', async () => {
    // A plain tree stands in for a brick: nothing moves in it.
    it.session.type('with_tree(plain, [outB-\'lego-ev3-l-motor\', outC-\'lego-ev3-l-motor\', in1-\'lego-ev3-us\'], ( pose(_, _, _), us_dist_cm(_, _), repeat, thread_get_message(over) ))');
    const shown = await shows(it.page, (s) => s.source === 'brick' && s.robot?.believed && s.ports.filter((p) => p.kind === 'motor').length === 2, 'the robot');
    assert.equal(shown.world, null);
    assert.equal(shown.robot.true ?? null, null);
    assert.equal(shown.ports.find((p) => p.port === 'in1').kind, 'sensor');
    assert.deepEqual(await it.page.evaluate(() => ['transport', 'add-box', 'more'].filter((id) => document.getElementById(id).offsetParent)), []);
    assert.ok(await it.page.$eval('[data-key=enter]', (key) => key.disabled));
    assert.deepEqual(await violations(it.page), []);
    await it.page.keyboard.press('Escape');
    await shows(it.page, (s) => s.program.state === 'idle', 'the prompt');
  });
});

group('those who should not', ROOM, '', (it) => {
  const unmoved = async () => {
    const [x, y] = await it.session.pose();
    assert.ok(near(x, 40, 1e-3) && near(y, 40, 1e-3), 'the robot stands where it stood');
    await shows(it.page, (s) => s.phase === 'live', 'a page that lives');
  };

  test('a wrong token, no token, a foreign Host and Origin are refused', async () => {
    const { origin, host } = new URL(it.url);
    const cookies = (await it.page.cookies()).map((c) => `${c.name}=${c.value}`).join('; ');
    for (const [what, path, options, status] of [
      ['no token', '/', {}, 403],
      ['a wrong token', '/?t=wrong', {}, 403],
      ['a wrong cookie', '/', { headers: { Cookie: cookies.replace(/=.*/, '=wrong') } }, 403],
      ['a foreign Host', '/', { headers: { Cookie: cookies, Host: 'evil.example' } }, 403],
      ['a foreign Origin', '/', { headers: { Cookie: cookies, Origin: 'http://evil.example' } }, 403],
      ['a socket without a cookie', '/ws', { upgrade: true, headers: { Origin: origin } }, 403],
      ['a socket of a foreign Origin', '/ws', { upgrade: true, headers: { Cookie: cookies, Origin: 'http://evil.example' } }, 403],
      ['a socket of a foreign Host', '/ws', { upgrade: true, headers: { Cookie: cookies, Origin: origin, Host: 'evil.example' } }, 403],
      ['STOP without a cookie', '/stop', { method: 'POST', headers: { Origin: origin } }, 403],
      ['STOP of a foreign Origin', '/stop', { method: 'POST', headers: { Cookie: cookies, Origin: 'http://evil.example' } }, 403],
      ['another method', '/', { method: 'DELETE', headers: { Cookie: cookies, Origin: origin } }, 405],
      ['a file of another folder', '/../view.pl', { headers: { Cookie: cookies } }, 404],
      ['all as it should be', '/', { headers: { Cookie: cookies, Host: host } }, 200],
    ]) {
      const answer = await request(origin + path, options);
      assert.equal(answer.status, status, what);
      if (status === 403) assert.ok(!/ev3dev_|error\(|_\d+/.test(answer.body), 'no inner words');
    }
    await unmoved();
  });

  test('a page of another origin reads nothing and moves nothing', async () => {
    const other = http.createServer((_, answer) => answer.end('<!doctype html><title>other</title>'));
    await new Promise((resolve) => { other.listen(0, '127.0.0.1', resolve); });
    const page = await browser.newPage();
    await page.goto(`http://127.0.0.1:${other.address().port}/`);
    const { host, port } = new URL(it.url);
    const outcome = await page.evaluate(async (address, number) => {
      const tries = {};
      for (const name of [address, `127.0.0.1:${number}`]) {
        tries[`socket ${name}`] = await new Promise((resolve) => {
          const socket = new WebSocket(`ws://${name}/ws`);
          socket.onopen = () => { socket.send('place 200 200 0'); resolve('open'); };
          socket.onerror = () => resolve('refused');
        });
        tries[`fetch ${name}`] = await fetch(`http://${name}/`, { credentials: 'include' }).then(() => 'read', () => 'refused');
        tries[`stop ${name}`] = await fetch(`http://${name}/stop`, { method: 'POST', mode: 'no-cors', credentials: 'include' }).then(() => 'sent', () => 'refused');
      }
      return tries;
    }, host, port);
    for (const [what, came] of Object.entries(outcome)) if (!what.startsWith('stop')) assert.equal(came, 'refused', what);
    await page.close();
    other.close();
    await unmoved();
  });

  test('lines that are malformed or huge end their connection alone', async () => {
    const outcomes = await it.page.evaluate(async () => {
      const closes = (send) => new Promise((resolve) => {
        const socket = new WebSocket(`ws://${location.host}/ws`);
        socket.onopen = () => send(socket);
        socket.onclose = (event) => resolve(event.code);
      });
      return [
        await closes((s) => s.send('halt')),
        await closes((s) => s.send('place here there 0')),
        await closes((s) => s.send(`mark ${'x'.repeat(100000)}`)),
        await closes((s) => s.send(new Uint8Array([1, 2, 3]))),
      ];
    });
    assert.ok(outcomes.every((code) => [1002, 1003, 1006, 1007, 1008, 1009].includes(code)), outcomes.join());
    await unmoved();
  });

  test('a page that stops reading harms no other', async () => {
    await it.page.evaluate(() => {
      window.idle = new WebSocket(`ws://${location.host}/ws`);
      window.idle.onopen = () => window.idle.send('next');
    });
    const { frames } = await state(it.page);
    await it.session.ask('wait(0.5)');
    await shows(it.page, (s) => s.frames > frames, 'frames');
    await it.page.evaluate(() => window.idle.close());
  });
});

group('many and none', ROOM, 'port(_), token(\'a-token-of-ours\')', (it) => {
  test('ten pages are served', async () => {
    const pages = [];
    for (let i = 0; i < 9; i += 1) pages.push(await open(browser, it.url, { width: 1000, height: 700 }));
    const before = await Promise.all(pages.map(state));
    await it.session.ask('go_cm(40, 10)');
    for (const [i, page] of [it.page, ...pages].entries()) {
      await page.bringToFront();
      await shows(page, (s) => Math.hypot(s.robot.true[0] - 40, s.robot.true[1] - 40) > 9 && (i === 0 || s.frames > before[i - 1].frames), `page ${i}`);
    }
    for (const page of pages) await page.close();
    await it.page.bringToFront();
  });

  test('a page says that the server stopped, and goes on when it is there again', async () => {
    const { port } = new URL(it.url);
    await it.session.ask('view_stop');
    await shows(it.page, (s) => s.phase === 'lost' && /ended|stopped/.test(s.notice), 'a page that is lost');
    await it.session.ask(`view([open(false), port(${port}), token('a-token-of-ours')])`);
    await shows(it.page, (s) => s.phase === 'live', 'a page that lives');
    it.page.said.length = 0; // of connections that were refused meanwhile
  });

  test('a page goes on though an answer never comes', async () => {
    const { port } = new URL(it.url);
    const swallow = (asked) => { if (!asked.url().endsWith('icon.svg')) asked.continue(); };
    await it.page.setRequestInterception(true);
    it.page.on('request', swallow);
    const asked = it.page.requests.length;
    await it.session.ask('view_stop');
    await until(() => it.page.requests.slice(asked).some((url) => url.endsWith('icon.svg')), 'the question why');
    await it.session.ask(`view([open(false), port(${port}), token('a-token-of-ours')])`);
    await shows(it.page, (s) => s.phase === 'live', 'a page that lives');
    it.page.off('request', swallow);
    await it.page.setRequestInterception(false);
    it.page.said.length = 0;
  });

  test('a page says that there is another token now', async () => {
    const { port } = new URL(it.url);
    await it.session.ask('view_stop');
    await it.session.ask(`view([open(false), port(${port}), token('another-token')])`);
    await shows(it.page, (s) => s.phase === 'refused' && /Open the address/.test(s.notice), 'a page that is refused');
    it.page.said.length = 0;
  });
});
