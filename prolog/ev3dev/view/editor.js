// The editor of a world. It works on a draft, so the world that is simulated stays as it is
// until the draft is started in its place. Each change is checked by the program, which knows
// where the robot can stand; one that is refused is undone. A draft has what is drawn, and as
// `typed` the text of facts that somebody has changed since then.

import { $, attribute, download, el, icon, notice, pressed, sentence, text, toggle } from './dom.js';
import { along, disc, fill, trace } from './canvas.js';
import { kept, keep } from './panels.js';
import { COLORS, EMPTY, KINDS, draftOf, factsOf, named, outside, worldOf } from './things.js';

const TOOLS = Object.entries(KINDS).filter(([, { tool }]) => tool).map(([kind, { tool }]) => [kind, tool]);
const NEAR = 12;
const AROUND_SEEN = 12;
/** A line to the program has at most 64 kB. */
const LONGEST = 60000;
const ARROWS = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
/** The draft of a page that was closed before it was started. */
const KEPT = 'ev3dev-draft';
const round = (place) => place.map(Math.round);
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
const bare = ({ typed, ...drawn }) => drawn;

export class Editor {
  /** `changed` is called when the editor opens or closes. */
  constructor(send, world, changed) {
    Object.assign(this, { send, world, changed, open: false, draft: null, past: [], future: [], pending: [], ignored: 0, selected: null });
    this.tool = null;
    this.folder = null;
    this.build();
    document.addEventListener('keydown', (event) => { if (this.open) this.key(event); }, true);
    addEventListener('pagehide', () => { if (this.isChanged) keep(KEPT, this.draft); });
  }

  build() {
    const button = (words, onclick, props = {}) => el('button', { class: 'tool text', onclick, ...props }, words);
    const sign = (name, words, act) => button(icon(name), act, { class: 'tool', title: words, 'aria-label': words });
    this.undoing = sign('undo', 'Undo (Ctrl Z)', () => this.undo());
    this.redoing = sign('redo', 'Redo (Ctrl Y)', () => this.redo());
    this.tools = new Map(TOOLS.map(([kind, words]) => [kind, button(words, (event) => this.pick(kind, event.detail === 0), { 'aria-pressed': 'false', title: `Draw: ${words.toLowerCase()}` })]));
    this.hint = el('p', { class: 'hint-text', role: 'status' });
    this.fields = el('form', { class: 'fields' });
    this.fields.addEventListener('submit', (event) => event.preventDefault());
    this.rows = el('ul', { 'aria-label': 'What is in the world' });
    this.list = el('div', { class: 'things' }, this.rows);
    this.list.addEventListener('scroll', () => this.renderRows());
    this.name = el('input', { type: 'text', maxLength: 32, spellcheck: false, autocomplete: 'off', id: 'edit-name' });
    this.file = el('input', { type: 'file', accept: '.pl', hidden: true, 'aria-label': 'A world to open' });
    this.file.addEventListener('change', () => this.opened());
    this.saving = button('Save', () => this.save('write'));
    this.text = el('textarea', { class: 'facts', spellcheck: false, autocapitalize: 'off', 'aria-label': 'The world as facts', hidden: true });
    this.text.addEventListener('input', () => this.type(this.text.value));
    this.asFacts = button('Facts', () => this.turnFacts(this.text.hidden), { 'aria-pressed': 'false', title: 'The world as a text' });
    $('editor').append(
      el('header', {}, el('h2', { id: 'editor-title' }, 'Edit the world'), el('div', { class: 'actions' }, this.undoing, this.redoing, sign('close', 'Back to the robot', () => this.leave()))),
      el('div', { class: 'kinds', role: 'group', 'aria-label': 'Draw' }, ...this.tools.values()),
      this.hint, this.fields, this.list, this.text,
      el('div', { class: 'files' },
        el('label', { for: 'edit-name' }, 'Name'), this.name,
        button('Start', () => this.begin(), { class: 'tool text main', title: 'Start this world: the robot goes to its start, and a running program is stopped' }),
        this.asFacts, this.saving, button('Download', () => this.download()), button('Open', () => this.file.click(), { title: 'Open a file of facts and start it' }), button('Empty', () => this.change(EMPTY), { title: 'Begin with nothing' }), this.file),
    );
  }

