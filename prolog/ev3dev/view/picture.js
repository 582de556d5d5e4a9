// The world on the canvas: floor, things, trails, what sensors see, robots, and what hands do.

import { Camera } from './camera.js';
import { along, disc, fill, stroke, trace } from './canvas.js';
import { $, el, nice, num, upper } from './dom.js';
import { KINDS, TURN, isThing } from './things.js';

/** Two dimensions: 95 % of all cases lie within this many standard deviations. */
const SIGMAS = 2.45;
/** The seconds of the trail that are drawn clearly. */
const CLEAR = 30;

const ahead = (h) => [Math.sin(h * TURN), Math.cos(h * TURN)];

/** A pose between two, for smooth motion. */
export function between(a, b, share) {
  return a.map((n, i) => n + (b[i] - n) * share);
}

export class Picture extends Camera {
  colors() {
    const style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue(`--${name}`).trim();
    this.dark = matchMedia('(prefers-color-scheme: dark)').matches;
    this.paint = Object.fromEntries(['robot', 'ground', 'outside', 'card', 'ink', 'soft', 'line', 'wall', 'block', 'block-edge',
      'beam', 'yellow', 'blue', 'red', 'violet', 'off'].map((name) => [name, color(name)]));
    this.font = style.getPropertyValue('--sans');
  }

  /** The floor's colors. White tape reflects 92 %, and looks white here. In
      the dark colors are dimmed, but stay apart. */
  tone(color) {
    const parts = [1, 3, 5].map((i) => Math.min(255, 1.085 * parseInt(color.slice(i, i + 2), 16)));
    if (!this.dark) return `rgb(${parts.map(Math.round).join(' ')})`;
    const light = 0.3 * parts[0] + 0.59 * parts[1] + 0.11 * parts[2];
    const dim = (c) => Math.round(Math.max(0, Math.min(255, 4 + 0.29 * light + 0.6 * (c - light))));
    return `rgb(${parts.map(dim).join(' ')})`;
  }

  legend() {
    const robot = this.model?.frame?.robot;
    const entries = [];
    if (robot?.true) entries.push(['true', 'robot']);
    if (robot?.believed && this.shown.believed) entries.push(['believed', robot.true ? 'believed' : 'robot, as it believes']);
    if (this.model?.path && this.shown.path) entries.push(['planned', 'planned']);
    if (this.model?.grid?.plan?.length && this.shown.map && !this.model.path) entries.push(['planned', 'planned']);
    const key = entries.join();
    if (key !== this.legendKey) {
      this.legendKey = key;
      $('legend').replaceChildren(...entries.map(([kind, words]) => el('span', { class: kind }, el('i'), words)));
    }
  }

  draw() {
    if (!this.model?.frame || !this.width) return;
    const { context: c, camera, ratio } = this;
    this.drawings += 1;
    const robot = this.now ?? { true: this.model.frame.robot?.true, pose: this.model.frame.robot?.believed?.pose };
    if (this.following && (robot.true || robot.pose)) [camera.x, camera.y] = robot.true ?? robot.pose;
    const s = camera.scale * ratio;
    this.dot = 1 / camera.scale;
    this.placed = [s, 0, 0, -s, (this.width / 2) * ratio - camera.x * s, (this.height / 2) * ratio + camera.y * s];
    const items = this.model.world?.items ?? [];
    const moving = items.filter((item) => this.moves(item));
    this.layer('floor', c, [this.shown.floor], (layer) => {
      layer.resetTransform();
      layer.fillStyle = this.paint.outside;
      layer.fillRect(0, 0, this.canvas.width, this.canvas.height);
      layer.setTransform(...this.placed);
      this.drawFloor(layer);
    });
    if (this.shown.map && this.model.map) this.drawRaster(c, this.model.map, this.paint.ink);
    if (this.shown.particles && this.model.belief) this.drawRaster(c, this.model.belief, this.paint.red);
    if (this.shown.map && this.model.grid) this.drawGrid(c, this.model.grid);
    if (this.shown.sensors) this.drawSeen(c, false);
    if (items.length) this.layer('items', c, moving, (layer) => this.drawItems(layer, items.filter((item) => !moving.includes(item))));
    this.drawItems(c, [...moving, ...this.model.frame.others ?? []]);
    if (this.shown.trail) this.drawTrails(c, robot);
    if (this.shown.path && this.model.path) this.drawPath(c, this.model.path);
    if (this.shown.sensors) this.drawSeen(c, true);
    if (this.shown.particles && this.model.localized) this.drawLocalized(c, this.model.localized);
    this.drawRobots(c, robot);
    this.thoughts?.paint(c, this);
    this.drawHands(c);
    this.drawn(robot);
  }

