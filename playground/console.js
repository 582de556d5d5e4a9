// The output of the program, the messages of Prolog, and the line for queries.

import { $, el, text } from './view/dom.js';

const MOST = 1000;
const SHOWN = new Set(['output', 'goal', 'answer', 'warning', 'error', 'stop', 'mark']);

export class Console {
  /** `goTo` shows a line of the program. */
  constructor(send, goTo) {
    this.send = send;
    this.goTo = goTo;
    this.list = $('said');
    this.input = $('query-text');
    this.history = [];
    this.at = 0;
    this.next = 1;
    this.newest = -1;
    this.line = null;
    $('query').addEventListener('submit', (event) => {
      event.preventDefault();
      this.ask(this.input.value.trim());
    });
    this.input.addEventListener('keydown', (event) => this.key(event));
    for (const word of ['more', 'enough']) $(`query-${word}`).addEventListener('click', () => this.another(word));
    $('said-clear').addEventListener('click', () => this.list.replaceChildren());
  }

  /** Lines of the log of a frame. */
  took({ log = [], new: begins }) {
    if (begins) this.newest = -1;
    for (const { n, kind, text: words } of log) {
      if (n <= this.newest) continue;
      this.newest = n;
      if (SHOWN.has(kind)) this.say(kind, words);
    }
  }

  begins() {
    this.newest = -1;
    this.waits = null;
    this.wait(null);
  }

  say(kind, words) {
    const { list } = this;
    const atEnd = list.scrollTop + list.clientHeight >= list.scrollHeight - 24;
    const place = /^(?:\S*\.pl:|line )(\d+)(?::\d+)?:\s*/.exec(words);
    const row = el('li', { 'data-kind': kind }, place ? words.slice(place[0].length) : words);
    if (place) this.link(row, Number(place[1]));
    list.append(row);
    while (list.children.length > MOST) list.firstChild.remove();
    if (atEnd) list.scrollTop = list.scrollHeight;
    if (kind === 'error' && this.line) this.was(this.line);
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

  ask(goal) {
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
