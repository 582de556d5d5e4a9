// The log: commands with their causes, rules, what the program prints,
// marks, warnings, goals; and a line for goals.

import { $, clock, download, el, following, goTo, pressed, text, toggle } from './dom.js';

const KINDS = [['command', 'Commands'], ['rule', 'Rules'], ['golog', 'Golog'], ['output', 'Output'], ['goal', 'Goals'], ['mark', 'Marks'], ['warning', 'Warnings']];
const MOST = 300;
const EARLIER = `The log shows the last ${MOST} lines. Earlier ones are left out.`;
/** Equal lines that come in turn, as those of two wheels, become one, at the time of the first:
    each at most so many lines and so many seconds after the one before. */
const LOOK_BACK = 4;
const IN_TURN = 0.5;

export class Log {
  constructor(send) {
    this.send = send;
    this.list = $('log');
    this.follow = following(this.list);
    this.hidden = new Set();
    this.history = [];
    this.next = 1;
    this.chips = new Map(KINDS.map(([kind, name]) => {
      const chip = el('button', { 'aria-pressed': 'true', hidden: true }, name);
      chip.addEventListener('click', () => {
        if (!this.hidden.delete(kind)) this.hidden.add(kind);
        pressed(chip, !this.hidden.has(kind));
        this.filter();
      });
      return [kind, chip];
    }));
    $('log-kinds').append(...this.chips.values());
    this.empty = el('li', { class: 'none' }, el('span'), el('span'), el('span', { class: 'text' }, 'Nothing has happened yet.'));
    this.earlier = el('li', { class: 'none begin' }, el('span'), el('span'), el('span', { class: 'text' }, EARLIER));
    this.clear();
    $('log-about').addEventListener('change', () => this.filter());
    document.addEventListener('ev3dev-time', ({ detail: { t } }) => { if (t === null) this.follow(true); });
    this.list.addEventListener('click', (event) => {
      const box = event.target.closest('li');
      if (box && getSelection().isCollapsed) this.choose(this.rows.find((row) => row.box === box));
    });
    this.list.addEventListener('keydown', (event) => this.key(event));
    $('goal').addEventListener('submit', (event) => {
      event.preventDefault();
      const { value } = $('goal-text');
      this.ask(this.reading ? value : value.trim());
    });
    for (const word of ['more', 'enough']) $(`goal-${word}`).addEventListener('click', () => this.another(word));
    $('goal-text').addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
      this.at = Math.max(0, Math.min(this.history.length, (this.at ?? this.history.length) + (event.key === 'ArrowUp' ? -1 : 1)));
      $('goal-text').value = this.history[this.at] ?? '';
      event.preventDefault();
    });
  }

  clear() {
    this.rows = [];
    this.chosen = null;
    this.abouts = new Map();
    this.age = 0;
    for (const chip of this.chips.values()) chip.hidden = true;
    $('log-about').replaceChildren(el('option', { value: '' }, 'All parts'));
    $('log-about').hidden = true;
    this.list.replaceChildren(this.empty);
  }

  take(model) {
    const { frame } = model;
    if (frame.new && this.rows.length) this.begins();
    if (frame.goals !== undefined && $('goal').hidden === Boolean(frame.goals)) $('goal').hidden = !frame.goals;
    if (model.missed > 0) this.leaveOut(model.missed);
    if (model.fresh.length) this.add(model.fresh.map((line) => ({ ...line, key: similar(line) })));
  }

  /** Another simulation, or another time of it: what was before stays, but cannot be gone to. */
  begins() {
    this.age += 1;
    for (const row of this.rows) row.box.classList.add('past');
    this.add([{ kind: 'begin', text: 'Another run begins.' }]);
  }

  /** What a frame lacks; if the last line says so already, it is one. */
  leaveOut(lines) {
    const last = this.rows.at(-1);
    this.left = (last?.kind === 'left' ? this.left : 0) + lines;
    const words = `${this.left} lines are left out here.`;
    if (last?.kind === 'left') text(last.words, (last.line = words));
    else this.add([{ kind: 'left', text: words }]);
  }

  /** Lines at the end; the list stays where it is if somebody reads above. */
  add(lines) {
    const { list } = this;
    this.empty.remove();
    for (const line of lines) {
      const chip = this.chips.get(group(line.kind));
      if (chip?.hidden) chip.hidden = false;
      for (const about of line.about ?? []) this.offer(about);
      const same = this.same(line);
      if (same) {
        same.count += line.times ?? 1;
        this.fill(same, line);
      } else this.rows.push(this.row(line));
    }
    const gone = this.rows.splice(0, Math.max(0, this.rows.length - MOST));
    for (const row of gone) row.box.remove();
    if (gone.length && !this.earlier.isConnected) list.prepend(this.earlier);
    this.follow();
  }

  /** The row that a line goes into, as it says the same. */
  same({ key, time }) {
    const recent = this.rows.slice(-LOOK_BACK);
    const last = recent.at(-1);
    return key && recent.find((row) => row.key === key && row.age === this.age && (row === last || time - row.at < IN_TURN));
  }

  row(line) {
    const row = {
      key: line.key, kind: line.kind, about: line.about, age: this.age, start: line.time, count: line.times ?? 1,
      words: el('span'), times: el('span', { class: 'times', hidden: true }), why: el('span', { class: 'why' }),
    };
    row.box = el('li', { class: line.kind, tabIndex: -1, hidden: !this.passes(row) },
      el('time', {}, Number.isFinite(line.time) ? clock(line.time) : ''), el('span', { class: 'kind', title: line.kind }),
      el('span', { class: 'text' }, row.words, row.times, row.why));
    if (Number.isFinite(line.time)) row.box.dataset.time = line.time;
    this.fill(row, line);
    this.list.append(row.box);
    return row;
  }

  fill(row, line) {
    row.at = line.until ?? line.time;
    text(row.words, line.text);
    row.line = line.text;
    if (row.count > 1) {
      row.times.hidden = false;
      const [from, until] = [row.start, row.at].map((time) => (Number.isFinite(time) ? clock(time) : ''));
      text(row.times, until === from ? `×${row.count}` : `×${row.count} until ${until}`);
    }
    row.causes = line.causes ?? [];
    this.because(row);
  }

  /** Why: the causes of the line that is chosen, the nearest first. */
  because(row) {
    row.why.hidden = !row.causes.length;
    if (row.causes.length) text(row.why, row === this.chosen ? `why: ${row.causes.join('\nwhich was for: ')}` : 'why?');
  }

  // ---------------- the filter

  passes(row) {
    const about = $('log-about').value;
    return !this.hidden.has(group(row.kind)) && (!about || Boolean(row.about?.includes(about)));
  }

  filter() {
    for (const row of this.rows) row.box.hidden = !this.passes(row);
    this.follow(true);
  }

  /** A motor or a rule that lines can be chosen by; they stand in the order of their names. */
  offer(about) {
    if (this.abouts.has(about)) return;
    const option = el('option', { value: about }, about);
    const after = [...this.abouts.keys()].filter((other) => other > about).sort()[0];
    $('log-about').insertBefore(option, this.abouts.get(after) ?? null);
    this.abouts.set(about, option);
    $('log-about').hidden = false;
  }

  // ---------------- one line

  /** Chooses a line, or none: it says why, and when it was. */
  choose(row) {
    const former = this.chosen;
    this.chosen = row === former ? null : row ?? null;
    for (const each of [former, this.chosen]) {
      if (!each) continue;
      toggle(each.box, 'chosen', each === this.chosen);
      this.because(each);
    }
    const t = this.chosen?.start;
    if (Number.isFinite(t) && this.chosen.age === this.age) goTo(t);
  }

  key(event) {
    const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (!step) return;
    const rows = this.rows.filter((row) => !row.box.hidden);
    const at = rows.indexOf(this.chosen);
    const row = at < 0 ? rows.at(-1) : rows[at + step];
    event.preventDefault();
    if (!row) return;
    this.choose(row);
    row.box.focus();
  }

  // ---------------- goals

  /** A goal is typed; what becomes of it comes in the log. */
  ask(goal) {
    if (this.reading) this.send(`input ${goal}`);
    else if (goal === ';' && this.waits) this.another('more');
    else if (goal) {
      if (!this.send(`goal ${this.next} ${goal}`)) return this.refused('The program does not answer.');
      this.next += 1;
      this.history.push(goal);
    } else return;
    this.at = this.history.length;
    $('goal-text').value = '';
    this.refused('');
    this.wait(null);
    this.reads(false);
  }

  /** The goal reads a line, which is typed in its place. */
  reads(does) {
    this.reading = does;
    text($('goal').querySelector('label'), does ? '|:' : '?-');
    if (does) $('goal-text').focus();
  }

  another(word) {
    this.send(`${word} ${this.waits}`);
    this.wait(null);
    $('goal-text').focus();
  }

  answer({ n, state }) {
    this.reads(false);
    if (n === this.next - 1) this.wait(state === 'more' ? n : null);
  }

  wait(n) {
    this.waits = n;
    for (const word of ['more', 'enough']) $(`goal-${word}`).hidden = n === null;
  }

  /** It stays in its line, and beside it stands why it was not done. */
  refused(why) {
    text($('goal-why'), why);
    $('goal-why').hidden = !why;
    if (why && !$('goal-text').value) $('goal-text').value = this.history.at(-1);
  }

  save() {
    const time = ({ start }) => (Number.isFinite(start) ? clock(start) : '');
    download('log.txt', this.rows.map((row) => `${time(row)}\t${row.kind}\t${row.line}`).join('\n'), 'text/plain');
  }
}

/** Errors are shown with warnings, answers with goals; other kinds alone. */
function group(kind) {
  return { error: 'warning', answer: 'goal' }[kind] ?? kind;
}

/** Commands that differ by a number only are alike. */
function similar(line) {
  if (line.kind !== 'command' && line.kind !== 'warning') return '';
  return `${line.kind} ${line.text.replace(/-?\d+(\.\d+)?/g, '#')} ${(line.causes ?? []).join()}`;
}
