// The page: takes frames, shows them, and asks for the next.

import { $, clock, el, goTo, notice, text, toggle, within } from './dom.js';
import { Brick } from './brick.js';
import { Charts } from './charts.js';
import { Hands } from './controls.js';
import { Log } from './log.js';
import { ALL, Model } from './model.js';
import { Panels } from './panels.js';
import { Ports } from './ports.js';
import { Program } from './program.js';
import { Timeline } from './timeline.js';
import { Wire } from './wire.js';
import { World } from './world.js';

const PHASES = ['waiting', 'live', 'lost', 'refused'];
const LOST = 'The program has ended, or the view was stopped. The page goes on when it runs again.';
const REFUSED = 'The view was started again. Open the address that it printed.';

// The token is in the cookie now, and need not stay in the address.
if (location.search) history.replaceState(null, '', location.pathname);

const model = new Model();
let phase = 'waiting';
let waiting = false;
let animation = 0;
let arrived = 0;
let interval = 50;

/** If no program runs, and a frame with no news comes within so many ms, the server does not wait
    for news: it is asked again later, or when a hand does something. */
const SOON = 200;
const LATER = 1000;
let asked = 0;
let later = 0;

function ask(now = false) {
  clearTimeout(later);
  later = 0;
  const { calm, clock: time, program: of } = model.frame ?? {};
  const rests = calm && (time.paused || of.state !== 'running');
  if (!now && rests && performance.now() - asked < SOON) later = setTimeout(ask, LATER, true);
  else {
    asked = performance.now();
    wire.next();
  }
}

function send(line) {
  const isSent = wire.send(line);
  if (later) ask(true);
  return isSent;
}

const world = new World(send);
const charts = new Charts(() => model.frame && ports.take(model));
const ports = new Ports(send, (column) => charts.plot(column), (column) => charts.plotted(column));
const brick = new Brick(send);
const program = new Program(send);
const log = new Log(send);
const wire = new Wire({ state, frame, reply });
const hands = new Hands({ send, stop: () => wire.stop() }, world, charts, log, ports);
const timeline = new Timeline(show);
/** Those that go back with the timeline, and those that are always of now. */
const scenes = [ports, brick, program];
const panels = [hands, log, charts];
const arranged = new Panels(layout);
/** Their code comes when they are opened. */
let [editor, reasoning] = [null, null];

// ---------------- the line

function state(name) {
  if (name === 'lost' && phase === 'refused') return;
  phase = name;
  for (const each of PHASES) toggle(document.body, each, each === name);
  if (name === 'live') {
    // It is told everything again.
    log.clear();
    notice('');
  }
  else if (name === 'refused') notice(REFUSED, { bad: true });
  else if (model.frame) notice(LOST, { bad: true });
  else notice('The program does not answer. The page goes on when it does.', { bad: true });
  if (name !== 'live') heading();
}

function reply(message) {
  if (message.type === 'answer') log.answer(message);
  else if (message.type === 'reads') log.reads(true);
  else if (message.type === 'refused' && ['goal', 'more', 'enough', 'input'].includes(message.what)) log.refused(message.why);
  else if (!editor?.reply(message) && !program.reply(message) && !reasoning?.reply(message)) hands.reply(message);
}

function frame(next) {
  const now = performance.now();
  // How long frames take, as a moving average: that is how long a motion may.
  if (arrived && now - arrived < 500) interval += 0.2 * (now - arrived - interval);
  arrived = now;
  const came = model.take(next);
  for (const panel of panels) panel.take(model, came);
  timeline.take(model);
  reasoning?.take(model);
  editor?.take(model);
  if (!timeline.past && !editor?.open && !reasoning?.kept) {
    for (const scene of scenes) scene.take(model, came);
    world.take(model, came, interval);
  }
  heading();
  if (came.has('world')) layout();
  if (came.has('bricks')) robots(model.bricks);
  waiting = true;
  if (!animation) animation = requestAnimationFrame(draw);
}

/** Another moment of the run, or now again. */
function show(moment) {
  if (editor?.open || !moment.frame) return;
  for (const scene of scenes) scene.take(moment, ALL);
  world.show(reasoning?.placed(moment) ?? moment);
}

const partOf = (file) => import(file).catch(() => {
  notice('This part of the page cannot be loaded: the program does not answer.', { bad: true });
  return {};
});

$('reasoning-open').addEventListener('click', async () => {
  const { Reasoning } = await partOf('./reasoning.js');
  if (!Reasoning) return;
  world.thoughts = reasoning ??= new Reasoning(send, () => show(timeline.past ?? model));
  reasoning.model = model;
  reasoning.turn(!reasoning.open);
});

/** The editor was opened or closed. */
function edited() {
  $('editor').hidden = !editor.open;
  if (!editor.open) {
    show(model);
    world.unfollow(() => world.fit());
  }
}

$('edit').addEventListener('click', async () => {
  const { Editor } = await partOf('./editor.js');
  if (!Editor) return;
  editor ??= new Editor(send, world, edited);
  if (editor.open) editor.leave();
  else if (model.simulated) {
    goTo(null);
    world.unfollow(() => world.fit());
    editor.enter(model);
  }
});

/** A hidden page draws nothing, and so asks for nothing. */
function draw(time) {
  animation = 0;
  const more = world.animate(time);
  if (waiting) {
    waiting = false;
    if (!model.frame.calm || !model.frame.clock.stands) charts.draw();
    ask();
  }
  if (more && !animation) animation = requestAnimationFrame(draw);
}

// ---------------- the top

