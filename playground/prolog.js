// SWI-Prolog with the pack's native library beside it, in one memory: in a worker of a page, and
// in node. SWI-Prolog's own WebAssembly build exports its functions, its memory and its table of
// functions; the library imports them, and registers its predicates as on any other machine.

/** Where the library's data begins, and how much memory is taken for it: see tools/wasm.sh. */
const WINDOW = { from: 8 << 20, taken: 32 << 20 };
/** Where its functions begin in the table. */
const TABLE_BASE = 1400;
const SECTION = { table: 4 };

/** An unsigned number in LEB128 at a place of some bytes: its value, and where it ends. */
function leb(bytes, at) {
  let [value, shift] = [0, 0];
  for (;;) {
    const byte = bytes[at];
    at += 1;
    value |= (byte & 127) << shift;
    shift += 7;
    if (byte < 128) return [value, at];
  }
}

/** The same module with a table that may grow: its maximum is its size. */
export function withLargerTable(source) {
  const bytes = new Uint8Array(source).slice();
  for (let at = 8; at < bytes.length;) {
    const id = bytes[at];
    const [size, begin] = leb(bytes, at + 1);
    if (id === SECTION.table) {
      // One table: its type, a flag that there is a maximum, the size, the maximum
      const [, afterSize] = leb(bytes, begin + 3);
      const [, end] = leb(bytes, afterSize);
      if (bytes[begin] !== 1 || bytes[begin + 2] !== 1 || end - afterSize !== 2) throw new Error('another table than expected');
      [bytes[afterSize], bytes[afterSize + 1]] = [0xff, 0x7f];
      return bytes;
    }
    at = begin + size;
  }
  throw new Error('no table');
}

/** What SWI-Prolog's WebAssembly build does not export. There is one thread; a redo handle is the
    bare pointer; its streams are not reached. */
const MISSING = {
  PL_thread_self: () => 1,
  PL_unify_thread_id: () => -1,
  _PL_retry_address: (address) => address,
  _PL_streams: () => 0,
  Sfwrite: () => 0,
  Sfputs: () => 0,
  Sferror: () => 0,
  Sclearerr: () => {},
  Sfileno: () => -1,
  PL_dispatch_hook: () => 0,
  PL_set_engine: () => 0,
  PL_thread_attach_engine: () => -1,
  // Asked for the number of the brick: there is one.
  PL_current_prolog_flag: () => 0,
};

/**
 * Starts SWI-Prolog.
 *
 * @param {object} parts
 * @param {Function} parts.swipl  the factory of swipl-wasm
 * @param {BufferSource} parts.swiplWasm  its swipl-web.wasm
 * @param {BufferSource} parts.library  ev3dev.wasm
 * @param {Uint8Array} [parts.state]  a saved state to start from
 * @param {string[]} [parts.arguments]  of swipl
 * @param {object} [parts.files]  what to put into the file system: text or bytes by path
 * @param {object} [parts.host]  what the library asks the page: say(text), hear()
 * @param {object} [parts.module]  more members of Emscripten's module
 * @returns {Promise<object>} Emscripten's module
 */
export async function startProlog({ swipl, swiplWasm, library, state, arguments: args = ['-q'], files = {}, host = {}, module = {} }) {
  const main = new WebAssembly.Module(withLargerTable(swiplWasm));
  const side = new WebAssembly.Module(library);
  let exports;
  let heard = null;
  const prolog = await swipl({
    ...module,
    arguments: state ? ['-x', '/state', ...args] : args,
    instantiateWasm(imports, receive) {
      const instance = new WebAssembly.Instance(main, imports);
      ({ exports } = instance);
      receive(instance, main);
      return exports;
    },
    preRun: [(started) => {
      const values = Object.values(exports);
      const memory = values.find((value) => value instanceof WebAssembly.Memory);
      const table = values.find((value) => value instanceof WebAssembly.Table);
      const [from, end] = [started._malloc(WINDOW.taken), WINDOW.from + WINDOW.taken / 2];
      if (from === 0 || from > WINDOW.from || from + WINDOW.taken < end) throw new Error(`the window is not in ${from}`);
      const utf8 = (address, length) => new TextDecoder().decode(new Uint8Array(memory.buffer).slice(address, address + length));
      const zero = (address) => utf8(address, new Uint8Array(memory.buffer).indexOf(0, address) - address);
      const missing = new Set();
      const bound = Object.fromEntries(WebAssembly.Module.imports(side).filter(({ module: of }) => of === 'swipl').map(({ name }) => {
        const found = started[`_${name}`] ?? MISSING[name];
        if (!found) missing.add(name);
        return [name, found ?? (() => { throw new Error(`${name} is missing`); })];
      }));
      if (missing.size) throw new Error(`SWI-Prolog lacks ${[...missing].join(' ')}`);
      /** How much there is of it, in bytes. */
      globalThis.ev3dev_memory = () => memory.buffer.byteLength;
      const grown = Math.max(0, TABLE_BASE + 8192 - table.length);
      table.grow(grown);
      let free = table.length - 1;
      const placed = new Map();
      const library = new WebAssembly.Instance(side, {
        env: { memory, __indirect_function_table: table },
        swipl: bound,
        host: {
          now_ms: () => performance.now(),
          say: (address, length) => host.say?.(utf8(address, length)),
          heard: () => {
            const line = host.hear?.();
            heard = line ? new TextEncoder().encode(line) : null;
            return heard?.length ?? 0;
          },
          take: (address) => { new Uint8Array(memory.buffer).set(heard, address); },
          look_up: (address) => {
            const name = zero(address);
            const found = started[`_${name}`];
            if (!found) return 0;
            if (!placed.has(name)) {
              table.set(free, found);
              placed.set(name, free);
              free -= 1;
            }
            return placed.get(name);
          },
        },
      });
      table.set(free, library.exports.install_predicate);
      const name = started.stringToNewUTF8('ev3dev_install');
      started._PL_register_foreign_in_module(started.stringToNewUTF8('system'), name, 0, free, 0, 0);
      free -= 1;
      if (state) started.FS.writeFile('/state', state);
      for (const [path, content] of Object.entries(files)) {
        const folder = path.slice(0, path.lastIndexOf('/'));
        if (folder) started.FS.mkdirTree(folder);
        started.FS.writeFile(path, content);
      }
    }],
  });
  // Prolog's bridge to JavaScript looks there; in node there is no place.
  globalThis.window ??= globalThis;
  globalThis.location ??= { toString: () => 'file:///' };
  return prolog;
}