  /** What stands is drawn once, in a canvas of its own: again only if the world, the view of it or
      something in `keys` is another one. */
  layer(name, c, keys, draw) {
    const { width, height } = this.canvas;
    const layer = (this.layers ??= {})[name] ??= { context: document.createElement('canvas').getContext('2d'), keys: [] };
    const now = [this.model.world, this.paint, width, height, ...this.placed, ...keys];
    if (now.length !== layer.keys.length || now.some((key, i) => key !== layer.keys[i])) {
      layer.keys = now;
      layer.drawn = (layer.drawn ?? 0) + 1;
      Object.assign(layer.context.canvas, { width, height });
      Object.assign(layer.context, { lineJoin: 'round', lineCap: 'round' });
      layer.context.setTransform(...this.placed);
      draw(layer.context);
    }
    c.resetTransform();
    c.drawImage(layer.context.canvas, 0, 0);
    c.setTransform(...this.placed);
    c.lineJoin = c.lineCap = 'round';
  }

  /** A thing that does not stand: it has a mass, is held, chosen, or has a port. */
  moves(item) {
    return isThing(item) || item.port !== undefined || item.id === this.selected?.id || (this.drag?.kind === 'item' && this.drag.item.id === item.id);
  }

  drawFloor(c) {
    const { world } = this.model;
    const { dot, camera } = this;
    const [left, top] = this.place([0, 0]);
    const [right, bottom] = this.place([this.width, this.height]);
    const bounds = world ? world.bounds ?? [left, bottom, right, top] : [left, bottom, right, top];
    c.fillStyle = world ? this.tone(world.floor ?? '#ffffff') : this.paint.card;
    c.fillRect(bounds[0], bounds[1], bounds[2] - bounds[0], bounds[3] - bounds[1]);
    if (this.shown.floor) {
      const step = nice(34 / camera.scale);
      c.beginPath();
      const [x1, y1, x2, y2] = [Math.max(left, bounds[0]), Math.max(bottom, bounds[1]), Math.min(right, bounds[2]), Math.min(top, bounds[3])];
      for (let x = Math.ceil(x1 / step) * step; x < x2; x += step) { c.moveTo(x, y1); c.lineTo(x, y2); }
      for (let y = Math.ceil(y1 / step) * step; y < y2; y += step) { c.moveTo(x1, y); c.lineTo(x2, y); }
      stroke(c, this.dark ? 'rgb(255 255 255 / .045)' : 'rgb(20 20 10 / .055)', dot);
    }
    for (const item of world?.items ?? []) KINDS[item.kind].lay?.(c, item, this);
    if (world?.bounds) {
      const thick = Math.max(1, 3 * dot);
      c.strokeStyle = this.paint.wall;
      c.lineJoin = 'miter';
      c.lineWidth = thick;
      c.strokeRect(bounds[0] - thick / 2, bounds[1] - thick / 2, bounds[2] - bounds[0] + thick, bounds[3] - bounds[1] + thick);
      c.lineJoin = 'round';
    }
  }

