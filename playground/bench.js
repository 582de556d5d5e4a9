// The playground: an editor, a console, and the live view with the robot.

import { Console } from './console.js';
import { Machine } from './machine.js';
import { keepProgram, programs } from './programs.js';
import { fromFragment, toFragment } from './share.js';
import { LEAVE, Text } from './text.js';
import { Tone } from './tone.js';
import { $, attribute, download, el, notice, pressed, text, toggle } from './view/dom.js';
import { divider, keep as keepSize, kept as keptSize } from './view/panels.js';

const FIRST = `% A robot that keeps away from things.

:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    drive.

drive :-
    us_dist_cm(_, Distance),
    (   Distance > 30
    ->  go(30)
    ;   turn(30, 90)
    ),
    drive.
`;
const KEY = 'ev3dev playground';
const DATE = new Intl.DateTimeFormat('en-GB', { day: 'numeric', month: 'short', hour: '2-digit', minute: '2-digit' });

const kept = read();
const machine = new Machine({ begins, took, runs, heard, ends, worldChanged: keep });
const console_ = new Console((line) => machine.send(line), goToLine, unseen);
const editor = new Text($('text'), { changed: keep, indented, run, words: [] });
const tone = new Tone();
let program = null;
/** What was said of lines when the program was loaded, and since it runs; and the error by which
    the last goal ended. */
let found = [];
let raised = [];
let failed = null;
/** The exercise of the course that is open; the programs that everybody has; and the text of this
    one as it was kept last. */
let task = '';
let known = [];
let former = null;
/** Whether the way out of the editor was said; and whether the notice is of the output. */
let [told, isUnseen] = [false, false];

window.ev3dev = { machine, editor, state };

// ----------------------------------------------------------------- what is kept

/** What this tab had; if it is new, what any tab had last. */
function read() {
  for (const store of ['sessionStorage', 'localStorage']) {
    try {
      const found = JSON.parse(window[store].getItem(KEY));
      if (found) return found;
    } catch { /* It is not kept where a browser does not allow it. */ }
  }
  return {};
}

const present = () => ({ name: name(), text: editor.text, world: machine.lines, task });

function keep() {
  for (const store of ['sessionStorage', 'localStorage']) {
    try {
      window[store].setItem(KEY, JSON.stringify(present()));
    } catch { /* as above */ }
  }
}

/** The user's own text is kept by its name before another one comes. */
function keepOwn() {
  const now = present();
  if (!now.text.trim() || now.text === FIRST || known.some(({ text: words }) => words === now.text)) return null;
  const title = keepProgram(now, former);
  former = now.text;
  return title;
}

/** Another program, in the place of this one. */
function show({ name: title, text: words, world, task: exercise = '' }, about = '') {
  const before = present();
  const own = keepOwn();
  $('name').value = title;
  editor.text = words;
  former = words;
  task = exercise;
  for (const button of document.querySelectorAll('.of-task')) button.hidden = !task;
  if (!task && document.body.classList.contains('shows-task')) showPart('program');
  if (world) begin(world);
  keep();
  if (own) notice(`${about} Your ${own} is kept: it is in the list under My programs.`.trim(), { seconds: 10, act: ['Back to mine', () => show(before)] });
  else if (about) notice(about, { seconds: 10 });
}

/** Begins a world and a robot by their lines. */
function begin(lines) {
  if (machine.open) for (const line of lines) machine.send(line);
  else machine.lines = lines;
}

// ----------------------------------------------------------------- Prolog

function begins() {
  text($('state'), '');
  console_.begins();
  if (!$('robot').src) $('robot').src = 'view/index.html';
}

function ends(why) {
  program = null;
  console_.say('error', why);
  text($('state'), 'Prolog starts');
  running(false);
}

function took(frame) {
  console_.took(frame);
  if (frame.program?.state !== program?.state) running(frame.program?.state === 'running');
  program = frame.program;
  tone.take(frame.brick?.tone ?? 0);
  if (frame.active !== undefined) editor.active((frame.active ?? []).filter(({ file }) => file === name()));
}

/** What was begun runs, until a frame says that it has ended. */
function runs() {
  program = { state: 'running' };
  raised = [];
  running(true);
}

