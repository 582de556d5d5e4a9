// The time and the memory that the playground takes; printed, not judged.

import { execFile } from 'node:child_process';
import { promisify } from 'node:util';
import { listen } from './server.mjs';
import { browse, home, share, spent, until } from '../view/session.mjs';

const TIMES = 5;
const RUNS = 100;
const WARM = 8;
const BOXES = `:- use_module(library(ev3dev)).
start :- set_robot(5.6, 10.6, outB, outC), drive.
drive :- us_dist_cm(_, D), ( D > 30 -> go(30) ; turn(30, 90) ), drive.
`;

const MANY = `:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
start :-
    findall(box(X, Y, 2, 2), ( between(1, 100, I), X is 10*I, between(1, 100, J), Y is 10*J ), Boxes),
    sim_start([bounds(0, 0, 1100, 1100), start(1055, 55, 0)|Boxes]),
    set_robot(5.6, 10.6, outB, outC),
    repeat, go(20), wait(1), go(-20), wait(1), fail.
`;

const server = await listen();
const { url } = server;

const browser = await browse();
const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor(numbers.length / 2)];
const robot = (page) => page.evaluate(() => document.getElementById('robot').contentWindow?.ev3view?.state().robot?.true).catch(() => null);
const open = (page) => until(() => page.evaluate(() => window.ev3dev?.state().open), 'Prolog');
const idle = (page) => until(() => page.evaluate(() => window.ev3dev.state().program?.state === 'idle'), 'the end');

/** From the link to a robot that moves, in ms. */
async function moves(page) {
  const begin = performance.now();
  await page.goto(url, { waitUntil: 'domcontentloaded' });
  await open(page);
  const [x, y] = await until(() => robot(page), 'the robot');
  await page.evaluate((text) => {
    window.ev3dev.editor.text = text;
    document.getElementById('run').click();
  }, BOXES);
  await until(async () => {
    const now = await robot(page);
    return now && (now[0] !== x || now[1] !== y);
  }, 'a move');
  return performance.now() - begin;
}

const [first, second] = [[], []];
let bytes = 0;
for (let i = 0; i < TIMES; i += 1) {
  const context = await browser.createBrowserContext();
  const page = await context.newPage();
  server.sent = 0;
  first.push(await moves(page));
  bytes = server.sent;
  await page.evaluate(() => navigator.serviceWorker.ready);
  second.push(await moves(page));
  await context.close();
}
console.log(`from the link to a robot that moves: ${(median(first) / 1000).toFixed(2)} s in an empty profile, ${(median(second) / 1000).toFixed(2)} s the second time (medians of ${TIMES})`);
console.log(`over the wire: ${(bytes / 1e6).toFixed(2)} MB until it moves`);

const page = await browser.newPage();
await page.goto(url);
await open(page);
const heap = () => page.workers()[0].evaluate(() => globalThis.ev3dev_memory());

console.log(`at the prompt: ${await share([browser.process().pid], 20)}`);
const inView = (id) => page.evaluate((name) => document.getElementById('robot').contentDocument.getElementById(name).click(), id);
await inView('pause');
console.log(`paused: ${await share([browser.process().pid], 20)}`);
await inView('pause');

/** Frames in a second, while a program drives at x1. */
const runs = (program) => page.evaluate((text) => {
  window.ev3dev.editor.text = text;
  document.getElementById('run').click();
}, program);
const frames = () => page.evaluate(() => document.getElementById('robot').contentWindow.ev3view.state().frames);
for (const [program, what] of [[BOXES, 'x1'], [MANY, 'x1 among 10 000 boxes']]) {
  await runs(program);
  await new Promise((resolve) => { setTimeout(resolve, 3000); });
  const [f0, t0, s0] = [await frames(), performance.now(), spent([browser.process().pid])];
  await new Promise((resolve) => { setTimeout(resolve, 5000); });
  const [f1, t1, s1] = [await frames(), performance.now(), spent([browser.process().pid])];
  console.log(`${((1000 * (f1 - f0)) / (t1 - t0)).toFixed(0)} frames a second at ${what}, each ${((1000 * (s1 - s0)) / (f1 - f0)).toFixed(1)} ms of processors, with Prolog`);
  await page.click('#run');
  await idle(page);
}
await page.evaluate(() => window.ev3dev.machine.send('choose world pack room'));

/** The program's own speed, with nobody who holds time. */
const seconds = async (goal) => {
  await page.evaluate(() => window.ev3dev.machine.send('pace max'));
  await page.evaluate((text) => { window.ev3dev.machine.send(`goal 900 get_time(A), (${text}), get_time(B), T is B - A, format("~3f s~n", [T])`); }, goal);
  const [, line] = await until(() => page.evaluate(() => window.ev3dev.state().said.filter(([kind, text]) => kind === 'output' && / s$/.test(text)).pop()), goal);
  await page.click('#said-clear');
  return line;
};
/** The same natively, on the virtual clock. */
async function natively(goal) {
  const { stdout } = await promisify(execFile)(process.env.SWIPL ?? 'swipl', ['-q', '-f', 'none', '-p', 'library=prolog', '-g',
    `use_module(library(ev3dev)), use_module(library(ev3dev/sim)), sim_start(room, [clock(virtual), seed(1)]), set_robot(5.6, 10.6, outB, outC), get_time(A), ((${goal}) -> true ; true), get_time(B), T is B - A, format("~3f", [T])`, '-t', 'halt'], { cwd: home });
  return Number(stdout);
}
await seconds('set_robot(5.6, 10.6, outB, outC)');
for (const goal of ['sim_step(60)', 'forall(between(1, 10, _), (go_cm(50, 10), turn(50, 90)))', 'forall(between(1, 20000, _), us_dist_cm(in1, _))',
  'findall(N, permutation([a, b, c, d, e, f, g, h], N), _)', 'forall(between(1, 1000000, X), X > 0)']) {
  const [here, there] = [[], []];
  // A browser translates what runs often, and not at once
  const cold = parseFloat(await seconds(goal));
  for (let i = 0; i < WARM; i += 1) await seconds(goal);
  for (let i = 0; i < 3; i += 1) {
    here.push(parseFloat(await seconds(goal)));
    there.push(await natively(goal));
  }
  console.log(`${goal}: ${median(here)} s, natively ${median(there)} s, ${(median(here) / median(there)).toFixed(1)} times as long, ${(cold / median(there)).toFixed(1)} the first time`);
}

// A hundred runs: the worker's memory does not grow.
const sizes = [];
for (let i = 1; i <= RUNS; i += 1) {
  await page.evaluate((text) => {
    window.ev3dev.editor.text = text;
    document.getElementById('run').click();
  }, `${BOXES.replace(', drive.', ', go_cm(50, 5), turn(50, 30).')}% ${i}`);
  await until(() => page.evaluate(() => window.ev3dev.state().said.some(([kind, text]) => kind === 'answer' && /true/.test(text))), 'a run');
  await page.click('#said-clear');
  if (i === 10 || i === RUNS) sizes.push(await heap());
}
console.log(`memory of Prolog and the robot after 10 runs ${(sizes[0] / 1e6).toFixed(0)} MB, after ${RUNS} ${(sizes[1] / 1e6).toFixed(0)} MB`);
await browser.close();
server.close();
