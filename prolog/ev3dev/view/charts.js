// Strip charts of samples and of the program's own values: one strip for
// each quantity, all over the same time.

import { $, attribute, brief, clock, download, el, nice, num, pressed, text } from './dom.js';
import { UNITS } from './ports.js';

const SPANS = [[5, '5 s'], [20, '20 s'], [60, '60 s'], [Infinity, 'all']];
const LEFT = 54;
const RIGHT = 116;
const BOTTOM = 22;
const LOWEST_STRIP = 50;
const PALETTE = ['s1', 's2', 's3', 's4', 's5', 's6'];
const TITLES = { speed: 'speed', position: 'position', duty: 'duty cycle', x: 'x', y: 'y', heading: 'heading', bx: 'x believed', by: 'y believed', bh: 'heading believed' };

export class Charts {
  /** `changed` is called when other columns are shown. */
  constructor(changed) {
    this.changed = changed;
    this.box = $('charts');
    this.canvas = el('canvas', { role: 'img', 'aria-label': 'No chart yet' });
    this.context = this.canvas.getContext('2d');
    this.empty = el('p', { class: 'empty', hidden: true }, 'No samples yet. They begin when time passes.');
    this.strip = el('div', { class: 'strips' }, this.canvas);
    this.axis = el('canvas', { class: 'axis', 'aria-hidden': 'true' });
    this.box.append(this.strip, this.axis, this.empty);
    this.columns = null;
    this.hidden = new Set();
    this.domains = new Map();
    this.colorsOf = new Map();
    this.strips = [];
    this.span = 20;
    this.held = null;
    this.cursor = null;
    this.spans = SPANS.map(([span, name]) => {
      const button = el('button', { type: 'button', 'aria-pressed': String(span === this.span) }, name);
      button.addEventListener('click', () => this.reach(span));
      return button;
    });
    $('spans').append(...this.spans);
    $('chart-pause').addEventListener('click', () => this.hold(this.held === null));
    $('chart-csv').addEventListener('click', () => this.save());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
    new ResizeObserver(() => this.resize()).observe(this.box);
    this.listen();
  }

  // ------------------------------------------------------------- what is shown

  plotted(column) {
    const shown = this.columns?.has(column) && !this.hidden.has(this.quantity(column));
    return shown ? this.colorsOf.get(column) ?? null : null;
  }

  plot(column) {
    this.columns ??= new Set();
    if (this.columns.has(column)) this.columns.delete(column);
    else this.columns.add(column);
    this.hidden.delete(this.quantity(column));
    this.arrange();
    this.changed();
    this.draw();
  }

  quantity(column) {
    const [port, attribute] = column.split('.');
    if (!attribute) return column;
    return attribute.startsWith('value') ? column : `${attribute} ${this.model?.samples.units.get(column) ?? ''}`;
  }

  /** At first: the wheels' speeds and two sensors. */
  choose() {
    const { columns } = this.model.samples;
    if (this.columns !== null || columns.size === 0) return;
    const { spec, frame } = this.model;
    const motors = [spec?.left?.port, spec?.right?.port].filter(Boolean).map((port) => `${port}.speed`);
    const sensors = (frame.ports ?? []).filter((port) => port.kind === 'sensor').map((port) => `${port.port}.value0`);
    const wanted = [...motors, ...sensors.slice(0, this.height > 200 ? 2 : 1)].filter((name) => columns.has(name));
    if (!wanted.length) wanted.push(...[...columns.keys()].filter((name) => /speed|value0/.test(name)).slice(0, 3));
    this.columns = new Set(wanted);
    this.changed();
  }