  // ---------------- open and close

  enter(model) {
    this.model = model;
    // Things may have been pushed since then.
    if (!this.isChanged || this.base !== model.world) {
      this.name.value = plain(model.name) || 'my_world';
      this.begins(draftOf(model.world));
    }
    this.again(kept(KEPT));
    this.send('worlds');
    this.turn(true);
    this.render();
  }

  leave() {
    this.stopDrawing();
    this.turn(false);
    $('edit').focus();
  }

  turn(open) {
    this.open = open;
    this.world.editing = open ? this : null;
    toggle(document.body, 'editing', open);
    toggle(this.world.canvas, 'adding', false);
    pressed($('edit'), open);
    this.changed();
  }

  /** A draft of before the page was closed is there by undo, too. */
  again(draft) {
    keep(KEPT, null);
    try {
      const facts = draft && factsOf(draft);
      if (!draft || (draft.typed ?? facts) === this.facts) return;
    } catch {
      return; // what another page has kept under this name
    }
    this.past.unshift(draft);
    notice('Your last draft was not started. Undo shows it.', { seconds: 8 });
  }

  get isChanged() {
    return this.past.length > 0 || this.draft?.typed !== undefined;
  }

  /** The draft as facts. */
  get facts() {
    return this.draft.typed ?? factsOf(this.draft);
  }

  /** Another world; a draft that was not started is there by undo. */
  begins(draft) {
    if (this.isChanged && factsOf(draft) !== this.facts) this.past.push(this.draft);
    else this.past = [];
    Object.assign(this, { draft, base: this.model.world, future: [], pending: [], selected: 'around' });
  }

  /** Frames of the world that runs: only one that was opened here matters. */
  take(model) {
    this.model = model;
    if (!this.open || !this.opening || !model.frame.new) return;
    this.opening = false;
    this.begins(draftOf(model.world));
    this.name.value = plain(model.name) || this.name.value;
    this.world.camera.own = false;
    this.render();
  }

  /** The draft, as the world shows a model. */
  get picture() {
    const { model } = this;
    const draft = this.drawn ?? this.draft;
    const { x, y, h } = draft.start;
    const picture = Object.create(model);
    Object.assign(picture, {
      world: worldOf(draft, model.world?.view ?? [-50, -50, 250, 200]), path: null, grid: null, log: [], name: this.name.value,
      samples: { time: [], columns: new Map(), units: new Map() }, age: -1,
      frame: { ...model.frame, robot: { true: [x, y, h], believed: null }, see: [], beams: draft.items.map(({ id }) => ({ id, power: 1 })) },
    });
    Object.defineProperty(picture, 'simulated', { value: false });
    return picture;
  }

  // ---------------- changes

  thing(which = this.selected, draft = this.drawn ?? this.draft) {
    if (which === 'around' || which === 'start') return draft[which];
    return draft.items.find((item) => item.id === which);
  }

  /** The draft with a thing in the place of another. */
  with(which, thing) {
    if (which === 'around' || which === 'start') return { ...this.draft, [which]: thing };
    return { ...this.draft, items: this.draft.items.map((item) => (item.id === which ? thing : item)) };
  }

  put(which, thing) {
    if (!same(thing, this.thing(which, this.draft))) this.change(this.with(which, thing), thing);
    else this.render();
  }

  add(thing) {
    const id = Math.max(0, ...this.draft.items.map((item) => item.id)) + 1;
    const added = { ...thing, id };
    if (this.change({ ...this.draft, items: [...this.draft.items, added] }, added)) this.select(id);
  }

  remove() {
    const { selected } = this;
    if (typeof selected !== 'number') return;
    this.selected = 'around';
    this.change({ ...this.draft, items: this.draft.items.filter((item) => item.id !== selected) });
  }