  /** The path of an item, for drawing and for finding what is pointed at. */
  shape(item, at = item) {
    const path = new Path2D();
    const kind = KINDS[item.kind];
    if (kind.path) kind.path(path, item, at, this.dot);
    else path.arc(at.x, at.y, Math.max(4, 10 * this.dot), 0, 7);
    return path;
  }

  /** Things of one color are one path, with one shadow. */
  drawItems(c, items) {
    const paths = new Map();
    for (const item of items) {
      const { solid, paint } = KINDS[item.kind];
      const [x, y, h] = this.now?.things.get(item.id) ?? [item.x, item.y, item.h];
      const at = this.drag?.kind === 'item' && this.drag.item.id === item.id ? this.drag.at : { x, y, h };
      paint?.(c, item, at, this);
      if (!solid) continue;
      const edge = this.selected?.id === item.id || item.held ? 'ink' : 'block-edge';
      const key = `${item.name ? 'robot' : item.traits?.color ?? solid} ${edge}`;
      if (!paths.has(key)) paths.set(key, new Path2D());
      paths.get(key).addPath(this.shape(item, at));
    }
    for (const [key, path] of paths) {
      const [name, edge] = key.split(' ');
      c.save();
      c.shadowColor = this.dark ? 'rgb(0 0 0 / .45)' : 'rgb(50 44 20 / .22)';
      c.shadowBlur = 7 * this.ratio;
      c.shadowOffsetY = 2.5 * this.ratio;
      fill(c, name[0] === '#' ? this.tone(name) : this.paint[name], path);
      c.restore();
      if (name === 'wall') continue;
      stroke(c, this.paint[edge], (edge === 'ink' ? 2 : 1) * this.dot, path);
    }
    for (const item of items) {
      if (item.name) this.label(c, item.name, item.x, item.y + (item.r ?? Math.hypot(item.w, item.d) / 2) + 9 * this.dot, this.paint.ink, 600, this.paint.card);
    }
  }

  label(c, words, x, y, color = this.paint.soft, weight = 500, halo = null, size = 11) {
    c.save();
    c.translate(x, y);
    c.scale(this.dot, -this.dot);
    c.font = `${weight} ${size}px ${this.font}`;
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    if (halo) {
      c.strokeStyle = halo;
      c.lineWidth = 3;
      c.strokeText(words, 0, 0);
    }
    c.fillStyle = color;
    c.fillText(words, 0, 0);
    c.restore();
  }

  /** The whole way faintly, the last of it clearly. */
  drawTrails(c, robot) {
    const { samples, age, thinned, until } = this.model;
    const end = until ?? samples.time.length;
    if (this.trail.age !== age || this.trail.thinned !== thinned) {
      this.trail = { age, thinned, true: { path: new Path2D(), from: 0 }, believed: { path: new Path2D(), from: 0 } };
    }
    this.fades = false;
    const lines = [['true', 'x', 'y', robot.true, this.dark ? '#dcb400' : '#9a7400', 1.8, []]];
    if (this.shown.believed) lines.push(['believed', 'bx', 'by', robot.pose, this.paint.blue, 1.4, [1, 4]]);
    for (const [name, xs, ys, here, color, width, dash] of lines) {
      // The way up to a moment of the past is not kept.
      const line = until === undefined ? this.trail[name] : { path: new Path2D(), from: 0 };
      const [x, y] = [samples.columns.get(xs), samples.columns.get(ys)];
      if (!x || !y) continue;
      for (; line.from < end; line.from += 1) this.extend(line, line.path, x, y, line.from);
      c.strokeStyle = color;
      c.lineWidth = width * this.dot;
      c.globalAlpha = 0.3;
      c.stroke(line.path);
      c.globalAlpha = 1;
      const recent = { last: null };
      const path = new Path2D();
      for (let i = upper(samples.time, this.model.time - CLEAR); i < end; i += 1) this.extend(recent, path, x, y, i);
      this.fades ||= recent.grows;
      if (here && recent.last && Math.hypot(here[0] - recent.last[0], here[1] - recent.last[1]) < 12) path.lineTo(here[0], here[1]);
      c.setLineDash(dash.map((n) => n * this.dot));
      c.stroke(path);
      c.setLineDash([]);
    }
  }

