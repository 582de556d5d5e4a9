// The world from above. Centimeters, y up, heading 0 along y and clockwise. What it shows is
// in picture.js, which part of it in camera.js; here are the frames, and the hands.

import { along } from './canvas.js';
import { $, attribute, el, notice, num, pressed, text, toggle } from './dom.js';
import { Picture, between } from './picture.js';
import { KINDS, LIGHT, TURN, cm, isThing, outside } from './things.js';

export const LAYERS = [
  ['floor', 'Centimeter grid'], ['trail', 'Trail'], ['believed', 'Believed pose'],
  ['sensors', 'What sensors see'], ['path', 'Planned path'], ['map', 'Maps'], ['particles', 'Where it may be'],
];
const GRAB = 14;

/** How long the program may take to answer that it has put the robot somewhere, in ms. */
const ANSWERED_WITHIN = 10000;

export class World extends Picture {
  constructor(send) {
    super();
    this.send = send;
    this.canvas = $('world');
    this.context = this.canvas.getContext('2d');
    this.camera = { x: 0, y: 0, scale: 2, own: false };
    this.shown = Object.fromEntries(LAYERS.map(([name]) => [name, true]));
    this.tool = 'move';
    this.following = false;
    this.measured = null;
    this.pushable = false; // whether robots push a box that is added
    this.drag = null;
    this.lifted = null;
    this.selected = null;
    this.pointers = new Map();
    this.trail = { age: -1 };
    this.motion = null;
    this.model = null;
    /** Something is not drawn yet. */
    this.stale = false;
    this.drawings = 0;
    /** An editor, while it has the world. */
    this.editing = null;
    this.colors();
    this.calm = matchMedia('(prefers-reduced-motion: reduce)');
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.colors();
      this.draw();
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.listen();
  }

  // ---------------- the frame

  /** True and believed pose, those that there are. */
  poses() {
    const robot = this.model?.frame?.robot;
    return [robot?.true, robot?.believed?.pose].filter(Boolean);
  }

  take(model, came, interval) {
    this.keepPut(model.frame);
    const first = this.model === null || came.has('world');
    const before = first ? null : this.still();
    this.model = model;
    if (came.has('world')) {
      // What is selected is so still, unless it is another world.
      const id = model.frame.new ? null : this.selected?.id;
      if (this.selected !== 'robot' || model.frame.new) this.selected = model.world?.items.find((item) => item.id === id) ?? null;
      // A box that moves leaves what is being measured; another world does not.
      if (model.frame.new) this.measured = null;
      if (!this.camera.own || model.frame.new) this.fit();
    } else if (!this.camera.own && !model.world?.bounds && !model.frame.calm) this.fit();
    this.motion = this.blend(before, interval);
    this.stale ||= !model.frame.calm || (this.fades && !model.frame.clock.stands);
    if (model.frame.calm) return;
    this.legend();
    if ((this.selected || came.has('world')) && !this.drag) this.told();
    this.describe();
  }

  /** Another moment, at once. */
  show(model) {
    this.model = model;
    this.motion = this.now = null;
    if (!model.simulated) {
      this.selected = null;
      if (['robot', 'item', 'box'].includes(this.drag?.kind)) this.drag = null;
    }
    this.told();
    this.legend();
    this.describe();
    this.draw();
  }

  /** What is drawn now, so that the next frame can begin there. */
  still() {
    const { frame } = this.model ?? {};
    if (!frame?.robot) return null;
    const things = this.now?.things ?? placesOf(frame);
    return { true: this.now?.true ?? frame.robot.true, pose: this.now?.pose ?? frame.robot.believed?.pose, see: frame.see, things };
  }

