// Makes the pictures of docs/playground.md: docs/pictures/*.png.

import { listen } from './server.mjs';
import { browse, until } from '../view/session.mjs';
import { keep } from '../view/keep.mjs';

const server = await listen();
const browser = await browse();
const page = await browser.newPage();
await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'light' }]);
await page.setViewport({ width: 1300, height: 800 });
await page.goto(server.url);
const state = () => page.evaluate(() => window.ev3dev?.state());
const time = () => page.evaluate(() => document.getElementById('robot').contentWindow?.ev3view?.state().time).catch(() => null);
const take = async (name) => keep(browser, await page.screenshot({ encoding: 'base64' }), name);

await until(async () => (await state())?.open && await time() !== null, 'the robot');
await page.click('#run');
await until(async () => await time() > 14, 'some seconds');
await until(() => page.$('.cm-called'), 'the goal that was called');
await take('playground');

await page.click('#run');
await until(async () => (await state()).program.state === 'idle', 'the end');
await page.click('#said-clear');
await page.evaluate(() => {
  window.ev3dev.editor.text = `% Five mistakes, each at its line
:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    forward(20, 30),
    go_cm(20, Distance).

drive :-
    us_dist_cm(_, Cm)
    Cm > 30.
`;
});
await page.click('#run');
await until(async () => (await state()).said.length > 3, 'what is wrong');
await page.mouse.move(60, 240);
await take('playground-mistakes');
await browser.close();
server.close();
