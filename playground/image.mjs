// Makes the saved state from which a page starts: the pack, loaded by SWI-Prolog's WebAssembly
// build.
//
//   node playground/image.mjs MODULES STATE

import fs from 'node:fs';
import { library, pack, swiplOf } from './parts.js';
import { startProlog } from './prolog.js';

/** What is ready at the start; other libraries of the pack are loaded when a program asks. */
const LIBRARIES = ['ev3dev', 'ev3dev/sim', 'ev3dev/drive', 'ev3dev/events', 'ev3dev/rules', 'ev3dev/layers', 'ev3dev/grid', 'ev3dev/planners',
  'ev3dev/roadmap', 'ev3dev/golog', 'ev3dev/journal', 'ev3dev/localize', 'ev3dev/map', 'ev3dev/grid_belief', 'ev3dev/view'];

const [modules, state] = process.argv.slice(2);
const { swipl, swiplWasm, locateFile } = swiplOf(modules);
const said = [];
/** Libraries that the build lacks, and that are named by what is loaded here. Nothing calls them,
    but for directories that are made and removed by programs of the system. */
const LACKING = {
  shlib: ':- module(shlib, [current_foreign_library/2]).\n:- dynamic current_foreign_library/2.\n',
  'http/json': ':- module(json, [json_write/2]).\njson_write(_, _) :- fail.\n',
  process: `:- module(process, [process_create/3, process_group_kill/2, process_kill/2, process_wait/2, process_wait/3]).
process_create(_, Arguments, _) :- ( append(_, [file(Folder)], Arguments), Arguments = ['-c'|_] -> delete_directory_and_contents(Folder) ; true ).
process_group_kill(_, _).\nprocess_kill(_, _).\nprocess_wait(_, exit(0)).\nprocess_wait(_, exit(0), _).\n`,
};
const started = await startProlog({
  swipl, swiplWasm, library: library(), arguments: ['-q', '-p', 'library=/pack/prolog'], files: {
    ...pack(), ...Object.fromEntries(Object.entries(LACKING).map(([name, text]) => [`/swipl/library/${name}.pl`, text])),
  },
  host: { say: (text) => said.push(text) },
  module: { locateFile, print: (line) => said.push(line), printErr: (line) => said.push(line), stdin: () => null },
});
for (const name of LIBRARIES) {
  const answer = started.prolog.query(`use_module(library(${name}), [])`).once();
  if (!answer.success) throw new Error(`${name}: ${answer.message ?? 'failed'}`);
}
const session = started.prolog.query("load_files(user:'/pack/playground/session.pl', [])").once();
if (!session.success) throw new Error(session.message ?? 'session.pl');
const saved = started.prolog.query("qsave_program('/saved', [class(development)])").once();
if (!saved.success) throw new Error(saved.message ?? 'qsave_program failed');
if (said.length) throw new Error(said.join('\n'));
fs.writeFileSync(state, started.FS.readFile('/saved'));
