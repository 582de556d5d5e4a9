// The delays from a program to the page and back; printed, not
// judged: wall time depends on what else the machine does.

import { Session, browse, open, share, shows, spent, state } from './session.mjs';

const TIMES = 30;
const session = await Session.start('sim_start(room)', 'set_robot(5.6, 10.6, outB, outC)');
const browser = await browse();
const page = await open(browser, await session.view());

/** In the page: when a port first shows that it runs, or does not. */
const seen = (running) => page.evaluate((wanted) => new Promise((resolve) => {
  const look = () => {
    const port = window.ev3view.state().ports.find((each) => each.port === 'outA');
    if (port.state.includes('running') === wanted) resolve(performance.timeOrigin + performance.now());
    else setTimeout(look, 1);
  };
  look();
}), running);

const median = (numbers) => numbers.sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
const worst = (numbers) => Math.max(...numbers);
const row = (what, numbers) => console.log(`${what}: median ${median(numbers).toFixed(0)} ms, worst ${worst(numbers).toFixed(0)} ms of ${numbers.length}`);

const starts = [];
const stops = [];
for (let i = 0; i < TIMES; i += 1) {
  const shown = seen(true);
  const [at] = await session.numbers('get_time(T), motor_run(outA, 20), Ms is T * 1000, format("~3f", [Ms])');
  starts.push(await shown - at);
  const stands = seen(false);
  const pressed = await page.evaluate(() => {
    document.getElementById('stop').click();
    return performance.timeOrigin + performance.now();
  });
  stops.push(await stands - pressed);
  await shows(page, (s) => !s.program.latched && s.program.state === 'idle', 'the prompt');
}
row('from a motor\'s start to its being seen', starts);
row('from STOP to its effect being seen', stops);

/** Frames and pictures of a second, and what each frame costs the browser: on a busy machine there
    are fewer, at the same cost. */
async function drawn(what, of) {
  const [begin, from, began] = [await state(of), spent([browser.process().pid]), performance.now()];
  await new Promise((resolve) => { setTimeout(resolve, 5000); });
  const [end, to, ended] = [await state(of), spent([browser.process().pid]), performance.now()];
  const [frames, pictures] = [end.frames - begin.frames, end.drawings - begin.drawings];
  const rate = (count) => ((1000 * count) / (ended - began)).toFixed(1);
  console.log(`${what}: ${rate(frames)} frames and ${rate(pictures)} pictures a second, each frame ${((1000 * (to - from)) / frames).toFixed(1)} ms of processors`);
}

/** Prolog and the browser together, while nothing changes. */
const idle = [session.prolog.pid, browser.process().pid];
console.log(`a page at the prompt: ${await share(idle, 20)}`);
await page.click('#pause');
await shows(page, (s) => s.clock.paused, 'a pause');
console.log(`a page that pauses: ${await share(idle, 20)}`);
await page.click('#pause');

session.type('repeat, go(20), wait(1), turn(20, 90), fail');
await shows(page, (s) => s.program.state === 'running', 'a program');
await drawn('a robot that drives', page);

// Six charts on a screen, each of two series, of the last 20 s and then of all.
const series = ['outA', 'outB', 'outC'].flatMap((port) => ['position', 'speed', 'duty'].map((quality) => `${port}.${quality}`)).concat(['in1.value0', 'in2.value0', 'in3.value0']);
await page.setViewport({ width: 1280, height: 1400 });
await page.evaluate((names) => {
  const charts = [0, 2, 4, 6, 8, 10].map((i) => ({ series: names.slice(i, i + 2), height: 88 }));
  localStorage.setItem('ev3dev-charts', JSON.stringify({ charts, known: [] }));
}, series);
await page.reload();
await shows(page, (s) => s.charts.length === 6 && s.samples > 100, 'six charts');
for (const [words, span] of [['20 s', 1], ['all', 3]]) {
  await page.evaluate((n) => document.querySelectorAll('#spans button')[n].click(), span);
  const spent = [];
  for (let i = 0; i < 21; i += 1) {
    const [from, first] = [await page.metrics(), await state(page)];
    await new Promise((resolve) => { setTimeout(resolve, 300); });
    const [to, last] = [await page.metrics(), await state(page)];
    if (last.frames > first.frames) spent.push(((to.ScriptDuration - from.ScriptDuration) * 1000) / (last.frames - first.frames));
  }
  console.log(`six charts of ${words}, ${(await state(page)).samples} samples: script of a frame, median ${median(spent).toFixed(1)} ms, worst ${worst(spent).toFixed(1)} ms`);
}
await page.close();
session.prolog.kill();          // its program does not end
await session.ended;

const many = await Session.start('findall(box(X, Y, 2, 2), ( between(1, 100, I), X is 10*I, between(1, 100, J), Y is 10*J ), Boxes), sim_start([bounds(0, 0, 1100, 1100), start(1055, 55, 0)|Boxes])', 'set_robot(5.6, 10.6, outB, outC)');
const crowded = await open(browser, await many.view());
many.type('repeat, go(20), wait(1), go(-20), wait(1), fail');
await shows(crowded, (s) => s.program.state === 'running', 'a program');
await drawn('10 000 boxes', crowded);
await browser.close();
many.prolog.kill();             // its program does not end
await many.ended;
