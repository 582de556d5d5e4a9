// A person's first use of the playground, in a browser that has never seen it.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import { after, before, describe, test } from 'node:test';
import { browse, home, isFirefox, patient, until, violations } from '../view/session.mjs';

const HEAD = ':- use_module(library(ev3dev)).\n';
const ROBOT = 'set_robot(5.6, 10.6, outB, outC)';
/** Ten lines that avoid boxes. */
const AVOIDS = `${HEAD}
start :-
    ${ROBOT},
    drive.

drive :-
    us_dist_cm(_, Distance),
    ( Distance > 30 -> go(30) ; turn(30, 90) ),
    drive.
`;

let browser;
let server;
let url;
process.on('exit', () => server?.kill('SIGKILL'));

async function freePort() {
  const probe = net.createServer();
  await new Promise((resolve) => { probe.listen(0, '127.0.0.1', resolve); });
  const { port } = probe.address();
  await new Promise((resolve) => { probe.close(resolve); });
  return port;
}

/** The server of `swipl ev3dev playground`. */
async function serve(port) {
  const started = spawn(process.env.SWIPL ?? 'swipl', ['app/ev3dev.pl', 'playground', '--no-open', '--port', port], { cwd: home, stdio: ['ignore', 'pipe', 'inherit'] });
  let said = '';
  started.stdout.on('data', (text) => { said += text; });
  await until(() => said.includes('Ctrl-C'), 'the server');
  return started;
}

const ended = (child) => new Promise((resolve) => {
  child.on('exit', resolve);
  child.kill('SIGKILL');
});

before(async () => {
  const port = await freePort();
  url = `http://localhost:${port}/`;
  server = await serve(port);
  browser = await browse();
});
after(async () => {
  await browser?.close();
  if (server) await ended(server);
});

/** A page in an empty profile. */
async function visit({ fragment = '', width = 1300, height = 850, scheme = 'light' } = {}) {
  const context = await browser.createBrowserContext();
  const page = patient(await context.newPage());
  page.problems = [];
  page.asked = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error') page.problems.push(message.text()); });
  page.on('request', (request) => page.asked.push(request.url()));
  if (!isFirefox) await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  await page.setViewport({ width, height });
  await page.goto(url + fragment);
  await ready(page);
  page.end = async () => {
    assert.deepEqual(page.problems, []);
    await context.close();
  };
  return page;
}

const state = (page) => page.evaluate(() => window.ev3dev.state());
const ready = (page) => until(async () => (await page.evaluate(() => window.ev3dev?.state().open)) && robot(page), 'Prolog and the robot');
/** Of the live view, in its frame; none while it is loaded. */
const robot = (page) => page.evaluate(() => {
  const view = document.getElementById('robot').contentWindow?.ev3view?.state();
  return view?.robot && { time: view.time, pose: view.robot.true, world: view.world.name, clock: view.clock, state: view.program.state };
}).catch(() => null);
const said = (page, pattern) => until(async () => (await state(page)).said.find(([, text]) => pattern.test(text)), `${pattern} in the console`)
  .catch(async (error) => { throw new Error(`${error.message}: ${JSON.stringify((await state(page)).said)}`); });
const idle = (page) => until(async () => (await state(page)).program?.state === 'idle', 'the end of the program');

async function type(page, text) {
  await page.evaluate((words) => { window.ev3dev.editor.text = words; }, text);
}

async function run(page, text) {
  await page.click('#said-clear');
  await type(page, text);
  await page.click('#run');
}

async function ask(page, goal) {
  await page.click('#query-text');
  await page.keyboard.type(`${goal}\n`);
}

/** The line of the first mark. */
const marked = (page) => page.evaluate(() => {
  const mark = document.querySelector('.cm-lint-marker').getBoundingClientRect();
  return Number([...document.querySelectorAll('.cm-lineNumbers .cm-gutterElement')].find((line) => Math.abs(line.getBoundingClientRect().top - mark.top) < 10)?.textContent);
});
/** The kinds of the marks beside lines. */
const marks = (page) => page.$$eval('.cm-lint-marker', (all) => all.map((mark) => mark.className.replace(/.*cm-lint-marker-/, '')));

