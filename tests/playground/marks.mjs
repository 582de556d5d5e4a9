// Check in the playground says what `swipl ev3dev try` says natively, word for word: for the
// skeleton and the solution of each exercise of the course. Only the reason of an error or a
// failure is another one, because programs are watched there: private/explain/last_goal.pl.
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
  const answer = prolog.query(`ev3dev_playground_check:checked('/home/web_user/mine.pl', '/pack/course/${exercise}/exercise.pl', ev3dev_playground:forget_program, found(_, _, _, Text))`).once();
  return answer.success ? String(answer.Text) : JSON.stringify([answer, lines]);
}

/** A program that was watched has its line there. */
const same = (text, isWatched) => (isWatched ? text.replace(/(With the seed \d+:\n  ).*/, '$1') : text);

let wrong = 0;
for (const exercise of named.length ? named : fs.readdirSync(path.join(home, 'course'))) {
  for (const name of ['skeleton', 'solution']) {
    const file = path.join(home, 'course', exercise, `${name}.pl`);
    const mine = path.join(modules, 'mine.pl');
    fs.copyFileSync(file, mine);
    const native = natively(path.join(home, 'course', exercise), mine);
    const began = performance.now();
    const found = inPage(exercise, fs.readFileSync(file));
    const took = ((performance.now() - began) / 1000).toFixed(1);
    const expected = await native;
    const isWatched = expected.includes('\n  mine.pl:');
    if (same(found, isWatched) === same(expected, isWatched)) console.log(`${exercise}, ${name}: ${/Together.*/.exec(found)} (${took} s)`);
    else {
      wrong += 1;
      console.log(`${exercise}, ${name}:\n  natively ${expected}\n  here     ${found}`);
    }
  }
}
assert.equal(wrong, 0, `${wrong} differ`);
