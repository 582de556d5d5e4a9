// The editor of the program.

import { acceptCompletion, autocompletion, completionStatus, selectedCompletionIndex, setSelectedCompletion } from '@codemirror/autocomplete';
import { indentLess, indentMore } from '@codemirror/commands';
import { HighlightStyle, indentUnit, syntaxHighlighting } from '@codemirror/language';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { EditorState, StateEffect, StateField } from '@codemirror/state';
import { Decoration, EditorView, hoverTooltip, keymap } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { basicSetup } from 'codemirror';
import { prolog } from 'codemirror-lang-prolog';

const colors = HighlightStyle.define([
  { tag: tags.comment, color: 'var(--soft)', fontStyle: 'italic' },
  { tag: tags.variableName, color: 'var(--s2)' },
  { tag: [tags.string, tags.literal], color: 'var(--s5)' },
  { tag: tags.number, color: 'var(--s1)' },
  { tag: [tags.operator, tags.keyword], color: 'var(--s4)' },
]);

const look = EditorView.theme({
  '&': { height: '100%', fontSize: '14px', color: 'var(--ink)', backgroundColor: 'var(--card)' },
  '.cm-scroller': { fontFamily: 'var(--mono)', lineHeight: '1.45' },
  '.cm-gutters': { backgroundColor: 'var(--card)', color: 'var(--soft)', border: 'none' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'color-mix(in srgb, var(--focus) 8%, transparent)' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)' },
  '&.cm-focused': { outline: 'none' },
  '&.cm-focused .cm-selectionBackground, .cm-selectionBackground, ::selection': { backgroundColor: 'color-mix(in srgb, var(--focus) 25%, transparent) !important' },
  '.cm-tooltip, .cm-panels': { backgroundColor: 'var(--raised)', color: 'var(--ink)', border: '1px solid var(--line)', maxWidth: '440px' },
  '.cm-tooltip .about': { padding: '6px 10px', fontFamily: 'var(--sans)', fontSize: '13px' },
  '.cm-tooltip .about b': { fontFamily: 'var(--mono)', display: 'block' },
  '.cm-runs': { backgroundColor: 'color-mix(in srgb, var(--green) 14%, transparent)' },
  '.cm-called': { backgroundColor: 'color-mix(in srgb, var(--green) 30%, transparent)' },
  '.cm-rule': { boxShadow: 'inset 3px 0 var(--amber)' },
});

const marks = StateEffect.define();
const marked = StateField.define({
  create: () => Decoration.none,
  update: (value, { docChanged, changes, effects }) => effects.reduce((now, effect) => (effect.is(marks) ? effect.value : now), docChanged ? value.map(changes) : value),
  provide: (field) => EditorView.decorations.from(field),
});

export const LEAVE = 'Tab indents here. Escape, then Tab, goes on to the next control.';

/** Takes what is chosen in the list of completions, or the first one. */
function complete(view) {
  if (completionStatus(view.state) !== 'active') return false;
  if (selectedCompletionIndex(view.state) === null) view.dispatch({ effects: setSelectedCompletion(0) });
  return acceptCompletion(view);
}