/** What is of the program and of queries; everything else is of the live view. */
function heard(message) {
  const { type, what, errors, why } = message;
  if (type === 'answer') {
    failed = message.state === 'error' ? message.text : null;
    console_.answer(message);
  } else if (type === 'reads') console_.reads(what);
  else if (type === 'say') {
    window.speechSynthesis?.speak(new SpeechSynthesisUtterance(message.text));
  } else if (type === 'raised') {
    const { line, kind = 'error', text: words = failed } = message;
    if (words) {
      raised.push({ line, kind, text: words });
      editor.errors([...found, ...raised]);
      if (kind === 'error') console_.was(line);
    }
  }
  else if (what === 'check') checked(message);
  else if (what === 'run' || what === 'load') {
    found = errors;
    editor.errors(found);
    if (errors.some(({ kind }) => kind === 'error')) {
      goToLine(errors.find(({ kind }) => kind === 'error').line);
      console_.say('stop', 'The program was not started: see the lines with a mark.');
    }
    machine.send('program');
  } else if (what === 'program') return true;
  else if (type === 'refused' && ['goal', 'more', 'enough'].includes(what)) console_.refused(why);
  else return false;
  return true;
}

function name() {
  const words = $('name').value.trim().replace(/\.pl$/, '').replace(/[^\w-]/g, '_') || 'my_robot';
  return `${words}.pl`;
}

function run() {
  if (program?.state === 'running') return stop();
  toNow();
  if (machine.send(`run ${name()} ${editor.text}`)) showPart('robot');
  else notice('Prolog is not ready yet.', { seconds: 3 });
  return true;
}

/** What begins is to be seen. */
function toNow() {
  $('robot').contentDocument?.dispatchEvent(new CustomEvent('ev3dev-time', { detail: { t: null } }));
}

function stop() {
  text($('run'), 'Stopping');
  machine.stop();
}

function running(runs) {
  if (!runs) {
    console_.reads(null);
    console_.nextPasted();
  }
  text($('run'), runs ? 'Stop' : 'Run');
  toggle($('run'), 'stops', runs);
  attribute($('run'), 'title', runs ? 'Stop the program and all motors' : 'Load the program and run it (Ctrl Enter)');
  if (!runs) editor.active([]);
}

// ----------------------------------------------------------------- the buttons

// STOP is for the moment in which the finger goes down. The click that follows it is no Run.
let stopped = false;
$('run').addEventListener('pointerdown', () => {
  stopped = program?.state === 'running';
  if (stopped) stop();
});
$('run').addEventListener('click', ({ detail }) => {
  if (!stopped || detail === 0) run();
  stopped = false;
});
document.addEventListener('keydown', (event) => {
  if (event.key === 'Escape' && !event.defaultPrevented && program?.state === 'running') stop();
});
$('name').addEventListener('change', () => {
  $('name').value = name();
  keep();
});
addEventListener('pagehide', () => keepOwn());
$('save').addEventListener('click', () => download(name(), editor.text, 'text/plain'));
$('open').addEventListener('click', () => $('file').click());
$('file').addEventListener('change', async () => {
  const [file] = $('file').files;
  $('file').value = '';
  if (file) show({ name: file.name, text: await file.text() });
});

$('share').addEventListener('click', async () => {
  $('link').value = `${location.href.replace(/#.*/, '')}#${await toFragment(present())}`;
  $('shared').showModal();
  $('link').select();
});
$('copy').addEventListener('click', async () => {
  await navigator.clipboard.writeText($('link').value).catch(() => document.execCommand('copy'));
  $('shared').close();
  notice('The link is copied.', { seconds: 3 });
});

/** On a phone there is room for one of them; elsewhere a task lies over the robot. */
function showPart(part) {
  for (const each of $('tabs').children) pressed(each, each.dataset.shows === part);
  for (const name of ['robot', 'task']) toggle(document.body, `shows-${name}`, part === name);
  attribute($('task'), 'aria-expanded', part === 'task');
  if (isUnseen) notice('');
  isUnseen = false;
}

/** How wide the program is; null as at first. */
const WIDTH = 'ev3dev playground width';
function widen(size) {
  const { style } = document.documentElement;
  if (size > 0) style.setProperty('--program', `${size}px`);
  else style.removeProperty('--program');
}
widen(keptSize(WIDTH));
$('bench').append(divider('Width of the program', {
  get: () => $('program').offsetWidth, least: 330, most: () => innerWidth - 440, across: true,
  set: (size) => {
    widen(size);
    keepSize(WIDTH, size);
  },
}));

function goToLine(line) {
  if (!$('text').clientHeight) showPart('program');
  editor.goTo(line);
}

/** What has failed is said where one looks, until one looks there or goes on. */
function unseen(words) {
  isUnseen = true;
  notice(words.length > 200 ? `${words.slice(0, 200)} …` : words, { bad: true, act: ['Output', () => showPart('program')] });
}

/** For those who want to leave the editor by Tab. */
function indented() {
  if (!told) notice(LEAVE, { seconds: 5 });
  told = true;
}

