// What Prolog has thought: the outline of what library(ev3dev/reasoning) has recorded. A row
// and the time of the run are one: a click on a row goes back to its moment, and the slider to
// its row. On the world each attempt that failed has a cross with its number.

import { stroke, trace } from './canvas.js';
import { $, attribute, clock, download, el, goTo, icon, notice, num, pressed, text, toggle, upper, within } from './dom.js';
import { TURN } from './things.js';

const ROW = 26;
const [DEPTH, MARK, TEXT, PLAIN, PLACE, FAULT, EFFECT, FROM, TO, SHUT] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9];
/** While a program runs, the outline comes again and again up to so many events. */
const MOST_LIVE = 3000;
const MOST_CROSSES = 60;
const MARKS = {
  '+': ['✓', 'true'], '-': ['✗', 'false'], '?': ['◆', 'choice'], '*': ['●', 'running'], '!': ['!', 'cut'], ' ': ['⋯', 'same'],
};
const STEPS = { Row: () => true, Branch: (row) => row.way, Move: (row) => row.effect };
const KIND = 'ev3dev reasoning';
/** The rows of a picture for a slide. */
const MOST_PICTURED = 200;
const SENSED = /^us_dist_cm\((in\d),([\d.]+)\)$/;

export class Reasoning {
  /** `shown` is called when another moment is to be drawn. */
  constructor(send, shown) {
    this.send = send;
    this.shown = shown;
    this.by = 'Row';
    this.clear();
    const tool = (words, name, act) => el('button', { class: 'tool', title: words, 'aria-label': words, onclick: act }, icon(name));
    this.title = el('p', { class: 'hint num' });
    this.why = el('div', { class: 'why-false', hidden: true });
    this.list = el('div', { class: 'outline', role: 'tree', tabIndex: 0, 'aria-label': 'What Prolog did' });
    this.room = el('div', { role: 'none' });
    this.list.append(this.room);
    this.empty = el('p', { class: 'empty' });
    this.detail = el('p', { class: 'detail', role: 'status' });
    this.steps = Object.keys(STEPS).map((by) => el('button', { onclick: () => this.stepBy(by) }, by));
    const back = tool('One step back', 'play', () => this.step(-1));
    back.classList.add('back');
    this.file = el('input', { type: 'file', accept: '.json', hidden: true, onchange: () => this.read() });
    $('reasoning').append(
      el('header', {}, el('h2', { id: 'reasoning-title' }, 'Reasoning'), this.title, el('div', { class: 'actions' },
        el('button', { class: 'tool', title: 'Picture of the rows and the world, as SVG', onclick: () => this.picture() }, 'SVG'),
        el('button', { class: 'tool', title: 'Save program and record as a file', onclick: () => this.save() }, 'Save'),
        el('button', { class: 'tool', title: 'Open such a file; nothing runs', onclick: () => this.file.click() }, 'Open'),
        tool('Close the reasoning', 'close', () => this.turn(false))), this.file),
      this.empty, this.list,
      el('footer', {}, back, tool('One step forward', 'play', () => this.step(1)), el('div', { class: 'segments', role: 'group', 'aria-label': 'Step by' }, ...this.steps), this.detail),
      this.why,
    );
    this.stepBy('Row');
    this.list.addEventListener('scroll', () => this.soon());
    this.list.addEventListener('click', (event) => {
      const item = event.target.closest('[role=treeitem]');
      if (!item) return;
      const i = Number(item.dataset.row);
      if (event.target.closest('.fold-row')) this.fold(i);
      else this.select(i);
    });
    this.list.addEventListener('keydown', (event) => this.key(event));
    new ResizeObserver(() => this.soon()).observe(this.list);
    // Before the timeline, which draws the moment.
    document.addEventListener('ev3dev-time', ({ detail: { t } }) => this.follow(t), true);
  }

  clear() {
    Object.assign(this, { rows: [], visible: [], moments: [], turned: new Set(), at: null, asked: '', waits: false, old: false, head: null, coming: null, kept: null });
  }

  turn(open) {
    this.open = open;
    if (this.kept) this.clear();
    $('reasoning').hidden = !open;
    toggle(document.body, 'thinking', open);
    attribute($('reasoning-open'), 'aria-expanded', open);
    if (open) {
      this.take(this.model);
      this.list.focus();
    } else $('reasoning-open').focus();
    this.shown();
  }

  // ---------------- the record

