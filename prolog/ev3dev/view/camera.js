// The part of the world that is on the canvas. Centimeters, y up.

import { $, nice, text, within } from './dom.js';

export class Camera {
  get view() {
    const world = this.model?.world;
    if (world?.bounds) {
      const [x1, y1, x2, y2] = world.bounds;
      // The wall around it is 1 cm thick.
      const edge = Math.max(1.2, 0.008 * Math.max(x2 - x1, y2 - y1));
      return [x1 - edge, y1 - edge, x2 + edge, y2 + edge];
    }
    const all = this.poses().map((pose) => [pose[0], pose[1]]);
    if (this.model?.path) all.push(...this.model.path);
    const grid = this.model?.grid;
    if (grid) {
      all.push(grid.origin, [grid.origin[0] + grid.cols * grid.cell, grid.origin[1] + grid.rows * grid.cell]);
    }
    // Where nothing bounds it, all of the way is seen.
    const column = (name) => (this.model?.samples.columns.get(name) ?? []).filter((n) => n !== null);
    const [xs, ys] = [['x', 'bx'], ['y', 'by']].map((names, i) => [...names.flatMap(column), ...all.map((p) => p[i])]);
    const [low, high] = [Math.min, Math.max].map((best) => (numbers) => numbers.reduce((a, b) => best(a, b)));
    const frame = all.length ? [low(xs) - 40, low(ys) - 40, high(xs) + 40, high(ys) + 40] : [-60, -50, 60, 50];
    const [left, bottom, right, top] = frame.map((n, i) => (i < 2 ? Math.min : Math.max)(n, world?.view?.[i] ?? n));
    const [w, h] = [Math.max(0, 120 - (right - left)) / 2, Math.max(0, 100 - (top - bottom)) / 2];
    return [left - w, bottom - h, right + w, top + h];
  }

  get aspect() {
    const [left, bottom, right, top] = this.view;
    return (right - left) / (top - bottom);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    const ratio = devicePixelRatio || 1;
    this.width = width;
    this.height = height;
    // What lies over the page leaves the tools free.
    document.documentElement.style.setProperty('--shown', `${width}px`);
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== w || this.canvas.height !== h) {
      this.canvas.width = w;
      this.canvas.height = h;
    }
    this.ratio = ratio;
    if (!this.camera.own) this.fit();
    this.draw();
  }

  /** What the tools and the foot of the card take, in pixels. */
  get margins() {
    const bar = $('toolbar');
    const below = bar.offsetWidth > bar.offsetHeight;
    return { left: 12, top: 12, right: below ? 12 : bar.offsetWidth + 20, bottom: below ? bar.offsetHeight + 48 : 36 };
  }

  fit() {
    const [left, bottom, right, top] = this.view;
    const free = this.margins;
    const [width, height] = [this.width - free.left - free.right, this.height - free.top - free.bottom];
    const scale = Math.min(width / (right - left), height / (top - bottom));
    this.camera = {
      x: (left + right) / 2 + (free.right - free.left) / 2 / scale,
      y: (bottom + top) / 2 - (free.bottom - free.top) / 2 / scale, scale, own: false,
    };
    this.foot();
  }

  zoom(factor, [px, py] = [this.width / 2, this.height / 2]) {
    const [x, y] = this.place([px, py]);
    const scale = within(0.02, 60, this.camera.scale * factor);
    this.camera = { x: x - (px - this.width / 2) / scale, y: y + (py - this.height / 2) / scale, scale, own: true };
    this.foot();
    this.draw();
  }

  follow(on) {
    this.following = on;
    const pose = this.poses()[0];
    if (on && pose) {
      // Near enough to see the robot well.
      const scale = Math.max(this.camera.scale, Math.min(this.width, this.height) / 120);
      this.camera = { x: pose[0], y: pose[1], scale, own: true };
    }
    this.foot();
    this.draw();
  }

  /** Pixels of a place in cm, and back. */
  pixel([x, y]) {
    const { camera } = this;
    return [this.width / 2 + (x - camera.x) * camera.scale, this.height / 2 - (y - camera.y) * camera.scale];
  }

  place([px, py]) {
    const { camera } = this;
    return [camera.x + (px - this.width / 2) / camera.scale, camera.y - (py - this.height / 2) / camera.scale];
  }

  /** The scale, and what the colors mean. */
  foot() {
    const length = nice(72 / this.camera.scale);
    $('scale-bar').style.width = `${Math.round(length * this.camera.scale)}px`;
    text($('scale-text'), length >= 100 ? `${length / 100} m` : `${length} cm`);
  }
}
