// The things of a world: how each kind of thing looks, begins, moves, is taken by its handles,
// what can be typed of it, and its fact. The page knows a kind of thing in this file alone.
// Things are items as in docs/view-protocol.md; the start, and the world around everything,
// count as things here.

import { along, disc, fill, stroke, trace } from './canvas.js';

export const TURN = Math.PI / 180;

/** The simulator's colors, by the names that facts have for them. */
export const COLORS = new Map([['black', '#0f0f0f'], ['white', '#ebebeb'], ['red', '#c81919'], ['yellow', '#e6be1e'],
  ['green', '#148232'], ['blue', '#143c96'], ['brown', '#6e3c1e']]);

/** A number with two decimals. */
export const cm = (n) => Math.round(n * 100) / 100;
const add = ([x, y], [dx, dy]) => [cm(x + dx), cm(y + dy)];
const far = ([x1, y1], [x2, y2]) => Math.hypot(x2 - x1, y2 - y1);
const degrees = ([x1, y1], [x2, y2]) => Math.round(Math.atan2(x2 - x1, y2 - y1) / TURN);
const mean = (points) => [0, 1].map((i) => cm(points.reduce((sum, point) => sum + point[i], 0) / points.length));

/** From the frame of a thing with a heading to the world's, and back. */
const out = ({ x, y, h = 0 }, [a, b]) => [x + a * Math.cos(h * TURN) + b * Math.sin(h * TURN), y - a * Math.sin(h * TURN) + b * Math.cos(h * TURN)];
const into = ({ x, y, h = 0 }, [px, py]) => {
  const [dx, dy] = [px - x, py - y];
  return [dx * Math.cos(h * TURN) - dy * Math.sin(h * TURN), dx * Math.sin(h * TURN) + dy * Math.cos(h * TURN)];
};

// Fields: [words, name or how to get and set it, unit, whether it is a number, a color or places].
const number = (words, name, unit = 'cm') => ({ words, unit, kind: 'number', get: (thing) => thing[name], set: (thing, value) => ({ ...thing, [name]: value }) });
const part = (words, name, i) => ({
  words, unit: 'cm', kind: 'number', has: (thing) => thing[name] !== null, get: (thing) => thing[name][i],
  set: (thing, value) => ({ ...thing, [name]: thing[name].map((old, k) => (k === i ? value : old)) }),
});
const color = { words: 'Color', kind: 'color', get: (thing) => thing.color, set: (thing, value) => ({ ...thing, color: value }) };
const places = { words: 'Places', kind: 'places', get: (thing) => thing.points, set: (thing, value) => ({ ...thing, points: value }) };
const AT = [number('x', 'x'), number('y', 'y')];
const HEADING = number('Heading', 'h', '°');

// What has a mass is a thing that robots push; without it, it neither slides nor rolls.
const trait = (words, name, unit, kind) => ({
  words, unit, kind, has: isThing, get: (thing) => thing.traits[name],
  set: (thing, value) => ({ ...thing, traits: { ...thing.traits, [name]: value } }),
});
export const isThing = ({ traits }) => traits?.mass !== undefined;
/** The mass in kg of a thing that is drawn. */
export const LIGHT = 0.05;
const MOVES = {
  words: 'Moves', kind: 'switch', get: isThing,
  set: (thing, on) => ({ ...thing, traits: { ...thing.traits, ...(on ? { mass: LIGHT } : { mass: undefined, friction: undefined, rolls: undefined, bounces: undefined }) } }),
};
const MASS = trait('Mass', 'mass', 'kg', 'number');
const ROLLS = trait('Rolls', 'rolls', '', 'switch');
const OWN_COLOR = {
  words: 'Color', kind: 'color', none: [''], get: (thing) => thing.traits?.color ?? '',
  set: (thing, value) => ({ ...thing, traits: { ...thing.traits, color: value || undefined } }),
};
const weight = (thing) => (isThing(thing) ? ` of ${thing.traits.mass} kg` : '');

/** The traits as an argument of the fact, if there are any. */
const options = ({ traits = {} }) => {
  const value = (it) => (typeof it === 'string' ? `'${it.replace(/[\\']/g, '\\$&')}'` : it);
  const all = Object.keys(traits).filter((name) => (traits[name] ?? false) !== false).map((name) => `${name}(${name === 'color' ? shade(traits.color) : value(traits[name])})`);
  return all.length ? [`[${all.join(', ')}]`] : [];
};

