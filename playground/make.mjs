// Makes the folder of the playground from what was built.
//
//   node playground/make.mjs MODULES FOLDER

import crypto from 'node:crypto';
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { gzipSync } from 'node:zlib';
import { pack as packed } from './archive.js';
import { course, folder, home, library, pack, swiplOf } from './parts.js';

const [modules, to] = process.argv.slice(2);
const need = createRequire(path.resolve(modules, 'package.json'));
const esbuild = need('esbuild-wasm');
const { marked } = need('marked');
const here = (name) => path.join(home, 'playground', name);
const { locateFile } = swiplOf(modules);

fs.rmSync(to, { recursive: true, force: true });
fs.mkdirSync(path.join(to, 'view'), { recursive: true });

// The live view, with another line to the program.
for (const [name, bytes] of Object.entries(folder(path.join(home, 'prolog/ev3dev/view'), 'view'))) fs.writeFileSync(path.join(to, name), bytes);
fs.copyFileSync(here('wire.js'), path.join(to, 'view/wire.js'));
for (const name of ['index.html', 'bench.css', 'patience.js']) fs.copyFileSync(here(name), path.join(to, name));
fs.copyFileSync(path.join(modules, 'words.json'), path.join(to, 'words.json'));

/** A task as it is for the page: what one types in a shell, buttons do here. */
function inPage(name, task) {
  const told = [
    [/```\nswipl ev3dev sim [^\n]*\n\?- \[skeleton\]\.\n\?- start\.\n```/g, 'Press **Run**.'],
    [/```\nswipl ev3dev sim [^\n]*\n\?- \[skeleton\]\.\n/g, 'Press **Run**, then **Stop**: now the program is loaded. Ask this below it:\n\n```\n'],
    [/```\nswipl ev3dev try [^\n]*\n```/g, 'Press **Check**.'],
    [/\n[^\n]*`swipl ev3dev mark [^`]*`\.?\n/g, '\n'],
    [/Load the skeleton/g, 'Press **Run**, which loads the skeleton,'],
    [/`try`/g, '**Check**'],
    [/Ctrl-C/g, '**Stop**'],
    [/\[([^\]]*)\]\([^)]*\.md\)/g, '$1'],
  ];
  const words = told.reduce((text, [from, to]) => text.replace(from, to), task);
  const left = /.*(?:swipl|\[skeleton\]|Ctrl).*/.exec(words);
  if (left) throw new Error(`The task of ${name} speaks of a shell: ${left}`);
  return words;
}

// A task is a part of the pack, and becomes HTML here.
const examples = JSON.parse(fs.readFileSync(path.join(modules, 'examples.json'), 'utf8'));
for (const each of examples) if (each.task) each.task = marked.parse(inPage(each.name, each.task));
fs.writeFileSync(path.join(to, 'examples.json'), JSON.stringify(examples));
fs.copyFileSync(locateFile('swipl-web.js'), path.join(to, 'swipl-web.js'));

const options = { bundle: true, minify: true, target: 'es2022', nodePaths: [path.resolve(modules, 'node_modules')], logLevel: 'warning', legalComments: 'none' };
const inView = { name: 'view', setup: (build) => build.onResolve({ filter: /^\.\/view\// }, ({ path: name }) => ({ path: path.join(home, 'prolog/ev3dev', name) })) };
await esbuild.build({ ...options, plugins: [inView], entryPoints: [here('bench.js')], format: 'esm', outfile: path.join(to, 'bench.js') });
await esbuild.build({ ...options, entryPoints: [here('worker.js')], format: 'iife', outfile: path.join(to, 'worker.js') });

const bytes = gzipSync(packed({
  'swipl-web.wasm': fs.readFileSync(locateFile('swipl-web.wasm')), 'swipl-web.data': fs.readFileSync(locateFile('swipl-web.data')),
  'ev3dev.wasm': library(), 'state.prc': fs.readFileSync(path.join(modules, 'state.prc')), ...pack(), ...course(),
  // What examples load from beside them
  ...Object.fromEntries(['grid_planner', 'plnxt'].map((name) => [`/home/web_user/${name}.pl`, fs.readFileSync(path.join(home, `examples/${name}.pl`))])),
}), { level: 9 });
fs.writeFileSync(path.join(to, 'parts.bin'), bytes);

const files = Object.keys(folder(to, '.')).map((name) => name.replace(/^\.\//, '')).sort();
const build = crypto.createHash('sha256');
for (const name of files) build.update(name).update(fs.readFileSync(path.join(to, name)));
fs.writeFileSync(path.join(to, 'offline.js'), fs.readFileSync(here('offline.js'), 'utf8')
  .replace('@BUILD@', build.digest('hex').slice(0, 12)).replace('@FILES@', ['./', ...files].join(' ')));

const size = (name) => fs.statSync(path.join(to, name)).size;
const sent = files.reduce((all, name) => all + (name === 'parts.bin' ? size(name) : gzipSync(fs.readFileSync(path.join(to, name))).length), 0);
console.log(`${path.relative(process.cwd(), path.resolve(to))}: ${files.length + 1} files; from a server that compresses, ${(sent / 1e6).toFixed(2)} MB`);
