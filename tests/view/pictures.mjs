// Makes the pictures of README.md and docs/view.md: docs/pictures/*.png.

import fs from 'node:fs';
import path from 'node:path';
import { Session, browse, home, open, shows } from './session.mjs';
import { encode } from './png.mjs';

const folder = path.join(home, 'docs/pictures');
const LARGEST = 60000;

/** Runs an example for simulated seconds at once, and then on as at x1. */
async function runs(session, page, goal, seconds) {
  session.type(`sim_at(${seconds}, ev3dev_native:view_pace_(1)), (${goal})`);
  await shows(page, (s) => s.time > seconds + 1.5, `${seconds} s of ${goal}`, 120);
}

const PICTURES = [
  {
    name: 'view', world: 'room', example: 'obstacle_avoidance', goal: 'start', seconds: 33,
    shots: [{ name: 'view-light' }, { name: 'view-phone', width: 390, height: 844, phone: true, scale: 1 }],
  },
  { name: 'grid', world: 'grid', example: 'grid_navigation', goal: 'start([7, 7])', seconds: 26, shots: [{ name: 'view-grid', scheme: 'dark' }] },
  {
    name: 'line', world: 'line', example: 'line_following', goal: 'start', seconds: 24,
    prepare: ['view_watch(\'left wheel\', outB-speed)'],
    shots: [{ name: 'view-charts', clip: '.charts-card', width: 1100, height: 1000 }],
  },
];

const browser = await browse();
fs.mkdirSync(folder, { recursive: true });
for (const { world, example, goal, seconds, prepare = [], shots } of PICTURES) {
  const session = await Session.start(`sim_start(${world}, [clock(virtual), noise(true), seed(7)])`, `load_files(user:examples/${example}, [])`);
  const url = await session.view();
  for (const query of prepare) await session.ask(query);
  const pages = [];
  for (const shot of shots) pages.push(await open(browser, url, shot));
  await pages[0].bringToFront();
  await runs(session, pages[0], goal, seconds);
  for (const [i, { name, clip, width = 1280, height = 800 }] of shots.entries()) {
    const page = pages[i];
    await page.bringToFront();
    await shows(page, (s) => s.time > seconds, 'the newest frame');
    const shot = await (clip ? await page.$(clip) : page).screenshot({ encoding: 'base64' });
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
    const file = path.join(folder, `${name}.png`);
    fs.writeFileSync(file, png);
    console.log(`${path.relative(home, file)}: ${picture.width} x ${picture.height}, ${png.length} bytes (${width} x ${height})`);
  }
  for (const page of pages) await page.close();
  await session.end();
}
await browser.close();
