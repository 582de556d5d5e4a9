// STOP, time, driving with the arrow keys, and the menus.

import { $, attribute, download, el, notice, pressed, sentence, toggle } from './dom.js';
import { Choices } from './choices.js';
import { LAYERS } from './world.js';

const PACES = [['x1', '×1'], ['x2', '×2'], ['x10', '×10'], ['max', 'max']];
const ARROWS = { ArrowUp: 'ahead', ArrowDown: 'back', ArrowLeft: 'left', ArrowRight: 'right' };
/** Keys that do the same as a button. */
const KEYS = {
  ' ': 'pause', '.': 'step', '+': 'zoom-in', '=': 'zoom-in', '-': 'zoom-out', 0: 'fit', f: 'follow', m: 'measure', b: 'add-box',
  r: 'reset', e: 'edit', p: 'program-open', t: 'reasoning-open', d: 'drive', h: 'chart-pause',
};
const OF_SIMULATION = new Set(['pause', 'step', 'add-box', 'reset']);
const JOG_SPEED = 30;
const JOG_AGAIN = 150;

export class Hands {
  constructor(wire, world, charts, log, ports) {
    Object.assign(this, { wire, world, charts, log, ports });
    this.held = new Set();
    this.choices = new Choices((line) => wire.send(line), this);
    this.paces = new Map(PACES.map(([pace, name]) => {
      const words = pace === 'max' ? 'As fast as possible' : `${name.slice(1)} times as fast as real`;
      return [pace, el('button', { onclick: () => wire.send(`pace ${pace}`), 'aria-pressed': 'false', title: words }, name)];
    }));
    $('speeds').append(...this.paces.values());
    // At once, and not when the finger is lifted; a click without a finger is a key's.
    $('stop').addEventListener('pointerdown', (event) => event.button === 0 && this.stop());
    $('stop').addEventListener('click', (event) => event.detail === 0 && this.stop());
    const acts = {
      reset: () => this.reset(), pause: () => this.pause(), step: () => wire.send('step'),
      'zoom-in': () => world.zoom(1.5), 'zoom-out': () => world.zoom(1 / 1.5), fit: () => world.unfollow(() => world.fit()),
      follow: () => this.follow(), measure: () => world.use('measure'), drive: () => this.drive(!this.driving),
      'add-box': () => world.use('add-box'), layers: () => this.menu('layers'), more: () => this.menu('more'),
    };
    for (const [name, act] of Object.entries(acts)) $(name).addEventListener('click', act);
    world.changed = () => this.tools();
    world.beside = () => this.drive(false);
    for (const button of $('pad').querySelectorAll('[data-jog]')) {
      const way = button.dataset.jog;
      button.addEventListener('pointerdown', (event) => {
        button.setPointerCapture(event.pointerId);
        this.jog(way, true);
      });
      for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) button.addEventListener(end, () => this.jog(way, false));
      button.addEventListener('keydown', (event) => { if (event.key === 'Enter' || event.key === ' ') { this.jog(way, true); event.preventDefault(); } });
      button.addEventListener('keyup', () => this.jog(way, false));
    }
    document.addEventListener('keydown', (event) => this.key(event));
    document.addEventListener('keyup', (event) => { if (ARROWS[event.key]) this.jog(ARROWS[event.key], false); });
    addEventListener('blur', () => this.letGo());
    document.addEventListener('pointerdown', (event) => {
      if (!event.target.closest('.menu, [aria-expanded=true]')) this.close();
      if (!event.target.closest('.world-card, .top')) this.putAway();
    });
    this.tools();
  }

  stop() {
    this.letGo();
    this.wire.stop();
    toggle($('stop'), 'pressed', true);
    setTimeout(() => toggle($('stop'), 'pressed', false), 160);
  }

  take(model) {
    this.model = model;
    this.choices.take(model);
    const { clock } = model.frame;
    const { simulated } = model;
    this.latch(model.frame.program?.latched === true);
    $('transport').hidden = !simulated;
    toggle(document.body, 'real', !simulated);
    toggle(document.body, 'nothing', model.frame.source === 'none');
    if (simulated && clock) {
      pressed($('pause'), clock.paused);
      const words = clock.paused ? 'Go on' : 'Pause';
      if ($('pause').title !== `${words} (space)`) {
        $('pause').title = `${words} (space)`;
        attribute($('pause').querySelector('use'), 'href', clock.paused ? '#i-play' : '#i-pause');
      }
      // Where the wall's clock counts, nothing is faster than x10.
      this.paces.get('max').hidden = clock.kind !== 'virtual' && clock.pace !== 'max';
      for (const [pace, button] of this.paces) pressed(button, clock.pace === pace);
    }
  }

  /** After STOP motors stay locked until the program has ended. */
  latch(on) {
    if (!on) {
      if (this.told) notice('');
      this.latched = this.told = false;
      return;
    }
    this.latched ||= performance.now();
    if (this.told || performance.now() - this.latched < 1500) return;
    this.told = true;
    notice('The motors stay locked until the program ends.', { act: ['Unlock', () => this.wire.send('go')] });
  }

  pause() {
    this.wire.send(this.model?.frame.clock?.paused ? 'resume' : 'pause');
  }

  /** Robot, things and time as at the start of the world; a program that runs is stopped. */
  reset() {
    this.letGo();
    this.ended = this.model?.frame.program?.state === 'running';
    this.wire.send('reset');
  }

  follow() {
    this.world.follow(!this.world.following);
    this.tools();
  }

  tools() {
    pressed($('follow'), this.world.following);
    pressed($('measure'), this.world.tool === 'measure');
    pressed($('add-box'), this.world.tool === 'add-box');
    pressed($('drive'), this.driving === true);
    this.world.told();
  }

  // ---------------- driving

  drive(on) {
    this.driving = on;
    $('pad').hidden = !on;
    if (!on) this.letGo();
    this.tools();
    // The pad goes where it hides no robot, before somebody clicks.
    this.world.draw();
  }

  jog(way, on) {
    if (!this.driving || this.held.has(way) === on) return;
    if (on) this.held.add(way);
    else this.held.delete(way);
    $('pad').querySelector(`[data-jog=${way}]`).classList.toggle('on', on);
    clearInterval(this.again);
    this.wheels();
    if (this.held.size) this.again = setInterval(() => this.wheels(), JOG_AGAIN);
  }

  wheels() {
    const has = (way) => (this.held.has(way) ? 1 : 0);
    const along = has('ahead') - has('back');
    const turn = (has('right') - has('left')) * (along ? 0.4 : 0.6) * (along < 0 ? -1 : 1);
    const speed = (n) => Math.round(JOG_SPEED * Math.max(-1, Math.min(1, n)));
    this.wire.send(`jog ${speed(along + turn)} ${speed(along - turn)}`);
  }

  letGo() {
    if (!this.held.size) return;
    for (const way of [...this.held]) this.jog(way, false);
  }

  // ---------------- keys

  key(event) {
    if (event.key === 'Escape') {
      event.preventDefault();
      this.escape();
      return;
    }
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest('input, select, textarea')) return;
    if (ARROWS[event.key] && this.driving && !target.closest('.charts, .log')) {
      if (!event.repeat) this.jog(ARROWS[event.key], true);
      event.preventDefault();
      return;
    }
    if (target.id === 'world' && (ARROWS[event.key] || event.key === 'Enter')) {
      if (event.key === 'Enter') this.world.selectNext();
      else this.arrow(event.key, event.shiftKey ? 10 : 1);
      event.preventDefault();
      return;
    }
    if (event.repeat || (event.key === ' ' && target.closest('button'))) return;
    const { model } = this;
    const key = event.key.toLowerCase();
    const name = KEYS[key];
    if (name) {
      if (model?.simulated || !OF_SIMULATION.has(name)) $(name).click();
    } else if (key === 'delete' || key === 'backspace') this.remove();
    else return;
    event.preventDefault();
  }

  /** A menu that is open is closed; else all stops, unless there was just something to put away. */
  escape() {
    if (this.close()) return;
    const { program, ports } = this.model?.frame ?? {};
    const runs = program?.state === 'running' || ports?.some((port) => port.state?.includes('running'));
    const away = this.putAway();
    if (runs || !away) this.stop();
  }

  /** Nothing is selected or in hand any more; answers whether something was. */
  putAway() {
    const { world } = this;
    const was = this.driving || world.tool !== 'move' || world.selected !== null;
    if (this.driving) this.drive(false);
    if (world.tool !== 'move') world.use('move');
    if (world.selected !== null) world.select(null);
    return was;
  }

  remove() {
    const { selected } = this.world;
    if (!Number.isFinite(selected?.id)) return;
    this.wire.send(`remove ${selected.id}`);
    this.world.select(null);
  }

  /** What is selected goes by so many centimeters, else what is seen of the world. */
  arrow(key, way) {
    const { world } = this;
    const [right, up] = [{ ArrowLeft: -1, ArrowRight: 1 }[key] ?? 0, { ArrowUp: 1, ArrowDown: -1 }[key] ?? 0];
    if (world.shift(right * way, up * way)) return;
    const step = 60 / world.camera.scale;
    world.unfollow(() => {
      world.camera.own = true;
      world.camera.x += right * step;
      world.camera.y += up * step;
    });
  }

  // ---------------- menus

  menu(name) {
    const open = $(`${name}-menu`).hidden;
    this.close();
    if (!open) return;
    const menu = $(`${name}-menu`);
    menu.replaceChildren(...(name === 'layers' ? this.layers() : this.simulation()));
    menu.hidden = false;
    attribute($(name), 'aria-expanded', true);
    this.opened = name;
    menu.querySelector('button')?.focus();
  }

  /** Closes what is open; answers whether something was. */
  close() {
    const was = this.ports.close();
    if (!this.opened) return was;
    const menu = $(`${this.opened}-menu`);
    const inside = menu.contains(document.activeElement);
    menu.hidden = true;
    attribute($(this.opened), 'aria-expanded', false);
    if (inside) $(this.opened).focus();
    this.opened = null;
    return true;
  }

  layers() {
    const { world } = this;
    return LAYERS.map(([name, words]) => {
      const onclick = () => {
        world.shown[name] = !world.shown[name];
        attribute(button, 'aria-checked', world.shown[name]);
        world.legend();
        world.draw();
      };
      const button = el('button', { onclick, class: 'check', role: 'checkbox', 'aria-checked': world.shown[name] }, words);
      return button;
    });
  }

  simulation() {
    const onclick = (act) => () => {
      this.close();
      act();
    };
    const entry = (words, act) => el('button', { onclick: onclick(act) }, words);
    const taken = this.model?.snapshots ?? [];
    let n = 1;
    while (taken.includes(`snapshot-${n}`)) n += 1;
    // Without a robot one can only begin a simulation.
    if (!this.model?.simulated) return this.choices.entries();
    return [
      ...this.choices.entries(),
      entry('Take a snapshot', () => this.wire.send(`save snapshot-${n}`)),
      ...taken.map((name) => entry(`Go back to ${name}`, () => this.wire.send(`restore ${name}`))),
      entry('Save the world as facts', () => this.wire.send('facts')),
      entry('Save the log', () => this.log.save()),
    ];
  }

  /** What the program answered to a hand. */
  reply(message) {
    if (this.choices.reply(message)) return;
    const { type, what, why, id, text: facts } = message;
    if (what === 'place') this.world.answered();
    if (type === 'refused') notice(sentence(why ?? `It cannot ${what}.`), { seconds: 6 });
    else if (what === 'facts') download('world.pl', facts, 'text/plain');
    else if (what === 'reset') notice(`${this.ended ? 'The program was stopped. ' : ''}Everything is as at the start.`, { seconds: 3 });
    else if (what === 'save') notice('The snapshot is taken.', { seconds: 3 });
    if ((what === 'move' || what === 'remove') && type === 'done' && id === undefined) this.world.select(null);
  }
}
