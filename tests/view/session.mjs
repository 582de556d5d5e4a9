// A Prolog session with the view, and the browser that looks at it.

import { spawn } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import path from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

export const home = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const require = createRequire(`${process.env.EV3DEV_NODE_MODULES}/`);
const puppeteer = require('puppeteer-core');
export const axePath = require.resolve('axe-core/axe.min.js');

/** The tests bound no time but this, in ms: what comes later does not come, or the machine is
    much too busy. */
const GUARD = 300_000;

/** Waits until `ask` answers something true. */
export async function until(ask, what) {
  const end = Date.now() + GUARD;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`it did not come in ${GUARD / 60_000} minutes, or the machine was too busy: ${what}`);
    await new Promise((resolve) => { setTimeout(resolve, 20); });
  }
}

const sessions = new Set();
process.on('exit', () => sessions.forEach((session) => session.prolog.kill('SIGKILL')));

/** A toplevel that reads its queries from a pipe. */
export class Session {
  static async start(...queries) {
    const session = new Session();
    for (const query of ['use_module(library(ev3dev))', 'use_module(library(ev3dev/sim))', 'use_module(library(ev3dev/view))', ...queries]) await session.ask(query);
    return session;
  }

  constructor() {
    // Both outputs are one, so that all comes in its order.
    this.prolog = spawn('sh', ['-c', 'exec "$0" "$@" 2>&1', process.env.SWIPL ?? 'swipl',
      '-q', '-f', 'none', '-p', 'library=prolog', '-g', 'set_prolog_flag(toplevel_prompt, \'\'),set_prolog_flag(ev3dev_hints, off)'],
      { cwd: home, stdio: ['pipe', 'pipe', 'inherit'] });
    this.output = '';
    this.asked = 0;
    this.prolog.stdout.on('data', (data) => { this.output += data; });
    sessions.add(this);
    this.ended = new Promise((resolve) => { this.prolog.on('exit', resolve); });
  }

  /** Types a query, and does not wait. */
  type(query) {
    this.prolog.stdin.write(`${query}.\n`);
  }

  /** Types a query and waits for its end; answers what was printed. */
  async ask(query) {
    this.asked += 1;
    const [begin, end] = [`<<${this.asked}>>`, `<</${this.asked}>>`];
    const from = this.output.length;
    // The marks are no output of the program.
    const mark = (text) => `flush_output, format(user_error, "${text}", [${this.asked}])`;
    this.type(`${mark('~n<<~d>>')}, ( catch((${query}), E, (print_message(error, E), fail)) -> true ; write(failed) ), ${mark('<</~d>>~n')}`);
    await until(() => this.output.indexOf(end, from) >= 0, `the end of ${query} in ${this.output.slice(from)}`);
    const start = this.output.indexOf(begin, from) + begin.length;
    return this.output.slice(start, this.output.indexOf(end, from));
  }

  /** Starts the view; answers the address with the token. */
  async view(options = '') {
    await this.ask(`view([open(false)${options ? `, ${options}` : ''}])`);
    return this.url();
  }

  async url() {
    return (await this.ask('view_url(U), write(user_error, U)')).trim();
  }

  async numbers(query) {
    return (await this.ask(query)).trim().split(/\s+/).map(Number);
  }

  pose() {
    return this.numbers('sim_pose(X, Y, H), format("~4f ~4f ~4f", [X, Y, H])');
  }

  async end() {
    this.prolog.stdin.end('halt.\n');
    const ended = await Promise.race([this.ended.then(() => true), new Promise((resolve) => { setTimeout(resolve, GUARD, false).unref(); })]);
    if (!ended) this.prolog.kill('SIGKILL');
    await this.ended;
    sessions.delete(this);
  }
}

/** Else it is Chromium. */
export const isFirefox = Boolean(process.env.FIREFOX);

/** By a signal, as of somebody's time limit, all ends. puppeteer itself would close the browser
    alone, and what is asked of that next fails with "Target closed". */
const SIGNALS = { SIGHUP: 1, SIGINT: 2, SIGTERM: 15 };
for (const [name, number] of Object.entries(SIGNALS)) {
  process.on(name, () => {
    console.error(`ended by ${name}`);
    process.exit(128 + number);
  });
}
const unheard = Object.fromEntries(Object.keys(SIGNALS).map((name) => [`handle${name}`, false]));

/** The colors matter to Firefox only: WebDriver BiDi cannot say which one page has. */
export async function browse(scheme = 'light') {
  // puppeteer's own limits are 30 s to start, 180 s for an answer
  const patience = { timeout: GUARD, protocolTimeout: GUARD, ...unheard };
  if (isFirefox) return puppeteer.launch({ ...patience, browser: 'firefox', executablePath: process.env.FIREFOX, headless: true, extraPrefsFirefox: { 'layout.css.prefers-color-scheme.content-override': scheme === 'light' ? 1 : 0 } });
  return puppeteer.launch({
    ...patience, executablePath: process.env.CHROMIUM, headless: true,
    args: [...(process.getuid?.() === 0 ? ['--no-sandbox'] : []), '--disable-gpu', '--font-render-hinting=none'],
  });
}

/** A page whose own limits are those of the tests. */
export function patient(page) {
  page.setDefaultTimeout(GUARD);
  return page;
}

