// Makes the pictures of README.md and docs/view.md: docs/pictures/*.png.

import { Session, browse, open, shows } from './session.mjs';
import { keep } from './keep.mjs';

/** Runs an example for simulated seconds at once, and then on as at x1. */
async function runs(session, page, goal, seconds) {
  session.type(`sim_at(${seconds}, ev3dev_native:view_pace_(1)), (${goal})`);
  await shows(page, (s) => s.time > seconds + 1.5, `${seconds} s of ${goal}`);
}

const PICTURES = [
  {
    name: 'view', world: 'room', example: 'obstacle_avoidance', goal: 'start', seconds: 33,
    shots: [{ name: 'view-light' }],
  },
  { name: 'grid', world: 'grid', example: 'grid_navigation', goal: 'start([7, 7])', seconds: 26, shots: [{ name: 'view-grid', scheme: 'dark' }] },
  {
    name: 'line', world: 'line', example: 'line_following', goal: 'start', seconds: 24,
    prepare: ['view_watch(\'left wheel\', outB-speed)'],
    shots: [{ name: 'view-charts', clip: '.charts-card', width: 1100, height: 1000 }],
  },
];

const browser = await browse();
for (const { world, example, goal, seconds, prepare = [], shots } of PICTURES) {
  const session = await Session.start(`sim_start(${world}, [clock(virtual), noise(true), seed(7)])`, `load_files(user:examples/${example}, [])`);
  const url = await session.view();
  for (const query of prepare) await session.ask(query);
  const pages = [];
  for (const shot of shots) pages.push(await open(browser, url, shot));
  await pages[0].bringToFront();
  await runs(session, pages[0], goal, seconds);
  for (const [i, { name, clip }] of shots.entries()) {
    const page = pages[i];
    await page.bringToFront();
    await shows(page, (s) => s.time > seconds, 'the newest frame');
    const shot = await (clip ? await page.$(clip) : page).screenshot({ encoding: 'base64' });
    await keep(browser, shot, name);
  }
  for (const page of pages) await page.close();
  session.prolog.kill();       // its program does not end
  await session.ended;
}
await browser.close();