  /** A short motion to the new frame, if it is one: not after a jump. */
  blend(before, interval) {
    const { robot: after } = this.model.frame;
    const moved = (a, b) => a && b && Math.hypot(a[0] - b[0], a[1] - b[1]) + Math.abs(a[2] - b[2]) / 10;
    const way = before && after && Math.max(moved(before.true, after.true) ?? moved(before.pose, after.believed?.pose) ?? 0, ...[...placesOf(this.model.frame)].map(([id, at]) => moved(before.things.get(id), at) ?? 0));
    this.now = null;
    if (!way || way < 0.02 || way > 15 || this.drag?.kind === 'robot' || this.calm.matches) return null;
    return { before, start: performance.now(), length: Math.min(120, interval) };
  }

  /** One picture, if another one is to be seen; answers whether there is more of the motion to come. */
  animate(time) {
    if (!this.stale) return false;
    if (this.motion) {
      const share = Math.min(1, (time - this.motion.start) / this.motion.length);
      const { before } = this.motion;
      const robot = this.model.frame.robot;
      this.now = {
        true: robot.true && before.true ? between(before.true, robot.true, share) : robot.true,
        pose: robot.believed && before.pose ? between(before.pose, robot.believed.pose, share) : robot.believed?.pose,
        share, before,
        things: new Map([...placesOf(this.model.frame)].map(([id, at]) => [id, between(before.things.get(id) ?? at, at, share)])),
      };
      if (share >= 1) {
        this.motion = null;
        this.now = null;
      }
    }
    this.draw();
    this.stale = this.motion !== null;
    return this.stale;
  }

  describe() {
    const { frame, world } = this.model;
    const parts = this.model.until === undefined ? [] : [`As it was at ${num(this.model.time, 2)} s.`];
    if (world) {
      const things = this.solids(world.items);
      const size = world.bounds ? `, ${num(world.bounds[2] - world.bounds[0])} by ${num(world.bounds[3] - world.bounds[1])} cm` : '';
      parts.push(`${this.model.name ? `World ${this.model.name}` : 'A world'}${size}, ${things} obstacle${things === 1 ? '' : 's'}.`);
    }
    const said = (pose) => `x ${num(pose[0])}, y ${num(pose[1])}, heading ${num(pose[2])}`;
    const { true: truly, believed } = frame.robot ?? {};
    if (truly) parts.push(`The robot is at ${said(truly)}.`);
    if (believed) parts.push(`It believes that it is at ${said(believed.pose)}.`);
    if (frame.robot?.hits) parts.push(`It ran into something ${frame.robot.hits === 1 ? 'once' : `${frame.robot.hits} times`}.`);
    for (const { traits, kind, x, y, held } of (world?.items ?? []).filter(isThing).slice(0, 8)) parts.push(`${traits.name ?? `A ${kind}`} is at x ${num(x)}, y ${num(y)}${held ? ', held by the gripper' : ''}.`);
    for (const seen of frame.see ?? []) {
      if (seen.kind === 'cone') parts.push(seen.hit ? `${seen.port} sees something.` : `${seen.port} sees nothing.`);
    }
    this.words = parts.join(' ') || 'No robot is known.';
    attribute(this.canvas, 'aria-label', this.words);
  }

  solids(items) {
    if (this.counted?.items !== items) this.counted = { items, count: items.filter((item) => KINDS[item.kind].solid).length };
    return this.counted.count;
  }

  /** What lies over the world goes to its other end where it hides the robot. */
  drawn(robot) {
    const pose = this.drag?.kind === 'robot' ? this.drag.at : robot.true ?? robot.pose;
    if (!pose) return;
    const [x, y] = this.pixel(pose);
    const far = Math.max(13, this.reach() * this.camera.scale) + 6;
    const hides = ({ offsetLeft: left, offsetTop: top, offsetWidth: width, offsetHeight: height }) => x > left - far && x < left + width + far && y > top - far && y < top + height + far;
    for (const box of [$('inspector'), $('pad')]) {
      if (box.hidden || !hides(box)) continue;
      box.classList.toggle('high');
      if (hides(box)) box.classList.toggle('high');
    }
  }

  // ---------------- hands