export class Text {
  /** `changed` is called after each change, `indented` when Tab has done so; `words` are the
      predicates to offer, by name. */
  constructor(parent, { changed, indented, run, words }) {
    this.words = words;
    this.key = '';
    const offered = (context) => {
      const word = context.matchBefore(/[a-z]\w*/);
      if (!word && !context.explicit) return null;
      return { from: word?.from ?? context.pos, options: this.words.map(({ name, template, about }) => ({ label: name, detail: template.slice(name.length), info: about, type: 'function' })), validFor: /^\w*$/ };
    };
    const about = hoverTooltip((view, at) => {
      const { from, to, text } = view.state.doc.lineAt(at);
      let [begin, end] = [at, at];
      while (begin > from && /\w/.test(text[begin - from - 1])) begin -= 1;
      while (end < to && /\w/.test(text[end - from])) end += 1;
      const found = this.words.filter(({ name }) => name === text.slice(begin - from, end - from));
      if (!found.length) return null;
      return { pos: begin, end, above: true, create: () => {
        const dom = document.createElement('div');
        for (const each of found) {
          const box = dom.appendChild(document.createElement('div'));
          box.className = 'about';
          box.append(Object.assign(document.createElement('b'), { textContent: each.template }), each.about);
        }
        return { dom };
      } };
    });
    const indent = (view) => {
      indented();
      return indentMore(view);
    };
    this.view = new EditorView({
      parent,
      state: EditorState.create({ extensions: [
        // Enter makes a new line, unless the arrow keys have chosen a completion. Escape, then Tab, leaves the editor.
        keymap.of([
          { key: 'Mod-Enter', run: () => { run(); return true; } },
          { key: 'Tab', run: (view) => complete(view) || indent(view), shift: indentLess },
        ]),
        basicSetup, prolog(), syntaxHighlighting(colors), look, marked, lintGutter(), about,
        autocompletion({ override: [offered], activateOnTyping: true, defaultKeymap: true, selectOnOpen: false, interactionDelay: 0 }),
        EditorState.tabSize.of(4), indentUnit.of('    '),
        EditorView.contentAttributes.of({ 'aria-label': 'The program', 'aria-description': LEAVE }),
        EditorView.updateListener.of((update) => { if (update.docChanged) changed(); }),
      ] }),
    });
    // Also by keys, where lines are longer than it is wide
    this.view.scrollDOM.tabIndex = 0;
  }

  get text() {
    return this.view.state.doc.toString();
  }

  set text(text) {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, selection: { anchor: 0 }, scrollIntoView: true });
    this.errors([]);
  }

  line(number) {
    const { doc } = this.view.state;
    return doc.line(Math.max(1, Math.min(doc.lines, number)));
  }

  /** What was said of lines. */
  errors(all) {
    this.view.dispatch(setDiagnostics(this.view.state, all.map(({ line, kind, text }) => {
      const { from, to, text: words } = this.line(line);
      return { from: from + (words.length - words.trimStart().length), to, severity: kind, message: text };
    })));
  }

  goTo(number) {
    const { from } = this.line(number);
    this.view.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: 'center' }) });
    this.view.focus();
  }

  /** The clauses that are active now, of this file: the innermost first. */
  active(clauses) {
    const key = JSON.stringify(clauses);
    if (key === this.key) return;
    this.key = key;
    const { doc } = this.view.state;
    const lines = new Map();
    clauses.forEach(({ line, goal, rule }, i) => {
      const end = endOf(doc, line);
      for (let n = line; n <= end; n += 1) {
        if (rule) lines.set(n, 'cm-rule');
        else if (i === 0 || clauses[i - 1]?.rule) lines.set(n, lines.get(n) ?? 'cm-runs');
      }
      if (!goal || rule) return;
      const word = new RegExp(`(^|[^\\w])${goal.replace(/[^\w]/g, '\\$&')}($|[^\\w])`);
      const called = [];
      for (let n = line; n <= end; n += 1) if (word.test(n === line ? doc.line(n).text.replace(/^.*?:-/, '') : doc.line(n).text)) called.push(n);
      if (called.length === 1) lines.set(called[0], 'cm-called');
    });
    const found = [...lines].filter(([n]) => n <= doc.lines).sort(([a], [b]) => a - b);
    this.view.dispatch({ effects: marks.of(Decoration.set(found.map(([n, name]) => Decoration.line({ class: name }).range(doc.line(n).from)))) });
  }
}

/** The line in which the clause ends that begins in one. */
function endOf(doc, line) {
  let end = line;
  while (end < doc.lines && !/(^|[^.\\])\.\s*(%.*)?$/.test(doc.line(end).text)) end += 1;
  return end;
}
