// What happened: commands with their causes, rules, marks, warnings; and a
// line for goals.

import { $, clock, download, el, pressed, text } from './dom.js';

const KINDS = [['command', 'Commands'], ['rule', 'Rules'], ['golog', 'Golog'], ['mark', 'Marks'], ['warning', 'Warnings']];
const MOST = 300;
/** Equal lines that come in turn, as those of two wheels, become one, at the time of the first:
    each at most so many lines and so many seconds after the one before. */
const LOOK_BACK = 4;
const IN_TURN = 0.5;

export class Log {
  constructor(send) {
    this.send = send;
    this.list = $('log');
    this.hidden = new Set();
    this.counts = new Map();
    this.rows = [];
    this.goals = new Map();
    this.next = 1;
    this.history = [];
    this.chips = new Map(KINDS.map(([kind, name]) => {
      const chip = el('button', { type: 'button', 'aria-pressed': 'true', hidden: true }, name);
      chip.addEventListener('click', () => this.filter(kind));
      return [kind, chip];
    }));
    $('log-kinds').append(...this.chips.values());
    this.empty = el('li', { class: 'none' }, el('span'), el('span'), el('span', { class: 'text' }, 'Nothing has happened yet.'));
    this.clear();
    $('goal').addEventListener('submit', (event) => {
      event.preventDefault();
      this.ask($('goal-text').value.trim());
    });
    $('goal-text').addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
      this.at = Math.max(0, Math.min(this.history.length, (this.at ?? this.history.length) + (event.key === 'ArrowUp' ? -1 : 1)));
      $('goal-text').value = this.history[this.at] ?? '';
      event.preventDefault();
    });
  }

  clear() {
    this.rows = [];
    this.counts.clear();
    for (const chip of this.chips.values()) chip.hidden = true;
    this.list.replaceChildren(this.empty);
  }

  filter(kind) {
    if (this.hidden.has(kind)) this.hidden.delete(kind);
    else this.hidden.add(kind);
    pressed(this.chips.get(kind), !this.hidden.has(kind));
    for (const row of this.rows) row.box.hidden = this.hidden.has(group(row.kind));
    this.list.scrollTop = this.list.scrollHeight;
  }

  take(model) {
    const { frame } = model;
    if (frame.new) this.clear();
    if (frame.goals !== undefined && $('goal').hidden === Boolean(frame.goals)) $('goal').hidden = !frame.goals;
    if (!model.fresh.length) return;
    this.add(model.fresh.map((line) => ({ ...line, key: similar(line) })));
  }

  /** Lines at the end; the list stays where it is if somebody reads above. */
  add(lines) {
    const { list } = this;
    const atEnd = list.scrollTop + list.clientHeight >= list.scrollHeight - 24;
    this.empty.remove();
    for (const line of lines) {
      const kind = group(line.kind);
      this.counts.set(kind, (this.counts.get(kind) ?? 0) + 1);
      const chip = this.chips.get(kind);
      if (chip?.hidden) chip.hidden = false;
      const same = this.same(line);
      if (same) {
        same.count += 1;
        this.fill(same, line);
      } else this.rows.push(this.row(line));
    }
    for (const row of this.rows.splice(0, Math.max(0, this.rows.length - MOST))) row.box.remove();
    if (atEnd) list.scrollTop = list.scrollHeight;
  }

  /** The row that a line goes into, as it says the same. */
  same({ key, time }) {
    const recent = this.rows.slice(-LOOK_BACK);
    const last = recent[recent.length - 1];
    return key && recent.find((row) => row.key === key && (row === last || time - row.at < IN_TURN));
  }

  row(line) {
    const row = {
      key: line.key, kind: line.kind, count: 1, time: el('time', {}, Number.isFinite(line.time) ? clock(line.time) : ''), words: el('span'), times: el('span', { class: 'times', hidden: true }),
      why: el('span', { class: 'why', hidden: true }),
    };
    row.box = el('li', { class: line.kind, hidden: this.hidden.has(group(line.kind)) },
      row.time, el('span', { class: 'kind', title: line.kind }), el('span', { class: 'text' }, row.words, row.times, row.why));
    if (Number.isFinite(line.time)) row.box.dataset.time = line.time;
    this.fill(row, line);
    this.list.append(row.box);
    return row;
  }

  fill(row, line) {
    row.at = line.time;
    text(row.words, line.text);
    row.line = line.text;
    if (row.count > 1) {
      row.times.hidden = false;
      const until = Number.isFinite(line.time) ? clock(line.time) : '';
      text(row.times, until === row.time.textContent ? `×${row.count}` : `×${row.count} until ${until}`);
    }
    const causes = line.causes ?? [];
    row.why.hidden = !causes.length;
    if (causes.length) text(row.why, `why: ${causes.join(', ')}`);
  }

  // ------------------------------------------------------------- goals

  ask(goal) {
    if (!goal) return;
    const n = this.next;
    this.next += 1;
    this.history.push(goal);
    this.at = this.history.length;
    if (!this.send(`goal ${n} ${goal}`)) return;
    this.add([{ kind: 'goal', text: `?- ${goal}` }]);
    $('goal-text').value = '';
  }

  answer({ n, state, text: words }) {
    const shown = { false: 'false.', stopped: 'stopped.' }[state] ?? `${words || 'true'}${state === 'last' ? '.' : ''}`;
    this.add([{ kind: state === 'error' ? 'error' : 'answer', text: shown }]);
    if (state !== 'more') return;
    const last = this.rows[this.rows.length - 1];
    const buttons = ['More', 'Enough'].map((name) => {
      const button = el('button', { type: 'button', class: 'tool text' }, name);
      button.addEventListener('click', () => {
        this.send(`${name.toLowerCase()} ${n}`);
        for (const each of buttons) each.remove();
        $('goal-text').focus();
      });
      return button;
    });
    last.box.querySelector('.text').append(...buttons);
    this.list.scrollTop = this.list.scrollHeight;
  }

  save() {
    download('log.txt', this.rows.map((row) => `${row.time.textContent}\t${row.kind}\t${row.line}`).join('\n'), 'text/plain');
  }
}

/** Errors are shown with warnings; other kinds alone. */
function group(kind) {
  return kind === 'error' ? 'warning' : kind;
}

/** Commands that differ by a number only are alike. */
function similar(line) {
  if (line.kind !== 'command' && line.kind !== 'warning') return '';
  return `${line.kind} ${line.text.replace(/-?\d+(\.\d+)?/g, '#')} ${(line.causes ?? []).join()}`;
}
