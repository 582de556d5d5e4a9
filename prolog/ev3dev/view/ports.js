// The eight ports: motors with speed and position, sensors with their value.

import { $, attribute, el, icon, num, text, toggle, within } from './dom.js';

const COLORS = ['none', 'black', 'blue', 'green', 'yellow', 'red', 'white', 'brown'];
const SWATCH = ['', '#17181a', '#0055bf', '#237841', '#f2cd37', '#c91a09', '#ffffff', '#6b3f22'];
const WORDS = {
  running: 'runs', ramping: 'changes speed', holding: 'holds', overloaded: 'overloaded', stalled: 'stalled',
};
/** The greatest value of a bar, by unit or mode. */
const FULL = { 'US-DIST-CM': 255, 'US-DIST-IN': 100, cm: 255, '%': 100, pct: 100, 'IR-PROX': 100, 'GYRO-ANG': 180, 'GYRO-RATE': 440, 'REF-RAW': 1023 };
const SIGNED = new Set(['GYRO-ANG', 'GYRO-RATE', 'GYRO-G&A', 'deg', 'd/s', 'deg/s']);

export const UNITS = { deg: '°', 'deg/s': '°/s', 'd/s': '°/s', pct: '%', 'mm/s': 'mm/s' };
const unit = (name) => UNITS[name] ?? name ?? '';

export class Ports {
  /** `plot` shows a column in the charts, or takes it away; `plotted` says in
      which color it is there. */
  constructor(send, plot, plotted) {
    this.send = send;
    this.plot = plot;
    this.plotted = plotted;
    this.rows = new Map();
    this.list = $('ports');
    this.menu = null;
  }

  take(model) {
    this.model = model;
    const { frame } = model;
    const ports = frame.ports ?? [];
    for (const port of ports) this.row(port);
    for (const [name, row] of this.rows) {
      if (!ports.some((port) => port.port === name)) {
        row.box.remove();
        this.rows.delete(name);
      }
    }
    const empty = ports.length === 0;
    $('ports-empty').hidden = !empty;
    this.list.hidden = empty;
    if (empty) text($('ports-empty'), 'No motor or sensor is known yet.');
  }

  row(port) {
    let row = this.rows.get(port.port);
    if (!row || row.kind !== port.kind || row.driver !== port.driver) {
      const fresh = this.build(port);
      if (row) row.box.replaceWith(fresh.box);
      else this.list.append(fresh.box);
      this.rows.set(port.port, (row = fresh));
    }
    const show = { motor: this.motor, dc: this.motor, servo: this.motor, sensor: this.sensor }[port.kind] ?? this.none;
    show.call(this, row, port);
  }

  build(port) {
    const parts = Object.fromEntries(['name', 'type', 'value', 'detail', 'gauge', 'acts'].map((name) => [name, el('span', { class: name })]));
    const row = { ...parts, kind: port.kind, driver: port.driver, bar: el('i'), words: document.createTextNode(''), unit: el('span', { class: 'unit' }) };
    text(row.name, port.port);
    row.gauge.append(row.bar);
    row.value.append(row.words, row.unit);
    row.box = el('li', { class: 'port', 'data-port': port.port }, ...Object.values(parts));
    row.plot = el('i', { class: 'plot', hidden: true });
    row.value.prepend(row.plot);
    if (column(port) || this.model.simulated) {
      const button = el('button', { class: 'tool', title: `More of ${port.port}`, 'aria-label': `More of ${port.port}`, 'aria-haspopup': 'true', 'aria-expanded': 'false', onclick: () => this.open(button, port.port) }, icon('more'));
      row.acts.append(button);
    }
    return row;
  }

  motor(row, port) {
    const states = port.state ?? [];
    const running = states.includes('running') && !states.includes('holding');
    toggle(row.box, 'running', running);
    toggle(row.box, 'bad', states.includes('stalled') || states.includes('overloaded') || port.held === true);
    text(row.type, port.name ?? port.driver);
    const full = port.max || 1050;
    const share = port.speed !== undefined ? port.speed / full : (port.duty ?? 0) / 100;
    row.words.data = port.speed !== undefined ? num(100 * share) : port.duty !== undefined ? num(port.duty) : port.kind === 'servo' ? num(port.position) : '–';
    text(row.unit, '%');
    const said = states.map((word) => WORDS[word] ?? word);
    if (port.held) said.push('held');
    // Its speed in the chart's unit, too; without a command it goes on for a moment.
    const moves = Math.abs(port.speed ?? 0) >= 1;
    if (!said.length) said.push(moves ? 'slows down' : 'rests');
    const speed = moves ? ` · ${num(port.speed)}${unit('deg/s')}` : '';
    const position = port.position !== undefined ? ` · ${num(port.position)} ${unit(port.unit ?? 'deg')}`.replace(' °', '°') : '';
    text(row.detail, said.join(', ') + speed + position);
    this.bar(row, share, true);
    this.dot(row, port);
  }

