// The run so far. A slider goes back through what the page has seen: poses, ports and the
// world as they were. Other parts of the page go along by the event `ev3dev-time` of the
// document, whose detail `t` is seconds of the run, or null for now; who dispatches it
// moves the slider.

import { $, attribute, clock, goTo, text, toggle, upper } from './dom.js';
import { at } from './model.js';

/** The frames that are kept, 11 MB in all: if there are more, every other one of the older half goes. */
const MOST_FRAMES = 3000;
/** Frames that are nearer than this, in seconds, are the same moment. */
const APART = 0.04;
/** What sensors see is shown at moments so near to a frame. */
const SEEN_WITHIN = 0.06;
const STEP = 0.05;
/** How far keys go. */
const WAYS = { ArrowLeft: -STEP, ArrowDown: -STEP, ArrowRight: STEP, ArrowUp: STEP, PageDown: -1, PageUp: 1 };
const KEPT = ['name', 'world', 'spec', 'path', 'grid', 'screen', 'active'];

export class Timeline {
  /** `show` is called with what is to be shown from now on. */
  constructor(show) {
    this.show = show;
    this.t = null;
    this.past = null;
    this.kept = [];
    this.slider = $('time-slider');
    this.slider.addEventListener('input', () => this.moved());
    this.slider.addEventListener('keydown', (event) => {
      const way = WAYS[event.key];
      if (!way) return;
      this.slider.value = Number(this.slider.value) + way;
      this.moved();
      event.preventDefault();
    });
    $('time-live').addEventListener('click', () => goTo(null));
    document.addEventListener('ev3dev-time', (event) => this.go(event.detail.t));
  }

  /** By a hand: the end is now. */
  moved() {
    const { value, max } = this.slider;
    goTo(Number(value) > Number(max) - STEP / 2 ? null : Number(value));
  }

  // ---------------- what is kept

  take(model) {
    this.model = model;
    if (model.frame.new) {
      this.kept = [];
      if (this.past) goTo(null);
    }
    this.keep(model);
    if (model.frame.new || model.time !== this.described) this.describe();
  }

  keep(model) {
    const { kept } = this;
    const last = kept.at(-1);
    const now = { time: model.time, frame: model.frame };
    for (const name of KEPT) now[name] = model[name];
    if (last && now.time < last.time) return;
    // Of frames of one moment the last one stays, also for what hands did while time stood.
    if (last && kept.length > 1 && now.time - kept[kept.length - 2].time < APART) kept.pop();
    kept.push(now);
    if (kept.length > MOST_FRAMES) this.kept = kept.filter((_, i) => i >= MOST_FRAMES / 2 || i % 2 === 0);
  }

  get first() {
    return Math.min(this.kept[0]?.time ?? 0, this.model.samples.time[0] ?? Infinity, this.model.recorded ?? Infinity);
  }

  // ---------------- going back

  go(t) {
    if (!this.model) return;
    const back = t !== null && Number.isFinite(t) && t < this.model.time;
    this.t = back ? Math.max(this.first, t) : null;
    this.past = back ? this.at(this.t) : null;
    toggle(document.body, 'past', back);
    this.describe();
    this.follow();
    this.show(this.past ?? this.model);
  }

  /** The model as it was: what does not change is the present one's. */
  at(t) {
    const { model, kept } = this;
    const found = kept[Math.max(0, upper(kept, t + 1e-9, (each) => each.time) - 1)];
    const until = upper(model.samples.time, t + 1e-9);
    const value = sampled(model.samples, until, t);
    const pose = (names) => {
      const parts = names.map((name) => value(name, true));
      return parts.includes(null) ? null : parts;
    };
    const { robot, see = [], ports = [], clock: time } = found.frame;
    const truly = robot?.true && (pose(['x', 'y', 'heading']) ?? robot.true);
    const believed = pose(['bx', 'by', 'bh']);
    const near = Math.abs(found.time - t) <= SEEN_WITHIN;
    const past = Object.create(model);
    for (const name of KEPT) past[name] = found[name];
    const things = found.frame.things?.map(({ id, pose: was, held }) => ({ id, pose: pose(['x', 'y', 'heading'].map((part) => `thing${id}.${part}`)) ?? was, held: near && held }));
    if (things) past.world = { ...past.world, items: past.world.items.map((item) => ({ ...item, ...things.filter(({ id }) => id === item.id).map(at)[0] })) };
    past.frame = {
      ...found.frame,
      things,
      clock: { ...time, time: t },
      robot: robot && { ...robot, true: truly, believed: believed && { ...robot.believed, pose: believed, ellipse: near ? robot.believed?.ellipse : null } },
      see: near ? see : [],
      ports: ports.map((port) => measured(port, value, near)),
    };
    past.until = until;
    past.fresh = [];
    Object.defineProperty(past, 'simulated', { value: false });
    return past;
  }

  // ---------------- the bar

  describe() {
    const { slider, model, t } = this;
    const last = model.time;
    const { first } = this;
    this.described = last;
    slider.disabled = !(last - first > 2 * STEP);
    if (Number(slider.min) !== first) slider.min = first;
    slider.max = last;
    slider.value = t ?? last;
    const words = t === null ? `${clock(last)} s` : `${clock(t)} of ${clock(last)} s`;
    text($('time-text'), words);
    attribute(slider, 'aria-valuetext', t === null ? `now, ${clock(last)} seconds` : `${clock(t)} seconds`);
    attribute($('time-live'), 'aria-pressed', t === null);
    slider.style.setProperty('--share', last > first ? ((t ?? last) - first) / (last - first) : 0);
  }

  /** The log shows the line of that time. */
  follow() {
    const rows = [...$('log').querySelectorAll('li[data-time]')];
    const now = this.t === null ? null : rows.filter((row) => Number(row.dataset.time) <= this.t + 1e-6).pop();
    for (const row of rows) attribute(row, 'aria-current', row === now ? 'time' : null);
    if (!now) return;
    // The list moves, and not the page.
    const list = $('log');
    const [top, bottom] = [now.offsetTop - list.offsetTop, now.offsetTop - list.offsetTop + now.offsetHeight];
    list.scrollTop = Math.max(bottom - list.clientHeight, Math.min(list.scrollTop, top));
  }
}

/** Values of a column at a moment; poses also between two samples, unless a hand lifted the robot. */
function sampled({ time, columns }, until, t) {
  const [a, b] = [until - 1, until];
  const share = a >= 0 && b < time.length ? (t - time[a]) / (time[b] - time[a]) : 0;
  const smooth = ['x', 'y', 'bx', 'by'].every((name) => {
    const column = columns.get(name);
    return !column || !(Math.abs(column[b] - column[a]) > 6 + 90 * (time[b] - time[a]));
  });
  return (name, between = false) => {
    const column = columns.get(name);
    const before = column?.[a] ?? null;
    if (before === null || !between || !smooth || share === 0) return before;
    return before + ((column[b] ?? before) - before) * share;
  };
}

/** A port with what was sampled of it. Its state is that of a frame, if one is near. */
function measured(port, value, near) {
  const at = (name, old) => value(`${port.port}.${name}`) ?? old;
  if (port.kind === 'motor') {
    const [position, speed, duty, opening] = ['position', 'speed', 'duty', 'opening'].map((name) => at(name, port[name]));
    return { ...port, position, speed, duty, opening, state: near ? port.state : speed ? ['running'] : [] };
  }
  if (port.kind === 'sensor') return { ...port, values: port.values?.map((old, i) => at(`value${i}`, old)) };
  return port;
}
