// The page's knowledge: the latest frame, what is kept between frames, and
// the samples since the simulation began.

/** What each frame has, or adds to what was there. All other keys are kept between frames. */
const PASSING = new Set(['type', 'have', 'new', 'calm', 'rate', 'source', 'tree', 'goals', 'clock', 'program', 'robot', 'see', 'beams', 'others', 'things', 'ports', 'brick', 'samples', 'values', 'log']);

/** A thing's place, as an item of the world has it. */
export const at = ({ pose: [x, y, h], held }) => ({ x, y, h, held });

/** All kept keys have come. */
export const ALL = { has: () => true };
const MOST_SAMPLES = 24000;
const MOST_LOG = 500;

export class Model {
  constructor() {
    this.frame = null;
    this.count = 0;
    this.kept = new Set();
    this.forget();
  }

  /** Another simulation, or another time of it. */
  forget() {
    this.age = (this.age ?? 0) + 1;
    for (const name of this.kept) this[name] = null;
    this.samples = { time: [], columns: new Map(), units: new Map() };
    this.values = new Map();
    this.log = [];
    this.thinned = 0;
  }

  /** Takes a frame; answers which kept keys came with it. */
  take(frame) {
    if (frame.source === 'none' && (this.simulated || this.ended)) return this.end(frame);
    this.ended = false;
    if (frame.new) this.forget();
    const names = Object.keys(frame).filter((name) => !PASSING.has(name));
    for (const name of names) {
      this[name] = frame[name];
      this.kept.add(name);
    }
    // Nobody knows the world of a real robot.
    if (frame.source !== 'sim') this.world = this.name = null;
    this.frame = frame;
    this.count += 1;
    for (const { id, ...place } of frame.things ?? []) Object.assign(this.world?.items.find((item) => item.id === id) ?? {}, at(place));
    if (frame.samples) this.append(frame.samples);
    for (const [name, time, value] of frame.values ?? []) this.value(name, time, value);
    this.hear(frame);
    return frame.new ? ALL : new Set(names);
  }

  /** The simulation has ended: its last picture stays, and its run can be looked at. */
  end(frame) {
    const { robot, see, beams, others, things, ports, brick, clock } = this.frame;
    this.frame = { ...frame, new: false, robot, see, beams, others, things, ports, brick, clock: { ...clock, stands: true } };
    const [first] = [!this.ended, this.ended = true];
    this.bricks = null;
    this.count += 1;
    this.hear(frame);
    return new Set(first ? ['bricks'] : []);
  }

  /** Takes what is new in the log. */
  hear(frame) {
    const { newest } = this;
    this.fresh = (frame.log ?? []).filter((line) => !(line.n <= newest));
    this.missed = newest >= 0 && this.fresh.length ? this.fresh[0].n - newest - 1 : 0;
    if (this.fresh.length) {
      this.log.push(...this.fresh);
      this.log.splice(0, Math.max(0, this.log.length - MOST_LOG));
    }
  }

  get newest() {
    return this.log.length ? this.log.at(-1).n : -1;
  }

  append({ columns, units, rows }) {
    const kept = this.samples;
    const length = kept.time.length;
    columns.forEach((name, i) => {
      if (units) kept.units.set(name, units[i]);
      if (i > 0 && !kept.columns.has(name)) kept.columns.set(name, new Array(length).fill(null));
    });
    for (const row of rows) {
      if (kept.time.length && row[0] <= kept.time.at(-1)) continue;
      kept.time.push(row[0]);
      for (const [name, values] of kept.columns) {
        const i = columns.indexOf(name);
        values.push(i < 0 ? null : row[i] ?? null);
      }
    }
    if (kept.time.length > MOST_SAMPLES) {
      // The older half keeps every other sample.
      const half = MOST_SAMPLES / 2;
      const stays = (_, i) => i >= half || i % 2 === 0;
      kept.time = kept.time.filter(stays);
      for (const [name, values] of kept.columns) kept.columns.set(name, values.filter(stays));
      this.thinned += 1;
    }
  }

  value(name, time, value) {
    let series = this.values.get(name);
    if (!series) this.values.set(name, (series = { time: [], values: [] }));
    series.time.push(time);
    series.values.push(value);
    if (series.time.length > MOST_SAMPLES) {
      series.time.splice(0, MOST_SAMPLES / 4);
      series.values.splice(0, MOST_SAMPLES / 4);
    }
  }

  get time() {
    return this.frame?.clock?.time ?? 0;
  }

  get simulated() {
    return this.frame?.source === 'sim';
  }

  port(name) {
    return this.frame?.ports?.find((port) => port.port === name);
  }
}
