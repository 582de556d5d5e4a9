// Another world or robot: those of the pack, and files beside the program. The simulation
// begins again with it.

import { $, el, notice } from './dom.js';

const KINDS = ['world', 'robot'];

export class Choices {
  constructor(send, hands) {
    this.send = send;
    this.hands = hands;
    this.wanted = null;
  }

  take(model) {
    this.model = model;
  }

  /** Entries of the menu of the simulation, which lead to lists. */
  entries() {
    const onclick = (kind) => () => {
      this.wanted = kind;
      this.send('worlds');
    };
    return KINDS.map((kind) => el('button', { onclick: onclick(kind) }, `Another ${kind} …`));
  }

  /** What the program answered; whether it was a question of ours. */
  reply({ type, what, why, ...more }) {
    if (what === 'worlds') this.list(more);
    else if (what !== 'choose') return false;
    else if (type === 'refused') notice(why, { seconds: 8 });
    else notice('The robot stands at the start.', { seconds: 3 });
    return true;
  }

  list({ worlds, robots, robot }) {
    const kind = this.wanted;
    this.wanted = null;
    if (!kind || $('more-menu').hidden) return;
    const now = kind === 'world' ? this.model.simulated && this.model.name : robot;
    const row = ({ name, from }) => {
      const chosen = name.replace(/\.pl$/, '') === now;
      const onclick = () => {
        this.hands.close();
        this.send(`choose ${kind} ${from} ${name}`);
      };
      return el('button', { onclick, class: 'radio', role: 'radio', 'aria-checked': chosen }, name);
    };
    const all = kind === 'world' ? worlds : robots;
    const group = (from, words) => {
      const some = all.filter((each) => each.from === from);
      return some.length ? [el('div', { role: 'radiogroup', 'aria-label': words }, el('p', {}, words), ...some.map(row))] : [];
    };
    $('more-menu').replaceChildren(...group('file', 'Beside the program'), ...group('pack', kind === 'world' ? 'Worlds of the pack' : 'Robots of the pack'));
    ($('more-menu').querySelector('[aria-checked=true]') ?? $('more-menu').querySelector('button'))?.focus();
  }
}