for (const tab of $('tabs').children) tab.addEventListener('click', () => (tab.dataset.shows === 'task' ? showTask() : showPart(tab.dataset.shows)));

const stars = (points, of) => '★'.repeat(Math.round(3 * points / of)).padEnd(3, '☆');

async function examples() {
  known = await (await fetch('examples.json')).json();
  for (const label of new Set(known.map(({ group }) => group))) {
    $('examples').append(el('optgroup', { label }, ...known.filter(({ group }) => group === label)
      .map(({ name: value, about }) => el('option', { value, title: about }, `${value}: ${about}`))));
  }
  $('examples').addEventListener('focus', mine);
  $('examples').addEventListener('change', () => {
    const { value } = $('examples');
    $('examples').value = '';
    const own = programs().find(({ name: title }) => value === `mine:${title}`);
    if (own) show(own);
    else choose(known.find(({ name: title }) => title === value));
  });
}

/** An example, or an exercise with its task. */
function choose(found) {
  if (!found) return;
  show({ name: `${found.name}.pl`, text: found.text, world: found.lines, task: found.task ? found.name : '' }, found.task ? '' : found.about);
  if (found.task) showTask();
}

function mine() {
  const all = programs();
  $('mine').hidden = !all.length;
  $('mine').replaceChildren(...all.map(({ name: title, kept: at }) => el('option', { value: `mine:${title}` }, at ? `${title}, ${DATE.format(at)}` : title)));
}

// ----------------------------------------------------------------- the course

function showTask() {
  const found = known.find(({ name: title }) => title === task);
  if (!found) return;
  // It was made of the pack's own files when the page was built.
  $('tasked-text').innerHTML = found.task;
  showPart('task');
  $('tasked-text').scrollTop = 0;
  $('tasked-label').focus();
}

function closeTask() {
  showPart('program');
  $('task').focus();
}

/** A program that still runs is ended by it. */
function check() {
  toNow();
  if (machine.send(`check ${name()} ${task} ${editor.text}`)) console_.say('mark', 'Check: the program runs in the open worlds of the exercise, as fast as it can.');
  else notice('Prolog is not ready yet.', { seconds: 3 });
}

function checked({ points, of, text: words }) {
  text($('checked-points'), `${stars(points, of)} ${points} of ${of} points`);
  text($('checked-text'), words);
  console_.say('mark', `Check: ${points} of ${of} points.`);
  $('checked').showModal();
}

/** The worst run was the last one: the slider goes through it. */
function film() {
  const { ev3view, document: page } = $('robot').contentWindow;
  const last = ev3view.state().time;
  let t = 0;
  showPart('robot');
  const play = setInterval(() => {
    t += Math.max(0.1, last / 400);
    page.dispatchEvent(new CustomEvent('ev3dev-time', { detail: { t: Math.min(t, last - 0.01) } }));
    if (t >= last || program?.state === 'running') clearInterval(play);
  }, 40);
}

$('task').addEventListener('click', () => (document.body.classList.contains('shows-task') ? closeTask() : showTask()));
$('task-close').addEventListener('click', closeTask);
$('check').addEventListener('click', check);
$('film').addEventListener('click', film);

async function words() {
  editor.words = await (await fetch('words.json')).json();
}

/** A link has a program in it, or names an exercise: #task=03. */
async function opened() {
  const exercise = /^#task=([\w-]+)$/.exec(location.hash)?.[1].replace(/^\d$/, '0$&');
  const shared = location.hash.length > 1 && !exercise ? await fromFragment(location.hash.slice(1)).catch(() => null) : null;
  const isLink = location.hash.length > 1;
  if (isLink) history.replaceState(null, '', location.pathname + location.search);
  await offered;
  if (!editor.text) show(kept.text ? kept : { name: 'my_robot.pl', text: FIRST });
  if (exercise) {
    const found = known.find(({ task: has, name: title }) => has && title.startsWith(exercise));
    if (found) choose(found);
    else notice(`There is no exercise ${exercise}.`, { bad: true });
  } else if (shared) show(shared, 'This program came with the link.');
  else if (isLink) notice('The link is not complete: its program cannot be read.', { bad: true });
}

const offered = examples();
addEventListener('hashchange', opened);
await opened();
await words();
if ('serviceWorker' in navigator) navigator.serviceWorker.register('offline.js').catch(() => {});

/** For tests. */
function state() {
  return { open: machine.open, program, name: name(), text: editor.text, world: machine.world, said: [...$('said').children].map((row) => [row.dataset.kind, row.textContent]) };
}
