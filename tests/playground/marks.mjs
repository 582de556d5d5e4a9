// Check in the playground says what `swipl ev3dev try` says natively, word for word: for the
// skeleton and the solution of each exercise of the course, and for programs with mistakes. A
// program that does not end by itself is ended.
//
//   node tests/playground/marks.mjs MODULES [EXERCISE ...]

import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { course, home, library, pack, swiplOf } from '../../playground/parts.js';
import { startProlog } from '../../playground/prolog.js';

const [modules, ...named] = process.argv.slice(2);

/** What is printed, natively; it fails if not all points are earned. The picture is left in `modules`. */
const natively = (exercise, file) => new Promise((resolve) => {
  execFile(process.env.SWIPL ?? 'swipl', [path.join(home, 'app/ev3dev.pl'), 'try', exercise, path.resolve(file)], { cwd: modules }, (_, out) => resolve(out.replace(/The picture: .*\n/, '')));
});

const lines = [];
const { swipl, swiplWasm, locateFile } = swiplOf(modules);
const { prolog, FS } = await startProlog({
  swipl, swiplWasm, library: library(), state: fs.readFileSync(path.join(modules, 'state.prc')), arguments: ['-q'],
  files: { ...pack(), ...course() },
  host: { say: (text) => lines.push(text) },
  module: { locateFile, print: (line) => lines.push(line), printErr: (line) => lines.push(line), stdin: () => null },
});

/** What is printed, in WebAssembly. */
function inPage(exercise, text) {
  FS.writeFile('/home/web_user/mine.pl', text);
  const answer = prolog.query(`set_prolog_flag(heartbeat, 2032), nb_setval(ev3dev_playground_turn, off), ev3dev_playground_check:checked('/home/web_user/mine.pl', '/pack/course/${path.basename(exercise)}/exercise.pl', ev3dev_playground:forget_program, found(_, _, _, Text))`).once();
  return answer.success ? String(answer.Text) : JSON.stringify([answer, lines]);
}

let wrong = 0;
function judge(what, found, isRight, expected) {
  if (isRight) return console.log(what);
  wrong += 1;
  console.log(`${what}:\n  expected ${expected}\n  here     ${found}`);
}

/** In which goal of a loop a stack is full is chance. */
const same = (text) => text.replace(/mine\.pl:\d+(?=: .* the stack of)/, 'mine.pl');

/** A page forgets which goal was the last one when a program computes for long. */
const unnamed = (text) => same(text).replace(/(mine\.pl:\d+: )?start failed(; its last goal was .*)?/, 'start failed');

async function compare(what, exercise, text, alike = same) {
  const mine = path.join(modules, 'mine.pl');
  fs.writeFileSync(mine, text);
  const native = natively(path.resolve(folder, exercise), mine);
  const began = performance.now();
  const found = inPage(exercise, text);
  const took = ((performance.now() - began) / 1000).toFixed(1);
  const expected = await native;
  judge(`${what}: ${/Together.*/.exec(found)} (${took} s)`, found, alike(found) === alike(expected), expected);
}

const folder = path.join(home, 'course');
for (const exercise of named.length ? named : fs.readdirSync(folder)) {
  for (const name of ['skeleton', 'solution']) await compare(`${exercise}, ${name}`, exercise, fs.readFileSync(path.join(folder, exercise, `${name}.pl`), 'utf8'), unnamed);
}

const HEAD = ':- use_module(library(ev3dev)).\n';
const GOES = 'set_robot(5.6, 10.6, outB, outC),\n    go_cm(30, 10)';
/** One seed and five seconds. */
const SHORT = `:- use_module(library(ev3dev/exercise)).
exercise(short, [seconds(5), seeds(1)]).
world(_, [bounds(0, 0, 160, 160), start(50, 50, 0)]).
score(2, 'is at 110, 110') :- time_to(110-110, 5, _).
`;
const short = path.resolve(modules, 'short');
fs.mkdirSync(short, { recursive: true });
fs.writeFileSync(path.join(short, 'exercise.pl'), SHORT);
FS.mkdirTree('/pack/course/short');
FS.writeFile('/pack/course/short/exercise.pl', SHORT);

const MISTAKES = {
  'a goal fails': `start :- ${GOES},\n    fast(30).\nfast(X) :- X > 40.`,
  'its last goal fails': `start :- ${GOES},\n    us_dist_cm(_, Cm),\n    near(Cm).\nnear(Cm) :-\n    Cm < 5.`,
  'a command fails': `start :- ${GOES},\n    motor_run(outX, 30).`,
  'no robot is set': 'start :- go_cm(30, 10).',
  'an argument is wrong': `start :- ${GOES},\n    go_cm(30, ten).`,
  'it computes with an atom': `start :- ${GOES}, half(ten).\nhalf(X) :-\n    Y is X / 2, print(Y).`,
  'it divides by zero': `start :- ${GOES},\n    X is 1 / 0, print(X).`,
  'a predicate is missing': `start :- ${GOES},\n    nosuch(3).`,
  'it throws': `start :- ${GOES},\n    throw(oops).`,
  'it fills its stack': 'start :- long(_, _).\nlong([_|T], N) :- long(T, N0), N is N0+1.',
  'it has no start': 'strat :- go_cm(30, 10).',
  'a clause has no head': 'start -> go(3).',
  'it has commands without a head': 'set_robot(5.6, 10.6, outB, outC).\ngo_cm(30, 10).',
};
if (!named.length) for (const [what, text] of Object.entries(MISTAKES)) await compare(what, path.relative(folder, short), HEAD + text);

/** They end by the number of their inferences, natively by the time of a processor. */
const ENDLESS = {
  counts: 'start :- count(0).\ncount(N) :- M is N+1, count(M).',
  'fails in a loop': 'start :- repeat, fail.',
  'collects without an end': 'start :- findall(X, between(1, inf, X), _).',
  'computes when it is loaded': 'start :- start.\n:- start.',
  'computes after it is loaded': ':- initialization(start).\nstart :- start.',
  'catches all, and computes': 'start :- catch(count(0), _, true), start.\ncount(N) :- M is N+1, count(M).',
};
const WAITS = `start :- ${GOES}, repeat, catch((wait(0.1), fail), _, fail).`;
if (!named.length) {
  prolog.query('abolish(ev3dev_playground_check:most_inferences/1), assertz(ev3dev_playground_check:most_inferences(1000000))').once();
  for (const [what, text] of Object.entries(ENDLESS)) {
    const found = inPage('short', HEAD + text);
    const reason = /Stopped: it computes without end, or for too long: .*\(robot time 0\.0 s\)/;
    judge(`a program that ${what} is ended`, found, reason.test(found), reason);
  }
  await compare('a program that catches all, and waits', path.relative(folder, short), HEAD + WAITS);
}
assert.equal(wrong, 0, `${wrong} differ`);
