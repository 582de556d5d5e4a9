// The playground: an editor, a console, and the live view with the robot.

import { Console } from './console.js';
import { Machine } from './machine.js';
import { fromFragment, toFragment } from './share.js';
import { Text } from './text.js';
import { Tone } from './tone.js';
import { $, attribute, download, el, notice, pressed, text, toggle } from './view/dom.js';

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
const DIRECTORY = '/home/web_user/';

const kept = read();
const machine = new Machine({ begins, took, runs, heard, ends, worldChanged: keep });
const console_ = new Console((line) => machine.send(line), (line) => editor.goTo(line));
const editor = new Text($('text'), { changed: keep, run, words: [] });
const tone = new Tone();
let program = null;
/** What was said of lines when the program was loaded, and by what the last goal failed. */
let found = [];
let failed = null;

window.ev3dev = { machine, editor, state };

// ----------------------------------------------------------------- what is kept

function read() {
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? {};
  } catch {
    return {};
  }
}

function keep() {
  try {
    localStorage.setItem(KEY, JSON.stringify({ name: $('name').value, text: editor.text, world: machine.world }));
  } catch { /* It is not kept where a browser does not allow it. */ }
}

function show({ name, text: words, world }) {
  $('name').value = name;
  editor.text = words;
  if (world) begin(world);
  keep();
}

/** Begins a world and a robot by their lines. */
function begin(lines) {
  if (machine.open) for (const line of lines) machine.send(line);
  else machine.world = lines;
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
  if (frame.active !== undefined) editor.active((frame.active ?? []).filter(({ file }) => file === DIRECTORY + name()));
}

/** What was begun runs, until a frame says that it has ended. */
function runs() {
  program = { state: 'running' };
  running(true);
}

/** What is of the program and of queries; everything else is of the live view. */
function heard(message) {
  const { type, what, errors, why } = message;
  if (type === 'answer') {
    failed = message.state === 'error' ? message.text : null;
    console_.answer(message);
  } else if (type === 'say') {
    window.speechSynthesis?.speak(new SpeechSynthesisUtterance(message.text));
  } else if (type === 'raised') {
    if (failed) {
      const error = { line: message.line, kind: 'error', text: failed };
      editor.errors([...found, error]);
      console_.was(message.line);
    }
  }
  else if (what === 'run' || what === 'load') {
    found = errors;
    editor.errors(found);
    if (errors.some(({ kind }) => kind === 'error')) {
      editor.goTo(errors.find(({ kind }) => kind === 'error').line);
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
  if (!machine.send(`run ${name()} ${editor.text}`)) notice('Prolog is not ready yet.', { seconds: 3 });
  return true;
}

function stop() {
  text($('run'), 'Stopping');
  machine.stop();
}

function running(runs) {
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
$('save').addEventListener('click', () => download(name(), editor.text, 'text/plain'));
$('open').addEventListener('click', () => $('file').click());
$('file').addEventListener('change', async () => {
  const [file] = $('file').files;
  $('file').value = '';
  if (file) show({ name: file.name, text: await file.text() });
});

$('share').addEventListener('click', async () => {
  $('link').value = `${location.href.replace(/#.*/, '')}#${await toFragment({ name: name(), text: editor.text, world: machine.world })}`;
  $('shared').showModal();
  $('link').select();
});
$('copy').addEventListener('click', async () => {
  await navigator.clipboard.writeText($('link').value).catch(() => document.execCommand('copy'));
  $('shared').close();
  notice('The link is copied.', { seconds: 3 });
});

for (const tab of $('tabs').children) {
  tab.addEventListener('click', () => {
    for (const each of $('tabs').children) pressed(each, each === tab);
    toggle(document.body, 'shows-robot', tab.dataset.shows === 'robot');
  });
}

async function examples() {
  const all = await (await fetch('examples.json')).json();
  for (const label of new Set(all.map(({ group }) => group))) {
    $('examples').append(el('optgroup', { label }, ...all.filter(({ group }) => group === label)
      .map(({ name: value, about }) => el('option', { value, title: about }, `${value}: ${about}`))));
  }
  $('examples').addEventListener('change', () => {
    const found = all.find(({ name: value }) => value === $('examples').value);
    $('examples').value = '';
    if (!found) return;
    const before = { name: $('name').value, text: editor.text, world: machine.world };
    show({ name: `${found.name}.pl`, text: found.text, world: found.lines });
    notice(found.about, { seconds: 10, act: ['Back to mine', () => show(before)] });
  });
}

async function words() {
  editor.words = await (await fetch('words.json')).json();
}

/** A link has a program in it. */
async function opened() {
  const shared = location.hash.length > 1 ? await fromFragment(location.hash.slice(1)).catch(() => null) : null;
  if (location.hash.length > 1) {
    history.replaceState(null, '', location.pathname + location.search);
    if (!shared) notice('The link is not complete: its program cannot be read.', { bad: true });
  }
  if (shared) {
    const before = kept.text;
    show(shared);
    if (before && before !== shared.text) notice('This program came with the link.', { act: ['Back to mine', () => show(kept)] });
  } else show(kept.text ? kept : { name: 'my_robot.pl', text: FIRST });
}

addEventListener('hashchange', opened);
await opened();
await Promise.all([examples(), words()]);
if ('serviceWorker' in navigator) navigator.serviceWorker.register('offline.js').catch(() => {});

/** For tests. */
function state() {
  return { open: machine.open, program, name: name(), text: editor.text, world: machine.world, said: [...$('said').children].map((row) => [row.dataset.kind, row.textContent]) };
}