  take(model) {
    this.model = model;
    if (!model?.frame) return;
    if (model.frame.new) {
      // What was recorded in another simulation has other times.
      this.waits = false;
      this.asked = '';
    }
    if (!this.open || this.kept) return;
    const [record, events] = model.record ?? [];
    const key = `${record} ${events}`;
    const running = model.frame.program.state === 'running';
    const late = running && events > MOST_LIVE;
    text(this.empty, !record ? 'Nothing is recorded. Type ?- reasoning(start). to see what Prolog does in start: library(ev3dev/reasoning) records it.'
      : late ? `${num(events)} events so far. The outline comes when the program has ended.` : '');
    this.empty.hidden = !this.empty.textContent;
    if (!record && this.rows.length) {
      this.clear();
      this.arrange();
    }
    if (!record || late || this.waits || key === this.asked) return;
    this.asked = key;
    this.waits = this.send('record');
  }

  /** What the program answered; whether it was a question of ours. */
  reply(message) {
    if (message.what !== 'record') return false;
    if (message.type === 'refused') {
      this.waits = false;
      notice(message.why, { seconds: 6 });
    } else if (message.goal !== undefined) this.coming = { head: message, texts: [], moments: [], rows: [] };
    else if (message.end) this.fill();
    else for (const name of ['texts', 'moments', 'rows']) this.coming[name].push(...message[name] ?? []);
    return true;
  }

  /** With `kept`, what was saved of another run: its world, too. */
  fill(kept = null) {
    const { head, texts, moments, rows } = this.raw = kept?.raw ?? this.coming;
    const again = !kept && head.record === this.head?.record;
    const atEnd = this.list.scrollTop + this.list.clientHeight >= this.list.scrollHeight - ROW;
    Object.assign(this, { head, moments, kept, waits: false, coming: null });
    if (!again) Object.assign(this, { turned: new Set(), at: null });
    const ways = [];
    let read = null;
    this.rows = rows.map((row, i) => {
      const [words, mark] = [texts[row[TEXT]], texts[row[MARK]]];
      const way = /^(\d+)\. /.exec(words)?.[1] ?? null;
      ways.length = Math.min(ways.length, row[DEPTH]);
      ways[row[DEPTH]] = way;
      const made = {
        depth: row[DEPTH], mark, shut: mark === ' ' || row[SHUT] === 1, words, way, place: texts[row[PLACE]], plain: texts[row[PLAIN]], fault: texts[row[FAULT]], effect: texts[row[EFFECT]],
        from: row[FROM], to: row[TO], has: rows[i + 1]?.[DEPTH] > row[DEPTH], name: ways.filter(Boolean).join('.'), read: null,
      };
      const sensed = SENSED.exec(words);
      if (sensed && mark === '+') read = { port: sensed[1], far: Number(sensed[2]), from: made.from };
      made.read = read;
      return made;
    });
    // The last reading in a branch is that of its failure.
    this.crosses = this.rows.flatMap((row, i) => {
      if (!row.way || !row.fault) return [];
      let end = i;
      while (this.rows[end + 1]?.depth > row.depth) end += 1;
      return [{ i, name: row.name, pose: this.pose(row.to), read: this.rows[end].read }];
    }).filter(({ pose }) => pose);
    const last = this.time({ from: moments.length });
    this.old = Boolean(kept) || last > this.model.time + 0.01;
    this.model.recorded = this.old ? null : moments[0]?.[0] ?? null;
    if (kept) this.empty.hidden = true;
    const [first] = this.rows;
    const moves = this.rows.filter(({ effect }) => effect).length;
    const ends = { '+': 'true', '-': 'false', '*': 'running' }[first?.mark] ?? '';
    text(this.title, first ? `${head.goal} · ${ends}${moments.length ? ` after ${num(last - this.time(first), 2)} s` : ''} · ${num(rows.length)} rows, ${moves} moves` : '');
    this.title.title = this.title.textContent;
    this.explain();
    this.arrange();
    if (again && atEnd && this.at === null) this.list.scrollTop = this.list.scrollHeight;
    this.shown();
  }

  /** Why the goal is false, and what became of the other attempts. */
  explain() {
    const { why, lost } = this.head;
    const first = this.rows.find(({ way }) => way);
    const others = why.length && first ? this.rows.flatMap((row, i) => (row.way && row.fault && row.depth === first.depth && !why[0].includes(`${row.words.slice(row.way.length + 2)} went`) ? [i] : [])) : [];
    this.why.hidden = !why.length && !lost;
    this.why.replaceChildren(
      ...(why.length ? [el('p', {}, el('b', {}, 'Why false?'), why.join(' ').replace(/^Why false\?/, ''))] : []),
      ...others.slice(0, 6).map((i) => el('button', { onclick: () => this.select(i) }, `${this.rows[i].words} · ${this.rows[i].fault}`)),
      ...(lost ? [el('p', {}, `${num(lost)} events in the middle are lost: the record was full.`)] : []),
    );
  }