const moved = (thing, [dx, dy]) => ({ ...thing, x: cm(thing.x + dx), y: cm(thing.y + dy) });
const turned = (thing, by) => ({ ...thing, h: Math.round((thing.h ?? 0) + by) % 360 });
const handleAhead = (thing, [, way]) => out(thing, [0, way]);

/** With points: each is a handle. It lies on the floor. */
const pointed = {
  outline: (thing) => thing.points,
  move: (thing, by) => ({ ...thing, points: thing.points.map((point) => add(point, by)) }),
  turn: (thing, by) => {
    const [x, y] = mean(thing.points);
    return { ...thing, points: thing.points.map((point) => out({ x, y, h: by }, [point[0] - x, point[1] - y]).map(cm)) };
  },
  handles: (thing) => thing.points,
  take: (thing, i, place) => ({ ...thing, points: thing.points.map((point, k) => (k === i ? place.map(cm) : point)) }),
  points: (thing) => thing.points,
};

const middle = ({ x, y }) => [[x, y]];
const fact = (name, ...numbers) => `${name}(${numbers.join(', ')})`;

/** Of a thing that is a point. */
const placed = { move: moved, turn: null, handles: () => [], take: null, points: middle };

const corners = (box) => [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([a, b]) => out(box, [(a * box.w) / 2, (b * box.d) / 2]));