/** What a browser says of a connection that a busy machine has lost: the page makes another one,
    without which the tests fail. */
const LOST = /establish a connection to the server at ws:|connection to ws:.* was interrupted|closed before the connection is established/;

/** A page at an address; keeps what its console said and what it asked for. What the program
    says comes `late`, by so many ms. */
export async function open(browser, url, { width = 1280, height = 800, scheme = 'light', phone = false, scale = 1, late = 0 } = {}) {
  const page = patient(await browser.newPage());
  if (late) await page.evaluateOnNewDocument(comesLate, late);
  page.said = [];
  page.requests = [];
  page.on('console', (message) => LOST.test(message.text()) || page.said.push(`${message.type()}: ${message.text()}`));
  page.on('pageerror', (error) => LOST.test(error.message) || page.said.push(`error: ${error.message}`));
  page.on('request', (request) => page.requests.push(request.url()));
  if (!isFirefox) await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
  await page.setViewport({ width, height, deviceScaleFactor: scale, isMobile: phone && !isFirefox, hasTouch: phone && !isFirefox });
  await page.goto(url);
  await shows(page, (state) => state.phase === 'live' && state.frames > 1, 'a live page');
  return page;
}

function comesLate(time) {
  window.WebSocket = class extends WebSocket {
    set onmessage(act) {
      super.onmessage = (event) => setTimeout(act, time, event);
    }
  };
}

/** Undefined while the page's modules have not run. */
export const state = (page) => page.evaluate(() => window.ev3view?.state());

/** The processor time of some processes and of all that these have started, in seconds; a tick of
    Linux is 10 ms. */
export function spent(roots) {
  const all = fs.readdirSync('/proc').filter((name) => /^\d+$/.test(name)).flatMap((pid) => {
    try {
      const fields = fs.readFileSync(`/proc/${pid}/stat`, 'utf8').replace(/.*\)/s, '').trim().split(' ');
      return [{ pid: Number(pid), parent: Number(fields[1]), time: (Number(fields[11]) + Number(fields[12])) / 100 }];
    } catch {
      return []; // it has ended
    }
  });
  const ours = new Set(roots);
  for (let size = 0; size < ours.size;) {
    size = ours.size;
    for (const { pid, parent } of all) if (ours.has(parent)) ours.add(pid);
  }
  return all.reduce((sum, { pid, time }) => sum + (ours.has(pid) ? time : 0), 0);
}

/** What share of a core processes take in so many seconds, in words. */
export async function share(roots, seconds) {
  const [before, begin] = [spent(roots), performance.now()];
  await new Promise((resolve) => { setTimeout(resolve, 1000 * seconds); });
  return `${((100 * (spent(roots) - before)) / ((performance.now() - begin) / 1000)).toFixed(1)} % of a core`;
}

/** Waits until the page's state satisfies a test; answers that state. */
export async function shows(page, test, what) {
  let last = null;
  return until(async () => {
    last = await state(page);
    return last && test(last) ? last : null;
  }, what).catch((error) => {
    const { log, ...rest } = last ?? {};
    // The log comes first: a summary shows the begin of a long line.
    throw new Error(`${error.message}; last: ${JSON.stringify({ log: log?.slice(-4), ...rest, world: undefined })}`);
  });
}

/** Where a place in cm is on the page. */
export const pixel = (page, x, y) => page.evaluate((a, b) => window.ev3view.pixel(a, b), x, y);

export async function drag(page, from, to) {
  await page.mouse.move(...await pixel(page, ...from));
  await page.mouse.down();
  await page.mouse.move(...await pixel(page, ...to), { steps: 4 });
  await page.mouse.up();
}

export async function violations(page) {
  // The rules come by DevTools: the page's own policy lets no script in.
  await page.evaluate(`(() => { ${axeSource()} })()`);
  const { violations: found } = await page.evaluate(() => window.axe.run());
  return found.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target).join(' ')}`);
}

let axeText = null;
function axeSource() {
  axeText ??= fs.readFileSync(axePath, 'utf8');
  return axeText;
}

/** A request with headers of one's choice; answers status and body. By a
    bare socket, because node's own client will not send such things. */
export function request(url, { headers = {}, method = 'GET', upgrade = false } = {}) {
  const { host, hostname, port } = new URL(url);
  const lines = {
    Host: host, Connection: upgrade ? 'Upgrade' : 'close',
    ...(upgrade && { Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==' }),
    ...(method === 'POST' && { 'Content-Length': '0' }), ...headers,
  };
  return new Promise((resolve, reject) => {
    const socket = net.connect(port, hostname === 'localhost' ? '127.0.0.1' : hostname);
    let text = '';
    const over = () => {
      socket.destroy();
      resolve({ status: Number(text.split(' ')[1]), body: text.slice(text.indexOf('\r\n\r\n') + 4) });
    };
    socket.on('data', (data) => {
      text += data;
      if (upgrade && text.includes('\r\n\r\n')) over();
    });
    socket.on('end', over);
    socket.on('error', reject);
    const path = url.slice(new URL(url).origin.length) || '/';
    socket.write(`${method} ${path} HTTP/1.1\r\n${Object.entries(lines).map(([name, value]) => `${name}: ${value}\r\n`).join('')}\r\n`);
  });
}
