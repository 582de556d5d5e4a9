// Panels that a hand folds or makes larger, and what the browser keeps of it.

import { $, attribute, el, icon, toggle, within } from './dom.js';

const KEPT = 'ev3dev-panels';
const NAMES = { world: 'World', ports: 'Ports', charts: 'Charts', brick: 'Brick', log: 'Log' };
const [GAP, PAD, PORTS, SIDE, CHARTS] = [12, 16, 276, 340, 186];

/** What was kept under a name; null if there is nothing, or nothing that can be read. */
export function kept(name) {
  try {
    return JSON.parse(localStorage.getItem(name));
  } catch {
    return null;
  }
}

/** Keeps a value; one that is null is forgotten. A browser that keeps nothing shows the page all the same. */
export function keep(name, value) {
  try {
    if (value === null) localStorage.removeItem(name);
    else localStorage.setItem(name, JSON.stringify(value));
  } catch { /* for this time only */ }
}

/** A bar beside something: a drag or the arrow keys make that larger or smaller. `get` answers its
    size in pixels, `set` takes one, or null for that of before any hand. `sign` is -1 if the bar
    stands before it, `across` if its width is meant. */
export function divider(words, { get, set, least, most, sign = 1, across = false }) {
  const bar = el('div', {
    class: 'divider', role: 'separator', tabIndex: 0, title: `${words}: drag, arrow keys; double click as before`,
    'aria-label': words, 'aria-orientation': across ? 'vertical' : 'horizontal', 'aria-valuemin': least, 'aria-valuenow': least,
  });
  const to = (size) => {
    set(size === null ? null : Math.round(Math.max(least, Math.min(most(), size))));
    bar.tell();
  };
  bar.tell = () => {
    attribute(bar, 'aria-valuenow', Math.round(get()));
    attribute(bar, 'aria-valuemax', Math.round(Math.max(most(), get())));
  };
  const at = (event) => (across ? event.clientX : event.clientY);
  bar.addEventListener('pointerdown', (event) => {
    const [start, size] = [at(event), get()];
    const drag = (moved) => to(size + sign * (at(moved) - start));
    bar.setPointerCapture(event.pointerId);
    bar.addEventListener('pointermove', drag);
    bar.addEventListener('lostpointercapture', () => bar.removeEventListener('pointermove', drag), { once: true });
  });
  bar.addEventListener('dblclick', () => to(null));
  bar.addEventListener('keydown', (event) => {
    const steps = { [across ? 'ArrowLeft' : 'ArrowUp']: -16, [across ? 'ArrowRight' : 'ArrowDown']: 16 }[event.key];
    if (steps) to(get() + sign * steps);
    else if (event.key === 'Home') to(least);
    else if (event.key === 'End') to(most());
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  return bar;
}

export class Panels {
  /** `changed` is called when there is another size for the grid. */
  constructor(changed) {
    const old = kept(KEPT);
    this.changed = changed;
    this.sizes = Object.fromEntries(Object.entries(old?.sizes ?? {}).filter(([, size]) => size > 0));
    this.folded = new Set(Array.isArray(old?.folded) ? old.folded : []);
    this.cards = Object.fromEntries(Object.keys(NAMES).map((name) => [name, document.querySelector(`.${name}-card`)]));
    this.side = document.querySelector('.side');
    for (const name of Object.keys(NAMES)) this.fold(name);
    const { world, brick } = this.cards;
    const main = $('main');
    const wide = (other) => main.clientWidth - 2 * PAD - 2 * GAP - PORTS - other.offsetWidth;
    const bar = (name, words, box, way, least, most, more) => divider(words, {
      get: () => box[way], set: (size) => this.resize(name, size), least, most, across: way === 'offsetWidth', ...more,
    });
    this.bars = [
      bar('world', 'Width of the world', world, 'offsetWidth', 300, () => wide(this.side)),
      bar('side', 'Width of brick and log', this.side, 'offsetWidth', 280, () => wide(world), { sign: -1 }),
      bar('row', 'Height of the charts', world, 'offsetHeight', 200, () => main.clientHeight - PAD - GAP - CHARTS),
      bar('brick', 'Height of the brick', brick, 'offsetHeight', 100, () => this.side.clientHeight - GAP - 150),
    ];
    ['world', 'side', 'row', 'brick'].forEach((name, i) => this.bars[i].classList.add('between', `of-${name}`));
    main.append(...this.bars.slice(0, 3));
    brick.after(this.bars[3]);
  }

  /** The button that folds a panel. */
  fold(name) {
    const card = this.cards[name];
    const button = el('button', { class: 'tool fold', 'aria-label': `${NAMES[name]}: folded or open` }, icon('fold'));
    const show = () => {
      const on = this.folded.has(name);
      toggle(card, 'folded', on);
      toggle($('main'), `no-${name}`, on);
      attribute(button, 'aria-expanded', String(!on));
      button.title = on ? 'Open' : 'Fold';
    };
    button.addEventListener('click', () => {
      if (!this.folded.delete(name)) this.folded.add(name);
      show();
      this.keep();
      button.focus();
    });
    card.querySelector('header').append(button);
    show();
  }

  resize(name, size) {
    if (size === null) delete this.sizes[name];
    else this.sizes[name] = size;
    this.keep();
  }

  keep() {
    keep(KEPT, { sizes: this.sizes, folded: [...this.folded] });
    this.changed();
  }

  /** Lays out the grid: as hands have made it, as far as there is room, else with these sizes. */
  fit(world, row) {
    const { sizes, folded } = this;
    const { style } = document.documentElement;
    const { clientWidth, clientHeight } = $('main');
    const pixels = (least, size, most) => `${Math.round(within(least, size, most))}px`;
    const set = (name, value) => (value ? style.setProperty(name, value) : style.removeProperty(name));
    const room = clientWidth - 2 * PAD - 2 * GAP - PORTS;
    const side = sizes.side && within(280, sizes.side, room - 300);
    const sideless = folded.has('brick') && folded.has('log');
    set('--side', sideless ? '48px' : side ? `${side}px` : folded.has('ports') && `${SIDE}px`);
    set('--world', folded.has('ports') ? 'minmax(0, 1fr)' : folded.has('world') && !sizes.world ? 'minmax(0, 2fr)' : pixels(300, sizes.world ?? world, room - (sideless ? 48 : side ?? SIDE)));
    set('--ports', folded.has('ports') && '48px');
    set('--row', folded.has('world') ? 'auto' : folded.has('charts') ? '1fr' : pixels(200, sizes.row ?? row, clientHeight - PAD - GAP - CHARTS));
    set('--charts', folded.has('charts') && !folded.has('world') && 'auto');
    set('--brick', sizes.brick && pixels(100, sizes.brick, clientHeight - PAD - GAP - 150));
    for (const bar of this.bars) bar.tell();
  }
}
