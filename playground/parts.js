// The parts of a page, from the files of this machine: for node.

import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

export const home = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '..');

/** All files of a folder that are not left out, by their paths below another. */
export function folder(from, to, keeps = () => true, all = {}) {
  for (const entry of fs.readdirSync(from, { withFileTypes: true })) {
    const [there, here] = [path.join(from, entry.name), `${to}/${entry.name}`];
    if (!keeps(here)) continue;
    if (entry.isDirectory()) folder(there, here, keeps, all);
    else if (entry.isFile()) all[here] = fs.readFileSync(there);
  }
  return all;
}

/** SWI-Prolog's WebAssembly build, of the npm package below a folder. */
export function swiplOf(modules) {
  const from = path.resolve(modules, 'node_modules/swipl-wasm/dist/swipl');
  return {
    swipl: createRequire(import.meta.url)(path.join(from, 'swipl-web.js')),
    swiplWasm: fs.readFileSync(path.join(from, 'swipl-web.wasm')),
    locateFile: (file) => path.join(from, file),
  };
}

/** ev3dev.wasm, of tools/page.sh. */
export const library = () => fs.readFileSync(path.join(home, 'target/page/ev3dev.wasm'));

/** The pack as it is loaded in a page. */
export const pack = () => ({
  ...folder(path.join(home, 'prolog'), '/pack/prolog', (file) => !/\/view\/[^/]*\.(?!pl$)/.test(file)),
  ...folder(path.join(home, 'playground'), '/pack/playground', (file) => /(session|check)\.pl$/.test(file)),
  '/pack/pack.pl': fs.readFileSync(path.join(home, 'pack.pl')),
});

/** The exercises of the course, which a page marks. */
export const course = () => Object.fromEntries(Object.entries(folder(path.join(home, 'course'), '/pack/course')).filter(([name]) => name.endsWith('exercise.pl')));
