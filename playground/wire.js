// The line of the live view to the program, in the playground: the page around it has a worker in
// which Prolog runs, see bench.js. In the place of view/wire.js, with the same members.

// Its address alone has no Prolog: the page around it is meant.
if (window.parent === window) {
  location.replace('../');
  await new Promise(() => {});
}
const { machine } = window.parent.ev3dev;

// The text of the program is beside the view.
document.getElementById('program-open').hidden = true;
document.querySelector('.brand').classList.add('sr');

export class Wire {
  /** `on` has: state(name, why), frame(object), reply(object). */
  constructor(on) {
    this.on = on;
    this.have = '';
    machine.show(this);
  }

  get open() {
    return machine.open;
  }

  /** Prolog runs, or does no more. */
  begins() {
    this.have = '';
    this.on.state('live');
    this.next();
  }

  ends() {
    this.on.state('lost', '');
  }

  take(message) {
    if (message.type === 'frame') {
      this.have = message.have;
      this.on.frame(message);
    } else this.on.reply(message);
  }

  next() {
    machine.next(this.have);
  }

  send(line) {
    return machine.send(line);
  }

  stop() {
    machine.stop();
  }
}