  time({ from }) {
    return this.moments[Math.max(0, from - 1)]?.[0] ?? 0;
  }

  pose(moment) {
    const [, x, y, heading] = this.moments[Math.max(0, moment - 1)] ?? [];
    return Number.isFinite(x) ? [x, y, heading] : null;
  }

  // ---------------- rows

  /** Rounds that do the same and guards are folded at first, all else is open. */
  folded(i) {
    return this.rows[i].has && this.rows[i].shut !== this.turned.has(i);
  }

  fold(i) {
    if (!this.turned.delete(i)) this.turned.add(i);
    this.arrange();
  }

  arrange() {
    this.visible = [];
    let hidden = Infinity;
    this.rows.forEach(({ depth }, i) => {
      if (depth > hidden) return;
      hidden = this.folded(i) ? depth : Infinity;
      this.visible.push(i);
    });
    this.room.style.height = `${this.visible.length * ROW}px`;
    this.list.hidden = !this.rows.length;
    this.drawn = '';
    this.soon();
  }

  soon() {
    this.animation ??= requestAnimationFrame(() => {
      this.animation = null;
      this.draw();
    });
  }

  /** Only rows that are seen are elements. */
  draw() {
    if (!this.open) return;
    const from = Math.max(0, Math.floor(this.list.scrollTop / ROW) - 4);
    const until = Math.min(this.visible.length, Math.ceil((this.list.scrollTop + this.list.clientHeight) / ROW) + 4);
    const key = `${from} ${until} ${this.at}`;
    if (key === this.drawn) return;
    this.drawn = key;
    this.room.replaceChildren(...this.visible.slice(from, until).map((i, n) => this.element(i, from + n)));
    attribute(this.list, 'aria-activedescendant', this.at !== null && $(`row-${this.at}`) ? `row-${this.at}` : null);
  }

  element(i, place) {
    const row = this.rows[i];
    const [glyph, kind] = MARKS[row.mark];
    const line = el('div', {
      role: 'treeitem', id: `row-${i}`, class: `${kind}${row.way ? ' way' : ''}${this.at !== null && i > this.at ? ' later' : ''}`, 'data-row': i,
      'aria-level': row.depth + 1, 'aria-selected': i === this.at, ...(row.has && { 'aria-expanded': !this.folded(i) }),
    },
    el('span', { class: 'num' }, clock(this.time(row))), el('span', { class: 'indent' }),
    el('span', { class: row.has ? 'glyph fold-row' : 'glyph', 'aria-hidden': true }, this.folded(i) ? '▸' : row.way ? '╰' : glyph), el('span', { class: 'sr' }, kind),
    el('code', {}, row.words), ...['plain', 'place', 'fault', 'effect'].filter((name) => row[name]).map((name) => el('span', { class: name }, row[name])),
    el('span', { class: 'lasts' }, el('i')));
    line.style.top = `${place * ROW}px`;
    line.children[1].style.width = `${Math.min(row.depth, 24) * (this.list.clientWidth < 480 ? 9 : 18)}px`;
    const [begin, length] = [this.time(this.rows[0]), this.time({ from: this.moments.length }) - this.time(this.rows[0])];
    const bar = line.lastChild.firstChild.style;
    if (length > 0) {
      bar.left = `${(100 * (this.time(row) - begin)) / length}%`;
      bar.width = `${(100 * (this.time({ from: row.to }) - this.time(row))) / length}%`;
    }
    return line;
  }

  // ---------------- the chosen row

  select(i, moves = true) {
    const row = this.rows[i];
    for (let [above, { depth }] = [i, row]; depth > 0 && above > 0;) {
      above -= 1;
      if (this.rows[above].depth < depth) {
        ({ depth } = this.rows[above]);
        if (this.folded(above)) this.fold(above);
      }
    }
    this.at = i;
    if (moves && !this.old) {
      this.moving = true;
      goTo(this.time(row));
      this.moving = false;
    } else if (this.kept) this.shown();
    const top = (upper(this.visible, i) - 1) * ROW;
    const { scrollTop, clientHeight } = this.list;
    if (top < scrollTop || top + ROW > scrollTop + clientHeight) this.list.scrollTop = top - clientHeight / 3;
    this.describe();
    this.soon();
  }

