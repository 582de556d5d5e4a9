// Prolog in its worker, as the page uses it.

/** After so long, in milliseconds, another worker begins to compute beside one that does not
    answer STOP: what has not answered when that is done computes without a pause, and is ended. */
const PATIENCE = 60;
/** So long nobody may ask for a frame, as a view that is not seen does not; then the page does. */
const UNSEEN = 250;

const HOME = '/home/web_user/';

export class Machine {
  /** `on` has: begins(), took(message), runs(), ends(why), and `heard(message)`, of each that is no frame. */
  constructor(on) {
    this.on = on;
    this.view = null;
    this.have = '';
    this.asked = 0;
    this.open = false;
    /** What made the world as it is: lines that begin it again; and those that are not answered yet. */
    this.world = [];
    this.begun = [];
    /** Where the robot stands; and how often STOP was pressed while nothing had answered. */
    this.pose = null;
    this.stops = 0;
    this.beside = new Worker('patience.js');
    this.beside.onmessage = ({ data }) => {
      if (data === this.stops) this.fails('The program computed without a pause, so it was ended. Prolog was started again; your text is unchanged, and the robot stands where it was.');
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
    if (typeof data !== 'string') {
      if (data.ready) this.begins();
      else this.fails(data.fault);
      return;
    }
    // Nobody has chosen the folder in which the program is.
    const message = JSON.parse(data.replaceAll(HOME, ''));
    if (message.type === 'frame') {
      this.have = message.have;
      this.pose = message.robot?.true;
      this.frames += 1;
      if (this.frames <= this.before) message.program = { ...message.program, state: 'running' };
      this.on.took(message);
      // Goals are typed beside the program.
      delete message.goals;
      this.view?.take(message);
      return;
    }
    if (message.what === 'stop') this.answers();
    if (message.what === 'begin' || message.what === 'choose') this.remember(message.type === 'done', this.begun.shift());
    if (!this.on.heard(message)) this.view?.take(message);
  }

  begins() {
    this.open = true;
    this.have = '';
    /** Frames that were asked for, and that came; those up to `before` do not know what was begun last. */
    [this.wanted, this.frames, this.before] = [0, 0, 0];
    const { world, pose } = this;
    this.world = [];
    this.begun = [];
    for (const line of world) this.send(line);
    if (pose) this.send(`place ${pose.join(' ')}`);
    this.on.begins();
    this.view?.begins();
  }

  /** The live view is there. */
  show(view) {
    this.view = view;
    if (this.open) view.begins();
  }

  next(have) {
    this.asked = performance.now();
    this.wanted += 1;
    this.send(have ? `next ${have}` : 'next');
  }

  send(line) {
    if (!this.open) return false;
    if (/^(choose|begin) /.test(line)) this.begun.push(line);
    this.worker.postMessage(line);
    if (/^(run|load|check|goal|more) /.test(line)) {
      this.before = this.wanted;
      this.on.runs();
    }
    return true;
  }

  /** A world that has begun, or a robot, takes the place of the former one. */
  remember(isDone, line) {
    const isRobot = (each) => /^choose robot /.test(each);
    if (isDone && line) this.world = [...this.world.filter((other) => isRobot(other) !== isRobot(line)), line];
    this.on.worldChanged();
  }

  stop() {
    if (!this.open) return;
    this.send('stop');
    if (this.late) return;
    this.late = setTimeout(() => this.beside.postMessage(this.stops), PATIENCE);
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
