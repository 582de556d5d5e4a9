// The text of the program, with the clauses and the rule that are active. The program is
// asked for them only while this is open.

import { $, attribute, el, icon, notice, toggle } from './dom.js';

export class Program {
  constructor(send) {
    this.send = send;
    this.open = false;
    this.file = null;
    this.text = null;
    this.lines = [];
    this.marked = [];
    this.here = $('program-open');
    this.here.addEventListener('click', () => this.turn(!this.open));
    const close = el('button', { class: 'tool', title: 'Back to the ports', 'aria-label': 'Back to the ports', onclick: () => this.turn(false) }, icon('close'));
    this.files = el('select', { 'aria-label': 'File of the program', hidden: true });
    this.files.addEventListener('change', () => this.read(this.files.value));
    this.title = el('h2', { id: 'program-title' }, 'Program');
    this.older = el('p', { class: 'hint-text', hidden: true }, 'The file was changed after it was loaded: make/0 loads it again.');
    this.list = el('ol', { class: 'code', tabIndex: 0, 'aria-labelledby': 'program-title' });
    $('program').append(el('header', {}, this.title, this.files, el('div', { class: 'actions' }, close)), this.older, this.list);
  }

  turn(open) {
    if (open) this.read(this.file);
    else {
      this.send('program off');
      this.show(false);
      this.here.focus();
    }
  }

  read(file) {
    this.wanted = true;
    this.send(file ? `program ${file}` : 'program');
  }

  show(open) {
    this.open = open;
    $('program').hidden = !open;
    toggle(document.body, 'reading', open);
    attribute(this.here, 'aria-expanded', open);
  }

  /** What the program answered; whether it was a question of ours. */
  reply({ type, what, why, ...more }) {
    if (what !== 'program') return false;
    if (type === 'refused') {
      // The file that was shown may be gone, and another one loaded.
      if (this.file && !this.open) this.read((this.file = null));
      else notice(why, { seconds: 6 });
    } else if (more.text !== undefined && this.wanted) this.fill(more);
    return true;
  }

  fill({ file, text, files, older }) {
    this.wanted = false;
    this.file = file;
    this.older.hidden = !older;
    this.files.hidden = files.length < 2;
    this.files.replaceChildren(...files.map((each) => el('option', { value: each, selected: each === file }, base(each))));
    this.title.textContent = files.length < 2 ? base(file) : 'Program';
    const lines = colored(text.replace(/\n$/, ''));
    this.lines = lines.map((parts) => el('li', {}, el('code', {}, ...(parts.length ? parts : [' ']))));
    this.text = text.split('\n');
    this.list.replaceChildren(...this.lines);
    this.marked = [];
    this.key = '';
    this.loaded = this.model?.loaded ?? null;
    this.show(true);
    if (this.model) this.take(this.model);
  }

  /** Another moment: what is active then. */
  take(model) {
    this.model = model;
    if (!this.open) return;
    if (this.loaded !== model.loaded) {
      // A file was loaded again.
      this.loaded = model.loaded;
      this.read(this.file);
    }
    const active = model.active ?? [];
    const key = JSON.stringify(active);
    if (key === this.key) return;
    this.key = key;
    // The clause that runs may stand in another file.
    const [first] = active;
    if (first && first.file !== this.file && !active.some((each) => each.file === this.file) && [...this.files.options].some((each) => each.value === first.file)) {
      this.read(first.file);
      return;
    }
    for (const line of this.marked) {
      line.className = '';
      attribute(line, 'aria-current', null);
    }
    this.marked = [];
    active.filter((each) => each.file === this.file).reverse().forEach((each, i, all) => this.mark(each, i === all.length - 1));
    const now = this.list.querySelector('.called[aria-current]') ?? this.list.querySelector('[aria-current]');
    if (now && !this.list.matches(':hover')) {
      const top = now.offsetTop - this.list.offsetTop;
      const { scrollTop, clientHeight } = this.list;
      if (top < scrollTop || top + now.offsetHeight > scrollTop + clientHeight) this.list.scrollTop = top - clientHeight / 3;
    }
  }

  /** The lines of a clause; what it called, if that stands in one line of it only. */
  mark({ line, goal, rule }, innermost) {
    const clause = [];
    for (let i = line - 1; i < this.lines.length; i += 1) {
      clause.push(i);
      if (/(^|[^.\\])\.\s*(%.*)?$/.test(this.text[i])) break;
    }
    for (const i of clause) {
      this.lines[i].classList.add(rule ? 'rule' : innermost ? 'active' : 'outer');
      if (innermost) attribute(this.lines[i], 'aria-current', 'true');
      this.marked.push(this.lines[i]);
    }
    const called = goal ? clause.filter((i) => new RegExp(`(^|[^\\w$])${goal.replace(/[^\w]/g, '\\$&')}($|[^\\w])`).test(i === line - 1 ? this.text[i].replace(/^[^:]*:-/, '') : this.text[i])) : [];
    if (called.length === 1) this.lines[called[0]].classList.add('called');
  }
}

const TOKEN = /(\/\*[^]*?(?:\*\/|$)|%.*)|(0'(?:\\.|''|.)|'(?:[^'\\]|\\[^]|'')*'|"(?:[^"\\]|\\[^])*")|(\b[A-Z_]\w*)|(\b\d+(?:\.\d+)?)|(:-|-->|->|~>|::|\\\+)/g;
const COLORS = ['comment', 'text', 'variable', 'number', 'operator'];

/** The lines of a program, each as texts and elements that have a color. */
function colored(text) {
  const lines = [[]];
  const put = (words, kind) => words.split('\n').forEach((part, i) => {
    if (i) lines.push([]);
    if (part) lines.at(-1).push(kind ? el(kind === 'comment' ? 'i' : 'span', { class: kind }, part) : part);
  });
  let end = 0;
  for (const { 0: words, index, ...kinds } of text.matchAll(TOKEN)) {
    put(text.slice(end, index));
    put(words, COLORS.find((_, i) => kinds[i + 1] !== undefined));
    end = index + words.length;
  }
  put(text.slice(end));
  return lines;
}

const base = (file) => file.replace(/.*\//, '');
