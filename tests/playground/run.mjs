// Runs an example in SWI-Prolog's WebAssembly build, as tests/playground/run.pl does.
//
//   node tests/playground/run.mjs MODULES EXAMPLE SECONDS

import fs from 'node:fs';
import path from 'node:path';
import { startProlog } from '../../playground/prolog.js';
import { folder, home, library, pack, swiplOf } from '../../playground/parts.js';

const [modules, example, seconds] = process.argv.slice(2);
const lines = [];
const { swipl, swiplWasm, locateFile } = swiplOf(modules);
const { prolog } = await startProlog({
  swipl, swiplWasm, library: library(),
  state: fs.readFileSync(path.join(modules, 'state.prc')),
  arguments: ['-q'],
  files: {
    ...pack(),
    ...folder(path.join(home, 'examples'), '/pack/examples'),
    ...folder(path.join(home, 'tests/support/reasoning'), '/pack/tests/support/reasoning'),
    ...folder(path.join(home, 'tests/support/things'), '/pack/tests/support/things'),
    '/pack/tools/demo.pl': fs.readFileSync(path.join(home, 'tools/demo.pl')),
    '/pack/run.pl': fs.readFileSync(path.join(home, 'tests/playground/run.pl')),
  },
  host: { say: (text) => lines.push(text) },
  module: { locateFile, print: (line) => lines.push(line), printErr: (line) => process.stderr.write(`${line}\n`), stdin: () => null },
});
const answer = prolog.query("working_directory(_, '/pack'), load_files(demo_script:'tools/demo.pl', []), "
  + `load_files('run.pl', []), played(${example}, ${seconds}), flush_output`).once();
if (answer.error) lines.push(answer.message);
process.stdout.write(`${lines.join('\n')}\n`);
