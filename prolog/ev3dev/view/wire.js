// The line to the program. The page asks for each frame after it has drawn
// the last one, so a page that is hidden asks for nothing.

const FIRST_PAUSE = 300;
const LONGEST_PAUSE = 4000;
// Who has not answered for so long is not there: a brick that left the network says nothing.
const PATIENCE = 4000;

export class Wire {
  /** `on` has: state(name, why), frame(object), reply(object). */
  constructor(on) {
    this.on = on;
    this.pause = FIRST_PAUSE;
    this.have = '';
    this.socket = null;
    this.ended = '';
    this.connect();
    document.addEventListener('visibilitychange', () => {
      if (!document.hidden && !this.open) this.soon(0);
    });
  }

  get open() {
    return this.socket !== null && this.socket.readyState === WebSocket.OPEN;
  }

  connect() {
    clearTimeout(this.retry);
    const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`);
    this.socket = socket;
    const late = setTimeout(() => socket.close(), PATIENCE);
    socket.onopen = () => {
      clearTimeout(late);
      this.pause = FIRST_PAUSE;
      this.ended = '';
      this.have = '';
      this.on.state('live');
      this.next();
    };
    socket.onmessage = (event) => {
      if (socket === this.socket) this.take(JSON.parse(event.data));
    };
    socket.onclose = () => {
      clearTimeout(late);
      if (socket === this.socket) this.lost();
    };
  }

  take(message) {
    if (message.type === 'frame') {
      this.have = message.have;
      this.on.frame(message);
    } else if (message.type === 'bye') {
      this.ended = message.why;
    } else {
      this.on.reply(message);
    }
  }

  next() {
    this.send(this.have ? `next ${this.have}` : 'next');
  }

  send(line) {
    if (!this.open) return false;
    this.socket.send(line);
    return true;
  }

  /** By the socket; if that is not there, by a request of its own. */
  stop() {
    if (!this.send('stop')) fetch('stop', { method: 'POST' }).catch(() => {});
  }

  async lost() {
    this.socket = null;
    this.on.state('lost', this.ended);
    // A socket does not say why it was refused; a request does.
    const answer = await fetch('icon.svg', { cache: 'no-store', signal: AbortSignal.timeout(PATIENCE) }).catch(() => null);
    if (this.socket !== null) return;
    if (answer && answer.status === 403) this.on.state('refused', this.ended);
    this.soon(this.pause);
    this.pause = Math.min(LONGEST_PAUSE, this.pause * 1.7);
  }

  soon(delay) {
    clearTimeout(this.retry);
    this.retry = setTimeout(() => {
      if (document.hidden) return;
      if (this.socket === null) this.connect();
    }, delay);
  }
}
