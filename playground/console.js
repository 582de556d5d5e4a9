// The output of the program, the messages of Prolog, and the line for queries.

import { $, el, following, text } from './view/dom.js';

/** How many rows and letters are kept. */
const MOST = { rows: 1000, letters: 200_000 };
const KEY = 'ev3dev playground queries';
/** An answer that is longer is folded. */
const LONG = 300;
const READS = { term: 'a term and a full stop', line: 'a line', clauses: 'clauses, and then an empty line' };
const FAILS = new Set(['warning', 'error']);
const SHOWN = new Set(['output', 'goal', 'answer', 'warning', 'error', 'stop', 'mark']);

export class Console {
  /** `goTo` shows a line of the program; `unseen` gets what must be seen while this is not displayed. */
  constructor(send, goTo, unseen) {
    Object.assign(this, { send, goTo, unseen });
    this.list = $('said');
    this.input = $('query-text');
    this.history = read();
    this.at = this.history.length;
    /** Whether the program reads a line; and lines that were pasted, which are asked in turn. */
    this.reading = false;
    this.pasted = [];
    this.next = 1;
    this.newest = -1;
    this.line = null;
    this.letters = 0;
    this.follow = following(this.list);
    $('query').addEventListener('submit', (event) => {
      event.preventDefault();
      this.ask(this.reading ? this.input.value : this.input.value.trim());
    });
    this.input.addEventListener('paste', (event) => this.paste(event));
    this.input.addEventListener('keydown', (event) => this.key(event));
    for (const word of ['more', 'enough']) $(`query-${word}`).addEventListener('click', () => this.another(word));
    $('said-clear').addEventListener('click', () => this.clear());
  }

  clear() {
    this.list.replaceChildren();
    this.letters = 0;
    this.follow(true);
  }

  /** Lines of the log of a frame. */
  took({ log = [], new: begins }) {
    if (begins) this.newest = -1;
    const fresh = log.filter(({ n, kind }) => n > this.newest && SHOWN.has(kind));
    if (log.length) this.newest = Math.max(this.newest, log[log.length - 1].n);
    this.write(fresh);
  }

  begins() {
    this.newest = -1;
    this.waits = null;
    this.wait(null);
    this.reads(null);
  }

  say(kind, words) {
    this.write([{ kind, text: words }]);
  }

  /** Adds rows at once: the page is laid out once, however many they are. */
  write(entries) {
    if (!entries.length) return;
    const { list } = this;
    list.append(...entries.map(({ kind, text: words }) => this.row(kind, words)));
    while (list.children.length > MOST.rows || (this.letters > MOST.letters && list.children.length > 1)) {
      this.letters -= list.firstChild.textContent.length;
      list.firstChild.remove();
    }
    this.follow();
    if (entries[entries.length - 1].kind === 'error' && this.line) this.was(this.line);
    const failed = entries.filter(({ kind, text: words }) => FAILS.has(kind) || words === 'false.').map(({ text: words }) => words);
    if (failed.length && !list.clientHeight) this.unseen(failed.slice(-2).join('\n'));
  }

  row(kind, words) {
    const place = /^(?:% )?(?:\S*\.pl:|line )(\d+)(?::\d+)?:\s*/.exec(words);
    const row = el('li', { 'data-kind': kind }, place ? words.slice(place[0].length) : words);
    if (place) this.link(row, Number(place[1]));
    if (kind === 'answer' && words.length > LONG) row.replaceChildren(el('details', {}, el('summary', {}, `${words.slice(0, LONG)} …`), words.slice(LONG)));
    this.letters += row.textContent.length;
    return row;
  }

  link(row, line) {
    const button = el('button', { type: 'button' }, `line ${line}`);
    button.addEventListener('click', () => this.goTo(line));
    row.prepend(button, ' ');
  }

  /** The last error was in a line; it may be said only now. */
  was(line) {
    const row = this.list.lastElementChild;
    this.line = row?.dataset.kind === 'error' ? null : line;
    if (!this.line) this.link(row, line);
  }

  key(event) {
    if (event.key === ';' && this.waits && !this.input.value) {
      this.another('more');
      event.preventDefault();
    } else if (event.key === 'ArrowUp' || event.key === 'ArrowDown') {
      this.at = Math.max(0, Math.min(this.history.length, this.at + (event.key === 'ArrowUp' ? -1 : 1)));
      this.input.value = this.history[this.at] ?? '';
      event.preventDefault();
    }
  }

  /** What the program reads, a key of READS; or nothing any more. */
  reads(what) {
    if (!what && !this.reading) return;
    this.reading = Boolean(what);
    text($('query-mark'), what ? '|:' : '?-');
    text($('query-hint'), what ? `The program reads: type ${READS[what]}.` : '');
    if (what) {
      this.input.focus();
      if (!this.list.clientHeight) this.unseen($('query-hint').textContent);
      this.nextPasted();
    }
  }

  /** Several lines are several queries, or lines of what is read. */
  paste(event) {
    const all = (event.clipboardData?.getData('text') ?? '').replace(/\r/g, '');
    if (!all.trim().includes('\n')) return;
    event.preventDefault();
    this.pasted = this.reading ? all.split('\n') : all.trim().split(/(?<=\.)\s*\n/).map((goal) => goal.replace(/^\s*\?-\s*/, '').replace(/\s*\n\s*/g, ' '));
    this.nextPasted();
  }

  /** The next of what was pasted; also asked when the program has ended. */
  nextPasted() {
    if (this.pasted.length) this.ask(this.pasted.shift());
  }

  ask(goal) {
    if (this.reading) {
      this.say('goal', `|: ${goal}`);
      this.input.value = '';
      this.reads(null);
      return this.send(`input ${goal}`);
    }
    if (!goal && this.waits) return this.another('enough');
    if (!goal) return;
    if (goal === ';' && this.waits) {
      this.input.value = '';
      return this.another('more');
    }
    if (!this.send(`goal ${this.next} ${goal}`)) return this.say('warning', 'Prolog is not ready yet.');
    this.next += 1;
    this.line = null;
    this.history.push(goal);
    keep(this.history);
    this.at = this.history.length;
    this.input.value = '';
    this.wait(null);
  }

  another(word) {
    this.send(`${word} ${this.waits}`);
    this.wait(null);
    this.input.focus();
  }

  /** What became of a goal. The answer itself is in the log. */
  answer({ n, state }) {
    this.wait(state === 'more' ? String(n) : null);
    // Another goal asks for no more answers of this one.
    if (state === 'more') this.nextPasted();
  }

  wait(n) {
    this.waits = n;
    for (const word of ['more', 'enough']) $(`query-${word}`).hidden = n === null;
    text($('query-hint'), n === null ? '' : 'More answers: type ; or press More');
  }

  refused(why) {
    this.say('warning', why);
  }
}

function read() {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? [];
  } catch {
    return [];
  }
}

function keep(queries) {
  try {
    localStorage.setItem(KEY, JSON.stringify(queries.slice(-100)));
  } catch { /* They are not kept where a browser does not allow it. */ }
}