  /** The slider, or another part of the page, has gone to a moment. */
  follow(t) {
    if (this.moving || !this.open || this.old) return;
    const i = t === null ? -1 : upper(this.visible, t + 1e-6, (row) => this.time(this.rows[row])) - 1;
    if (i >= 0) this.select(this.visible[i], false);
    else {
      this.at = null;
      this.describe();
      this.soon();
    }
  }

  stepBy(by) {
    this.by = by;
    for (const button of this.steps) pressed(button, button.textContent === by);
  }

  step(way) {
    const from = this.at ?? (way > 0 ? -1 : this.rows.length);
    for (let i = from + way; this.rows[i]; i += way) {
      // By rows it does not open what is folded.
      if (STEPS[this.by](this.rows[i]) && (this.by !== 'Row' || this.visible[upper(this.visible, i) - 1] === i)) return this.select(i);
    }
  }

  describe() {
    const row = this.rows[this.at];
    if (!row) return this.detail.replaceChildren();
    const [, name, line] = /(?:(\S+):|line )(\d+)/.exec(row.place) ?? [];
    const file = this.head.files.find((each) => !name || each.name === name);
    const source = file?.text.split('\n')[line - 1]?.trim();
    this.detail.replaceChildren(el('b', {}, `${clock(this.time(row))} s `), el('code', {}, row.words), ` ${[row.fault, row.effect].filter(Boolean).join(', ')}`,
      ...(source ? [el('br'), `${row.place.split(',')[0]}: `, el('code', {}, source)] : []));
  }

  key(event) {
    const here = this.visible.indexOf(this.at);
    const page = Math.max(1, Math.floor(this.list.clientHeight / ROW) - 1);
    const steps = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    const { key, altKey, ctrlKey, metaKey } = event;
    if (altKey || ctrlKey || metaKey || !this.visible.length) return;
    if (key in steps) this.select(this.visible[within(0, here + steps[key], this.visible.length - 1)]);
    else if (this.at === null || !['ArrowLeft', 'ArrowRight', 'Enter', ' '].includes(key)) return;
    else {
      const [folded, { has, depth }] = [this.folded(this.at), this.rows[this.at]];
      if (key === 'ArrowRight' && !folded) {
        if (has) this.select(this.at + 1);
      } else if (key === 'ArrowLeft' && (folded || !has)) {
        const above = this.rows.findLastIndex((row, i) => i < this.at && row.depth < depth);
        if (above >= 0) this.select(above);
      } else if (has) this.fold(this.at);
    }
    event.preventDefault();
    event.stopPropagation();
  }

  // ---------------- on the world

  /** A moment of the run, with the robot where it was by the record. */
  placed(moment) {
    const row = this.rows[this.at] ?? (this.kept && this.rows[0]);
    const pose = this.open && row && this.pose(row.from);
    if (this.kept && this.open) {
      const { world, spec, name } = this.kept;
      return Object.assign(Object.create(moment), {
        world, spec, name, path: null, grid: null, map: null, belief: null, localized: null, until: 0,
        frame: { ...moment.frame, robot: pose && { true: pose, believed: null, hits: 0 }, see: [], others: [], things: [], ports: [] },
      });
    }
    if (this.old || !pose || !moment.frame?.robot?.true || Math.abs(moment.time - this.time(row)) > 0.03) return moment;
    const placed = Object.create(moment);
    placed.frame = { ...moment.frame, robot: { ...moment.frame.robot, true: pose } };
    return placed;
  }

