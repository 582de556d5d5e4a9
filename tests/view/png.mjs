// A PNG with a palette: a fifth of the size of one in true color. The package pngjs writes no palettes.

import zlib from 'node:zlib';

const CRC = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k += 1) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  let crc = 0xffffffff;
  for (const byte of body) crc = CRC[(crc ^ byte) & 255] ^ (crc >>> 8);
  const whole = Buffer.alloc(body.length + 8);
  whole.writeUInt32BE(data.length, 0);
  body.copy(whole, 4);
  whole.writeUInt32BE((crc ^ 0xffffffff) >>> 0, body.length + 4);
  return whole;
}

/** Colors with how often they come: boxes are halved where they are widest. */
function palette(counts, size) {
  const widest = (box) => {
    let best = { spread: -1 };
    for (let k = 0; k < 3; k += 1) {
      let [low, high] = [255, 0];
      for (const [color] of box) {
        const part = (color >> (8 * k)) & 255;
        if (part < low) low = part;
        if (part > high) high = part;
      }
      if (high - low > best.spread) best = { spread: high - low, k };
    }
    // Rare colors count, too, or small things lose theirs.
    best.weight = best.spread * Math.cbrt(box.reduce((sum, [, n]) => sum + n, 0));
    return best;
  };
  const boxes = [{ box: [...counts], ...widest([...counts]) }];
  while (boxes.length < size) {
    boxes.sort((a, b) => b.weight - a.weight);
    const { box, k, spread } = boxes[0];
    if (spread <= 0) break;
    boxes.shift();
    box.sort((a, b) => ((a[0] >> (8 * k)) & 255) - ((b[0] >> (8 * k)) & 255));
    const half = box.reduce((sum, [, n]) => sum + Math.sqrt(n), 0) / 2;
    let at = 0;
    for (let sum = 0; at < box.length - 1 && sum < half; at += 1) sum += Math.sqrt(box[at][1]);
    at = Math.max(1, Math.min(box.length - 1, at));
    for (const part of [box.slice(0, at), box.slice(at)]) boxes.push({ box: part, ...widest(part) });
  }
  return boxes.map(({ box }) => {
    // The most frequent color of a box as it is: large areas keep theirs.
    let best = box[0];
    for (const each of box) if (each[1] > best[1]) best = each;
    const all = box.reduce((sum, [, n]) => sum + n, 0);
    if (best[1] > 0.3 * all) return best[0];
    return [0, 1, 2].reduce((color, k) => color
      | (Math.round(box.reduce((sum, [c, n]) => sum + ((c >> (8 * k)) & 255) * n, 0) / all) << (8 * k)), 0);
  });
}

/** RGBA bytes to a PNG of at most `colors` colors. */
export function encode(rgba, width, height, colors = 128) {
  const pixels = new Uint32Array(width * height);
  const counts = new Map();
  for (let i = 0; i < pixels.length; i += 1) {
    const color = rgba[4 * i] | (rgba[4 * i + 1] << 8) | (rgba[4 * i + 2] << 16);
    pixels[i] = color;
    counts.set(color, (counts.get(color) ?? 0) + 1);
  }
  const table = palette(counts, colors);
  const nearest = new Map();
  const index = (color) => {
    let best = nearest.get(color);
    if (best !== undefined) return best;
    let least = Infinity;
    table.forEach((each, i) => {
      let distance = 0;
      for (let k = 0; k < 3; k += 1) distance += (((each >> (8 * k)) & 255) - ((color >> (8 * k)) & 255)) ** 2;
      if (distance < least) [least, best] = [distance, i];
    });
    nearest.set(color, best);
    return best;
  };
  const rows = Buffer.alloc((width + 1) * height);
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) rows[y * (width + 1) + 1 + x] = index(pixels[y * width + x]);
  }
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  const plte = Buffer.from(table.flatMap((color) => [color & 255, (color >> 8) & 255, (color >> 16) & 255]));
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', head), chunk('PLTE', plte),
    chunk('IDAT', zlib.deflateSync(rows, { level: 9, memLevel: 9 })), chunk('IEND', Buffer.alloc(0))]);
}