  /** The strips: values of the program first, then what is watched, then columns. */
  arrange() {
    const { samples, values, watches } = this.model;
    const strips = new Map();
    const put = (key, title, unit, series) => {
      const strip = strips.get(key) ?? { key, title, unit: UNITS[unit] ?? unit ?? '', series: [] };
      strip.series.push(series);
      strips.set(key, strip);
    };
    for (const [name, series] of values) put(`value ${name}`, name, '', { name, label: name, time: series.time, values: series.values });
    for (const { name, column, unit } of watches ?? []) {
      const taken = samples.columns.get(column);
      if (taken) put(`watch ${name}`, name, unit ?? samples.units.get(column), { name: column, label: name, time: samples.time, values: taken });
    }
    for (const column of this.columns ?? []) {
      const taken = samples.columns.get(column);
      if (!taken) continue;
      const [port, quality] = column.split('.');
      const title = !quality ? TITLES[column] ?? column : quality.startsWith('value') ? this.sensorTitle(port, quality) : TITLES[quality] ?? quality;
      put(this.quantity(column), title, samples.units.get(column), { name: column, label: quality ? port : column, time: samples.time, values: taken });
    }
    this.strips = [...strips.values()];
    this.shown = this.strips.filter((strip) => !this.hidden.has(strip.key));
    for (const strip of this.strips) {
      for (const series of strip.series) {
        if (!this.colorsOf.has(series.name)) this.colorsOf.set(series.name, PALETTE[this.colorsOf.size % PALETTE.length]);
        series.color = this.colorsOf.get(series.name);
      }
    }
    this.chips();
  }

  sensorTitle(port, value) {
    const sensor = this.model.port(port);
    const words = sensor?.label ?? sensor?.name ?? value;
    return value === 'value0' ? words : `${words} ${value.slice(5)}`;
  }

  chips() {
    const key = this.strips.map((strip) => `${strip.key}|${strip.title}|${this.hidden.has(strip.key)}`).join();
    if (key === this.chipKey) return;
    this.chipKey = key;
    $('series').replaceChildren(...this.strips.map((strip) => {
      const on = !this.hidden.has(strip.key);
      const names = strip.series.map((series) => series.label).join(', ');
      const chip = el('button', { type: 'button', 'aria-pressed': String(on), title: names }, strip.title === names ? strip.title : `${strip.title} ${names}`);
      chip.addEventListener('click', () => {
        if (on) this.hidden.add(strip.key);
        else this.hidden.delete(strip.key);
        this.arrange();
        this.changed();
        this.resize();
      });
      return chip;
    }));
  }

  take(model) {
    this.model = model;
    if (model.frame.new) {
      this.held = null;
      this.cursor = null;
      this.domains.clear();
      pressed($('chart-pause'), false);
    }
    this.choose();
    const before = this.shown?.length;
    this.arrange();
    if (before !== this.shown.length) this.resize();
    this.empty.hidden = this.shown.length > 0;
    text(this.empty, this.strips.length ? 'All charts are hidden.' : model.samples.columns.size ? 'Choose a port to see its chart.' : 'No samples yet. They begin when time passes.');
    this.strip.hidden = this.axis.hidden = this.shown.length === 0;
  }

  // ------------------------------------------------------------- time

  get latest() {
    const { samples, values } = this.model;
    let latest = samples.time[samples.time.length - 1] ?? 0;
    for (const series of values.values()) latest = Math.max(latest, series.time[series.time.length - 1] ?? 0);
    return latest;
  }

  get range() {
    const end = this.held ?? this.latest;
    let first = Infinity;
    for (const strip of this.shown) for (const series of strip.series) first = Math.min(first, series.time[0] ?? Infinity);
    if (this.span === Infinity) return [Math.min(first, end - 1), end];
    // What is younger than that fills the strips from the left.
    if (Number.isFinite(first) && end - first < this.span) return [first, first + this.span];
    return [end - this.span, end];
  }

  reach(span) {
    this.span = span;
    SPANS.forEach(([each], i) => pressed(this.spans[i], each === span));
    this.draw();
  }

  hold(on) {
    this.held = on ? this.latest : null;
    if (!on) this.cursor = null;
    pressed($('chart-pause'), on);
    this.draw();
  }

  // ------------------------------------------------------------- reading off

