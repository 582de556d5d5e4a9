// Prolog in its worker, as the page uses it.

/** After so long, in milliseconds, another worker begins to compute beside one that does not
    answer STOP: what has not answered after so many rounds computes without a pause, and is ended.
    Less is enough for one that has said nothing since it was asked for so many frames: it sends one
    a second at least. */
const PATIENCE = { wait: 40, rounds: 1.2e7 };
const IMPATIENCE = { wait: 20, rounds: 1e6, frames: 6 };
/** So long nobody may ask for a frame, as a view that is not seen does not; then the page does. */
const UNSEEN = 250;

/** Folders of which nobody needs to know: that of the program, and those of the pack. */
const FOLDERS = /\/(home\/web_user|pack(\/prolog|\/course)?)\b\/?/g;

/** Words of the lines by which hands change a world, and of those that begin another one. */
const HANDS = ['add', 'move', 'remove', 'unplug', 'plug', 'hold', 'free'];
const isHand = (line) => HANDS.includes(line.split(' ', 1)[0]);
const isRobot = (line) => line.startsWith('choose robot ');
const WORLDS = ['begin', 'choose'];
const nameOf = (line) => line?.split(' ')[line.startsWith('begin') ? 1 : 3];

export class Machine {
  /** `on` has: begins(), took(message), runs(), ends(why), and `heard(message)`, of each that is no frame. */
  constructor(on) {
    this.on = on;
    this.view = null;
    this.have = '';
    this.asked = 0;
    this.open = false;
    /** What made the world as it is: lines that begin it again, and what hands did to it then;
        and those lines that are not answered yet. */
    this.world = [];
    this.hands = [];
    this.begun = [];
    /** The world, where the robot stands, and how often STOP was pressed while nothing had answered. */
    this.name = null;
    this.pose = null;
    this.stops = 0;
    this.beside = new Worker('patience.js');
    this.beside.onmessage = ({ data }) => {
      if (data.stops === this.stops) this.fails('The program computed without a pause, so STOP has started Prolog again: your text, the world and the robot\u2019s place are as they were, but facts that a program added are gone.');
    };
    this.start();
    setInterval(() => {
      if (this.open && performance.now() - this.asked > UNSEEN) this.next(this.have);
    }, UNSEEN);
  }

  start() {
    this.worker = new Worker('worker.js');
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => this.take({ fault: event.message });
  }

  take(data) {
    this.unheard = 0;
    if (typeof data !== 'string') {
      if (data.ready) this.begins();
      else this.fails(data.fault);
      return;
    }
    const message = JSON.parse(data.replace(FOLDERS, ''));
    if (message.type === 'frame') {
      this.have = message.have;
      this.pose = message.robot?.true;
      this.name = message.name ?? this.name;
      this.frames += 1;
      if (this.frames <= this.before) message.program = { ...message.program, state: 'running' };
      this.on.took(message.new && this.all && this.frames > 1 ? { ...message, new: false } : message);
      if (message.new) this.all = false;
      // Goals are typed beside the program.
      delete message.goals;
      this.view?.take(message);
      return;
    }
    if (message.what === 'stop') this.answers();
    this.remember(message);
    if (!this.on.heard(message)) this.view?.take(message);
  }

  begins() {
    this.open = true;
    this.have = '';
    /** Frames that were asked for, and that came; those up to `before` do not know what was begun last. */
    [this.wanted, this.frames, this.before] = [0, 0, 0];
    const { lines, isOwn, name, pose } = this;
    [this.world, this.hands, this.begun] = [[], [], []];
    for (const line of lines) this.send(line);
    if (!isOwn) this.send(`choose world pack ${name}`);
    if (pose) this.send(`place ${pose.join(' ')}`);
    this.on.begins();
    this.view?.begins();
  }

  /** A program may have begun another world than the page. */
  get isOwn() {
    return !this.name || this.name === (nameOf(this.world.findLast((line) => !isRobot(line))) ?? 'room');
  }

  /** What makes the world of the page as it is: lines that begin it, and what hands did to it. */
  get lines() {
    return [...this.world, ...this.isOwn ? this.hands : []];
  }

  set lines(lines) {
    this.world = lines.filter((line) => !isHand(line));
    this.hands = lines.filter(isHand);
  }

  /** The live view is there. */
  show(view) {
    this.view = view;
    if (this.open) view.begins();
  }

  next(have) {
    this.asked = performance.now();
    this.wanted += 1;
    // The live view that comes later asks for all that was there before.
    this.all ||= !have;
    this.unheard += 1;
    this.send(have ? `next ${have}` : 'next');
  }

  send(line) {
    if (!this.open) return false;
    if (isHand(line) || WORLDS.includes(line.split(' ', 1)[0])) this.begun.push(line);
    this.worker.postMessage(line);
    if (/^(run|load|check|goal|more) /.test(line)) {
      this.before = this.wanted;
      this.on.runs();
    }
    return true;
  }

  /** A world that has begun, or a robot, takes the place of the former one. */
  remember({ type, what }) {
    const at = this.begun.findIndex((line) => line.startsWith(`${what} `));
    const [line] = at < 0 ? [] : this.begun.splice(at, 1);
    if (type !== 'done') return;
    if (what === 'reset') this.hands = [];
    else if (HANDS.includes(what)) this.hands.push(line);
    else if (line) {
      this.world = [...this.world.filter((other) => isRobot(other) !== isRobot(line)), line];
      this.hands = [];
    }
    if (line || what === 'reset') this.on.worldChanged();
  }

  stop() {
    if (!this.open) return;
    this.send('stop');
    if (this.late) return;
    const { wait, rounds } = this.unheard > IMPATIENCE.frames ? IMPATIENCE : PATIENCE;
    this.late = setTimeout(() => this.beside.postMessage({ stops: this.stops, rounds }), wait);
  }

  /** STOP is waited for no more. */
  answers() {
    clearTimeout(this.late);
    this.late = null;
    this.stops += 1;
  }

  /** Begins again with another worker. */
  fails(why) {
    this.answers();
    const before = this.open;
    this.open = false;
    this.worker.terminate();
    this.view?.ends();
    this.on.ends(why);
    if (before) this.start();
  }
}