describe('the playground', () => {
  let page;
  before(async () => { page = await visit(); });
  after(() => page.end());

  test('drives a robot that ten lines steer, and stops it', async () => {
    await run(page, AVOIDS);
    const { pose } = await robot(page);
    await until(async () => {
      const now = await robot(page);
      return Math.hypot(now.pose[0] - pose[0], now.pose[1] - pose[1]) > 10;
    }, 'a robot that has moved');
    await until(() => page.$('.cm-called'), 'the clause that runs');
    assert.equal(await page.$eval('#run', (button) => button.textContent), 'Stop');
    await page.click('#run');
    await idle(page);
    await said(page, /^STOP/);
    const { pose: stands } = await robot(page);
    await new Promise((resolve) => { setTimeout(resolve, 300); });
    assert.deepEqual((await robot(page)).pose, stands);
  });

  test('says what is wrong, at its line', async () => {
    await run(page, `${HEAD}start :-\n    ${ROBOT},\n    go_cm(20, 30.\n`);
    await said(page, /the \( in line 4 is not closed/);
    await said(page, /was not started/);
    assert.deepEqual(await marks(page), ['error']);

    await run(page, `${HEAD}start :-\n    ${ROBOT},\n    go_ahead(20, 30).\n`);
    await said(page, /^line 4 .*go_ahead\/2/);
    await idle(page);
    await run(page, `${HEAD}start :-\n    go_cm(20, Distance).\n`);
    await said(page, /^line 2 Singleton variables: \[Distance\]/);
    await idle(page);

    await run(page, `${HEAD}start :-\n    motor_run(outX, 30),\n    wait(1).\n`);
    await said(page, /there is no motor at outX; there are: outA/);
    await idle(page);
    await until(async () => String(await marks(page)) === 'warning', 'a mark at the port');
    assert.equal(await marked(page), 3);

    await run(page, `${HEAD}start :-\n    go_cm(20, 30),\n    wait(1).\n`);
    await said(page, /no robot is set/);
    await idle(page);
    await until(async () => await marked(page) === 3, 'a mark at the command');

    await run(page, `${HEAD}start -> go(3).\n`);
    await said(page, /^line 2 this clause has no head/);
    await run(page, `${HEAD}go_cm(20, 30).\n`);
    await said(page, /^line 2 go_cm\/2 is a predicate of the pack/);
    await said(page, /no start\/0 to begin with\. Write `start :-`/);
    await idle(page);

    await run(page, `${HEAD}start :-\n    half(ten).\n\nhalf(X) :-\n    Y is X / 2, print(Y).\n`);
    await said(page, /^line 6 .*`ten\/0' is not a function/);
    assert.ok((await marks(page)).includes('error'));

    await run(page, 'start :- us_dist_cm(_, Cm), print(Cm).\n');
    await said(page, /does not load the robot.s library/);
    await idle(page);
  });

  test('stops what computes, with waits and without', async () => {
    await run(page, `${HEAD}start :- repeat, catch((wait(0.1), fail), _, fail).\n`);
    await until(async () => (await state(page)).program?.state === 'running', 'a program');
    await page.click('#run');
    await said(page, /^stopped/);
    await idle(page);

    // One that does not hear STOP is ended with its worker: see the tests of STOP.
    await run(page, `${HEAD}start :- writeln(begins), loop.\nloop :- numlist(1, 3000000, L), msort(L, _), loop.\n`);
    await said(page, /^begins/);
    await page.evaluate(() => window.ev3dev.machine.stop());
    await said(page, /computed without a pause|^stopped/);
    await ready(page);
    await idle(page);
    assert.match((await state(page)).text, /msort/);
    await ask(page, 'X is 6 * 7.');
    await said(page, /X = 42/);
  });

  test('answers as at the toplevel', async () => {
    await page.click('#said-clear');
    await ask(page, 'member(X, [one, two, three]).');
    await said(page, /^X = one/);
    await page.keyboard.type(';');
    await said(page, /^X = two/);
    await page.keyboard.type('\n');
    await ask(page, 'us_dist_cm(in1, Cm).');
    await said(page, /^Cm = \d/);
    await ask(page, 'format("hello~n").');
    await said(page, /^hello/);
    await ask(page, 'say(good_bye), writeln(over).');
    await said(page, /^the brick said good_bye/);
    await said(page, /^over/);
  });

  test('halt ends the program, not Prolog; the tracer asks for no keys', async () => {
    await page.click('#said-clear');
    await ask(page, 'assertz(known(7)).');
    await said(page, /^true/);
    await run(page, `${HEAD}:- dynamic known/1.\nstart :- ${ROBOT}, go(30), halt.\n`);
    await said(page, /^halt: the program ends/);
    await idle(page);
    await run(page, `${HEAD}start :- ${ROBOT}, trace, drive(1).\ndrive(N) :- N > 0, go_cm(30, 1), N1 is N-1, drive(N1).\ndrive(0).\n`);
    await said(page, /Call: \(\d+\) drive\(1\)[^]*Exit: \(\d+\) 1>0[^]*Call: \(\d+\) go_cm/);
    await said(page, /Fail: \(\d+\) 0>0/);
    await said(page, /^The tracer prints/);
    await ask(page, 'notrace.');
    await idle(page);
    await ask(page, 'leash(-all), trace, X = 5.');
    await said(page, /X = 5/);
    await ask(page, 'notrace.');
    await idle(page);
  });

  test('says that the program has failed, and how to see where', async () => {
    await run(page, `${HEAD}start :- ${ROBOT}, go_cm(20, 3), drive(3).\ndrive(N) :- N > 10, go_cm(30, 2).\n`);
    await said(page, /^start is false: a goal in it has failed.*`trace, start\.`/);
    await idle(page);
  });

  test('drives on while nobody asks anything', async () => {
    await run(page, `${HEAD}start :- ${ROBOT}.\n`);
    await idle(page);
    await page.evaluate(() => document.getElementById('robot').contentDocument.getElementById('reset').click());
    await until(async () => (await robot(page)).time === 0, 'the start');
    await ask(page, `${ROBOT}, go(10).`);
    await said(page, /^true/);
    const { pose } = await robot(page);
    await until(async () => (await robot(page)).pose[1] !== pose[1] && (await robot(page)).time > 0.3, 'a robot that moves');
    await ask(page, 'stop.');
    await idle(page);
    const { time } = await robot(page);
    await ask(page, 'X = standing.');
    await said(page, /^X = standing/);
    assert.equal((await robot(page)).time, time);
  });

  test('lists the program, and shows no folder of the page', async () => {
    await run(page, `${HEAD}:- dynamic seen/1.\nseen(1).\nstart :- near(5).\nnear(X) :- X < 10.\n`);
    await idle(page);
    await page.click('#said-clear');
    await ask(page, 'listing(start).');
    await said(page, /^start :-\n    near\(5\)\.$/);
    await idle(page);
    await page.click('#said-clear');
    await ask(page, 'listing.');
    await said(page, /seen\(1\)\./);
    for (const goal of ['X is 1/0.', 'shell(ls).', 'edit.', 'source_file(start, File).', 'module_property(ev3dev, file(File)).', 'consult(nothing).']) {
      await ask(page, goal);
      await until(async () => (await state(page)).said.at(-1)[0] !== 'goal', goal);
      await idle(page);
    }
    const all = (await state(page)).said.map(([, words]) => words).join('\n');
    for (const words of ['a number is divided by 0', 'a page has no shell', 'in the editor of the page already']) assert.ok(all.includes(words), all);
    assert.doesNotMatch(all, /ev3dev_\w+:|web_user|\/pack|zero_divisor/);
  });

  test('shows what Prolog thinks beside the robot', async () => {
    // What it tries depends on where the robot stands.
    await page.evaluate(() => document.getElementById('robot').contentDocument.getElementById('reset').click());
    await until(async () => (await robot(page)).time === 0, 'the start');
    await run(page, fs.readFileSync(path.join(home, 'examples/backtracking.pl'), 'utf8'));
    await said(page, /reasoning\(start\)/);
    await idle(page);
    const view = await (await page.$('#robot')).contentFrame();
    await view.evaluate(() => document.getElementById('reasoning-open').click());
    const shown = () => view.evaluate(() => window.ev3view.state());
    await until(async () => (await shown()).reasoning?.rows === 27, 'the rows')
      .catch(async (error) => { throw new Error(`${error.message}: ${JSON.stringify([(await shown()).reasoning, (await shown()).notice, await state(page)])}`); });
    const { crosses } = (await shown()).reasoning;
    assert.deepEqual(crosses.map(([name]) => name), ['1', '2', '3']);
    await view.evaluate(() => [...document.querySelectorAll('.outline [role=treeitem]')].find((row) => /is false/.test(row.textContent)).click());
    const { past, reasoning } = await until(async () => { const now = await shown(); return now.past && now; }, 'the past');
    assert.match(reasoning.words, /^[\d.]+ > 60$/);
    assert.ok([0, 1, 2].every((i) => Math.abs(past.robot.true[i] - crosses[0][i + 1]) < 0.2), JSON.stringify([past.robot, crosses[0]]));
    await view.evaluate(() => {
      document.getElementById('time-live').click();
      window.files = {};
      let blob = null;
      URL.createObjectURL = (made) => { blob = made; return '#'; };
      HTMLAnchorElement.prototype.click = function keep() { blob.text().then((words) => { window.files[this.download] = words; }); };
      for (const name of ['SVG', 'Save']) [...document.querySelectorAll('#reasoning button')].find((button) => button.textContent === name).click();
    });
    const saved = await until(() => view.evaluate(() => window.files['reasoning.json'] && window.files['reasoning.svg'] && window.files), 'both files');
    assert.match(saved['reasoning.svg'], /^<svg[^]*given up: [\d.]+ &#62; 60[^]*<image /);
    // It opens beside another program in another world, and runs nothing.
    await run(page, `${HEAD}:- use_module(library(ev3dev/sim)).\nstart :- sim_start(maze, [clock(virtual)]).\n`);
    await until(async () => (await robot(page)).world === 'maze', 'another world');
    await idle(page);
    const { time } = await robot(page);
    const kept = path.join(fs.mkdtempSync(path.join(os.tmpdir(), 'playground-')), 'run.json');
    fs.writeFileSync(kept, saved['reasoning.json']);
    await (await view.$('#reasoning input[type=file]')).uploadFile(kept);
    await until(async () => (await shown()).reasoning.kept, 'the saved run');
    fs.rmSync(path.dirname(kept), { recursive: true });
    assert.equal((await shown()).reasoning.rows, 27);
    assert.equal((await robot(page)).time, time);
    await view.evaluate(() => document.getElementById('reasoning-open').click());
  });

  test('answers what a program reads, and what is typed as at the toplevel', { skip: isFirefox && 'a script of Firefox cannot paste' }, async () => {
    await run(page, `${HEAD}start :- read(Cm), writeln(got(Cm)), read(Next), writeln(next(Next)).\n`);
    await until(() => page.$eval('#query-mark', (mark) => mark.textContent === '|:'), 'a program that reads');
    await ask(page, '5.');
    await said(page, /^got\(5\)/);
    await ask(page, 'point(1,');
    await ask(page, '2).');
    await said(page, /^next\(point\(1,2\)\)/);
    await idle(page);
    await ask(page, '[user].');
    await said(page, /^Type clauses/);
    await page.evaluate(() => {
      const clipboardData = new DataTransfer();
      clipboardData.setData('text', 'likes(mary, wine).\nlikes(john, X) :-\n    likes(X, wine).\n\n');
      document.getElementById('query-text').dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
    });
    await idle(page);
    await page.click('#said-clear');
    await page.evaluate(() => {
      const clipboardData = new DataTransfer();
      clipboardData.setData('text', '?- likes(john, Who).\n?- Other = $Who,\n   atom(Other).');
      document.getElementById('query-text').dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
    });
    await said(page, /^Who = mary/);
    await said(page, /^Other = mary/);
    await idle(page);
    await ask(page, 'read(X).');
    await until(() => page.$eval('#query-mark', (mark) => mark.textContent === '|:'), 'a goal that reads');
    await page.keyboard.press('Escape');
    await said(page, /^stopped/);
    await idle(page);
    await ask(page, 'help.');
    await said(page, /^help\(go_cm\)\. explains/);
    await idle(page);
    await ask(page, 'help(go_cm).');
    await said(page, /Go straight on for Distance cm/);
    await idle(page);
    await ask(page, 'numlist(1, 200, L).');
    await until(() => page.$('#said details'), 'a long answer that is folded');
    await page.keyboard.press('ArrowUp');
    assert.equal(await page.$eval('#query-text', (field) => field.value), 'numlist(1, 200, L).');
    await page.$eval('#query-text', (field) => { field.value = ''; });
  });

  test('answers what reads letters, lines and terms', async () => {
    await run(page, `${HEAD}start :-
    get_char(A), peek_char(B), get_char(B), get_char(_),
    read_line_to_string(user_input, Line),
    read_term(user_input, _, [variable_names(Names)]),
    current_input(In), read_line_to_codes(In, _),
    read_line_to_codes(In, Codes), atom_codes(Atom, Codes),
    read(First), read(In, Second),
    print([A, B, Line, Names, Atom, First, Second]), nl.\n`);
    for (const [typed, hint] of [['ab', 'a line'], ['two  words ', 'a line'], ['point(X,', 'a term'], ['Y).', 'a term'], ['codes', 'a line'], ['1. 2.', 'a term']]) {
      await until(() => page.$eval('#query-hint', (hint, words) => hint.textContent.includes(words), hint), `${hint} to be read`);
      await ask(page, typed);
      await until(async () => (await state(page)).said.some(([, words]) => words === `|: ${typed}`), typed);
    }
    await said(page, /^\[a,b,"two  words ",\['X'=_\w*,'Y'=_\w*\],codes,1,2\]/);
    await idle(page);
    await ask(page, 'engine_create(X, read(X), E), engine_next(E, X).');
    await said(page, /^Nothing can be typed while/);
    await idle(page);
  });

  test('shows a line once, also if all is asked for again', async () => {
    await page.click('#said-clear');
    await ask(page, 'writeln(once).');
    await said(page, /^true/);
    const { frames } = await page.evaluate(() => { window.ev3dev.machine.next(''); return { frames: window.ev3dev.machine.frames }; });
    await until(() => page.evaluate((n) => window.ev3dev.machine.frames > n + 1, frames), 'more frames');
    assert.deepEqual((await state(page)).said.filter(([, words]) => /^once/.test(words)).length, 1);
  });

  test('goes on after engines, branches and output that is caught', async () => {
    await page.click('#said-clear');
    await ask(page, 'engine_create(L, (wait(0.2), numlist(1, 30000, L)), E), engine_next(E, [One|_]), writeln(engine(One)).');
    await said(page, /^engine\(1\)/);
    await idle(page);
    await ask(page, 'use_module(library(ev3dev/events)), race([wait(0.2), (repeat, us_dist_cm(_, D), D < 0)], First), writeln(first(First)).');
    await said(page, /^first\(1\)/);
    await idle(page);
    await ask(page, 'with_output_to(string(S), (wait(0.2), write(caught))), writeln(S), repeat, wait(0.1), fail.');
    await said(page, /^caught/);
    await page.keyboard.press('Escape');
    await said(page, /^stopped/);
    await idle(page);
  });

  test('holds time, lets it pass by steps, and slowly or fast', async () => {
    const view = (id) => page.evaluate((name) => document.getElementById('robot').contentDocument.getElementById(name).click(), id);
    await run(page, `${HEAD}start :- us_dist_cm(_, Cm), Cm < 0.\nstart :- start.\n`);
    await until(async () => (await robot(page)).state === 'running', 'a program');
    await view('pause');
    await until(async () => (await robot(page)).clock.paused, 'a pause');
    const { time } = await robot(page);
    await new Promise((resolve) => { setTimeout(resolve, 300); });
    assert.equal((await robot(page)).time, time);
    await view('step');
    await until(async () => (await robot(page)).time > time, 'a step');
    await view('pause');
    await until(async () => !(await robot(page)).clock.paused, 'time that passes');
    await page.click('#run');
    await idle(page);
  });

  test('runs each example that it offers: it moves, or says why not', async () => {
    const names = await page.$$eval('#examples option', (all) => all.map((each) => each.value).filter(Boolean));
    assert.ok(names.length > 20, names.join());
    await page.evaluate(() => window.ev3dev.machine.send('pace max'));
    for (const name of isFirefox ? names.slice(0, 2) : names) {
      const isExample = await page.$eval(`#examples option[value="${name}"]`, (option) => option.parentElement.label === 'Examples');
      await page.select('#examples', name);
      await until(async () => (await state(page)).name === `${name}.pl`, name);
      await page.evaluate(() => document.querySelectorAll('dialog[open]').forEach((box) => box.close()));
      const waits = await page.$eval('#notice-text', (box) => /keys of the brick/.test(box.textContent));
      await page.click('#said-clear');
      await page.click('#run');
      await until(async () => (await state(page)).program?.state === 'running' || (await state(page)).said.length > 1, `${name} to run`);
      if (isExample && !waits) {
        await until(async () => (await state(page)).said.some(([kind]) => kind === 'output' || kind === 'warning')
          || page.evaluate(() => document.getElementById('robot').contentDocument.querySelector('#log li.command:not(.past)') !== null), `${name} to move, or to say why not`);
      } else await new Promise((resolve) => { setTimeout(resolve, 200); });
      // In one step: if it ended in between, the click would start it again
      await page.evaluate(() => { if (window.ev3dev.state().program?.state === 'running') window.ev3dev.machine.stop(); });
      await idle(page);
      const { said: all } = await state(page);
      assert.deepEqual(all.filter(([kind, words]) => kind === 'error' || /web_user/.test(words)), [], name);
    }
  });

  test('keeps the program in the browser', async () => {
    await page.evaluate(() => { document.getElementById('name').value = 'mine.pl'; });
    await type(page, '% This is mine.\n');
    await page.reload();
    await ready(page);
    assert.equal((await state(page)).text, '% This is mine.\n');
    assert.equal((await state(page)).name, 'mine.pl');
  });

  test('asks nobody else for anything', () => {
    assert.deepEqual(page.asked.filter((asked) => !asked.startsWith(url) && !/^(blob|data):/.test(asked)), []);
  });
});

describe('STOP', () => {
  const PROGRAMS = {
    'prints in a loop': 'start :- writeln(abc), start.',
    'prints in a failing loop': 'start :- repeat, writeln(abc), fail.',
    'prints and computes': 'start :- numlist(1, 2000, L), print(L), nl, start.',
    'writes to user_error': 'start :- format(user_error, "hello~n", []), start.',
    'has 10 MB in one line': "start :- format(\"~*c\", [10000000, 0'x]), start.",
    'fails in a loop': 'start :- repeat, fail.',
    counts: 'start :- count(0).\ncount(N) :- N1 is N+1, count(N1).',
    'recurs without an end': 'start :- long(_, _).\nlong([_|T], N) :- long(T, N0), N is N0+1.',
    'collects for long': 'start :- findall(X, between(1, inf, X), _).',
    'computes for long in one call': 'start :- use_module(library(ev3dev/sim)), sim_step(100000), start.',
    'sorts three million numbers': 'start :- numlist(1, 3000000, L), msort(L, _), start.',
  };
  for (const [what, text] of Object.entries(PROGRAMS)) {
    test(`is for the moment in which the pointer goes down: a program that ${what}`, async () => {
      const page = await visit();
      await run(page, HEAD + text);
      await until(async () => (await state(page)).program?.state === 'running', 'a program');
      if (/^prints (in a|and)|^writes/.test(what)) await until(async () => (await state(page)).said.some(([, words]) => /abc|hello|\d,\d/.test(words)), 'output');
      await page.hover('#run');
      await page.mouse.down();
      assert.notEqual(await page.$eval('#run', (button) => button.textContent), 'Stop');
      await until(async () => (await state(page)).open && (await state(page)).program?.state === 'idle', 'the end of the program');
      await page.mouse.up();
      const now = await state(page);
      assert.equal(now.program.state, 'idle', 'the click after it is no Run');
      assert.equal(now.text, HEAD + text);
      const letters = now.said.reduce((all, [, words]) => all + words.length, 0);
      assert.ok(letters < 210_000, `${letters} letters`);
      await ask(page, 'X is 6 * 7.');
      await said(page, /X = 42/);
      await page.end();
    });
  }

  test('of a program that computes without a pause leaves text, world, things and robot', async () => {
    const page = await visit();
    await page.evaluate(() => ['begin my_world bounds(0,0,90,80).\nstart(30,30,0).\n', 'add box 60 60 10 10', 'add box 20 70 5 5', 'remove 2', 'unplug in1', 'place 40 35 90']
      .forEach((line) => window.ev3dev.machine.send(line)));
    await until(async () => String((await robot(page)).pose) === '40,35,90', 'the robot at its place');
    const seen = () => page.evaluate(() => {
      const { world, ports, robot: { true: pose } } = document.getElementById('robot').contentWindow.ev3view.state();
      return { name: world.name, pose, items: world.items, in1: ports.find(({ port }) => port === 'in1').kind };
    });
    const before = await seen();
    await run(page, `${HEAD}start :- assertz(known(1)), count(0).\ncount(N) :- N1 is N+1, count(N1).\n`);
    await until(() => page.evaluate(() => window.ev3dev.machine.unheard > 6), 'a program that does not answer');
    await page.keyboard.press('Escape');
    await said(page, /computed without a pause.*facts that a program added are gone/);
    await ready(page);
    await until(async () => JSON.stringify(await seen()) === JSON.stringify(before), 'the world as it was');
    await ask(page, 'known(X).');
    await said(page, /unknown procedure.*known\/1/i);
    // A program has begun another world.
    await run(page, `${HEAD}:- use_module(library(ev3dev/sim)).\nstart :- sim_start(maze), wait(1), loop.\nloop :- loop.\n`);
    await until(async () => (await robot(page)).world === 'maze' && (await robot(page)).time > 0.9, 'the other world');
    await page.keyboard.press('Escape');
    await ready(page);
    await until(async () => (await robot(page)).world === 'maze', 'the other world again');
    await page.end();
  });

  test('says how much of the output is left out', async () => {
    const page = await visit();
    await run(page, `${HEAD}start :- writeln(abc), start.\n`);
    await said(page, /^\(\d+ letters of output are left out/);
    await page.keyboard.press('Escape');
    await idle(page);
    await page.end();
  });
});

describe('a link', () => {
  test('has the program and its world in it', async () => {
    const page = await visit();
    await type(page, AVOIDS);
    await page.evaluate(() => window.ev3dev.machine.send('begin my_world bounds(0,0,90,80).\nstart(30,30,0).\nbox(60,60,10,10).\n'));
    await until(async () => (await robot(page)).world === 'my_world', 'the world');
    await page.click('#share');
    const link = await until(() => page.$eval('#link', (field) => field.value), 'a link');
    await page.end();
    const other = await visit({ fragment: link.slice(url.length) });
    assert.equal((await state(other)).text, AVOIDS);
    await until(async () => (await robot(other)).world === 'my_world', 'the world');
    assert.deepEqual((await robot(other)).pose, [30, 30, 0]);
    await other.end();
  });

  test('that is cut off says so', async () => {
    const page = await visit({ fragment: '#q1YqSS0uUbJSKi4' });
    assert.match(await page.$eval('#notice-text', (box) => box.textContent), /not complete/);
    // Firefox says so on its console, too.
    page.problems = page.problems.filter((problem) => !/ReadableStream/.test(problem));
    await page.end();
  });
});

describe('the course', () => {
  const exercise = (name) => fs.readFileSync(path.join(home, 'course/01-first-moves', `${name}.pl`), 'utf8');
  const isOpen = (page, id) => until(() => page.$eval(id, (box) => box.open), id);

  test('is a link: the task, the points of a try, and the worst run as a film', async () => {
    const page = await visit({ fragment: '#task=01' });
    await page.waitForSelector('#tasked', { visible: true });
    assert.match(await page.$eval('#tasked h1', (title) => title.textContent), /First moves/);
    // One reads it beside the program.
    const [task, text] = await page.$$eval('#tasked, #text', (all) => all.map((box) => box.getBoundingClientRect().toJSON()));
    assert.ok(Math.min(task.right, text.right) <= Math.max(task.left, text.left), 'it covers no program');
    assert.deepEqual(await violations(page), []);
    assert.equal((await state(page)).text, exercise('skeleton'));
    await page.click('#task');
    await page.waitForSelector('#tasked', { hidden: true });
    await page.click('#check');
    await isOpen(page, '#checked');
    assert.match(await page.$eval('#checked-points', (line) => line.textContent), /☆☆☆ 0 of 10 points/);
    assert.match(await page.$eval('#checked-text', (box) => box.textContent), /it was never within 5 cm of 110-110/);
    await page.click('#film');
    await until(() => page.evaluate(() => document.getElementById('robot').contentDocument.getElementById('time-text').textContent.startsWith('4.3')), 'the end of the film');

    await type(page, exercise('solution'));
    await page.click('#check');
    await isOpen(page, '#checked');
    assert.match(await page.$eval('#checked-points', (line) => line.textContent), /★★★ 10 of 10 points/);
    await page.click('#checked .text:not(.main)');
    await type(page, 'start :- start_');
    await page.click('#check');
    await isOpen(page, '#checked');
    assert.match(await page.$eval('#checked-text', (box) => box.textContent), /Line 1.*[Ss]yntax|Line 1.*[Ee]nd of file/);
    await page.click('#checked .text:not(.main)');

    // A program that does not end by itself is ended, and STOP is as for any other.
    await type(page, `${HEAD}start :- count(0).\ncount(N) :- M is N+1, count(M).\n`);
    await page.click('#check');
    await isOpen(page, '#checked');
    assert.match(await page.$eval('#checked-text', (box) => box.textContent), /Stopped: it computes without end/);
    await page.click('#checked .text:not(.main)');
    await type(page, 'start :- repeat, fail.');
    await page.click('#check');
    await until(() => page.$eval('#run', (button) => button.textContent === 'Stop'), 'a try');
    await page.click('#run');
    await until(async () => (await state(page)).open && (await state(page)).program?.state === 'idle', 'the end of the try');
    await page.reload();
    await ready(page);
    assert.equal(await page.$eval('#task', (button) => button.hidden), false);
    await page.end();
  });

  test('speaks of buttons, and not of a shell', async () => {
    const tasks = (await (await fetch(`${url}examples.json`)).json()).filter((each) => each.task);
    assert.equal(tasks.length, fs.readdirSync(path.join(home, 'course')).length);
    for (const { name, task } of tasks) {
      assert.doesNotMatch(task, /swipl|Ctrl|\[skeleton\]|href=/, name);
      assert.match(task, /<strong>Check<\/strong>/, name);
    }
  });

  test('has the world of its exercise again after a run', async () => {
    const page = await visit({ fragment: '#task=4' });
    await page.waitForSelector('#tasked', { visible: true });
    const world = () => page.evaluate(() => JSON.stringify(document.getElementById('robot').contentWindow.ev3view.state().world));
    await until(async () => /"line"/.test(await world()), 'the line');
    const before = await world();
    await run(page, `${HEAD}start :- ${ROBOT}, go_cm(20, 10).\n`);
    await until(async () => (await robot(page)).time > 0.5, 'a program that moves');
    await page.waitForSelector('#tasked', { hidden: true });
    await idle(page);
    await page.evaluate(() => document.getElementById('robot').contentDocument.getElementById('reset').click());
    await until(async () => (await robot(page)).time === 0, 'the start');
    assert.equal(await world(), before);
    await page.end();
  });
});

describe('a program of a pupil', () => {
  test('has predicates of its own with the names of ours, and others have ours again', async () => {
    const page = await visit();
    await run(page, `${HEAD}start :- stop(5), writeln(mine).\nstop :- writeln(here).\nstop(_) :- stop.\n`);
    await said(page, /^here\nmine/);
    await run(page, `${HEAD}start :- ${ROBOT}, go(20), wait(0.1), stop, writeln(ours).\n`);
    await said(page, /^ours/);
    await page.end();
  });

  test('sleeps while the simulation goes on, as on a PC', async () => {
    const page = await visit();
    await run(page, `${HEAD}start :- ${ROBOT}, go(30), sleep(1), stop.\n`);
    await until(async () => (await robot(page)).time > 0.99, 'a second');
    await page.end();
  });

  test('is seen at once, though the slider was in the past', async () => {
    const page = await visit();
    await run(page, `${HEAD}start :- ${ROBOT}, go_cm(30, 10).\n`);
    await until(async () => (await robot(page)).time > 0.9, 'a run');
    await idle(page);
    const past = () => page.evaluate(() => Boolean(document.getElementById('robot').contentWindow.ev3view.state().past));
    await page.evaluate(() => document.getElementById('robot').contentDocument.dispatchEvent(new CustomEvent('ev3dev-time', { detail: { t: 0.3 } })));
    await until(past, 'the past');
    await page.click('#run');
    await until(async () => !await past(), 'now');
    await page.end();
  });

  test('has in its link what was drawn by hand', async () => {
    const page = await visit();
    const items = (from) => from.evaluate(() => document.getElementById('robot').contentWindow.ev3view.state().world.items.length);
    const before = await items(page);
    await page.evaluate(() => window.ev3dev.machine.send('add box 60 60 5 5'));
    await until(async () => await items(page) === before + 1, 'the box');
    await page.click('#share');
    const link = await until(() => page.$eval('#link', (field) => field.value), 'a link');
    await page.end();
    const other = await visit({ fragment: link.slice(url.length) });
    await until(async () => await items(other) === before + 1, 'the box of the link');
    await other.reload();
    await ready(other);
    await until(async () => await items(other) === before + 1, 'the box after a reload');
    await other.end();
  });
});

describe('the editor', () => {
  let page;
  before(async () => { page = await visit(); });
  after(() => page.end());
  const offered = () => page.waitForSelector('.cm-tooltip-autocomplete li');
  const text = async () => (await state(page)).text;

  test('makes a new line by Enter, and completes by Tab or what the arrow keys have chosen', async () => {
    await type(page, '');
    await page.click('.cm-content');
    await page.keyboard.type('nl');
    await offered();
    await page.keyboard.press('Enter');
    await page.keyboard.type('us_di');
    await offered();
    await page.keyboard.press('Tab');
    await until(async () => await text() === 'nl\nus_dist_cm', 'the first completion');
    await page.keyboard.press('Enter');
    await page.keyboard.type('us_di');
    await offered();
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
    await until(async () => await text() === 'nl\nus_dist_cm\nus_dist_inches', 'the second completion');
  });

  test('indents by Tab, and is left by Escape and Tab', async () => {
    await type(page, 'x.');
    await page.click('.cm-content');
    await page.keyboard.press('Tab');
    assert.equal(await text(), '    x.');
    assert.match(await page.$eval('#notice-text', (box) => box.textContent), /Escape, then Tab/);
    await page.keyboard.down('Shift');
    await page.keyboard.press('Tab');
    await page.keyboard.up('Shift');
    assert.equal(await text(), 'x.');
    const inEditor = () => page.evaluate(() => Boolean(document.activeElement.closest('#text')));
    assert.ok(await inEditor());
    await page.keyboard.press('Escape');
    await page.keyboard.press('Tab');
    assert.equal(await inEditor(), false);
    assert.equal(await text(), 'x.');
  });

  test('is as wide as a hand makes it, also the next time', async () => {
    const width = () => page.$eval('#program', (card) => card.offsetWidth);
    const before = await width();
    await page.focus('#bench > .divider');
    await page.keyboard.press('ArrowLeft');
    assert.equal(await width(), before - 16);
    await page.reload();
    await ready(page);
    assert.equal(await width(), before - 16);
    await page.focus('#bench > .divider');
    await page.keyboard.press('End');
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
  });
});

describe('nothing is lost', () => {
  const mine = (page) => page.evaluate(() => {
    document.getElementById('examples').dispatchEvent(new Event('focus'));
    return [...document.getElementById('mine').children].map(({ value }) => value);
  });

  test('a text that another one replaces is kept by its name', async () => {
    const page = await visit();
    assert.deepEqual(await mine(page), []);
    await type(page, '% one\n');
    await page.select('#examples', 'square');
    assert.deepEqual(await mine(page), ['mine:my_robot.pl']);
    assert.match(await page.$eval('#mine option', (option) => option.textContent), /^my_robot\.pl, \d+ \w+,? \d\d:\d\d$/);
    await type(page, '% two\n');
    await page.select('#examples', 'square');
    assert.deepEqual(await mine(page), ['mine:square.pl', 'mine:my_robot.pl']);
    await type(page, '% three\n');
    await page.select('#examples', 'square');
    assert.deepEqual(await mine(page), ['mine:square_2.pl', 'mine:square.pl', 'mine:my_robot.pl']);
    await page.select('#examples', 'mine:my_robot.pl');
    assert.equal((await state(page)).text, '% one\n');
    await type(page, '% one, and more\n');
    await page.select('#examples', 'mine:square_2.pl');
    assert.equal((await state(page)).text, '% three\n');
    await page.select('#examples', 'mine:my_robot.pl');
    assert.equal((await state(page)).text, '% one, and more\n');
    assert.equal((await mine(page)).length, 3);

    // Another tab has its own text.
    const other = patient(await page.browserContext().newPage());
    await other.goto(url);
    await until(() => other.evaluate(() => window.ev3dev?.state().open), 'Prolog');
    await type(other, '% of another tab\n');
    await page.reload();
    await ready(page);
    assert.equal((await state(page)).text, '% one, and more\n');
    await other.close({ runBeforeUnload: true });
    await page.end();
  });
});

describe('a phone', () => {
  test('has room for all of it, in two parts', async () => {
    const page = await visit({ width: 390, height: 780 });
    const wide = () => page.evaluate(() => [document, document.getElementById('robot').contentDocument].map((each) => each.documentElement.scrollWidth));
    assert.ok((await wide())[0] <= 390);
    await run(page, `${HEAD}start :- writeln(done).\n`);
    await said(page, /^done/);
    await until(async () => page.$eval('#robot', (frame) => getComputedStyle(frame).visibility === 'visible' && frame.clientWidth > 300), 'the robot, which Run shows');
    assert.ok((await wide()).every((width) => width <= 390));
    await page.end();
  });

  test('says in front of the robot what has failed and what is read', async () => {
    const page = await visit({ width: 390, height: 780 });
    const notice = () => page.$eval('#notice', (box) => (box.hidden ? '' : box.querySelector('p').textContent));
    const shown = (part) => until(() => page.$eval(`#tabs [data-shows=${part}]`, (tab) => tab.ariaPressed === 'true'), part);
    for (const [program, words] of [[`go_cm(500, 5)`, /500 %.*\nfalse\.$/], ['atom_length(1 + 2, _)', /1\s*\+\s*2/], ['fail', /false/], ['read(_)', /The program reads/]]) {
      await run(page, `${HEAD}start :- ${ROBOT}, ${program}.\n`);
      await shown('robot');
      await until(async () => words.test(await notice()), `${words}`);
      await page.click('#notice-act');
      await shown('program');
      assert.equal(await notice(), '');
    }
    await page.click('#run');
    await idle(page);
    await page.end();
  });
});

describe('the frame of the robot', () => {
  test('shows the whole page by its own address', async () => {
    const page = patient(await browser.newPage());
    await page.goto(`${url}view/index.html`);
    await until(() => page.evaluate(() => window.ev3dev?.state().open), 'the playground');
    assert.equal(page.url(), url);
    await page.close();
  });
});

describe('nothing is wrong for axe', () => {
  for (const scheme of isFirefox ? [] : ['light', 'dark']) {
    for (const [width, height] of [[1300, 850], [390, 780]]) {
      test(`${scheme}, ${width} wide`, async () => {
        const page = await visit({ scheme, width, height });
        await run(page, `${HEAD}start :- writeln(done), X is foo + 1, print(X), print(Y).\n`);
        await said(page, /was not started/);
        assert.deepEqual(await violations(page), []);
        await page.click('#share');
        assert.deepEqual(await violations(page), []);
        await page.end();
      });
    }
  }
});

describe('without a network', () => {
  test('it is there again', { skip: isFirefox && 'Firefox keeps no worker in a private window' }, async () => {
    const page = await visit();
    await page.evaluate(() => navigator.serviceWorker.ready);
    const port = new URL(url).port;
    await ended(server);
    page.problems = [];
    await page.reload();
    await ready(page);
    await run(page, `${HEAD}start :- writeln(offline).\n`);
    await said(page, /^offline/);
    await page.end();
    server = await serve(port);
  });
});
