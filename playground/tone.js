// The brick's tone, by Web Audio.

const LOUDNESS = 0.05;

export class Tone {
  constructor() {
    this.hertz = 0;
  }

  /** Sounds at so many hertz from now on; 0 is silence. */
  take(hertz) {
    if (hertz === this.hertz) return;
    this.hertz = hertz;
    if (hertz > 0 && !this.oscillator) {
      this.context ??= new AudioContext();
      this.gain = new GainNode(this.context, { gain: LOUDNESS });
      this.oscillator = new OscillatorNode(this.context, { type: 'square' });
      this.oscillator.connect(this.gain).connect(this.context.destination);
      this.oscillator.start();
    }
    if (this.oscillator) {
      this.oscillator.frequency.value = hertz || this.oscillator.frequency.value;
      this.gain.gain.value = hertz > 0 ? LOUDNESS : 0;
    }
  }
}