  /** Another draft; answers whether it may be. */
  change(draft, thing = null) {
    const why = (thing && outside(thing, draft.around)) ?? [draft.start, ...draft.items].map((each) => (same(draft.around.bounds, this.draft.around.bounds) ? null : outside(each, draft.around))).find(Boolean);
    if (why) {
      notice(why, { seconds: 6 });
      this.render();
      return false;
    }
    const facts = factsOf(draft);
    if (!this.fits(facts)) return false;
    this.pending.push(this.past.length);
    this.past.push(this.draft);
    this.future = [];
    if (this.draft.typed !== undefined) notice('The text of facts was changed, too. Undo shows it.', { seconds: 6 });
    this.draft = bare(draft);
    this.send(`check ${facts}`);
    this.render();
    return true;
  }

  fits(facts) {
    const size = new TextEncoder().encode(facts).length;
    if (size > LONGEST) notice(`The world has ${size} bytes of facts. The page can send ${LONGEST}.`, { seconds: 6 });
    return size <= LONGEST;
  }

  /** What is typed is one step, the last one. */
  type(facts) {
    this.future = [];
    this.draft = facts === factsOf(this.draft) ? bare(this.draft) : { ...this.draft, typed: facts };
    this.render();
  }

  undo() {
    if (!this.isChanged || this.pending.length) return;
    this.future.push(this.draft);
    this.draft = this.draft.typed === undefined ? this.past.pop() : bare(this.draft);
    this.render();
  }

  redo() {
    if (!this.future.length || this.pending.length) return;
    const next = this.future.pop();
    if (next.typed === undefined || !same(bare(next), this.draft)) this.past.push(this.draft);
    this.draft = next;
    this.render();
  }

  /** What the program answered; whether it was a question of ours. */
  reply({ type, what, why, line, ...more }) {
    const refused = type === 'refused';
    if (what === 'check') {
      if (this.ignored) this.ignored -= 1;
      else if (this.pending.length && refused) this.refuse(why);
      else this.pending.shift();
    } else if (what === 'begin') {
      if (refused) {
        const typed = !this.opening && this.draft.typed !== undefined;
        notice(line && (this.opening || typed) ? `Line ${line}: ${why}` : sentence(why), { seconds: 8 });
        this.opening = false;
        if (typed && line) this.choose(line);
      } else if (!this.opening) {
        this.past = [];
        this.draft = bare(this.draft);
        this.leave();
        notice('The robot stands at the start of this world.', { seconds: 3 });
      }
    } else if (what === 'write' || what === 'rewrite') {
      if (more.exists) notice(why, { act: ['Replace it', () => this.save('rewrite')] });
      else notice(refused ? sentence(why) : `Saved as ${more.file}.`, { seconds: 6 });
    } else if (what === 'worlds') {
      this.folder = more.writes ? more.directory : null;
      this.saving.hidden = !this.folder;
      if (this.folder) this.saving.title = `Save in ${this.folder}`;
      return false;
    } else return false;
    return true;
  }

  /** The first change that is refused goes, and what was built on it. */
  refuse(why) {
    const [to] = this.pending;
    this.ignored = this.pending.length - 1;
    this.pending = [];
    const { typed } = this.draft;
    this.draft = typed === undefined ? this.past[to] : { ...this.past[to], typed };
    this.past.length = to;
    if (!this.thing()) this.selected = 'around';
    notice(sentence(why), { seconds: 6 });
    this.render();
  }

  // ---------------- files

  named() {
    const name = plain(this.name.value);
    if (!name) {
      notice('A name has letters, digits, _ and -, at most 32.', { seconds: 6 });
      this.name.focus();
    }
    return name;
  }

  begin() {
    const name = this.named();
    if (name && this.fits(this.facts)) this.send(`begin ${name} ${this.facts}`);
  }

  save(word) {
    const name = this.named();
    if (name) this.send(`${word} ${name} ${this.facts}`);
  }

  download() {
    const name = this.named();
    if (name) download(`${name}.pl`, this.facts, 'text/plain');
  }

  async opened() {
    const [file] = this.file.files;
    if (!file) return;
    const facts = await file.text().catch(() => null);
    this.file.value = '';
    if (facts === null) notice(`${file.name} cannot be read.`, { seconds: 6 });
    else this.use(facts, file.name.replace(/\.pl$/, ''));
  }

  /** Starts the world of a file; its drawing takes the place of this one. */
  use(facts, name) {
    if (!this.fits(facts)) return;
    this.opening = true;
    this.send(`begin ${plain(name) || 'world'} ${facts}`);
  }

