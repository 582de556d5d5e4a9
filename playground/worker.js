// The worker in which Prolog runs. The page sends lines; it is told texts, `ready`, and of a fault.

import { serve } from './serve.js';
import { unpack } from './archive.js';

const line = [];
let hear = (text) => line.push(text);
onmessage = ({ data }) => hear(data);

const fault = (error) => postMessage({ fault: String(error?.message ?? error) });
addEventListener('error', fault);
addEventListener('unhandledrejection', ({ reason }) => fault(reason));

async function start() {
  importScripts('swipl-web.js');
  const answer = await fetch('parts.bin');
  if (!answer.ok) throw new Error(`parts.bin: ${answer.status}`);
  const parts = await unpack(answer.body);
  const files = Object.fromEntries([...parts].filter(([name]) => name.startsWith('/')));
  hear = await serve({
    swipl: globalThis.SWIPL, swiplWasm: parts.get('swipl-web.wasm'), library: parts.get('ev3dev.wasm'), state: parts.get('state.prc'), files,
    module: { getPreloadedPackage: () => parts.get('swipl-web.data').slice().buffer },
  }, (text) => {
    if (text.startsWith('{')) postMessage(text);
    else fault(text);
  });
  for (const text of line) hear(text);
  postMessage({ ready: true });
}

start().catch(fault);