  /** A sample more; no line is drawn where somebody lifted the robot. */
  extend(line, path, x, y, i) {
    if (x[i] === null || y[i] === null) {
      line.last = null;
      return;
    }
    const time = this.model.samples.time[i];
    const way = line.last && Math.hypot(x[i] - line.last[0], y[i] - line.last[1]);
    if (!line.last || way > 6 + 90 * (time - line.last[2])) path.moveTo(x[i], y[i]);
    else if (way > 0.05) {
      path.lineTo(x[i], y[i]);
      line.grows = true;
    } else {
      // It stood until now, and then it is lifted.
      line.last[2] = time;
      return;
    }
    line.last = [x[i], y[i], time];
  }

  drawPath(c, points) {
    if (points.length < 2) return;
    const { dot } = this;
    c.beginPath();
    points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
    stroke(c, this.paint.violet, 2 * dot, null, [7 * dot, 5 * dot]);
    const [x, y] = points.at(-1);
    disc(c, x, y, 5 * dot);
    fill(c, this.paint.card);
    c.stroke();
    disc(c, x, y, 2 * dot);
    fill(c, this.paint.violet);
  }

  /** Cells with a probability each: a belief on a grid, or a map that the robot makes. */
  drawRaster(c, { cell, origin, h, cells }, color) {
    c.save();
    c.translate(...origin);
    c.rotate(-h * TURN);
    c.fillStyle = color;
    for (const [column, row, probability] of cells) {
      c.globalAlpha = 0.04 + 0.6 * probability;
      c.fillRect(column * cell, row * cell, cell, cell);
    }
    c.restore();
  }

  /** Particles, as short strokes ahead, and the clusters of them that are worth a number. */
  drawLocalized(c, { particles, clusters }) {
    const length = 7 * this.dot;
    c.beginPath();
    for (const [x, y, h] of particles) {
      const [dx, dy] = ahead(h);
      c.moveTo(x, y);
      c.lineTo(x + dx * length, y + dy * length);
    }
    c.strokeStyle = this.paint.red;
    c.globalAlpha = 0.55;
    c.lineWidth = 1.3 * this.dot;
    c.stroke();
    c.globalAlpha = 1;
    for (const { weight, pose, ellipse } of clusters) {
      if (weight < 0.02) continue;
      this.drawEllipse(c, pose, ellipse, this.paint.red);
      this.label(c, `${Math.round(100 * weight)} %`, pose[0], pose[1] - this.reach() - 9 * this.dot, this.paint.red, 600, this.paint.card);
    }
  }

  drawGrid(c, grid) {
    const { dot } = this;
    const { cell, cols, rows } = grid;
    // In a frame of its own: turned clockwise about its origin.
    c.save();
    c.translate(...grid.origin);
    c.rotate(-(grid.h ?? 0) * TURN);
    const each = (cells, inset, fill) => {
      c.fillStyle = fill;
      for (const [i, j] of cells ?? []) c.fillRect(i * cell + inset, j * cell + inset, cell - 2 * inset, cell - 2 * inset);
    };
    each(grid.free, 0.5 * dot, this.dark ? 'rgb(111 177 255 / .10)' : 'rgb(11 98 196 / .07)');
    c.beginPath();
    for (let i = 0; i <= cols; i += 1) { c.moveTo(i * cell, 0); c.lineTo(i * cell, rows * cell); }
    for (let j = 0; j <= rows; j += 1) { c.moveTo(0, j * cell); c.lineTo(cols * cell, j * cell); }
    c.strokeStyle = this.paint.blue;
    c.globalAlpha = 0.28;
    c.lineWidth = dot;
    c.stroke();
    // An obstacle that the robot knows of: its cell is crossed out.
    c.globalAlpha = 0.9;
    c.lineWidth = 1.5 * dot;
    c.beginPath();
    for (const [i, j] of grid.blocked ?? []) {
      const [x, y] = [i * cell, j * cell];
      c.rect(x + 1.5 * dot, y + 1.5 * dot, cell - 3 * dot, cell - 3 * dot);
      for (let k = 1; k < 4; k += 1) {
        c.moveTo(x + 1.5 * dot, y + (cell * k) / 4); c.lineTo(x + cell - (cell * k) / 4, y + cell - 1.5 * dot);
        if (k > 1) { c.moveTo(x + (cell * (k - 1)) / 4, y + 1.5 * dot); c.lineTo(x + cell - 1.5 * dot, y + cell - (cell * (k - 1)) / 4); }
      }
    }
    c.stroke();
    c.globalAlpha = 1;
    if (grid.plan?.length > 1 && this.shown.path) this.drawPath(c, grid.plan.map(([i, j]) => [(i + 0.5) * cell, (j + 0.5) * cell]));
    c.restore();
  }