  /** The text of facts in the place of the list of things, or that again. */
  turnFacts(shown) {
    this.text.hidden = !shown;
    this.list.hidden = shown;
    pressed(this.asFacts, shown);
    this.render();
  }

  /** A line of the text, which has no numbers beside it. */
  choose(line) {
    this.turnFacts(true);
    const lines = this.facts.split('\n');
    const from = lines.slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0);
    this.text.focus();
    this.text.setSelectionRange(from, from + (lines[line - 1]?.length ?? 0));
  }

  // ---------------- the canvas

  pick(kind, byKey) {
    this.stopDrawing();
    if (byKey && kind) {
      // By the keyboard it appears in the middle of what is seen.
      const { camera } = this.world;
      const [x, y] = round([camera.x, camera.y]);
      const half = Math.max(2, Math.round(Math.min(20, 60 / camera.scale) / 2));
      this.add(KINDS[kind].between([x - half, y - half], [x + half, y + half]));
      this.fields.querySelector('input')?.focus();
      return;
    }
    this.tool = this.tool === kind ? null : kind;
    this.render();
  }

  stopDrawing() {
    this.tool = this.drawing = this.drawn = null;
  }

  /** What is at a place: a handle of what is selected, the start, a thing. */
  at(place) {
    const { world } = this;
    const reach = NEAR * world.dot;
    const near = (point) => Math.hypot(point[0] - place[0], point[1] - place[1]) <= reach;
    const thing = this.thing();
    const handle = thing && this.handles(thing).findIndex(near);
    if (handle >= 0) return { which: this.selected, handle };
    const { start } = this.draft;
    if (Math.hypot(start.x - place[0], start.y - place[1]) <= Math.max(world.reach(), reach)) return { which: 'start' };
    const found = [...this.draft.items].reverse().find((item) => world.covers(item, place, reach / 2));
    return found ? { which: found.id } : null;
  }

  handles(thing) {
    if (!KINDS[thing.kind].handles) return [];
    const { world } = this;
    return KINDS[thing.kind].handles(thing, 24 * world.dot, Math.max(world.reach(), 13 * world.dot));
  }

  /** A finger or the mouse goes down; answers whether that is for the editor. */
  down(place) {
    if (this.tool) {
      const at = round(place);
      if (this.tool !== 'line') this.drawing = { from: at, to: at };
      else if (!this.drawing) this.drawing = { points: [at], from: at, to: at };
      else if (same(at, this.drawing.points.at(-1))) this.finish();
      else this.drawing.points.push(at);
      return true;
    }
    const found = this.at(place);
    this.select(found?.which ?? 'around');
    if (!found) return false;
    this.grabbed = { ...found, thing: this.thing(found.which), place };
    return true;
  }

  move(place) {
    const at = round(place);
    if (this.drawing) this.drawing.to = at;
    else if (this.grabbed) {
      const { which, handle, thing, place: from } = this.grabbed;
      const kind = KINDS[thing.kind];
      const next = handle >= 0 ? kind.take(thing, handle, at) : kind.move(thing, round([place[0] - from[0], place[1] - from[1]]));
      this.drawn = this.with(which, next);
      this.said(next);
    } else return;
    this.world.show(this.picture);
  }

  up(canceled) {
    const { drawing, grabbed, tool } = this;
    if (drawing) {
      const { from, to } = drawing;
      const dragged = Math.hypot(to[0] - from[0], to[1] - from[1]) > 1;
      if (canceled) this.stopDrawing();
      else if (tool === 'line') {
        if (drawing.points.length === 1 && dragged) {
          drawing.points.push(to);
          this.finish();
        }
      } else {
        this.stopDrawing();
        this.add(KINDS[tool].between(from, dragged || KINDS[tool].click ? to : [from[0] + 20, from[1] + 20]));
      }
    }
    this.grabbed = null;
    const { drawn } = this;
    this.drawn = null;
    if (drawn && grabbed && !canceled) this.put(grabbed.which, this.thing(grabbed.which, drawn));
    else this.render();
  }

  /** The end of a line of several places. */
  finish() {
    const points = this.drawing?.points ?? [];
    this.stopDrawing();
    if (points.length > 1) this.add({ ...KINDS.line.between(points[0], points[1]), points });
    else this.render();
  }

  /** What is being drawn, and the handles. */
  draw(c, { dot, paint }) {
    const thing = this.thing();
    if (this.drawing) {
      const { from, to, points } = this.drawing;
      const tool = KINDS[this.tool];
      const ghost = points ? { ...tool.between(from, to), points: [...points, to] } : tool.between(from, to);
      c.beginPath();
      if (tool.outline) along(c, tool.outline(ghost), tool.closed);
      else c.arc(ghost.x, ghost.y, ghost.r ?? 4 * dot, 0, 7);
      c.strokeStyle = paint.blue;
      c.lineWidth = Math.max(2 * dot, ghost.width ?? ghost.thickness ?? 0);
      c.globalAlpha = 0.7;
      c.stroke();
      c.globalAlpha = 1;
      return;
    }
    if (!thing || thing.kind === 'around') return;
    c.strokeStyle = paint.blue;
    c.lineWidth = 2 * dot;
    if (thing.kind !== 'start') {
      const points = thing.points ?? (thing.from && [thing.from, thing.to]);
      if (points) trace(c, points, thing.kind === 'patch');
      c.stroke(...points ? [] : [this.world.shape(thing)]);
    }
    for (const [x, y] of this.handles(thing)) {
      disc(c, x, y, 6 * dot);
      fill(c, paint.card);
      c.stroke();
    }
  }

  // ---------------- the keyboard

  key(event) {
    const { key, target } = event;
    const ctrl = event.ctrlKey || event.metaKey;
    if (key === 'Escape') {
      // STOP gets it, too.
      this.stopDrawing();
      this.render();
      return;
    }
    if (target.closest('input, select, textarea')) return;
    const step = event.shiftKey ? 10 : 1;
    const lower = key.toLowerCase();
    const thing = this.thing();
    const kind = thing && KINDS[thing.kind];
    let act = null;
    if (ctrl && lower === 'z') act = event.shiftKey ? () => this.redo() : () => this.undo();
    else if (ctrl && lower === 'y') act = () => this.redo();
    else if (ctrl || event.altKey) return;
    else if (ARROWS[key] && kind?.move && !target.closest('#time-slider, .charts, .log')) act = () => this.put(this.selected, kind.move(thing, ARROWS[key].map((n) => n * step)));
    else if ((key === '[' || key === ']') && kind?.turn) act = () => this.put(this.selected, kind.turn(thing, key === '[' ? -15 : 15));
    else if (key === 'Delete' || key === 'Backspace') act = () => this.remove();
    else if (key === 'Enter' && this.drawing) act = () => this.finish();
    // These are of the robot's world.
    else if ('bdfpr'.includes(lower)) act = () => {};
    if (!act) return;
    act();
    event.preventDefault();
    event.stopPropagation();
  }

  // ---------------- the card

  select(which) {
    if (this.selected === which) return;
    this.selected = which;
    this.render();
  }

  render() {
    if (!this.open) return;
    if (!this.thing()) this.selected = 'around';
    this.undoing.disabled = !this.isChanged;
    this.redoing.disabled = !this.future.length;
    for (const [kind, button] of this.tools) pressed(button, this.tool === kind);
    toggle(this.world.canvas, 'adding', this.tool !== null);
    this.said(this.thing());
    this.renderFields();
    this.renderList();
    if (this.text.value !== this.facts) this.text.value = this.facts;
    const { camera } = this.world;
    this.world.show(this.picture);
    if (!camera.own) {
      this.world.fit();
      this.world.draw();
    }
  }

  said(thing) {
    const words = this.tool ? KINDS[this.tool].hint ?? 'Drag it in the world.'
      : this.draft.typed === undefined ? KINDS[thing.kind].words(thing) : `Start begins the world of ${this.text.hidden ? 'the text under Facts' : 'this text'}.`;
    text(this.hint, words);
  }

  renderFields() {
    const thing = this.thing();
    const key = `${this.selected} ${JSON.stringify(thing)}`;
    if (key === this.fieldsKey) return;
    this.fieldsKey = key;
    const at = this.fields.contains(document.activeElement) ? [...this.fields.elements].indexOf(document.activeElement) : -1;
    const rows = KINDS[thing.kind].fields.filter(({ has }) => has?.(thing) ?? true).map((field, i) => this.row(field, thing, i));
    const remove = { class: 'tool text', title: 'Delete (Delete)', onclick: () => this.remove() };
    if (typeof this.selected === 'number') rows.push(el('button', remove, 'Delete'));
    this.fields.replaceChildren(...rows);
    attribute(this.fields, 'aria-label', KINDS[thing.kind].words(thing));
    if (at >= 0) this.fields.elements[Math.min(at, this.fields.elements.length - 1)]?.focus();
  }

  row(field, thing, i) {
    const id = `edit-${i}`;
    const value = field.get(thing);
    const input = field.kind === 'color'
      ? el('select', { id }, ...[...new Set([...field.none ?? [], ...COLORS.keys(), named(value)])].map((name) => el('option', { value: COLORS.get(name) ?? name, selected: named(value) === name }, name || 'none')))
      : field.kind === 'switch' ? el('input', { id, type: 'checkbox', checked: value === true })
      : el('input', { id, type: 'text', inputMode: field.kind === 'places' ? 'text' : 'decimal', autocomplete: 'off', spellcheck: false, value: field.kind === 'places' ? value.map((place) => place.join(' ')).join(', ') : String(value ?? '') });
    input.addEventListener('change', () => {
      const next = field.kind === 'switch' ? input.checked : read(field.kind, input.value);
      this.fieldsKey = '';
      if (next === null) {
        notice(field.kind === 'places' ? 'Places are pairs of numbers: 0 0, 100 50' : `${field.words} is a number.`, { seconds: 6 });
        this.render();
      } else this.put(this.selected, field.set(thing, next));
    });
    return el('div', { class: `field ${field.kind}` }, el('label', { for: id }, field.words), input, el('span', { class: 'unit' }, field.unit ?? ''));
  }

  renderList() {
    const { list, draft } = this;
    this.things = [['around', draft.around], ['start', draft.start], ...draft.items.map((item) => [item.id, item])];
    this.chosenAt = this.things.findIndex(([which]) => which === this.selected);
    const focused = list.contains(document.activeElement);
    // All rows are as high as the first one.
    list.style.setProperty('--rows', this.things.length);
    this.high = this.rows.offsetHeight / this.things.length || 1;
    const top = this.chosenAt * this.high;
    list.scrollTop = Math.max(top + this.high - list.clientHeight, Math.min(list.scrollTop, top));
    this.renderRows();
    if (focused) list.querySelector('[aria-pressed=true]')?.focus();
  }

  /** The rows of the list that are seen, and some around them. */
  renderRows() {
    const { list, things, high } = this;
    const from = Math.max(0, Math.floor(list.scrollTop / high) - AROUND_SEEN);
    const rows = things.slice(from, Math.ceil((list.scrollTop + list.clientHeight) / high) + AROUND_SEEN);
    const key = JSON.stringify([from, this.selected, rows]);
    if (key === this.listKey) return;
    this.listKey = key;
    list.style.setProperty('--from', from);
    this.rows.replaceChildren(...rows.map(([which, thing], i) => {
      const button = el('button', { onclick: () => this.select(which), 'aria-pressed': which === this.selected }, KINDS[thing.kind].words(thing));
      return el('li', { 'aria-setsize': things.length, 'aria-posinset': from + i + 1 }, button);
    }));
  }
}

/** What was typed, or null. */
function read(kind, typed) {
  if (kind === 'color') return typed;
  const numbers = (words) => words.trim().split(/\s+/).map((word) => Number(word.replace('−', '-').replace(',', '.')));
  if (kind === 'number') {
    const [n, ...rest] = numbers(typed);
    return typed.trim() && !rest.length && Number.isFinite(n) ? n : null;
  }
  const places = typed.split(',').map(numbers);
  return places.every((place) => place.length === 2 && place.every(Number.isFinite)) ? places : null;
}

/** A name as the program takes it. */
const plain = (name) => (name ?? '').replace(/[^A-Za-z0-9_-]+/g, '_').slice(0, 32);
