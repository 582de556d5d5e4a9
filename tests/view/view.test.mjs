// What a person does with the page, done in a browser. Each group has a
// session of its own.

import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { after, before, describe, test as testOf } from 'node:test';
import { Session, browse, drag, home, isFirefox, open, pixel, request, shows, state, until, violations } from './session.mjs';

let browser;
before(async () => { browser = await browse(); });
after(async () => { await browser?.close(); });

const ROOM = ['sim_start(room)', 'set_robot(5.6, 10.6, outB, outC)'];
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance;
const free = (page) => async () => {
  assert.deepEqual(page.said, []);
  await page.close();
};

/** What is tried in Firefox, too: something of each part of the page, and what browsers do each
    in its own way. All of it has one page in front and no finger, which BiDi does not have. */
const IN_FIREFOX = new RegExp(['is drawn where', 'is seen to move', 'is dragged by', 'shows keys', 'lights and screen', 'loses a wire',
  'boxes are added', 'key Delete', 'is measured', 'is followed', 'by the arrow keys', 'beside it', 'by Escape', 'by steps', 'never ends$', 'alone, pressed',
  'a program names', 'held, read off', 'what the program prints', 'chosen by part', 'as at the toplevel', 'show that they run', 'on a screen, light',
  'by its files', 'a foreign Host', 'another token'].join('|'));

let wanted = [];
function test(name, act) {
  if (!isFirefox || IN_FIREFOX.test(name)) wanted.push([name, act]);
}

/** A session with a page, for all tests of a group. */
function group(name, queries, options, tests) {
  const it = {};
  wanted = [];
  tests(it);
  const mine = wanted;
  if (mine.length) describe(name, () => {
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
    for (const [title, act] of mine) testOf(title, act);
  });
}