  /** Cones lie under the boxes, spots and touches above. */
  drawSeen(c, above) {
    const { dot } = this;
    const { see = [] } = this.model.frame;
    const old = this.now?.before?.see;
    for (const [index, seen] of see.entries()) {
      const was = old?.[index]?.kind === seen.kind ? old[index] : null;
      const at = (name) => (was ? seen[name] + (was[name] - seen[name]) * (1 - this.now.share) : seen[name]);
      if (seen.kind === 'cone' && seen.fan?.length) {
        const fan = was?.fan?.length === seen.fan.length ? seen.fan.map((p, i) => between(was.fan[i], p, this.now.share)) : seen.fan;
        const [x, y] = [at('x'), at('y')];
        if (above) {
          if (!seen.hit) continue;
          const hit = was?.hit ? between(was.hit, seen.hit, this.now.share) : seen.hit;
          disc(c, ...hit, 3 * dot);
          fill(c, this.paint.beam);
          stroke(c, this.paint.card, 1.5 * dot);
          continue;
        }
        trace(c, [[x, y], ...fan], true);
        const reach = Math.max(1, ...fan.map((p) => Math.hypot(p[0] - x, p[1] - y)));
        const fade = c.createRadialGradient(x, y, 0, x, y, reach);
        c.globalAlpha = this.dark ? 0.34 : 0.26;
        fade.addColorStop(0, this.paint.beam);
        fade.addColorStop(1, `color-mix(in srgb, ${this.paint.beam} 30%, transparent)`);
        fill(c, fade);
        c.globalAlpha = this.dark ? 0.5 : 0.4;
        stroke(c, this.paint.beam, dot);
        c.globalAlpha = 1;
      } else if (seen.kind === 'beacon' && seen.at && !above) {
        trace(c, [[at('x'), at('y')], seen.at]);
        stroke(c, this.paint.violet, dot, null, [2 * dot, 4 * dot]);
      }
    }
  }

  hull() {
    return this.model.spec?.hull ?? { kind: 'circle', r: 8 };
  }

  hullPath() {
    const hull = this.hull();
    const path = new Path2D();
    if (hull.kind === 'circle') path.arc(0, 0, hull.r, 0, 7);
    else path.roundRect(-hull.w / 2, hull.offset - hull.l / 2, hull.w, hull.l, Math.min(hull.w, hull.l) * 0.18);
    return path;
  }

  reach() {
    const hull = this.hull();
    return hull.kind === 'circle' ? hull.r : Math.max(hull.w / 2, hull.l / 2 + Math.abs(hull.offset));
  }

  drawRobots(c, robot) {
    const { believed } = this.model.frame.robot ?? {};
    const truly = this.drag?.kind === 'robot' ? this.drag.at : robot.true;
    if (believed?.ellipse && robot.pose && this.shown.believed) this.drawEllipse(c, robot.pose, believed.ellipse);
    if (truly) this.drawRobot(c, truly, this.drag?.kind === 'robot' ? 'ghost' : 'true');
    if (robot.pose && (this.shown.believed || !truly)) this.drawRobot(c, robot.pose, truly ? 'believed' : 'real');
  }