  paint(c, picture) {
    if (!this.open || (this.old && !this.kept) || !this.head) return;
    const { dot, paint, model } = picture;
    const ray = ({ port, far, from }, color) => {
      const [at, sensor] = [this.pose(from), model.spec?.sensors?.find((each) => each.port === port)];
      if (!at || !sensor) return;
      const [x, y] = turned(at, [sensor.x, sensor.y]);
      const [dx, dy] = turned([0, 0, at[2] + (sensor.h ?? 0)], [0, far]);
      trace(c, [[x, y], [x + dx, y + dy]]);
      stroke(c, color, 1.6 * dot, null, [5 * dot, 4 * dot]);
    };
    const row = this.rows[this.at];
    const begin = Math.max(0, this.crosses.findLastIndex(({ i }) => i <= (this.at ?? Infinity)) - MOST_CROSSES / 2);
    // Those at one place are one cross.
    const places = new Map();
    for (const cross of this.crosses.slice(begin, begin + MOST_CROSSES)) {
      const key = cross.pose.slice(0, 2).map((n) => Math.round(n / (9 * dot))).join();
      places.set(key, [...places.get(key) ?? [], cross]);
    }
    for (const here of places.values()) {
      const { i, pose: [x, y] } = here[0];
      c.globalAlpha = this.at !== null && i > this.at ? 0.35 : 1;
      const reach = 7 * dot;
      for (const { read } of here) if (read) ray(read, paint.red);
      c.beginPath();
      for (const side of [-1, 1]) {
        c.moveTo(x - reach, y - side * reach);
        c.lineTo(x + reach, y + side * reach);
      }
      stroke(c, paint.red, 3 * dot);
      const names = here.map(({ name }) => name);
      picture.label(c, names.length < 4 ? names.join(', ') : `${names[0]} … ${names.at(-1)}`, x, y + 17 * dot, paint.red, 700, paint.card, 16);
    }
    c.globalAlpha = 1;
    if (row?.read && Math.abs(this.time(row) - this.time(row.read)) < 0.05) ray(row.read, paint.blue);
  }

  // ---------------- files

  save() {
    const { world, spec, name } = this.kept ?? this.model;
    if (this.rows.length) download('reasoning.json', JSON.stringify({ kind: KIND, raw: this.raw, world, spec, name }), 'application/json');
  }

  async read() {
    const [file] = this.file.files;
    this.file.value = '';
    try {
      const kept = JSON.parse(await file.text());
      if (kept.kind !== KIND) throw new Error(kept.kind);
      this.fill(kept);
      text(this.title, `${file.name}: ${this.title.textContent}`);
    } catch {
      notice(`${file.name} is no file that Save has written here.`, { bad: true, seconds: 6 });
    }
  }

  picture() {
    if (!this.rows.length) return;
    const safe = (words) => words.replace(/[&<>]/g, (sign) => `&#${sign.charCodeAt(0)};`);
    const part = (name, words) => (words ? `<tspan class="${name}" dx="7">${safe(words)}</tspan>` : '');
    const rows = this.visible.slice(0, MOST_PICTURED);
    const canvas = $('world');
    const wide = 420;
    const high = Math.round((wide * canvas.height) / canvas.width);
    const lines = rows.map((i, n) => {
      const row = this.rows[i];
      const [glyph, kind] = MARKS[row.mark];
      return `<text class="${kind}${row.way ? ' way' : ''}" y="${24 + 20 * n}"><tspan class="time" x="52">${clock(this.time(row))}</tspan>`
        + `<tspan x="${66 + 16 * row.depth}">${row.way ? '╰' : glyph}</tspan><tspan class="goal" dx="7">${safe(row.words)}</tspan>`
        + `${part('plain', row.plain)}${part('plain', row.place)}${part('fault', row.fault)}${part('effect', row.effect)}</text>`;
    });
    download('reasoning.svg', `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${760 + wide} ${Math.max(high, 20 * rows.length) + 24}">
<style>text{font:13px sans-serif;fill:#1c1e22}.time{text-anchor:end;fill:#5b6068}.goal{font-family:monospace}.plain{fill:#5b6068;font-size:12px}
.fault,.false:not(.way) .goal,.false{fill:#c8201a}.way{fill:#8a5a00}.way .goal{font-weight:700;fill:#1c1e22}.true{fill:#1a7f43}.true .goal{fill:#1c1e22}.effect{fill:#0b62c4}</style>
<rect width="100%" height="100%" fill="#fff"/>
${lines.join('\n')}
<image x="750" y="8" width="${wide}" height="${high}" href="${canvas.toDataURL()}"/>
</svg>
`, 'image/svg+xml');
  }

  get state() {
    return { open: this.open, kept: Boolean(this.kept), rows: this.rows.length, shown: this.room.children.length, at: this.at, words: this.rows[this.at]?.words ?? null, waits: this.waits, old: this.old, crosses: (this.crosses ?? []).map(({ name, pose }) => [name, ...pose]) };
  }
}

/** A place in the frame of a pose, in the world's. */
function turned([x, y, h], [right, ahead]) {
  const [sin, cos] = [Math.sin(h * TURN), Math.cos(h * TURN)];
  return [x + right * cos + ahead * sin, y - right * sin + ahead * cos];
}
