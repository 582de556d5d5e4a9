// Small helpers: elements, numbers, words for those who listen.

export const $ = (id) => document.getElementById(id);

/** An element with properties, attributes (`aria-`, `data-`, `role`, `for`)
    and children. */
export function el(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  if (tag === 'button') element.type = tag;
  for (const [name, value] of Object.entries(props)) {
    if (/^(aria-|data-|role$|for$)/.test(name)) element.setAttribute(name, value);
    else if (name === 'class') element.className = value;
    else element[name] = value;
  }
  element.append(...children);
  return element;
}

const SVG = 'http://www.w3.org/2000/svg';

export function icon(name) {
  const svg = document.createElementNS(SVG, 'svg');
  const use = document.createElementNS(SVG, 'use');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('viewBox', '0 0 20 20');
  svg.setAttribute('aria-hidden', 'true');
  use.setAttribute('href', `#i-${name}`);
  svg.append(use);
  return svg;
}

// A button of the page has an icon, and the words of its title without the key.
for (const button of document.querySelectorAll('[data-icon]')) {
  button.append(icon(button.dataset.icon));
  button.ariaLabel = button.title.replace(/ \(.*/, '');
}

/** Writes only what differs, so that nothing is laid out again in vain. */
export function text(element, value) {
  const node = element.firstChild;
  if (node && node === element.lastChild && node.nodeType === 3) {
    if (node.data !== value) node.data = value;
  } else element.textContent = value;
}

export function attribute(element, name, value) {
  if (value === null || value === false) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
}

export function toggle(element, name, on) {
  if (element.classList.contains(name) !== on) element.classList.toggle(name, on);
}

/** How many of the sorted things, each at a time, are not after a moment. */
export function upper(sorted, t, time = (each) => each) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time(sorted[middle]) <= t) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The number, or the bound that it exceeds. */
export const within = (least, n, most) => Math.max(least, Math.min(n, most));

/** Words as a sentence. */
export function sentence(words) {
  return words[0].toUpperCase() + words.slice(1) + (/[.!?]$/.test(words) ? '' : '.');
}

/** A moment for the whole page, in seconds of the run; null for what is now. */
export const goTo = (t) => document.dispatchEvent(new CustomEvent('ev3dev-time', { detail: { t } }));

export function pressed(button, on) {
  attribute(button, 'aria-pressed', on);
}

/** A number with a true minus sign; a dash if there is none. */
export function num(value, digits = 0) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const shown = value.toFixed(digits);
  return Number(shown) < 0 ? `−${shown.slice(1)}` : shown.replace(/^-/, '');
}

/** Three or four significant digits: for quantities of any size. */
export function brief(value) {
  const size = Math.abs(value);
  if (!Number.isFinite(value)) return '–';
  if (size >= 1e6 || (size > 0 && size < 1e-3)) return value.toExponential(2).replace('-', '−');
  return num(value, size >= 100 || Number.isInteger(value) ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

/** 1, 2 or 5 times a power of ten, at least `least`. */
export function nice(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  const part = least / power;
  return (part <= 1.0001 ? 1 : part <= 2.0001 ? 2 : part <= 5.0001 ? 5 : 10) * power;
}

/** Seconds as 59.02, 1:05.2 or 1:02:03. */
export function clock(seconds) {
  if (seconds < 60) return seconds.toFixed(2);
  const minutes = Math.floor(seconds / 60);
  const rest = seconds - 60 * minutes;
  if (minutes < 60) return `${minutes}:${(Math.floor(rest * 10) / 10).toFixed(1).padStart(4, '0')}`;
  const two = (n) => String(Math.floor(n)).padStart(2, '0');
  return `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${two(rest)}`;
}

/** A list that stays at its end, unless somebody has scrolled up from there, also if it was not
    displayed meanwhile. Answers what is called after rows were added; with `true` it goes there
    in any case. */
export function following(list) {
  let [atEnd, height] = [true, list.clientHeight];
  const follow = (goes = false) => {
    atEnd ||= goes;
    if (atEnd) list.scrollTop = list.scrollHeight;
  };
  // One that is displayed again, or has another size, is scrolled by Firefox itself.
  list.addEventListener('scroll', () => {
    if (list.clientHeight === height) atEnd = list.scrollTop + list.clientHeight >= list.scrollHeight - 24;
  });
  new ResizeObserver(() => {
    height = list.clientHeight;
    follow();
  }).observe(list);
  return follow;
}

let noticeEnds = 0;

/** A line over the page; it goes away by itself if `seconds` are given.
    `act` is the words of a button and what it does. */
export function notice(message, { bad = false, seconds = 0, act = null } = {}) {
  clearTimeout(noticeEnds);
  const box = $('notice');
  box.hidden = !message;
  toggle(box, 'bad', bad);
  text($('notice-text'), message || '');
  $('notice-act').hidden = !act;
  if (act) {
    text($('notice-act'), act[0]);
    $('notice-act').onclick = () => {
      notice('');
      act[1]();
    };
  }
  if (message && seconds) noticeEnds = setTimeout(() => notice(''), 1000 * seconds);
}

export function download(name, content, type) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  el('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