  /** Within the world, and the fainter the less it says. */
  drawEllipse(c, [x, y], [a, b, h], color = this.paint.blue) {
    if (a * SIGMAS < 2 * this.dot) return;
    const [left, bottom, right, top] = this.view;
    const clear = Math.min(1, Math.max(0.15, (0.25 * Math.min(right - left, top - bottom)) / (a * SIGMAS)));
    c.save();
    if (this.model.world?.bounds) {
      const [x1, y1, x2, y2] = this.model.world.bounds;
      c.beginPath();
      c.rect(x1, y1, x2 - x1, y2 - y1);
      c.clip();
    }
    c.beginPath();
    // Its long axis along the heading h, which is clockwise from y.
    c.ellipse(x, y, a * SIGMAS, Math.max(b * SIGMAS, this.dot), (90 - h) * TURN, 0, 7);
    c.globalAlpha = 0.16 * clear;
    fill(c, color);
    c.globalAlpha = 0.9 * clear;
    stroke(c, color, 1.2 * this.dot);
    c.restore();
  }

  drawRobot(c, [x, y, h], kind) {
    const { dot } = this;
    const { spec } = this.model;
    const reach = this.reach();
    const path = this.hullPath();
    c.save();
    c.translate(x, y);
    c.rotate(-h * TURN);
    // Far away, it is drawn larger than it is, on a disc that says so.
    const small = reach * this.camera.scale < 13;
    if (small && kind !== 'believed') {
      disc(c, 0, 0, 17 * dot);
      fill(c, this.dark ? 'rgb(245 196 0 / .2)' : 'rgb(245 196 0 / .34)');
    }
    if (small) c.scale((13 * dot) / reach, (13 * dot) / reach);
    const line = small ? (dot * reach) / (13 * dot) : dot;
    if (kind === 'believed') {
      stroke(c, this.paint.blue, 1.6 * line, path, [4 * line, 3 * line]);
      if (this.apart(x, y, h)) this.nose(c, reach * 0.8, 1.6 * line, this.paint.blue);
      c.restore();
      return;
    }
    const ink = '#1c1e22';
    const axle = spec?.axle ?? reach * 1.3;
    const wheels = new Path2D();
    for (const [side, wheel] of spec && !spec.left ? [] : [[-1, spec?.left], [1, spec?.right]]) {
      const d = wheel?.d ?? reach * 0.7;
      wheels.roundRect((side * axle) / 2 - 1.2, -d / 2, 2.4, d, 0.8);
    }
    fill(c, this.dark ? '#8b9096' : '#3a3d42', wheels);
    if (kind === 'ghost') c.globalAlpha = 0.75;
    c.shadowColor = 'rgb(0 0 0 / .25)';
    c.shadowBlur = 6 * this.ratio;
    c.shadowOffsetY = 1.5 * this.ratio;
    fill(c, kind === 'real' ? this.paint.blue : this.paint.yellow, path);
    c.shadowColor = 'transparent';
    stroke(c, ink, 1.4 * line, path);
    fill(c, 'rgb(28 30 34 / .42)', wheels);
    for (const sensor of spec?.sensors ?? []) {
      const at = this.model.port(sensor.port);
      if (at && at.kind !== 'sensor') continue;
      const spot = this.model.frame.see?.find((seen) => seen.port === sensor.port && seen.kind === 'spot');
      const touch = this.model.frame.see?.find((seen) => seen.port === sensor.port && seen.kind === 'touch');
      c.beginPath();
      if (touch) c.roundRect(sensor.x - 4, sensor.y - 0.6, 8, 1.2, 0.6);
      else c.arc(sensor.x, sensor.y, 1.1, 0, 7);
      fill(c, touch ? (touch.on ? this.paint.red : ink) : spot ? this.tone(spot.color) : ink);
      if (spot) {
        stroke(c, ink, Math.min(0.5, 1.4 * line));
      }
    }
    for (const { port, x, y } of spec?.grippers ?? []) {
      const half = this.model.port(port)?.opening / 2;
      if (!(half >= 0)) continue;
      // Two arms from the hull, whose ends are as far apart as the jaws.
      const root = Math.max(0, y - 7);
      c.beginPath();
      for (const side of [-1, 1]) along(c, [[x + 2.5 * side, root], [x + side * (half + 0.5), y - 2.5], [x + side * (half + 0.5), y + 2.5]]);
      stroke(c, ink, 1);
    }
    this.nose(c, reach, Math.max(1.6 * line, 0.13 * reach), kind === 'real' ? this.paint.card : ink);
    c.restore();
  }

