// The brick: lights, screen, keys, battery.

import { $, attribute, el, num, text, toggle } from './dom.js';

const KEYS = ['back', 'up', 'left', 'enter', 'right', 'down'];

export class Brick {
  constructor(send) {
    this.send = send;
    this.canvas = el('canvas', { class: 'screen', width: 178, height: 128, role: 'img', 'aria-label': 'The screen' });
    this.lights = { left: el('i', { class: 'light left' }), right: el('i', { class: 'light right' }) };
    this.keys = Object.fromEntries(KEYS.map((key) => [key, this.key(key)]));
    this.words = el('p', { class: 'lights-text' });
    $('brick').append(this.canvas, el('div', { class: 'keys', role: 'group', 'aria-label': 'Keys' }, this.lights.left, ...Object.values(this.keys), this.lights.right), this.words);
    this.style = getComputedStyle(document.documentElement);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.screen(this.model?.screen));
    this.screen(null);
  }

  key(name) {
    const button = el('button', { 'data-key': name, title: `Key ${name}`, 'aria-label': `Key ${name}` });
    // A hand holds it for as long as it is there, at least 0.1 s.
    const hold = () => {
      if (button.disabled || this.held === name) return;
      this.held = name;
      this.since = performance.now();
      this.send(`press ${name}`);
    };
    const free = () => {
      if (this.held !== name) return;
      this.held = null;
      setTimeout(() => this.send(`release ${name}`), Math.max(0, 100 - (performance.now() - this.since)));
    };
    button.addEventListener('pointerdown', (event) => { if (event.button === 0) hold(); });
    for (const end of ['pointerup', 'pointerleave', 'pointercancel', 'blur']) button.addEventListener(end, free);
    button.addEventListener('keydown', (event) => { if (event.key === 'Enter') { hold(); event.preventDefault(); } });
    button.addEventListener('keyup', (event) => { if (event.key === 'Enter') free(); });
    return button;
  }

  take(model, came) {
    this.model = model;
    const { brick } = model.frame;
    if (came.has('screen')) this.screen(model.screen);
    const down = brick?.keys ?? [];
    for (const [name, button] of Object.entries(this.keys)) {
      toggle(button, 'down', down.includes(name));
      if (button.disabled !== !model.simulated) button.disabled = !model.simulated;
    }
    this.said = [];
    for (const side of ['left', 'right']) this.light(side, brick?.lights?.[side]);
    text(this.words, brick?.lights ? `Lights: ${this.said[0] === this.said[1] ? this.said[0] : `left ${this.said[0]}, right ${this.said[1]}`}${brick.tone ? `. Sounds at ${num(brick.tone)} Hz` : ''}` : 'The lights are not known.');
    text($('battery'), brick?.volts !== undefined && brick.volts !== null ? `${num(brick.volts, 1)} V${Number.isFinite(brick.amps) ? ` · ${num(brick.amps, 2)} A` : ''}` : '');
  }

  light(side, levels) {
    const [red, green] = levels ?? [0, 0];
    const on = red + green > 0;
    toggle(this.lights[side], 'on', on);
    if (on) this.lights[side].style.setProperty('--glow', mixed(red, green));
    this.said.push(!on ? 'off' : named(red, green));
  }

  screen(screen) {
    const context = this.canvas.getContext('2d');
    const { width, height } = this.canvas;
    const paper = rgb(this.style.getPropertyValue('--lcd'));
    const ink = rgb(this.style.getPropertyValue('--lcd-ink'));
    const known = screen && (screen.bits || screen.gray || screen.rgb);
    if (known && (screen.w !== width || screen.h !== height)) {
      this.canvas.width = screen.w;
      this.canvas.height = screen.h;
    }
    const image = context.createImageData(this.canvas.width, this.canvas.height);
    const { data } = image;
    const bytes = known ? Uint8Array.from(atob(known), (c) => c.charCodeAt(0)) : null;
    let black = 0;
    for (let i = 0; i < data.length / 4; i += 1) {
      // How dark: 0 to 1; or a color of its own.
      let dark = 0;
      if (screen?.bits) dark = (bytes[i >> 3] >> (7 - (i & 7))) & 1;
      else if (screen?.gray) dark = 1 - bytes[i] / 255;
      if (dark > 0.5) black += 1;
      for (let k = 0; k < 3; k += 1) {
        data[4 * i + k] = screen?.rgb ? bytes[3 * i + k] : paper[k] + (ink[k] - paper[k]) * dark;
      }
      data[4 * i + 3] = 255;
    }
    context.putImageData(image, 0, 0);
    this.black = black;
    attribute(this.canvas, 'aria-label', !known ? 'The screen is not known' : black ? `The screen, ${black} of its ${data.length / 4} pixels are black` : 'The screen is empty');
  }
}

function rgb(color) {
  const hex = color.trim();
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

function mixed(red, green) {
  const most = Math.max(red, green) / 255;
  const share = green / (red + green);
  // From red over orange and amber to green.
  const hue = share < 0.5 ? 4 + 84 * share : 46 + 180 * (share - 0.5);
  return `hsl(${Math.round(hue)} 90% ${Math.round(34 + 16 * most)}%)`;
}

function named(red, green) {
  if (!green) return 'red';
  if (!red) return 'green';
  const share = green / (red + green);
  return share < 0.4 ? 'orange' : share < 0.52 ? 'amber' : share < 0.8 ? 'yellow' : 'green';
}
