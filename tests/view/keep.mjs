// Keeps a picture of a page in docs/pictures, with few colors.

import fs from 'node:fs';
import path from 'node:path';
import { encode } from './png.mjs';
import { home } from './session.mjs';

const folder = path.join(home, 'docs/pictures');
const LARGEST = 60000;

/** Writes a screenshot, in base64, as docs/pictures/NAME.png. */
export async function keep(browser, shot, name) {
  // Decoded by the browser itself, in a page without a policy.
  const desk = await browser.newPage();
  const picture = await desk.evaluate(async (data) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data: bytes } = context.getImageData(0, 0, image.width, image.height);
    let text = '';
    for (let k = 0; k < bytes.length; k += 8192) text += String.fromCharCode(...bytes.subarray(k, k + 8192));
    return { width: image.width, height: image.height, bytes: btoa(text) };
  }, shot);
  await desk.close();
  let colors = 192;
  let png;
  do {
    png = encode(Buffer.from(picture.bytes, 'base64'), picture.width, picture.height, colors);
    colors = Math.floor(colors * 0.75);
  } while (png.length > LARGEST && colors >= 24);
  fs.mkdirSync(folder, { recursive: true });
  const file = path.join(folder, `${name}.png`);
  fs.writeFileSync(file, png);
  console.log(`${path.relative(home, file)}: ${picture.width} x ${picture.height}, ${png.length} bytes`);
}