  /** Whether a believed pose differs visibly from the true one. */
  apart(x, y, h) {
    const truly = this.model.frame.robot?.true;
    return !truly || Math.hypot(x - truly[0], y - truly[1]) > 0.4 * this.reach() || Math.abs(h - truly[2]) > 8;
  }

  /** An arrow that says where ahead is. */
  nose(c, reach, width, color) {
    c.beginPath();
    c.moveTo(0, -reach * 0.42);
    c.lineTo(0, reach * 0.52);
    c.moveTo(-reach * 0.3, reach * 0.2);
    c.lineTo(0, reach * 0.54);
    c.lineTo(reach * 0.3, reach * 0.2);
    stroke(c, color, width);
  }

  drawHands(c) {
    const { dot } = this;
    this.editing?.draw(c, this);
    if (this.selected === 'robot' && !this.drag) {
      const handle = this.handle();
      if (handle) {
        const pose = this.model.frame.robot.true;
        trace(c, [pose, handle]);
        c.strokeStyle = this.paint.ink;
        c.globalAlpha = 0.5;
        c.lineWidth = dot;
        c.stroke();
        c.globalAlpha = 1;
        disc(c, ...handle, 6 * dot);
        fill(c, this.paint.card);
        c.lineWidth = 2 * dot;
        c.stroke();
      }
    }
    if (this.drag?.kind === 'box') {
      const { from, to } = this.drag;
      c.fillStyle = this.paint.block;
      c.globalAlpha = 0.7;
      c.fillRect(Math.min(from[0], to[0]), Math.min(from[1], to[1]), Math.abs(to[0] - from[0]), Math.abs(to[1] - from[1]));
      c.globalAlpha = 1;
    }
    if (this.measured) {
      const [a, b] = this.measured;
      const end = b ?? this.pointer ?? a;
      trace(c, [a, end]);
      stroke(c, c.fillStyle = this.paint.ink, 1.5 * dot);
      for (const [x, y] of [a, end]) {
        disc(c, x, y, 3 * dot);
        c.fill();
      }
      const words = `${num(Math.hypot(end[0] - a[0], end[1] - a[1]), 1)} cm`;
      c.save();
      c.translate((a[0] + end[0]) / 2, (a[1] + end[1]) / 2);
      c.scale(dot, -dot);
      c.font = `600 13px ${this.font}`;
      c.textAlign = 'center';
      c.textBaseline = 'middle';
      const width = c.measureText(words).width + 16;
      c.beginPath();
      c.roundRect(-width / 2, -12, width, 24, 12);
      fill(c, this.paint.ink);
      c.fillStyle = this.paint.card;
      c.fillText(words, 0, 1);
      c.restore();
    }
  }

  /** Where the robot is taken to be turned. */
  handle() {
    const pose = this.model?.frame?.robot?.true;
    if (!pose) return null;
    const far = Math.max(this.reach(), 13 * this.dot) + 18 * this.dot;
    const [dx, dy] = ahead(pose[2]);
    return [pose[0] + dx * far, pose[1] + dy * far];
  }
}
