// Serves a page: Prolog with the pack runs, and does what it hears. In a worker, and in node.

import { startProlog } from './prolog.js';

/** So long, in milliseconds, the program goes on before the page has a turn. */
const TURN = 16;
/** How many letters of what is written to user_error are kept until they are in the log. */
const MOST = 1800;

/**
 * @param {object} parts  those of startProlog
 * @param {Function} say  gets what the page is told, a text
 * @returns {Promise<Function>} what takes a line of the page
 */
export async function serve(parts, say) {
  const lines = [];
  let printed = [];
  let [letters, leftOut] = [0, 0];
  let wake = null;
  let began = 0;
  // setTimeout waits for 4 ms at least; a message comes at once.
  const { port1, port2 } = new MessageChannel();
  const soon = [];
  port1.onmessage = () => soon.shift()();
  const turn = (ms) => new Promise((resolve) => {
    const goOn = () => {
      began = performance.now();
      resolve(true);
    };
    if (ms > 0) setTimeout(goOn, ms);
    else {
      soon.push(goOn);
      port2.postMessage(0);
    }
  });
  Object.assign(globalThis, {
    ev3dev_turn: turn,
    ev3dev_due: () => performance.now() - began >= TURN,
    ev3dev_line: () => (lines.length ? turn(0) : new Promise((resolve) => { wake = resolve; })),
    ev3dev_printed: () => {
      if (leftOut) printed.unshift(`(${leftOut} letters are left out here: the program prints faster than anybody can read)`);
      const text = printed.join('\n');
      [printed, letters, leftOut] = [[], 0, 0];
      return text;
    },
  });
  const written = (line) => {
    printed.push(line.slice(-MOST));
    letters += line.length;
    leftOut += Math.max(0, line.length - MOST);
    while (letters - leftOut > MOST && printed.length > 1) leftOut += printed.shift().length;
  };
  // What is written to user_output is seen by the library, and goes nowhere else.
  const { prolog } = await startProlog({
    ...parts,
    host: { say, hear: () => lines.shift() },
    module: { ...parts.module, stdout: () => {}, printErr: written, stdin: () => null },
  });
  const session = async () => {
    for (;;) await prolog.forEach('ev3dev_playground:session').catch(() => {});
  };
  session();
  return (line) => {
    lines.push(line);
    wake?.(true);
    wake = null;
  };
}
