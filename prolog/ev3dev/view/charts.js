// Charts of samples and of the program's own values. A chart has any series; those of one
// quantity have one scale. The time is that of all charts.

import { disc, fill, stroke, trace } from './canvas.js';
import { $, attribute, brief, clock, download, el, goTo, icon, nice, num, pressed, text, upper, within } from './dom.js';
import { divider, keep, kept } from './panels.js';
import { UNITS } from './ports.js';

const SPANS = [[5, '5 s'], [20, '20 s'], [60, '60 s'], [Infinity, 'all']];
const KEPT = 'ev3dev-charts';
const SCALE = 46;
const RIGHT = 12;
const BOTTOM = 22;
const LOWEST = 88;
const COLORS = 8;
const CLICK = 5;
const TITLES = { duty: 'duty cycle', bx: 'x believed', by: 'y believed', bh: 'heading believed' };

export class Charts {
  /** `changed` is called when other columns are shown. */
  constructor(changed) {
    this.changed = changed;
    this.box = $('charts');
    this.list = el('div', { class: 'strips' });
    this.axis = el('canvas', { class: 'axis', 'aria-hidden': 'true' });
    this.empty = el('p', { class: 'empty', hidden: true });
    this.box.append(this.list, this.axis, this.empty);
    /** What hands have chosen, if any: the charts, and the program's own series that were seen. */
    this.own = valid(kept(KEPT));
    this.charts = [];
    this.views = [];
    this.paints = new Map();
    this.span = 20;
    /** The time shown, if it is not the last seconds; where the pointer is; the moment of the page. */
    this.zoom = null;
    this.cursor = null;
    this.moment = null;
    this.spans = SPANS.map(([span, name]) => el('button', { onclick: () => this.reach(span), 'aria-pressed': span === this.span }, name));
    $('spans').append(...this.spans);
    $('chart-live').addEventListener('click', () => this.live());
    $('chart-pause').addEventListener('click', () => this.hold(this.zoom === null));
    $('chart-add').addEventListener('click', () => this.add());
    $('chart-csv').addEventListener('click', () => this.save());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.theme = null;
      this.draw();
    });
    this.sizes = new ResizeObserver(() => this.resize());
    this.sights = new IntersectionObserver((seen) => {
      for (const { target, isIntersecting } of seen) target.view.seen = isIntersecting;
      this.draw();
    }, { rootMargin: '200px' });
    this.sizes.observe(this.box);
    this.listen();
    // Of another part of the page, too, wherever it says so.
    addEventListener('ev3dev-time', (event) => {
      this.moment = event.detail?.t ?? null;
      this.shift(this.zoom);
    }, true);
  }

  // ---------------- series

  /** All there are, by name: `=` and a value of the program, `@` and what it watches, columns. */
  names() {
    const { samples, values, watches } = this.model;
    return [
      ...[...values.keys()].map((name) => `=${name}`),
      ...(watches ?? []).filter(({ column }) => samples.columns.has(column)).map(({ name }) => `@${name}`),
      ...samples.columns.keys(),
    ];
  }

  /** A series by its name, as it is now; null if there is none. Those of one `scale` share it. */
  series(name) {
    const { samples, values, watches } = this.model;
    const rest = name.slice(1);
    if (name[0] === '=') {
      const value = values.get(rest);
      return value ? { name, title: rest, label: rest, unit: '', scale: name, ...value } : null;
    }
    const watch = name[0] === '@' ? (watches ?? []).find((each) => each.name === rest) : null;
    const column = watch ? watch.column : name;
    const taken = samples.columns.get(column);
    if (!taken) return null;
    const [port, quality] = column.split('.');
    const given = watch?.unit ?? samples.units.get(column);
    const unit = UNITS[given] ?? given ?? '';
    const title = watch ? rest : quality?.startsWith('value') ? this.sensorTitle(port, quality) : TITLES[quality ?? port] ?? quality ?? port;
    const scale = quality ? `${quality.startsWith('value') ? title : quality} ${unit}` : unit;
    return { name, title, label: watch || !quality ? title : `${port} ${title}`, unit, scale, time: samples.time, values: taken };
  }

  sensorTitle(port, value) {
    const sensor = this.model.port(port);
    const words = sensor?.label ?? sensor?.name ?? value;
    return value === 'value0' ? words : `${words} ${value.slice(5)}`;
  }

  plotted(column) {
    const paint = this.paints.get(column);
    return paint === undefined ? null : color(paint);
  }

  /** Shows a column beside what has its scale, or takes it away. */
  plot(column) {
    const scale = this.series(column)?.scale;
    const shown = this.paints.has(column);
    this.edit((charts) => {
      for (const chart of charts) chart.series = chart.series.filter((name) => name !== column);
      if (shown) return;
      const fit = charts.find((chart) => !chart.hidden && chart.series.some((name) => this.series(name)?.scale === scale));
      if (fit) fit.series.push(column);
      else charts.push({ series: [column] });
    });
  }

  // ---------------- which charts

  /** Before any hand: what the program names, what it reads, the wheels' speeds. */
  automatic(names) {
    const { spec, frame } = this.model;
    const sensors = (frame.ports ?? []).filter((port) => port.kind === 'sensor');
    const read = sensors.filter((port) => port.read);
    const wheels = [spec?.left?.port, spec?.right?.port].filter(Boolean).map((port) => `${port}.speed`);
    const values = (ports) => ports.map(({ port }) => [`${port}.value0`]);
    const charts = [...names.filter(given).map((name) => [name]), ...values(read), wheels, ...read.length ? [] : values(sensors.slice(0, 2))]
      .map((series) => ({ series: series.filter((name) => names.includes(name)) })).filter(({ series }) => series.length);
    return charts.length ? charts : names.filter((name) => /speed|value0/.test(name)).slice(0, 3).map((name) => ({ series: [name] }));
  }

  /** A hand changes the charts. */
  edit(change) {
    if (this.own?.charts !== this.charts) this.own = { charts: this.charts, known: this.names().filter(given) };
    change(this.own.charts);
    this.own.charts = this.charts = this.own.charts.filter((chart) => chart.series.length || chart === this.edited);
    keep(KEPT, this.own);
    this.arrange();
    this.draw();
  }

  arrange() {
    const names = this.names();
    const { own } = this;
    const has = (chart) => chart.series.some((name) => names.includes(name));
    if (own && (own.charts.some(has) || own.charts.includes(this.edited))) {
      const fresh = names.filter((name) => given(name) && !own.known.includes(name));
      if (fresh.length) {
        own.known.push(...fresh);
        own.charts.unshift(...fresh.map((name) => ({ series: [name] })));
        keep(KEPT, own);
      }
      this.charts = own.charts;
    } else {
      const charts = this.automatic(names);
      if (JSON.stringify(charts) !== this.automated || this.charts === own?.charts) this.charts = charts;
      this.automated = JSON.stringify(charts);
    }
    const there = this.charts.filter((chart) => chart === this.edited || has(chart));
    const shown = there.filter((chart) => !chart.hidden);
    this.paint(shown.flatMap((chart) => chart.series));
    const parts = shown.map((chart) => chart.series.map((name) => this.series(name)).filter(Boolean));
    const signature = JSON.stringify([there, parts.map((all) => all.map(({ label, unit }) => [label, unit]))], (part, value) => (part === 'height' || part === 'off' ? undefined : value));
    if (signature !== this.signature) {
      this.signature = signature;
      this.build(there, shown, parts);
      this.changed();
    }
    this.views.forEach((view, i) => { view.series = parts[i]; });
    this.empty.hidden = shown.length > 0;
    text(this.empty, there.length ? 'All charts are hidden.' : names.length ? 'Add a chart with +.' : 'No samples yet. They begin when time passes.');
  }

  /** Each series keeps its color for as long as it is shown, and no other has it. */
  paint(names) {
    for (const name of [...this.paints.keys()]) if (!names.includes(name)) this.paints.delete(name);
    for (const name of names) {
      if (this.paints.has(name)) continue;
      const taken = [...this.paints.values()];
      let paint = 0;
      while (taken.includes(paint)) paint += 1;
      this.paints.set(name, paint);
    }
  }

  build(there, shown, parts) {
    this.sizes.disconnect();
    this.sights.disconnect();
    this.sizes.observe(this.box);
    this.views = shown.map((chart, i) => this.view(chart, parts[i]));
    this.list.replaceChildren(...this.views.map(({ box }) => box));
    $('series').replaceChildren(...there.filter((chart) => chart.hidden).map((chart) => el('button', {
      onclick: () => this.edit(() => { delete chart.hidden; }), title: 'Show this chart again',
    }, `+ ${title(chart.series.map((name) => this.series(name)).filter(Boolean))}`)));
    for (const view of this.views) {
      this.sizes.observe(view.plot);
      this.sights.observe(view.box);
    }
  }

  view(chart, series) {
    const canvas = el('canvas', { 'aria-hidden': 'true' });
    const plot = el('div', { class: 'chart-plot' }, canvas);
    const view = { chart, canvas, plot, context: canvas.getContext('2d'), domains: new Map(), width: 0, height: 0, seen: true };
    const name = title(series);
    view.keys = series.map((each) => {
      const value = document.createTextNode('');
      const key = el('button', { class: 'key', 'aria-pressed': !chart.off?.includes(each.name), title: 'Hide or show this series' },
        el('i', { class: this.paints.get(each.name) < COLORS ? 'paint' : 'paint ring' }), each.label, el('b', { class: 'num' }, value), el('span', { class: 'unit' }, each.unit));
      key.style.setProperty('--plot', `var(--${color(this.paints.get(each.name))})`);
      key.addEventListener('click', () => this.edit(() => {
        const off = chart.off ?? [];
        chart.off = off.includes(each.name) ? off.filter((other) => other !== each.name) : [...off, each.name];
        pressed(key, !chart.off.includes(each.name));
      }));
      return { value, key };
    });
    view.more = el('button', { class: 'tool chart-more', title: 'What this chart shows', 'aria-label': `What the chart of ${name || 'nothing'} shows`, 'aria-haspopup': 'true', onclick: () => this.menu(chart) }, icon('more'));
    view.bar = divider(`Height of the chart of ${name || 'nothing'}`, {
      get: () => view.box.offsetHeight, least: LOWEST, most: () => 600,
      set: (height) => this.edit(() => {
        if (height === null) delete chart.height;
        else chart.height = height;
        sized();
      }),
    });
    view.box = el('div', { class: 'chart', role: 'group', 'aria-label': name || 'A new chart' }, el('div', { class: 'chart-head' }, el('div', { class: 'keys-of' }, ...view.keys.length ? view.keys.map(({ key }) => key) : [el('span', { class: 'key' }, 'Choose what it shows.')]), view.more), plot, view.bar);
    const sized = () => { view.box.style.flex = chart.height ? `0 0 ${chart.height}px` : ''; };
    sized();
    view.box.view = view;
    return view;
  }

  // ---------------- the menu of a chart

  add() {
    const chart = { series: [] };
    this.edited = chart;
    this.edit((charts) => charts.push(chart));
    this.list.scrollTop = this.list.scrollHeight;
    this.menu(chart);
  }

  menu(chart) {
    const rank = (name) => (given(name) ? 0 : name.startsWith('in') ? 1 : name.startsWith('out') ? 2 : 3);
    const names = this.names().sort((a, b) => rank(a) - rank(b));
    const entry = (words, act, props) => {
      const button = el('button', { onclick: () => act(button), ...props }, words);
      return button;
    };
    const ends = (words, act) => entry(words, () => {
      menu.hidePopover();
      act();
    });
    const menu = el('div', { class: 'menu popup series-menu', popover: 'auto', role: 'group', 'aria-label': 'What the chart shows' },
      ...names.map((name) => entry(this.series(name).label, (button) => {
        const on = !chart.series.includes(name);
        attribute(button, 'aria-checked', on);
        this.edited = chart;
        this.edit(() => { chart.series = on ? [...chart.series, name] : chart.series.filter((each) => each !== name); });
      }, { class: 'check', role: 'checkbox', 'aria-checked': chart.series.includes(name) })),
      ends('Hide this chart', () => this.edit(() => { chart.hidden = true; })),
      ends('Remove this chart', () => this.edit((charts) => charts.splice(charts.indexOf(chart), 1))),
      ends('Reset all charts', () => {
        this.own = this.automated = null;
        keep(KEPT, null);
        this.arrange();
      }));
    const near = (this.views.find((view) => view.chart === chart)?.more ?? $('chart-add')).getBoundingClientRect();
    document.body.append(menu);
    menu.showPopover();
    menu.style.left = `${Math.max(8, near.right - menu.offsetWidth) + scrollX}px`;
    menu.style.top = `${within(8, near.bottom + 4, innerHeight - menu.offsetHeight - 8) + scrollY}px`;
    menu.querySelector('button').focus();
    menu.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      menu.hidePopover();
      event.stopPropagation();
    });
    menu.addEventListener('toggle', (event) => {
      if (event.newState !== 'closed') return;
      const inside = menu.contains(document.activeElement) || document.activeElement === document.body;
      menu.remove();
      this.edited = null;
      if (!chart.series.length) this.edit(() => {});
      if (inside) (this.views.find((view) => view.chart === chart)?.more ?? $('chart-add')).focus();
    });
  }

  take(model) {
    this.model = model;
    if (model.frame.new) {
      this.cursor = null;
      for (const view of this.views) view.domains.clear();
      this.shift(null);
    }
    this.arrange();
  }

  // ---------------- time

  get latest() {
    const { samples, values } = this.model;
    let latest = samples.time.at(-1) ?? 0;
    for (const series of values.values()) latest = Math.max(latest, series.time.at(-1) ?? 0);
    return latest;
  }

  get range() {
    const still = this.zoom ?? this.grip?.range;
    if (still) return still;
    const live = this.until(this.latest);
    if (this.moment === null || (this.moment >= live[0] && this.moment <= live[1])) return live;
    return this.until(within(this.moment, this.latest, this.moment + this.span / 2));
  }

  /** The span that ends there. */
  until(end) {
    let first = Infinity;
    for (const view of this.views) for (const series of view.series) first = Math.min(first, series.time[0] ?? Infinity);
    if (this.span === Infinity) return [Math.min(first, end - 1), end];
    // What is younger than that fills the strips from the left.
    if (Number.isFinite(first) && end - first < this.span) return [first, first + this.span];
    return [end - this.span, end];
  }

  /** Whether the charts are held still. */
  get held() {
    return this.zoom;
  }

  /** Shows a stretch of time, or the last seconds if that is null. */
  shift(range) {
    this.zoom = range;
    pressed($('chart-pause'), range !== null);
    $('chart-live').hidden = range === null && this.moment === null;
    this.draw();
  }

  reach(span) {
    this.span = span;
    SPANS.forEach(([each], i) => pressed(this.spans[i], each === span));
    this.shift(this.zoom && this.until(this.zoom[1]));
  }

  hold(on) {
    if (!on) this.cursor = null;
    this.shift(on ? this.range : null);
  }

  /** Back to what is now. */
  live() {
    this.hold(false);
    if (this.moment !== null) goTo(null);
  }

  // ---------------- hands

  listen() {
    const { box } = this;
    box.addEventListener('pointerdown', (event) => {
      const { target } = event;
      if (target.tagName !== 'CANVAS' || event.button || !this.views.length) return;
      this.keyed = false;
      target.setPointerCapture(event.pointerId);
      // Meanwhile the charts stand still under the hand.
      this.grip = { x: event.clientX, time: this.timeAt(event), range: this.range, pan: target === this.axis || event.shiftKey };
    });
    box.addEventListener('pointermove', (event) => {
      const { grip } = this;
      if (grip?.pan) {
        const [from, to] = grip.range;
        const by = Math.min(this.latest - to, ((grip.x - event.clientX) * (to - from)) / this.wide);
        this.shift([from + by, to + by]);
      } else if (grip || event.target.tagName === 'CANVAS') {
        if (grip) this.stretch = Math.abs(event.clientX - grip.x) < CLICK ? null : [grip.time, this.timeAt(event)].sort((a, b) => a - b);
        this.point(this.timeAt(event));
      }
    });
    box.addEventListener('pointerup', (event) => {
      const [range, was] = [this.stretch, this.grip];
      this.grip = this.stretch = null;
      if (!was || was.pan) return;
      if (range) this.shift(this.about((range[0] + range[1]) / 2, range[1] - range[0]));
      else if (event.target !== this.axis) goTo(was.time);
    });
    box.addEventListener('pointercancel', () => { this.grip = this.stretch = null; });
    box.addEventListener('pointerleave', () => { if (!this.keyed) this.point(null); });
    box.addEventListener('dblclick', (event) => { if (event.target.tagName === 'CANVAS') this.live(); });
    box.addEventListener('keydown', (event) => this.key(event));
    box.addEventListener('blur', () => {
      this.keyed = false;
      this.point(null);
      attribute(box, 'aria-label', 'Charts; arrow keys read values');
    });
  }

  key(event) {
    if (event.target !== this.box || !this.views.length || event.ctrlKey || event.metaKey) return;
    const [from, to] = this.range;
    const step = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity }[event.key];
    const at = this.cursor ?? (step ? to : (from + to) / 2);
    if (step) {
      this.keyed = true;
      this.point(Math.max(from, Math.min(to, at + (step * (to - from)) / (event.shiftKey ? 20 : 100))));
      attribute(this.box, 'aria-label', `At ${clock(Math.max(0, this.cursor))} s: ${this.readings().join(', ')}`);
    } else if (event.key === '+' || event.key === '=') this.shift(this.about(at, (to - from) / 2));
    else if (event.key === '-') this.shift(this.about(at, (to - from) * 2));
    else if (event.key === '0') this.live();
    else if (event.key === 'Enter') goTo(at);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** So many seconds about a time, or the least there is to see. */
  about(time, seconds) {
    const half = Math.max(0.1, seconds / 2);
    return [time - half, time + half];
  }

  get wide() {
    return Math.max(10, this.width - this.left - RIGHT);
  }

  timeAt(event) {
    const [from, to] = this.range;
    const share = (event.clientX - this.axis.getBoundingClientRect().left - this.left) / this.wide;
    return from + within(0, 1, share) * (to - from);
  }

  point(time) {
    if (this.cursor === time) return;
    this.cursor = time;
    this.draw();
  }

  readings() {
    return this.views.flatMap((view) => view.series.map((series) => {
      const value = valueAt(series, this.cursor);
      return `${series.label} ${value === null ? 'unknown' : brief(value)} ${series.unit}`.trim();
    }));
  }

  /** What is drawn, for tests. */
  state() {
    return this.views.map(({ chart, series, box }) => ({
      title: title(series), unit: [...new Set(series.map(({ unit }) => unit))].join(', '), height: box.offsetHeight,
      series: series.map((each) => ({
        label: each.label, value: valueAt(each, null), scale: each.scale, color: this.paints.get(each.name), hidden: chart.off?.includes(each.name) ?? false,
      })),
    }));
  }

  // ---------------- drawing

  resize() {
    this.ratio = devicePixelRatio || 1;
    this.width = this.list.clientWidth;
    for (const view of this.views) {
      [view.width, view.height] = [view.plot.clientWidth, view.plot.clientHeight];
      this.fit(view.canvas, view.width, view.height);
      view.bar.tell();
    }
    this.axis.style.width = `${this.width}px`;
    this.fit(this.axis, this.width, BOTTOM);
    this.draw();
  }

  fit(canvas, width, height) {
    const [w, h] = [Math.round(width * this.ratio), Math.round(height * this.ratio)];
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  }

  color(name) {
    if (!this.theme) {
      const style = getComputedStyle(document.documentElement);
      this.theme = new Map(['ink', 'soft', 'line', 'off', 'card', 'yellow', 'sans', ...Array.from({ length: COLORS }, (_, i) => color(i))]
        .map((each) => [each, style.getPropertyValue(`--${each}`).trim()]));
      this.font = `12px ${this.theme.get('sans')}`;
    }
    return this.theme.get(name);
  }

  draw() {
    if (!this.model || !this.width) return;
    this.color('ink');
    const [from, to] = this.range;
    const scales = Math.max(1, ...this.views.map((view) => new Set(view.series.map(({ scale }) => scale)).size));
    this.left = 8 + SCALE * Math.max(1, Math.min(scales, Math.floor(this.width / 4 / SCALE)));
    const x = (time) => this.left + ((time - from) / (to - from)) * this.wide;
    const step = nice(((to - from) * 76) / this.wide);
    const times = [];
    for (let time = Math.ceil(Math.max(0, from) / step) * step; time <= to; time += step) times.push(time);
    const marks = this.model.log.filter(({ kind, time }) => kind === 'mark' && time >= from && time <= to);
    for (const view of this.views) if (view.seen && view.width) this.drawChart(view, from, to, x, times, marks);
    this.drawAxis(times, step, from, to, x);
  }

  drawAxis(times, step, from, to, x) {
    const c = this.axis.getContext('2d');
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, this.width, BOTTOM);
    if (!this.views.length) return;
    c.font = this.font;
    c.textAlign = 'center';
    c.fillStyle = this.color('soft');
    for (const time of times) if (x(time) < this.width - 30) c.fillText(axisTime(time, step), x(time), 15);
    c.textAlign = 'right';
    c.fillText('s', this.width - RIGHT + 4, 15);
    const pill = this.cursor ?? this.moment;
    if (pill === null || pill < from || pill > to) return;
    const words = `${clock(Math.max(0, pill))} s`;
    c.font = `600 ${this.font}`;
    c.textAlign = 'center';
    const half = c.measureText(words).width / 2 + 7;
    const middle = Math.max(half, Math.min(this.width - half, x(pill)));
    c.fillStyle = this.color('ink');
    c.beginPath();
    c.roundRect(middle - half, 1, 2 * half, 20, 6);
    c.fill();
    c.fillStyle = this.color('card');
    c.fillText(words, middle, 15);
  }

  drawChart(view, from, to, x, times, marks) {
    const { context: c, series, width, height } = view;
    const at = this.cursor ?? this.moment ?? this.zoom?.[1] ?? null;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    c.lineWidth = 1;
    c.font = this.font;
    c.textBaseline = 'middle';
    c.textAlign = 'right';
    const upright = (time, name, thick) => {
      const at = Math.round(x(time)) + 0.5;
      trace(c, [[at, 0], [at, height]]);
      stroke(c, this.color(name), thick);
    };
    for (const time of times) upright(time, 'line', 1);
    const scales = new Map();
    for (const each of series) {
      if (view.chart.off?.includes(each.name)) continue;
      if (!scales.has(each.scale)) scales.set(each.scale, []);
      scales.get(each.scale).push(each);
    }
    const ys = new Map();
    let place = 0;
    for (const [scale, all] of scales) {
      const edge = SCALE * (place + 1);
      const y = this.drawScale(view, scale, all, from, to, edge, scales.size > 1);
      for (const each of all) ys.set(each, y);
      place += 1;
    }
    for (const { time } of marks) upright(time, 'yellow', 1.5);
    c.save();
    c.beginPath();
    c.rect(this.left, 0, this.wide, height);
    c.clip();
    for (const [each, y] of ys) this.drawSeries(c, each, from, to, x, y);
    if (this.stretch) {
      c.globalAlpha = 0.12;
      c.fillStyle = this.color('ink');
      c.fillRect(x(this.stretch[0]), 0, x(this.stretch[1]) - x(this.stretch[0]), height);
      c.globalAlpha = 1;
    }
    if (this.moment !== null) upright(this.moment, 'ink', 2);
    if (this.cursor !== null) upright(this.cursor, 'soft', 1);
    c.restore();
    series.forEach((each, i) => {
      const value = valueAt(each, at);
      const words = value === null ? '–' : brief(value);
      const { value: node } = view.keys[i];
      if (node.data !== words) node.data = words;
      if (at === null || value === null || !ys.has(each) || at < from || at > to) return;
      disc(c, x(at), ys.get(each)(value), 3.5);
      fill(c, this.color(color(this.paints.get(each.name))));
    });
  }

  /** The labels of a scale, left of an edge; those of the first have lines. Answers where a value is. */
  drawScale(view, scale, all, from, to, edge, several) {
    const { context: c, height, width } = view;
    const [low, high, step] = this.domain(view, scale, all, from, to);
    const y = (value) => 7 + (1 - (value - low) / (high - low)) * (height - 14);
    if (edge > this.left) return y;
    // As many labels as there is room for.
    const shown = step * Math.max(1, Math.ceil(17 / Math.max(1, (step / (high - low)) * (height - 14))));
    for (let value = Math.ceil(low / shown - 1e-9) * shown; value <= high + step * 1e-6; value += shown) {
      const at = Math.round(y(value)) + 0.5;
      if (edge === SCALE) {
        trace(c, [[this.left, at], [width - RIGHT, at]]);
        stroke(c, this.color(Math.abs(value) < step * 1e-6 ? 'off' : 'line'), 1);
      }
      c.fillStyle = this.color(several ? color(this.paints.get(all[0].name)) : 'soft');
      c.fillText(num(value, Math.max(0, Math.min(6, -Math.floor(Math.log10(shown) + 1e-9)))), edge, at);
    }
    return y;
  }

  /** The axis keeps still for as long as the values fit well. */
  domain(view, scale, all, from, to) {
    let [low, high] = [Infinity, -Infinity];
    for (const { time, values } of all) {
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
    const old = view.domains.get(scale);
    if (old && low >= old[0] && high <= old[1] && high - low > 0.3 * (old[1] - old[0])) return old;
    const step = nice((high - low) / 3);
    const fresh = [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step, step];
    view.domains.set(scale, fresh);
    return fresh;
  }

  drawSeries(c, { name, time, values }, from, to, x, y) {
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
    const paint = this.paints.get(name);
    c.strokeStyle = this.color(color(paint));
    c.lineWidth = 1.6;
    c.lineJoin = 'round';
    c.setLineDash(paint < COLORS ? [] : [6, 3]);
    c.stroke();
    c.setLineDash([]);
  }

  // ---------------- CSV

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

function axisTime(time, step) {
  if (time < 60 || step < 1) return num(time, step < 0.1 ? 2 : step < 1 ? 1 : 0);
  return `${Math.floor(time / 60)}:${String(Math.round(time % 60)).padStart(2, '0')}`;
}

/** Series that the program names appear by themselves. */
const given = (name) => /^[=@]/.test(name);

/** One of eight; what comes after those is dashed. */
const color = (paint) => `s${(paint % COLORS) + 1}`;

/** Kept by another version, or by a hand: then there is nothing. */
const valid = (own) => {
  const texts = (all) => Array.isArray(all) && all.every((name) => typeof name === 'string');
  return texts(own?.known) && Array.isArray(own.charts) && own.charts.every((chart) => texts(chart?.series) && texts(chart.off ?? [])) ? own : null;
};

/** What its series are, without their ports. */
const title = (series) => [...new Set(series.map((each) => each.title))].join(', ');

/** The value at a time, or the last one. */
function valueAt({ time: times, values }, time) {
  const i = time === null ? times.length - 1 : upper(times, time) - 1;
  return i < 0 ? null : values[i] ?? null;
}