  sensor(row, port) {
    const values = port.values ?? [];
    const [value] = values;
    text(row.type, (port.name ?? port.driver).replace(/ sensor$/, ''));
    const color = port.mode === 'COL-COLOR' && COLORS[value] !== undefined;
    const touch = port.driver?.includes('touch') || port.mode === 'TOUCH';
    if (color) row.words.data = COLORS[value];
    else if (touch) row.words.data = value ? 'pressed' : 'free';
    else row.words.data = values.length ? values.slice(0, 3).map((n) => (Number.isInteger(n) ? num(n) : num(n, 1))).join('  ') : '–';
    text(row.unit, color || touch ? '' : unit(port.units));
    let swatch = row.value.querySelector('.swatch');
    if (color && value > 0) {
      if (!swatch) row.value.prepend((swatch = el('span', { class: 'swatch' })));
      swatch.style.background = SWATCH[value];
    } else swatch?.remove();
    text(row.detail, port.mode ?? '');
    const full = FULL[port.mode] ?? FULL[port.units] ?? 0;
    row.gauge.hidden = !full || value === undefined;
    if (full && value !== undefined) this.bar(row, value / full, SIGNED.has(port.mode) || SIGNED.has(port.units));
    this.dot(row, port);
  }

  /** A dot in the color that the port has in the charts. */
  dot(row, port) {
    const color = this.plotted(column(port));
    if (row.plot.hidden === Boolean(color)) row.plot.hidden = !color;
    if (color && row.color !== color) {
      row.color = color;
      row.plot.style.setProperty('--plot', `var(--${color})`);
    }
  }

  none(row, port) {
    row.box.classList.add('none');
    row.gauge.hidden = true;
    const words = { empty: 'nothing plugged in', coming: 'connecting', gone: 'unplugged' };
    text(row.type, words[port.kind] ?? port.driver ?? '');
    row.words.data = '';
  }

  bar(row, share, centered) {
    toggle(row.gauge, 'centered', centered);
    row.bar.style.transform = `scaleX(${Math.max(-1, Math.min(1, share))})`;
  }

  /** What a hand can do at a port of the simulated brick. */
  open(button, name) {
    const was = this.menu?.name;
    this.close();
    if (was === name) return;
    const port = this.model.port(name);
    const menu = el('div', { class: 'menu popup port-menu', popover: 'manual', role: 'group', 'aria-label': `Port ${name}` });
    const action = (words, act) => {
      const onclick = () => {
        if (typeof act === 'string') this.send(act);
        else act();
        this.close();
        button.focus();
      };
      menu.append(el('button', { onclick }, words));
    };
    const plot = column(port);
    if (plot) action(this.plotted(plot) ? 'Hide its chart' : 'Show its chart', () => this.plot(plot));
    if (port.kind === 'motor' && port.position !== undefined) {
      const position = `${name}.position`;
      action(this.plotted(position) ? 'Hide its position' : 'Chart its position', () => this.plot(position));
    }
    if (this.model.simulated) this.hands(action, port);
    if (!menu.children.length) return;
    this.place(button, name, menu);
  }

  hands(action, port) {
    const { port: name } = port;
    if (port.kind === 'motor') action(port.held ? 'Let go of the shaft' : 'Hold the shaft', `${port.held ? 'free' : 'hold'} ${name}`);
    const touch = port.driver?.includes('touch');
    if (touch) {
      action('Press', `press ${name}`);
      action('Release', `release ${name}`);
    }
    if (port.kind === 'gone') action('Plug in again', `plug ${name}`);
    else if (port.kind !== 'empty') action('Pull the wire', `unplug ${name}`);
    const types = this.model.plugs?.[name.startsWith('out') ? 'out' : 'in'] ?? [];
    for (const type of ['empty', 'gone'].includes(port.kind) ? types : []) action(type, `plug ${name} ${type}`);
  }

  place(button, name, menu) {
    attribute(button, 'aria-expanded', true);
    const { bottom, right } = button.getBoundingClientRect();
    button.closest('.card').append(menu);
    menu.showPopover();
    // All of it is seen, wherever its port is.
    menu.style.left = `${Math.max(8, right - menu.offsetWidth) + scrollX}px`;
    menu.style.top = `${within(8, bottom + 4, innerHeight - menu.offsetHeight - 8) + scrollY}px`;
    this.menu = { name, menu, button };
    menu.querySelector('button').focus();
  }

  /** Answers whether it was open. */
  close() {
    if (!this.menu) return false;
    this.menu.menu.remove();
    attribute(this.menu.button, 'aria-expanded', false);
    this.menu = null;
    return true;
  }
}

/** The column of the samples that a port's button plots. */
function column(port) {
  const quality = { motor: 'speed', dc: 'duty', servo: 'position', sensor: 'value0' }[port.kind];
  return quality ? `${port.port}.${quality}` : null;
}