// Of each kind: `tool`, if the editor can draw it; `solid`, its color if it is an obstacle, with its
// `path`; else `lay`, if it lies on the floor, or `paint` draws it. `at` is where it is while it is
// moved; `picture` is that of picture.js.
export const KINDS = {
  wall: {
    tool: 'Wall',
    solid: 'wall',
    path: (path, { from: [x1, y1], to: [x2, y2], thickness }, at, dot) => {
      const half = Math.max(thickness, 1.5 * dot) / 2 / (Math.hypot(x2 - x1, y2 - y1) || 1);
      const [nx, ny] = [(y2 - y1) * half, (x1 - x2) * half];
      along(path, [[x1 + nx, y1 + ny], [x2 + nx, y2 + ny], [x2 - nx, y2 - ny], [x1 - nx, y1 - ny]], true);
    },
    outline: (wall) => [wall.from, wall.to],
    words: (wall) => `Wall from ${wall.from.join(', ')} to ${wall.to.join(', ')}`,
    fields: [part('From x', 'from', 0), part('From y', 'from', 1), part('To x', 'to', 0), part('To y', 'to', 1), number('Thickness', 'thickness')],
    between: (a, b) => ({ kind: 'wall', from: a, to: b, thickness: 1 }),
    move: (wall, by) => ({ ...wall, from: add(wall.from, by), to: add(wall.to, by) }),
    turn: (wall, by) => {
      const [x, y] = mean([wall.from, wall.to]);
      const round = (point) => out({ x, y, h: by }, [point[0] - x, point[1] - y]).map(cm);
      return { ...wall, from: round(wall.from), to: round(wall.to) };
    },
    handles: (wall) => [wall.from, wall.to],
    take: (wall, i, place) => ({ ...wall, [i ? 'to' : 'from']: place.map(cm) }),
    points: (wall) => [wall.from, wall.to],
    fact: (wall) => fact('wall', ...wall.from, ...wall.to, ...(wall.thickness === 1 ? [] : [wall.thickness])),
  },
  box: {
    tool: 'Box',
    solid: 'block',
    path: (path, { w, d, h = 0 }, at) => {
      const turned = new Path2D();
      turned.rect(-w / 2, -d / 2, w, d);
      path.addPath(turned, new DOMMatrix().translateSelf(at.x, at.y).rotateSelf(-(at.h ?? h)));
    },
    outline: corners,
    closed: true,
    words: (box) => `Box ${box.w} × ${box.d}${weight(box)} at ${box.x}, ${box.y}`,
    fields: [...AT, number('Width', 'w'), number('Depth', 'd'), HEADING, OWN_COLOR, MOVES, MASS],
    between: (a, b) => ({ kind: 'box', x: cm((a[0] + b[0]) / 2), y: cm((a[1] + b[1]) / 2), w: cm(Math.abs(a[0] - b[0])), d: cm(Math.abs(a[1] - b[1])), h: 0 }),
    move: moved,
    turn: turned,
    handles: (box, gap) => [...corners(box), handleAhead(box, [0, box.d / 2 + gap])],
    take: (box, i, place) => {
      if (i === 4) return { ...box, h: degrees([box.x, box.y], place) };
      // The corner across stays where it is.
      const [a, b] = [[1, 1], [1, -1], [-1, -1], [-1, 1]][i];
      const [px, py] = into(box, place);
      const [qx, qy] = [(-a * box.w) / 2, (-b * box.d) / 2];
      const [x, y] = out(box, [(px + qx) / 2, (py + qy) / 2]);
      return { ...box, x: cm(x), y: cm(y), w: Math.max(1, Math.round(Math.abs(px - qx))), d: Math.max(1, Math.round(Math.abs(py - qy))) };
    },
    points: middle,
    fact: (box) => fact('box', box.x, box.y, box.w, box.d, ...(box.h || options(box).length ? [box.h] : []), ...options(box)),
  },
  circle: {
    tool: 'Circle',
    solid: 'block',
    path: (path, { r }, at) => path.arc(at.x, at.y, r, 0, 7),
    words: (circle) => `Circle of radius ${circle.r}${weight(circle)} at ${circle.x}, ${circle.y}`,
    fields: [...AT, number('Radius', 'r'), OWN_COLOR, MOVES, MASS, ROLLS],
    between: (a, b) => ({ kind: 'circle', x: a[0], y: a[1], r: Math.max(1, Math.round(far(a, b))) }),
    move: moved,
    turn: null,
    handles: (circle) => [[circle.x + circle.r, circle.y]],
    take: (circle, _, place) => ({ ...circle, r: Math.max(1, Math.round(far([circle.x, circle.y], place))) }),
    points: middle,
    fact: (circle) => fact('circle', circle.x, circle.y, circle.r, ...options(circle)),
  },
  line: {
    tool: 'Line',
    hint: 'Click place by place; click the last one twice, or Enter. Or drag.',
    lay: (c, line, picture) => {
      trace(c, line.points);
      stroke(c, picture.tone(line.color), line.width);
    },
    words: (line) => `${capital(named(line.color))} line, ${line.points.length} places`,
    fields: [number('Width', 'width'), color, places],
    between: (a, b) => ({ kind: 'line', color: COLORS.get('black'), width: 2, points: [a, b] }),
    ...pointed,
    fact: (line) => `line(${shade(line.color)}, ${line.width}, ${list(line.points)})`,
  },
  patch: {
    tool: 'Patch',
    closed: true,
    lay: (c, patch, picture) => {
      trace(c, patch.points, true);
      fill(c, picture.tone(patch.color));
    },
    words: (patch) => `${capital(named(patch.color))} patch, ${patch.points.length} corners`,
    fields: [color, places],
    between: (a, b) => ({ kind: 'patch', color: COLORS.get('red'), points: [a, [b[0], a[1]], b, [a[0], b[1]]] }),
    ...pointed,
    fact: (patch) => `patch(${shade(patch.color)}, ${list(patch.points)})`,
  },
  lamp: {
    tool: 'Lamp',
    hint: 'Click where it is.',
    click: true,
    paint: (c, lamp, at, picture) => {
      const { dark, dot, model, paint } = picture;
      const power = lamp.port ? model.frame.beams?.find((beam) => beam.id === lamp.id)?.power ?? 0 : 1;
      const reach = Math.max(24 * dot, Math.min(90, 8 * Math.sqrt(lamp.intensity)));
      if (power > 0.01) {
        const glow = c.createRadialGradient(at.x, at.y, 0, at.x, at.y, reach);
        const strength = (dark ? 0.5 : 0.75) * power;
        glow.addColorStop(0, `rgb(255 200 40 / ${strength})`);
        glow.addColorStop(0.4, `rgb(255 205 60 / ${strength * 0.3})`);
        glow.addColorStop(1, 'rgb(255 210 80 / 0)');
        disc(c, at.x, at.y, reach);
        fill(c, glow);
      }
      const r = Math.max(2.2, 6 * dot);
      disc(c, at.x, at.y, r);
      fill(c, power > 0.01 ? '#fff3c4' : paint.off);
      stroke(c, power > 0.01 ? '#b98900' : paint['block-edge'], 1.5 * dot);
      if (lamp.port) picture.label(c, lamp.port, at.x, at.y - r - 9 * dot);
    },
    words: (lamp) => `Lamp at ${lamp.x}, ${lamp.y}`,
    fields: [...AT, number('Intensity', 'intensity', '%')],
    between: (a, b) => ({ kind: 'lamp', x: b[0], y: b[1], intensity: 50 }),
    ...placed,
    fact: (lamp) => fact('lamp', lamp.x, lamp.y, lamp.intensity, ...(lamp.port ? [lamp.port] : [])),
  },
  beacon: {
    paint: (c, beacon, at, picture) => {
      const { dot, paint } = picture;
      c.strokeStyle = paint.violet;
      for (const [radius, alpha] of [[6, 1], [11, 0.5], [16, 0.25]]) {
        c.globalAlpha = alpha;
        c.lineWidth = 1.5 * dot;
        disc(c, at.x, at.y, radius * dot);
        c.stroke();
      }
      c.globalAlpha = 1;
      picture.label(c, String(beacon.channel), at.x, at.y, paint.violet, 700);
    },
    words: (beacon) => `Beacon ${beacon.channel} at ${beacon.x}, ${beacon.y}`,
    fields: [...AT, number('Channel', 'channel', '')],
    ...placed,
    fact: (beacon) => fact('beacon', beacon.x, beacon.y, beacon.channel),
  },
  start: {
    words: (start) => `Start at ${start.x}, ${start.y}, heading ${start.h}`,
    fields: [...AT, HEADING],
    move: moved,
    turn: turned,
    handles: (start, gap, reach) => [handleAhead(start, [0, reach + gap])],
    take: (start, _, place) => ({ ...start, h: degrees([start.x, start.y], place) }),
    points: middle,
    fact: (start) => fact('start', start.x, start.y, start.h),
  },
  around: {
    words: ({ bounds }) => (bounds ? `World of ${cm(bounds[2] - bounds[0])} × ${cm(bounds[3] - bounds[1])}` : 'World without bounds'),
    fields: [part('Left', 'bounds', 0), part('Bottom', 'bounds', 1), part('Right', 'bounds', 2), part('Top', 'bounds', 3),
      { ...color, words: 'Floor' }, number('Light', 'ambient', '%'), number('Warmth', 'temperature', '°C'), number('Sound', 'loudness', '%')],
    fact: (around) => [
      ...(around.bounds ? [`bounds(${around.bounds.join(', ')})`] : []),
      ...(named(around.color) === 'white' ? [] : [`floor(${shade(around.color)})`]),
      ...['ambient', 'temperature', 'loudness'].filter((name) => around[name] !== AROUND[name]).map((name) => `${name}(${around[name]})`),
    ],
  },
};

