// Sizes that a hand sets, and what the browser keeps of them.

import { attribute, el } from './dom.js';

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