group('a simulated robot', ROOM, '', (it) => {
  test('has an address that is said, even by swipl -q', () => {
    assert.ok(it.session.output.includes(`The robot is at ${it.url}`), it.session.output);
  });

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

  test('is not put outside of the world', async () => {
    for (const to of [[318, 100], [-9, 240], [100, 262]]) {
      await it.page.evaluate(() => { document.getElementById('notice-text').textContent = ''; });
      await drag(it.page, [250, 200], to);
      await shows(it.page, (s) => /outside of the world|inside the walls/.test(s.notice), 'why not');
      await shows(it.page, (s) => near(s.robot.true[0], 250, 2) && near(s.robot.true[1], 200, 2), 'the robot where it was');
    }
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

  test('loses a box that is selected by the key Delete', async () => {
    const count = (await state(it.page)).world.items.length;
    await it.session.ask('sim_add(box(60, 200, 20, 20))');
    await shows(it.page, (s) => s.world.items.length === count + 1, 'a box');
    await it.page.mouse.click(...await pixel(it.page, 60, 200));
    await shows(it.page, (s) => s.selected === 'box', 'it is selected');
    await it.page.keyboard.press('Delete');
    await shows(it.page, (s) => s.world.items.length === count && s.selected === null, 'no box');
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

group('what lies over the world', ROOM, '', (it) => {
  const apart = async (page, id) => {
    const { robot, robotPixels } = await state(page);
    const [x, y] = await pixel(page, ...robot.true);
    const box = await (await page.$(id)).boundingBox();
    const far = robotPixels / 2;
    return x < box.x - far || x > box.x + box.width + far || y < box.y - far || y > box.y + box.height + far;
  };
  for (const [name, size] of [['a screen', {}], ['a phone', { width: 390, height: 844, phone: true }]]) {
    test(`does not hide a robot that is dropped there on ${name}`, async () => {
      const page = await open(browser, it.url, size);
      await page.bringToFront();
      for (const to of [[285, 12], [285, 236], [14, 14], [40, 40]]) {
        await drag(page, (await state(page)).robot.true, to);
        await shows(page, (s) => near(s.robot.true[0], to[0], 2) && near(s.robot.true[1], to[1], 2) && s.selected === 'robot', 'the robot there');
        await until(() => apart(page, '#inspector'), `the robot at ${to} to be seen`);
        await page.click('#drive');
        await until(() => apart(page, '#pad'), `the robot at ${to} to be seen beside the pad`);
        await page.click('#drive');
      }
      await page.close();
    });
  }

  test('goes away by a click beside it', async () => {
    const { robot } = await state(it.page);
    await it.page.mouse.click(...await pixel(it.page, ...robot.true));
    await it.page.click('#drive');
    await shows(it.page, (s) => s.selected === 'robot' && s.driving, 'both');
    await it.page.mouse.click(...await pixel(it.page, 150, 200));
    await shows(it.page, (s) => s.selected === null && !s.driving, 'none');
    await it.page.mouse.click(...await pixel(it.page, ...robot.true));
    await it.page.click('#drive');
    await it.page.click('#log-title');
    await shows(it.page, (s) => s.selected === null && !s.driving, 'none again');
  });

  test('is closed by Escape, which stops the program only if no menu is open', async () => {
    it.session.type('repeat, wait(0.05), fail');
    await shows(it.page, (s) => s.program.state === 'running', 'a program');
    for (const open of ['#layers', '[data-port=outB] button']) {
      await it.page.click(open);
      await it.page.keyboard.press('Escape');
      assert.equal(await it.page.$$eval('.menu', (menus) => menus.filter((menu) => !menu.hidden).length), 0);
    }
    const { frames } = await state(it.page);
    await shows(it.page, (s) => s.frames > frames + 4, 'more frames');
    assert.equal((await state(it.page)).program.state, 'running');
    await it.page.keyboard.press('Escape');
    await shows(it.page, (s) => s.program.state === 'idle' && !s.program.latched, 'STOP');
    const stops = async () => (await state(it.page)).log.filter(({ kind }) => kind === 'stop').length;
    const before = await stops();
    await it.page.click('#drive');
    await it.page.keyboard.press('Escape');
    const after = await shows(it.page, (s) => !s.driving, 'no pad');
    await shows(it.page, (s) => s.frames > after.frames + 4, 'more frames');
    assert.equal(await stops(), before, 'nothing ran');
    it.session.type('go(20), repeat, wait(0.05), fail');
    await shows(it.page, (s) => s.program.state === 'running', 'a program');
    await it.page.mouse.click(...await pixel(it.page, ...(await state(it.page)).robot.true));
    await it.page.keyboard.press('Escape');
    await shows(it.page, (s) => s.program.state === 'idle' && s.selected === null, 'STOP, though the robot is selected');
  });
});

/** Colors of the world's canvas at places in cm. */
const colors = (page, places) => page.evaluate((all) => {
  const canvas = document.getElementById('world');
  const box = canvas.getBoundingClientRect();
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
  copy.drawImage(canvas, 0, 0);
  return all.map(([x, y]) => {
    const [px, py] = window.ev3view.pixel(x, y);
    const [sx, sy] = [(px - box.left) * canvas.width / box.width, (py - box.top) * canvas.height / box.height];
    return [...copy.getImageData(Math.round(sx), Math.round(sy), 1, 1).data].slice(0, 3);
  });
}, places);

group('a robot that has lost its way', ['sim_start([bounds(0, 0, 120, 120), start(60, 60, 0)], [clock(virtual)])', 'set_robot(5.6, 10.6, outB, outC)', 'use_module(library(ev3dev/drive))', 'drive_option(use_gyro, false)'], '', (it) => {
  test('is uncertain within the world only, and faintly', async () => {
    await it.session.ask('pose(_, _, _), forall(between(1, 12, _), turn(60, 360)), catch(for_seconds(20, ( go(50), wait(30) )), _, true)');
    const { robot, world } = await shows(it.page, (s) => s.time > 20, 'a while');
    assert.ok(robot.believed.ellipse[0] > 100, `an ellipse of ${robot.believed.ellipse}`);
    await it.page.click('#zoom-out');
    const [x1, y1, x2, y2] = world.bounds;
    const around = [];
    for (let share = 0.05; share < 1; share += 0.1) {
      for (const off of [8, 16, 24]) {
        around.push([x1 - off, y1 + share * (y2 - y1)], [x2 + off, y1 + share * (y2 - y1)], [x1 + share * (x2 - x1), y1 - off], [x1 + share * (x2 - x1), y2 + off]);
      }
    }
    const outside = new Set((await colors(it.page, around)).map(String));
    assert.equal(outside.size, 1, [...outside].join(' '));
    await it.page.click('#fit');
  });

  test('has wheels that slow down, as time stands after the end', async () => {
    await it.session.ask('motor_run(outA, 40), wait(1), motor_stop(outA, coast)');
    await shows(it.page, ({ ports: [port] }) => port.speed > 300 && !port.state.length, 'a wheel');
    const text = await it.page.$eval('[data-port=outA]', (row) => row.innerText.replace(/\s+/g, ' '));
    assert.match(text, /\d+ ?% slows down · \d+°\/s · \d+°/, 'in the units of commands and of charts');
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
    await it.page.keyboard.press(' ');
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

/** The rows of the log that can be seen. */
const rows = (page) => page.$$eval('#log li', (all) => all.filter((row) => !row.hidden).map((row) => ({
  kind: row.className.split(' ')[0], text: row.querySelector('.text').innerText, at: Number(row.querySelector('time')?.textContent),
})));
const row = (page, pattern, what = String(pattern)) => until(async () => (await rows(page)).find(({ text }) => pattern.test(text)), what);
const choose = (page, source) => page.evaluate((pattern) => [...document.querySelectorAll('#log li')].find((each) => new RegExp(pattern).test(each.textContent)).click(), source);

group('the log', [...ROOM, 'use_module(library(ev3dev/rules))', 'use_module(library(ev3dev/journal))'], '', (it) => {
  test('has what the program prints, between what it does, and not what the toplevel says', async () => {
    it.session.type('writeln(before), go_cm(30, 3), format("~w~n~w~n", [lines, two]), write(\'no end of line\'), T = secret');
    await row(it.page, /no end of line/);
    const { log } = await state(it.page);
    const of = (pattern) => log.findIndex(({ text }) => pattern.test(text));
    const places = [/^before$/, /^the robot goes 3 cm/, /^the robot rests/, /^lines\ntwo\nno end of line$/].map(of);
    assert.ok(places.every((place, i) => place >= 0 && place > (places[i - 1] ?? -1)), JSON.stringify([places, log]));
    assert.ok(log.every(({ text }) => !/secret|T =/.test(text)), JSON.stringify(log));
    assert.ok((await rows(it.page)).some(({ kind }) => kind === 'output'));
    it.session.type('wait(0.3), write(half)');
    it.session.type('wait(0.3), writeln(other)');
    await row(it.page, /^other$/);
    await row(it.page, /^half$/);
  });

  test('has what was asked for, as by why/1', async () => {
    await it.session.ask('why(robot)');
    await shows(it.page, (s) => s.log.some(({ kind, text }) => kind === 'output' && /^the robot rests/.test(text)), 'the answer of why/1');
  });

  test('has STOP in it', async () => {
    it.session.type('repeat, go(20), fail');
    await shows(it.page, (s) => s.program.state === 'running', 'a program');
    await it.page.click('#stop');
    await row(it.page, /^STOP: all motors brake, and the program ends$/);
    await shows(it.page, (s) => s.program.state === 'idle', 'the prompt');
  });

  test('is chosen by part and by rule, and says why of a line that is clicked', async () => {
    await it.session.ask('catch(behave([(left :: us_dist_cm(_, D), D > 1 ~> motor_run(outA, 20))], [timeout(0.5)]), _, true), motor_run(outB, 10), motor_stop(outB)');
    await row(it.page, /^outB was stopped/);
    const options = await it.page.$$eval('#log-about option', (all) => all.map((option) => option.value));
    assert.deepEqual(options, ['', 'outA', 'outB', 'outC', 'robot', 'rule left']);
    await it.page.select('#log-about', 'rule left');
    const ruled = await rows(it.page);
    assert.ok(ruled.some(({ text }) => /^outA runs at 20 %/.test(text)) && ruled.every(({ text }) => /outA|rule left/.test(text)), JSON.stringify(ruled));
    assert.ok(ruled.every(({ text }) => !/why: /.test(text)), 'nothing says why unasked');
    await it.page.evaluate(() => document.addEventListener('ev3dev-time', (event) => { window.asked = event.detail.t; }));
    await choose(it.page, '^[^a-z]*outA runs at 20');
    const { text, at } = await row(it.page, /^outA runs at 20 %/);
    assert.match(text, /why: rule left, us_dist_cm .* > 1/);
    assert.ok(near(await it.page.evaluate(() => window.asked), at, 0.006));
    await it.page.keyboard.press('Tab');
    await it.page.focus('#log');
    await it.page.keyboard.press('ArrowUp');
    assert.ok((await rows(it.page)).every(({ text: words }) => !/^outA runs.*why: /.test(words)), 'another line is chosen');
    await it.page.select('#log-about', '');
  });

  test('is kept when another simulation begins', async () => {
    await it.session.ask('sim_start(room)');
    await row(it.page, /^Another run begins\.$/);
    await row(it.page, /^STOP: /);
    await it.page.evaluate(() => { window.asked = 'nothing'; });
    await choose(it.page, 'STOP: ');
    assert.equal(await it.page.evaluate(() => window.asked), 'nothing', 'its time is over');
  });
});

group('goals', ROOM, 'goals(true)', (it) => {
  const type = async (goal) => {
    await it.page.$eval('#goal-text', (input) => { input.value = ''; });
    await it.page.type('#goal-text', goal);
    await it.page.keyboard.press('Enter');
  };
  const ask = async (goal, pattern) => {
    await type(goal);
    return row(it.page, pattern);
  };
  const why = () => it.page.$eval('#goal-why', (line) => (line.hidden ? '' : line.textContent));

  test('are answered as at the toplevel', async () => {
    await shows(it.page, (s) => s.goals, 'goals');
    await ask('X is 6 * 7.', /^X = 42\.$/);
    await ask('fail.', /^false\.$/);
    await ask('nothing_such.', /nothing_such\/0/);
    await ask('member(X, [apple, pear]).', /^X = apple$/);
    await it.page.waitForSelector('#goal-more', { visible: true });
    await it.page.click('#goal-more');
    await row(it.page, /^X = pear\.$/);
    await until(() => it.page.$eval('#goal-more', (button) => button.hidden), 'no more answers');
    await ask('member(X, [fig, plum]).', /^X = fig$/);
    await it.page.waitForSelector('#goal-more', { visible: true });
    await ask(';', /^X = plum\.$/);
  });

  test('end one of before that has more answers', async () => {
    await ask('setup_call_cleanup(true, member(X, [one, two]), writeln(\'cleaned up\')).', /^X = one$/);
    await ask('X is 5 + 6.', /^X = 11\.$/);
    await row(it.page, /^cleaned up$/);
    assert.equal(await why(), '');
    assert.ok((await rows(it.page)).every(({ text }) => !/X = two/.test(text)));
  });

  test('have what they print before their answer', async () => {
    await ask('writeln(hello), write(there), Y = 1.', /^Y = 1\.$/);
    const all = (await rows(it.page)).map(({ text }) => text);
    assert.deepEqual(all.slice(-3), ['?- writeln(hello), write(there), Y = 1.', 'hello\nthere', 'Y = 1.']);
  });

  test('that are no goals are refused in words', async () => {
    const { text } = await ask('go_cm 30, 20.', /Syntax error/);
    assert.match(text, /operator expected/i);
    assert.doesNotMatch(text, /operator_expected|stream/);
    await ask('X = "abc.', /Syntax error: .*string/i);
  });

  test('show that they run, and are ended by STOP', async () => {
    await type('go(20), wait(1), repeat, wait(0.1), fail.');
    await shows(it.page, (s) => s.program.state === 'running' && s.ports[1].state?.includes('running'), 'a goal that runs');
    await until(() => it.page.$eval('#place-doing', (words) => /a program runs/.test(words.textContent)), 'the words');
    await type('X = 77.');
    await until(async () => /A program runs/.test(await why()), 'why not');
    assert.equal(await it.page.$eval('#goal-text', (input) => input.value), 'X = 77.', 'what was typed is kept');
    assert.equal((await state(it.page)).notice, '');
    await it.page.keyboard.press('Escape');
    await row(it.page, /^stopped\.$/);
    await shows(it.page, (s) => s.program.state === 'idle' && !s.program.latched, 'the prompt');
    await ask('repeat, fail.', /^\?- repeat, fail\.$/);
    await shows(it.page, (s) => s.program.state === 'running', 'a goal that spins');
    await it.page.click('#stop');
    await shows(it.page, (s) => s.program.state === 'idle' && !s.program.latched, 'its end');
    await type('X = 78.');
    await row(it.page, /^X = 78\.$/);
    assert.doesNotMatch(it.session.output, /died on|\[Thread/, 'nothing of threads on the terminal');
  });

  test('are refused while a program runs at the toplevel', async () => {
    it.session.type('go(20), repeat, wait(0.1), fail');
    await shows(it.page, (s) => s.program.state === 'running', 'a program');
    await type('X = 79.');
    await until(async () => /A program runs/.test(await why()), 'why not');
    await it.page.click('#stop');
    await shows(it.page, (s) => s.program.state === 'idle' && !s.program.latched, 'the prompt');
    await it.page.focus('#goal-text');
    await it.page.keyboard.press('Enter');
    await row(it.page, /^X = 79\.$/);
    assert.equal(await why(), '');
  });

  test('find nothing to read, and do not wait for it', async () => {
    await ask('read(X).', /^X = end_of_file\.$/);
    await row(it.page, /has nothing to read/);
    await ask('consult(user), Y = consulted.', /^Y = consulted\.$/);
    assert.equal(await it.session.ask('X = 3, write(X)'), '3', 'the terminal is the toplevel\'s');
  });

  test('end with their page', async () => {
    const page = await open(browser, it.url);
    await page.type('#goal-text', 'go(20), repeat, wait(0.1), fail.');
    await page.keyboard.press('Enter');
    await shows(page, (s) => s.program.state === 'running', 'a goal');
    await page.close();
    await it.page.bringToFront();
    await shows(it.page, (s) => s.program.state === 'idle', 'its end');
    await it.session.ask('stop');
    assert.doesNotMatch(it.session.output, /died on|\[Thread/);
  });
});

group('for everybody', [...ROOM, 'use_module(library(ev3dev/journal))', 'because(go_cm(30, 10), curious)'], 'goals(true)', (it) => {
  for (const scheme of ['light', 'dark']) {
    for (const [name, size] of [['a screen', {}], ['a wide screen', { width: 1920, height: 1080 }], ['a tablet', { width: 820, height: 1180, phone: true }], ['a phone', { width: 390, height: 844, phone: true }]]) {
      test(`nothing is wrong for axe on ${name}, ${scheme}`, async () => {
        const page = await open(browser, it.url, { ...size, scheme });
        assert.deepEqual(await violations(page), []);
        await choose(page, 'the robot goes');
        await page.$eval('#goal-why', (line) => { line.hidden = false; line.textContent = 'A program runs.'; });
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

  test('the page says on a phone that a program runs', async () => {
    const page = await open(browser, it.url, { width: 390, height: 844, phone: true });
    it.session.type('repeat, wait(0.05), fail');
    await shows(page, (s) => s.program.state === 'running', 'a program');
    await until(() => page.$eval('#place-text', (words) => /a program runs/.test(words.innerText)), 'the words');
    const hidden = await page.$eval('#place-text', (words) => [words.scrollWidth - words.clientWidth, words.scrollHeight - words.clientHeight]);
    assert.ok(hidden.every((length) => length <= 0), `${hidden} pixels cannot be seen`);
    await page.tap('#stop');
    await shows(page, (s) => s.program.state === 'idle', 'the prompt');
    await free(page)();
  });

  test('a tablet has no void', async () => {
    const page = await open(browser, it.url, { width: 820, height: 1180, phone: true });
    const cards = await page.$$eval('.card', (all) => all.map((card) => {
      const { left, top, width, height } = card.getBoundingClientRect();
      return { left, top, width, height, used: [...card.children].filter((child) => child.offsetParent && getComputedStyle(child).position !== 'absolute').reduce((sum, child) => sum + child.getBoundingClientRect().height, 0), name: card.className };
    }));
    const main = await page.$eval('main', (box) => box.getBoundingClientRect().width * box.getBoundingClientRect().height);
    const area = cards.reduce((sum, { width, height }) => sum + width * height, 0);
    assert.ok(area > 0.9 * main, `${area / main} is covered by cards`);
    for (const { name, height, used } of cards) if (!/world/.test(name)) assert.ok(height - used < 40, `${name} is empty for ${height - used} pixels`);
    await free(page)();
  });

  test('boxes stand out from the floor in the dark', async () => {
    const page = await open(browser, it.url, { scheme: 'dark' });
    const box = (await state(page)).world.items.find((item) => item.kind === 'box');
    const [inside, floor] = (await colors(page, [[box.x, box.y], [295, 245]])).map((color) => {
      const [r, g, b] = color.map((part) => (part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    });
    assert.ok((inside + 0.05) / (floor + 0.05) > 2.5, `a contrast of ${(inside + 0.05) / (floor + 0.05)}`);
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

  test('the page weighs less than 150 kB and asks nobody else', async () => {
    const page = await open(browser, it.url);
    const origin = new URL(it.url).origin;
    assert.deepEqual(page.requests.filter((url) => !url.startsWith(origin) && !url.startsWith(origin.replace('http', 'ws'))), []);
    assert.ok(!page.url().includes('?'), 'the token left the address');
    const folder = path.join(home, 'prolog/ev3dev/view');
    const size = fs.readdirSync(folder).reduce((sum, file) => sum + fs.statSync(path.join(folder, file)).size, 0);
    assert.ok(size < 150000, `${size} bytes`);
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