  listen() {
    const { box } = this;
    box.addEventListener('pointermove', (event) => {
      if (this.grip) {
        const [from, to] = this.range;
        this.held = Math.min(this.latest, this.grip.end - ((event.clientX - this.grip.x) * (to - from)) / this.wide);
        this.draw();
      } else if (event.target === this.canvas) this.point(this.timeAt(event.offsetX));
    });
    box.addEventListener('pointerleave', () => { if (!this.keyed) this.point(null); });
    box.addEventListener('pointerdown', (event) => {
      this.keyed = false;
      if (this.held !== null && event.pointerType === 'mouse') {
        this.grip = { x: event.clientX, end: this.held };
        box.setPointerCapture(event.pointerId);
      } else if (event.target === this.canvas) this.point(this.timeAt(event.offsetX));
    });
    for (const end of ['pointerup', 'pointercancel']) box.addEventListener(end, () => { this.grip = null; });
    box.addEventListener('keydown', (event) => {
      const steps = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity }[event.key];
      if (!steps || !this.shown?.length) return;
      const [from, to] = this.range;
      const step = (steps * (to - from)) / (event.shiftKey ? 20 : 100);
      this.keyed = true;
      this.point(Math.max(from, Math.min(to, (this.cursor ?? to) + step)));
      attribute(box, 'aria-label', `At ${clock(Math.max(0, this.cursor))} s: ${this.readings().join(', ')}`);
      event.preventDefault();
    });
    box.addEventListener('blur', () => {
      this.keyed = false;
      this.point(null);
      attribute(box, 'aria-label', 'Charts; arrow keys read off');
    });
  }

  timeAt(px) {
    if (!this.model || !this.shown?.length) return null;
    const [from, to] = this.range;
    const share = (px - LEFT) / this.wide;
    return share < 0 || share > 1 ? null : from + share * (to - from);
  }

  point(time) {
    if (this.cursor === time) return;
    this.cursor = time;
    this.draw();
  }

  readings() {
    return (this.shown ?? []).flatMap((strip) => strip.series.map((series) => {
      const value = this.valueAt(series, this.cursor);
      return `${strip.title === series.label ? '' : `${strip.title} `}${series.label} ${value === null ? 'unknown' : brief(value)} ${strip.unit}`.trim();
    }));
  }

  valueAt(series, time) {
    const { time: times, values } = series;
    const i = time === null ? times.length - 1 : upper(times, time) - 1;
    return i < 0 ? null : values[i] ?? null;
  }

  // ------------------------------------------------------------- drawing

  resize() {
    const { clientWidth: width, clientHeight } = this.box;
    const height = clientHeight - BOTTOM;
    if (!width || height <= 0) return;
    this.ratio = devicePixelRatio || 1;
    this.width = width;
    this.height = Math.max(height, (this.shown?.length ?? 0) * LOWEST_STRIP);
    this.strip.style.overflowY = this.height > height + 1 ? 'auto' : 'hidden';
    this.box.style.setProperty('--strips', this.shown?.length ?? 0);
    this.canvas.style.height = `${this.height}px`;
    for (const [canvas, tall] of [[this.canvas, this.height], [this.axis, BOTTOM]]) {
      const [w, h] = [Math.round(width * this.ratio), Math.round(tall * this.ratio)];
      if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    }
    this.draw();
  }

  get wide() {
    return Math.max(10, this.width - LEFT - RIGHT);
  }

  draw() {
    if (!this.model || !this.width || !this.shown?.length) return;
    const c = this.context;
    const style = getComputedStyle(document.documentElement);
    this.color = (name) => style.getPropertyValue(`--${name}`).trim();
    this.font = this.color('sans');
    const axis = this.axis.getContext('2d');
    for (const each of [c, axis]) {
      each.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
      each.clearRect(0, 0, this.width, this.height);
    }
    const [from, to] = this.range;
    const x = (time) => LEFT + ((time - from) / (to - from)) * this.wide;
    const tall = this.height / this.shown.length;
    this.drawTimes(c, axis, from, to, x);
    this.shown.forEach((strip, i) => this.drawStrip(c, strip, i * tall, tall, from, to, x));
    if (this.cursor !== null && this.cursor >= from && this.cursor <= to) this.drawCursor(c, axis, x(this.cursor));
    const now = this.cursor;
    this.cursor = null;
    attribute(this.canvas, 'aria-label', `Charts. ${this.readings().join(', ')}`);
    this.cursor = now;
  }

  drawTimes(c, axis, from, to, x) {
    const step = nice(((to - from) * 76) / this.wide);
    axis.font = `12px ${this.font}`;
    axis.textAlign = 'center';
    axis.fillStyle = this.color('soft');
    c.lineWidth = 1;
    c.strokeStyle = this.color('line');
    for (let time = Math.ceil(Math.max(0, from) / step) * step; time <= to; time += step) {
      const at = Math.round(x(time)) + 0.5;
      c.beginPath();
      c.moveTo(at, 0);
      c.lineTo(at, this.height);
      c.stroke();
      if (at < this.width - RIGHT + 12) axis.fillText(axisTime(time, step), at, 15);
    }
    axis.textAlign = 'left';
    axis.fillText('s', this.width - RIGHT + 23, 15);
    c.strokeStyle = this.color('yellow');
    c.globalAlpha = 0.8;
    for (const line of this.model.log) {
      if (line.kind !== 'mark' || line.time < from || line.time > to) continue;
      c.beginPath();
      c.moveTo(x(line.time), 0);
      c.lineTo(x(line.time), this.height);
      c.lineWidth = 1.5;
      c.stroke();
    }
    c.globalAlpha = 1;
  }

  /** The axis keeps still for as long as the values fit well. */
  domain(strip, from, to) {
    let [low, high] = [Infinity, -Infinity];
    for (const { time, values } of strip.series) {
      for (let i = Math.max(0, upper(time, from) - 1), end = upper(time, to); i < end; i += 1) {
        const value = values[i];
        if (value === null) continue;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    if (low > high) [low, high] = [0, 1];
    // Not magnified beyond what means something.
    const least = 0.02 * Math.max(Math.abs(low), Math.abs(high));
    if (low === 0 && high === 0) high = 1;
    else if (high - low < least) [low, high] = [low - least, high + least];
    if (low > 0 && low < 0.6 * high) low = 0;
    if (high < 0 && high > 0.6 * low) high = 0;
    const old = this.domains.get(strip.key);
    if (old && low >= old[0] && high <= old[1] && high - low > 0.3 * (old[1] - old[0])) return old;
    const step = nice((high - low) / 3);
    const fresh = [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step, step];
    this.domains.set(strip.key, fresh);
    return fresh;
  }

  drawStrip(c, strip, top, tall, from, to, x) {
    const above = tall < 70 ? 17 : 22, below = 5;
    const [low, high, step] = this.domain(strip, from, to);
    const y = (value) => top + above + (1 - (value - low) / (high - low)) * (tall - above - below);
    const right = this.width - RIGHT;
    c.textBaseline = 'middle';
    c.textAlign = 'right';
    c.font = `12px ${this.font}`;
    c.lineWidth = 1;
    // As many labels as there is room for.
    const shown = step * Math.max(1, Math.ceil(17 / Math.max(1, (step / (high - low)) * (tall - above - below))));
    for (let value = Math.ceil(low / shown - 1e-9) * shown; value <= high + step * 1e-6; value += shown) {
      const at = Math.round(y(value)) + 0.5;
      c.strokeStyle = this.color(Math.abs(value) < step * 1e-6 ? 'off' : 'line');
      c.beginPath();
      c.moveTo(LEFT, at);
      c.lineTo(right, at);
      c.stroke();
      c.fillStyle = this.color('soft');
      c.fillText(num(value, Math.max(0, Math.min(6, -Math.floor(Math.log10(shown) + 1e-9)))), LEFT - 8, at);
    }
    c.textAlign = 'left';
    c.fillStyle = this.color('soft');
    c.font = `12px ${this.font}`;
    c.fillText(this.cut(c, `${strip.title}${strip.unit ? `  ${strip.unit}` : ''}`, this.wide - 8), LEFT + 4, top + (tall < 70 ? 9 : 12));
    c.save();
    c.beginPath();
    c.rect(LEFT, top, this.wide, tall);
    c.clip();
    for (const series of strip.series) this.drawSeries(c, series, from, to, x, y);
    c.restore();
    const size = Math.min(20, (tall - 8) / strip.series.length);
    strip.series.forEach((series, i) => {
      const at = top + above + 2 + size * i;
      const value = this.valueAt(series, this.cursor ?? this.held);
      c.fillStyle = this.color(series.color);
      c.beginPath();
      c.arc(right + 14, at, 4, 0, 7);
      c.fill();
      c.fillStyle = this.color('ink');
      c.font = `600 13px ${this.font}`;
      c.textAlign = 'right';
      const words = value === null ? '–' : brief(value);
      c.fillText(words, this.width - 8, at);
      const room = RIGHT - 38 - c.measureText(words).width;
      if (strip.series.length > 1 || series.label !== strip.title) {
        c.font = `12px ${this.font}`;
        c.textAlign = 'left';
        c.fillStyle = this.color('soft');
        c.fillText(this.cut(c, series.label, room), right + 23, at);
      }
    });
  }

  cut(c, words, room) {
    if (c.measureText(words).width <= room) return words;
    let length = words.length;
    while (length > 0 && c.measureText(`${words.slice(0, length)}…`).width > room) length -= 1;
    return length > 0 ? `${words.slice(0, length)}…` : '';
  }

  drawSeries(c, { time, values, color }, from, to, x, y) {
    const start = Math.max(0, upper(time, from) - 1);
    const end = Math.min(time.length, upper(time, to) + 1);
    c.beginPath();
    let pen = false;
    // Where there are several samples to a pixel: their lowest and highest.
    const many = end - start > 2 * this.wide;
    let column = null, low = 0, high = 0;
    const flush = () => {
      if (column === null) return;
      if (pen) c.lineTo(column, y(low)); else c.moveTo(column, y(low));
      if (high > low) c.lineTo(column, y(high));
      pen = true;
      column = null;
    };
    for (let i = start; i < end; i += 1) {
      const value = values[i];
      if (value === null || value === undefined) { flush(); pen = false; continue; }
      if (!many) {
        if (pen) c.lineTo(x(time[i]), y(value)); else c.moveTo(x(time[i]), y(value));
        pen = true;
        continue;
      }
      const at = Math.round(x(time[i]));
      if (column === at) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      } else {
        flush();
        [column, low, high] = [at, value, value];
      }
    }
    flush();
    c.strokeStyle = this.color(color);
    c.lineWidth = 1.6;
    c.lineJoin = 'round';
    c.stroke();
  }

  drawCursor(c, axis, at) {
    c.strokeStyle = this.color('ink');
    c.lineWidth = 1;
    c.beginPath();
    c.moveTo(Math.round(at) + 0.5, 0);
    c.lineTo(Math.round(at) + 0.5, this.height);
    c.stroke();
    const words = `${clock(Math.max(0, this.cursor))} s`;
    axis.font = `600 12px ${this.font}`;
    axis.textAlign = 'center';
    const half = axis.measureText(words).width / 2 + 7;
    const middle = Math.max(half, Math.min(this.width - half, at));
    axis.fillStyle = this.color('ink');
    axis.beginPath();
    axis.roundRect(middle - half, 1, 2 * half, 20, 6);
    axis.fill();
    axis.fillStyle = this.color('card');
    axis.fillText(words, middle, 15);
  }

  // ------------------------------------------------------------- CSV

  /** All samples and values, a line for each moment. */
  csv() {
    const { samples, values } = this.model;
    const names = [...samples.columns.keys()];
    const own = [...values.keys()];
    const quote = (word) => (/[",\n]/.test(word) ? `"${word.replace(/"/g, '""')}"` : word);
    const lines = new Map();
    samples.time.forEach((time, i) => lines.set(time, [...names.map((name) => samples.columns.get(name)[i] ?? ''), ...own.map(() => '')]));
    own.forEach((name, k) => values.get(name).time.forEach((time, i) => {
      if (!lines.has(time)) lines.set(time, [...names, ...own].map(() => ''));
      lines.get(time)[names.length + k] = values.get(name).values[i];
    }));
    const rows = [...lines].sort((a, b) => a[0] - b[0]).map(([time, row]) => [time, ...row].join());
    return [['time', ...names, ...own].map(quote).join(), ...rows, ''].join('\n');
  }

  save() {
    if (this.model) download('samples.csv', this.csv(), 'text/csv');
  }
}

/** How many of the sorted numbers are at most n. */
function upper(sorted, n) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= n) low = middle + 1;
    else high = middle;
  }
  return low;
}

function axisTime(time, step) {
  if (time < 60 || step < 1) return num(time, step < 0.1 ? 2 : step < 1 ? 1 : 0);
  return `${Math.floor(time / 60)}:${String(Math.round(time % 60)).padStart(2, '0')}`;
}