  listen() {
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.up(event));
    canvas.addEventListener('pointercancel', (event) => this.up(event, true));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      if (this.width) this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0016)), [event.offsetX, event.offsetY]);
    }, { passive: false });
    canvas.addEventListener('dblclick', () => { if (this.tool === 'move' && !this.editing) this.unfollow(() => this.fit()); });
  }

  unfollow(act) {
    this.following = false;
    act();
    this.changed?.();
    this.draw();
  }

  /** What is at a place: the turning handle, the robot, another one, a thing, nothing. */
  at(place) {
    const { frame, world } = this.model ?? {};
    if (!this.model?.simulated) return null;
    const near = (point, reach) => point && Math.hypot(place[0] - point[0], place[1] - point[1]) <= reach;
    if (this.selected === 'robot' && near(this.handle(), GRAB * this.dot)) return { kind: 'turn' };
    if (near(frame.robot?.true, Math.max(this.reach(), GRAB * this.dot))) return { kind: 'robot' };
    const other = frame.others?.find((each) => this.covers(each, place));
    if (other) return { kind: 'other', name: other.name };
    const item = [...(world?.items ?? [])].reverse().find((each) => each.x !== undefined && this.covers(each, place));
    return item ? { kind: 'item', item } : null;
  }

  /** Whether a thing is at a place; what is thin is so within a reach. */
  covers(item, [x, y], reach = 0) {
    const context = flat();
    const { lay, closed } = KINDS[item.kind];
    if (!lay) {
      context.lineWidth = 2 * reach;
      const path = this.shape(item);
      return context.isPointInPath(path, x, y) || (reach > 0 && context.isPointInStroke(path, x, y));
    }
    const path = new Path2D();
    along(path, item.points);
    context.lineWidth = Math.max(item.width ?? 0, 2 * reach);
    return closed ? context.isPointInPath(path, x, y) : context.isPointInStroke(path, x, y);
  }

  down(event) {
    if (!this.model?.frame || event.button > 0) return;
    const pixel = [event.offsetX, event.offsetY];
    const place = this.place(pixel);
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, pixel);
    if (this.pointers.size === 2) {
      this.drag = { kind: 'pinch', apart: this.spread() };
      return;
    }
    this.moved = false;
    this.start = pixel;
    if (this.tool === 'measure') {
      this.measured = this.measured && !this.measured[1] ? [this.measured[0], place] : [place, null];
      this.told();
    } else if (this.editing?.down(place)) {
      this.drag = { kind: 'edit' };
    } else if (this.tool === 'add-box' && this.model.simulated) {
      this.drag = { kind: 'box', from: place, to: place };
    } else {
      const found = this.at(place);
      if (found?.kind === 'robot' || found?.kind === 'turn') {
        const pose = this.model.frame.robot.true;
        this.drag = { kind: 'robot', turn: found.kind === 'turn', at: [...pose], off: [pose[0] - place[0], pose[1] - place[1]] };
        this.select('robot');
      } else if (found?.kind === 'other') {
        this.drag = { kind: 'pan', place, name: found.name };
      } else if (found) {
        const { item } = found;
        this.drag = { kind: 'item', item, at: { x: item.x, y: item.y }, off: [item.x - place[0], item.y - place[1]] };
        this.select(item);
      } else {
        this.drag = { kind: 'pan', place };
        this.select(null);
      }
    }
    this.draw();
  }

  spread() {
    const [a, b] = [...this.pointers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  }

  move(event) {
    if (!this.model?.frame) return;
    const pixel = [event.offsetX, event.offsetY];
    const place = this.place(pixel);
    this.pointer = place;
    const { drag } = this;
    if (this.pointers.has(event.pointerId)) this.pointers.set(event.pointerId, pixel);
    if (!drag) {
      if (this.tool === 'move') {
        const kind = this.at(place)?.kind;
        toggle(this.canvas, 'over-robot', kind === 'robot' || kind === 'turn');
        toggle(this.canvas, 'over-box', kind === 'item');
        toggle(this.canvas, 'over-other', kind === 'other');
      }
      if (this.measured && !this.measured[1]) this.draw();
      this.editing?.move(place);
      return;
    }
    if (this.start && Math.hypot(pixel[0] - this.start[0], pixel[1] - this.start[1]) > 3) this.moved = true;
    if (drag.kind === 'pinch') {
      if (this.pointers.size < 2) return;
      const apart = this.spread();
      const all = [...this.pointers.values()];
      this.zoom(apart / drag.apart, [(all[0][0] + all[1][0]) / 2, (all[0][1] + all[1][1]) / 2]);
      drag.apart = apart;
      return;
    }
    if (!this.moved) return;
    if (drag.kind === 'pan') {
      this.following = false;
      toggle(this.canvas, 'grabbing', true);
      this.camera.x += drag.place[0] - place[0];
      this.camera.y += drag.place[1] - place[1];
      this.camera.own = true;
      this.changed?.();
    } else if (drag.kind === 'edit') {
      this.editing?.move(place);
      return;
    } else if (drag.kind === 'box') drag.to = place;
    else if (drag.turn) drag.at[2] = Math.round(Math.atan2(place[0] - drag.at[0], place[1] - drag.at[1]) / TURN);
    else if (drag.kind === 'robot') [drag.at[0], drag.at[1]] = [place[0] + drag.off[0], place[1] + drag.off[1]];
    else drag.at = { x: place[0] + drag.off[0], y: place[1] + drag.off[1] };
    this.told();
    this.draw();
  }

  up(event, canceled = false) {
    this.pointers.delete(event.pointerId);
    const { drag } = this;
    if (drag?.kind === 'pinch' && this.pointers.size) return;
    this.drag = null;
    toggle(this.canvas, 'grabbing', false);
    if (drag?.kind === 'edit') return this.editing?.up(canceled);
    if (!drag || canceled) return this.draw();
    if (drag.kind === 'pan' && !this.moved) {
      this.beside?.();
      // A click on another robot chooses its brick.
      if (drag.name !== undefined) this.send(`brick ${drag.name}`);
    }
    if (drag.kind === 'box') {
      const size = (a, b) => Math.abs(a - b);
      const [w, d] = this.moved ? [size(drag.from[0], drag.to[0]), size(drag.from[1], drag.to[1])] : [20, 20];
      const at = this.moved ? [(drag.from[0] + drag.to[0]) / 2, (drag.from[1] + drag.to[1]) / 2] : drag.from;
      const why = outside({ kind: 'box', x: cm(at[0]), y: cm(at[1]) }, this.model.world ?? {});
      if (why) notice(why, { seconds: 6 });
      else if (w >= 0.5 && d >= 0.5) this.send(`add box ${cm(at[0])} ${cm(at[1])} ${cm(w)} ${cm(d)}${this.pushable ? ` 0 mass ${LIGHT}` : ''}`);
      this.use('move');
    } else if (drag.kind === 'robot' && this.moved) {
      this.put(drag.at, 'robot');
    } else if (drag.kind === 'item' && this.moved) {
      this.put([drag.at.x, drag.at.y, drag.item.h ?? 0], drag.item);
    }
    this.told();
    this.draw();
  }

  /** Moves and turns what is selected; answers whether something is. */
  shift(right, up, by = 0) {
    const { selected } = this;
    const [x, y, h] = selected === 'robot' ? this.model.frame.robot?.true ?? [] : [selected?.x, selected?.y, selected?.h ?? 0];
    if (x !== undefined) this.put([x + right, y + up, by ? Math.round(h) + by : h], selected);
    return x !== undefined;
  }

  /** The next one of the robot and the things that can be moved is selected. */
  selectNext() {
    const all = ['robot', ...(this.model?.world?.items ?? []).filter(({ x }) => x !== undefined)];
    if (this.model?.simulated) this.select(all[(all.indexOf(this.selected) + 1) % all.length]);
    this.draw();
  }

  /** Puts the robot or a thing at a pose. */
  put(pose, what) {
    if (what !== 'robot') {
      [what.x, what.y, what.h] = pose;
      this.send(`move ${what.id} ${pose.map(cm).join(' ')}`);
      this.told();
      this.draw();
      return;
    }
    if (!this.send(`place ${pose.map(cm).join(' ')}`)) return;
    this.lifted = { pose, answers: (this.lifted?.answers ?? 0) + 1, since: performance.now() };
    this.keepPut(this.model.frame);
  }

  /** The robot is shown where it was put: a frame of before may still come. */
  keepPut(frame) {
    if (frame.new || performance.now() - this.lifted?.since > ANSWERED_WITHIN) this.lifted = null;
    if (this.lifted && frame.robot?.true) frame.robot.true = this.lifted.pose;
  }

  /** The program has put the robot there, or has said why not: the next frame is of after. */
  answered() {
    if (!this.lifted) return;
    this.lifted.answers -= 1;
    if (this.lifted.answers === 0) this.lifted = null;
  }

  select(what) {
    this.selected = what;
    this.told();
  }

  use(tool) {
    this.tool = this.tool === tool ? 'move' : tool;
    this.measured = null;
    toggle(this.canvas, 'measuring', this.tool === 'measure');
    toggle(this.canvas, 'adding', this.tool === 'add-box');
    this.select(null);
    this.changed?.();
    this.draw();
  }

  /** The line that says what is selected, and what can be done to it. */
  told() {
    const box = $('inspector');
    const { selected, drag } = this;
    let words = '';
    const actions = [];
    const action = (...all) => actions.push(all); // name, title, onclick, whether it is on
    const turns = () => {
      action('−15°', 'Turn left by 15 degrees', () => this.shift(0, 0, -15));
      action('+15°', 'Turn right by 15 degrees', () => this.shift(0, 0, 15));
    };
    if (this.tool === 'add-box') {
      words = this.pushable ? 'Draw a box that robots push' : 'Draw a box';
      action('Moves', 'Robots push it', () => { this.pushable = !this.pushable; this.told(); }, this.pushable);
    }
    else if (this.tool === 'measure') {
      const [a, b] = this.measured ?? [];
      words = !a ? 'Click two places' : b ? `${num(Math.hypot(b[0] - a[0], b[1] - a[1]), 1)} cm, from ${num(a[0])}, ${num(a[1])} to ${num(b[0])}, ${num(b[1])}` : `From ${num(a[0])}, ${num(a[1])}`;
    } else if (selected === 'robot') {
      const pose = drag?.at ?? this.model.frame.robot?.true;
      if (pose) {
        words = `Robot at ${num(pose[0], 1)}, ${num(pose[1], 1)} cm, ${num(pose[2])}°`;
        turns();
      }
    } else if (selected) {
      const at = drag?.at ?? selected;
      const size = selected.kind === 'box' ? ` ${num(selected.w)} × ${num(selected.d)}` : selected.kind === 'circle' ? ` of radius ${num(selected.r)}` : '';
      words = `${selected.kind[0].toUpperCase()}${selected.kind.slice(1)}${size} at ${num(at.x)}, ${num(at.y)} cm`;
      if (KINDS[selected.kind].turn) turns();
      action('Remove', 'Remove it from the world', () => { this.send(`remove ${selected.id}`); this.select(null); });
    }
    box.hidden = !words;
    if (this.toldKey === words) return;
    this.toldKey = words;
    const kept = box.querySelector('p');
    const names = actions.map(([name]) => name).join();
    if (kept && this.toldActions === names) text(kept, words);
    else {
      this.toldActions = names;
      box.replaceChildren(el('p', {}, words), ...actions.map(([name, title, onclick]) => el('button', { class: 'tool text', title, onclick }, name)));
    }
    actions.forEach(([, , , on], i) => on === undefined || pressed(box.querySelectorAll('button')[i], on));
  }
}

/** Where the things of a frame are, by their numbers. */
const placesOf = ({ things = [] }) => new Map(things.map(({ id, pose }) => [id, pose]));

// Asks whether a point is in a path, in centimeters.
let flatContext = null;
function flat() {
  flatContext ??= document.createElement('canvas').getContext('2d');
  return flatContext;
}
