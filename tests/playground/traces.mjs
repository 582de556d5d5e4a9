// The examples that need no thread do the same in WebAssembly as natively, byte for byte.
//
//   node tests/playground/traces.mjs MODULES [EXAMPLE ...]
//
// The two may be of different versions: an exponent has a digit more in newer ones.

import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import path from 'node:path';
import { promisify } from 'node:util';
import { home } from '../../playground/parts.js';

/** Examples with the simulated seconds that they run, and up to which seed random programs are recorded. Left out are those with threads
    (convoy, map_together, sumo_match, far_grid, grid_team), those that call sin, cos, tan or exp
    themselves, which are not the same in every C library, and brick_check, which prints the version
    of Prolog. */
const EXAMPLES = {
  crowd: 18,
  obstacle_avoidance: 60, grid_navigation: 60, braitenberg: 60, line_following: 30, square: 30, slalom: 30,
  remote_control: 10, thermometer: 10, traffic_light: 60, lost: 30, grid_lost: 30, explore_room: 30,
  golog_elevator: 40, golog_rescue: 30, golog_wumpus: 30,
  rules_light_seeker: 30, rules_line_follower: 30, rules_sumo: 30, rules_traffic_light: 60, rules_processes: 40, rules_wander: 30, three_places: 30, pushed: 30,
  backtracking: 30, clear_the_ring: 60, sort_parcels: 60, goal: 60, random_programs: 260,
};

const [modules, ...named] = process.argv.slice(2);
const examples = named.length ? named : Object.keys(EXAMPLES);
const run = promisify(execFile);
const same = (text) => text.replace(/e([+-])0?(\d)(?!\d)/g, 'e$1$2');

/** What is printed, natively. */
async function natively(example, seconds) {
  const { stdout } = await run(process.env.SWIPL ?? 'swipl', ['-q', '-f', 'none', '-p', 'library=prolog',
    '-g', `load_files(demo_script:'tools/demo.pl', []), load_files('tests/playground/run.pl', []), played(${example}, ${seconds})`, '-t', 'halt'],
  { cwd: home, maxBuffer: 1 << 28 });
  return stdout;
}

/** What is printed, in WebAssembly. */
async function inPage(example, seconds) {
  const { stdout } = await run(process.execPath, [path.join(home, 'tests/playground/run.mjs'), modules, example, seconds], { maxBuffer: 1 << 28 });
  return stdout;
}

let wrong = 0;
for (const example of examples) {
  const began = performance.now();
  const [expected, found] = [same(await natively(example, EXAMPLES[example])), same(await inPage(example, EXAMPLES[example]))];
  const [a, b] = [expected.split('\n'), found.split('\n')];
  const differs = a.findIndex((line, i) => line !== b[i]);
  const took = ((performance.now() - began) / 1000).toFixed(1);
  if (expected === found) console.log(`${example}: ${expected.length} bytes, the same (${took} s)`);
  else {
    wrong += 1;
    console.log(`${example}: line ${differs + 1} of ${a.length}:\n  natively ${a[differs]?.slice(0, 300)}\n  here     ${b[differs]?.slice(0, 300)}`);
  }
}
assert.equal(wrong, 0, `${wrong} of ${examples.length} differ`);