/** What is so if no fact says otherwise; its bounds are those of a world that is begun here. */
export const AROUND = { kind: 'around', bounds: [0, 0, 200, 150], color: COLORS.get('white'), ambient: 2, temperature: 21.5, loudness: 0 };

export const EMPTY = { around: AROUND, start: { kind: 'start', x: 100, y: 75, h: 0 }, items: [] };

/** A world that a frame has, as a draft. */
export function draftOf(world) {
  if (!world) return EMPTY;
  const [x, y, h] = world.start;
  const { bounds, floor, ambient, temperature, loudness } = world;
  return { around: { kind: 'around', bounds, color: floor, ambient, temperature, loudness }, start: { kind: 'start', x, y, h }, items: world.items.map(({ held, ...item }) => item) };
}

/** A draft as a frame has a world. */
export function worldOf({ around, items }, view) {
  return { bounds: around.bounds, view, floor: around.color, items };
}

/** The name of a color, or itself. */
export const named = (value) => [...COLORS].find(([, hex]) => hex === value)?.[0] ?? value;
const capital = (words) => words[0].toUpperCase() + words.slice(1);
const shade = (value) => (COLORS.has(named(value)) ? named(value) : `'${value}'`);
const list = (points) => `[${points.map(([x, y]) => (y < 0 ? `${x} - ${y}` : `${x}-${y}`)).join(', ')}]`;

/** The draft as a file of facts; each fact is on a line of its own. */
export function factsOf({ around, start, items }) {
  const facts = [...KINDS.around.fact(around), KINDS.start.fact(start), ...items.map((item) => KINDS[item.kind].fact(item))];
  return `${facts.join('.\n')}.\n`;
}

/** Why a thing cannot be there, in words; else null. The simulator knows the rest. */
export function outside(thing, { bounds }) {
  if (!bounds || thing.kind === 'around') return null;
  const [x1, y1, x2, y2] = bounds;
  const out1 = KINDS[thing.kind].points(thing).find(([x, y]) => x < x1 || x > x2 || y < y1 || y > y2);
  return out1 ? `${out1.join(', ')} is outside of the world, which goes from ${x1}, ${y1} to ${x2}, ${y2}.` : null;
}