function heading() {
  const { frame: now } = model;
  const { program, clock: time } = now ?? {};
  const [what, name] = phase !== 'live' ? ['', ''] : {
    sim: ['Simulation', model.name], brick: ['Robot', now?.tree], none: model.ended ? ['Ended', model.name] : ['No robot yet', ''],
  }[now?.source] ?? ['Connected', ''];
  const doing = phase !== 'live' ? { waiting: 'Connecting', lost: 'Not connected', refused: 'Refused' }[phase]
    : program?.latched ? 'stopping' : time?.paused ? 'paused' : { running: 'a program runs', idle: 'ready' }[program?.state] ?? '';
  text($('place-what'), what && (name || doing) ? `${what} · ` : what);
  text($('place-name'), name ?? '');
  text($('place-doing'), name && doing ? ` · ${doing}` : doing);
  if (phase !== 'live') return;
  text($('clock-text'), clock(time?.time ?? 0));
  const title = model.name ? `${model.name} – ev3dev` : 'ev3dev';
  if (document.title !== title) document.title = title;
  emptiness();
}

/** The robots to choose from. */
function robots(bricks) {
  $('bricks').hidden = !bricks;
  $('bricks').replaceChildren(...(bricks?.names ?? []).map((name) => el('button', { onclick: () => send(`brick ${name}`), 'aria-pressed': name === bricks.shown }, name)));
}

function emptiness() {
  const { frame: now } = model;
  const known = now?.robot?.true || now?.robot?.believed;
  const words = model.ended ? '' : now?.source === 'none' ? 'No robot and no simulation yet. The first use of a motor or sensor chooses one; the three dots begin a simulation.'
    : !known && !model.world ? 'The place of the robot is unknown. set_robot/4 and pose/3 define it.' : '';
  $('world-empty').hidden = !words;
  text($('world-empty'), words);
}

// ---------------- layout

/** The card of the world takes the world's aspect. */
function layout() {
  const style = document.documentElement.style;
  const aspect = within(0.6, 2.4, world.aspect || 1.2);
  style.setProperty('--aspect', aspect.toFixed(4));
  const gap = 12, pad = 16;
  const main = $('main').getBoundingClientRect();
  const free = world.margins;
  const [sides, ends] = [free.left + free.right, free.top + free.bottom];
  const tall = main.height - pad - gap - 44;
  const most = main.width - 2 * pad - 2 * gap - 276 - 340;
  const tallest = Math.max(300, tall - gap - (tall > 900 ? 320 : 256));
  const width = Math.max(420, Math.min(most, (tallest - ends) * aspect + sides));
  const height = Math.min(tallest, Math.max(432, (width - sides) / aspect + ends));
  arranged.fit(width, height);
}

new ResizeObserver(layout).observe($('main'));

// ---------------- state()

/** What is drawn, for tests and for other programs: a canvas cannot be read. */
function shown() {
  const { frame: now } = model;
  return {
    phase,
    frames: model.count,
    drawings: world.drawings,
    layers: Object.fromEntries(Object.entries(world.layers ?? {}).map(([name, { drawn }]) => [name, drawn])),
    age: model.age,
    source: now?.source ?? null,
    time: now?.clock?.time ?? null,
    clock: now?.clock ?? null,
    program: now?.program ?? null,
    world: model.world ? { name: model.name, bounds: model.world.bounds, items: model.world.items } : null,
    robot: now?.robot ?? null,
    see: now?.see ?? [],
    ports: now?.ports ?? [],
    brick: { ...now?.brick, pixels: brick.black },
    bricks: model.bricks,
    others: now?.others ?? [],
    path: model.path,
    grid: model.grid,
    localized: model.localized,
    snapshots: model.snapshots ?? [],
    samples: model.samples.time.length,
    charts: charts.state(),
    chartHeld: charts.held !== null,
    chartRange: charts.model ? charts.range : null,
    chartMoment: charts.moment,
    log: model.log.map(({ kind, text: words }) => ({ kind, text: words })),
    goals: now?.goals ?? false,
    camera: { ...world.camera, pixels: [world.width, world.height] },
    robotPixels: world.model && world.width ? 2 * Math.max(13, world.reach() * world.camera.scale) : 0,
    tool: world.tool,
    following: world.following,
    driving: hands.driving === true,
    past: timeline.past && { t: timeline.t, robot: timeline.past.frame.robot, items: timeline.past.world?.items ?? [], ports: timeline.past.frame.ports },
    recorded: timeline.kept.length,
    seen: timeline.kept[0]?.time ?? null,
    active: model.active ?? [],
    reasoning: reasoning?.state ?? null,
    edits: editor?.open ? { draft: editor.draft, selected: editor.thing(), tool: editor.tool, undo: editor.past.length, redo: editor.future.length, waits: editor.pending.length, facts: editor.facts, folder: editor.folder } : null,
    selected: world.selected === null ? null : world.selected.kind ?? world.selected,
    measured: world.measured?.[1] ? Math.hypot(world.measured[1][0] - world.measured[0][0], world.measured[1][1] - world.measured[0][1]) : null,
    words: world.words ?? '',
    notice: $('notice').hidden ? '' : $('notice-text').textContent,
  };
}

window.ev3view = {
  state: shown,
  pixel: (x, y) => {
    const box = $('world').getBoundingClientRect();
    const [px, py] = world.pixel([x, y]);
    return [box.left + px, box.top + py];
  },
  csv: () => charts.csv(),
};

// Said now and then to those who do not see the world.
setInterval(() => {
  if (phase === 'live' && model.frame && world.words !== $('world-text').textContent) text($('world-text'), world.words);
}, 2000);

