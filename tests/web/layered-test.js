// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Layered scenes in a browser: what a head sees from its places is sent to result/NAME, for C++ to judge; the rest is
// judged here. testLayered(job) runs a part, and throws an error if it fails.
import { Glb } from './glb.js';
import { Headset } from './headset.js';
import { Panorama } from './panorama.js';
import { Player } from './player.js';
import { readScene } from './layered.js';

const sleep = (time) => new Promise((done) => setTimeout(done, time));
const bytesOf = async (address) => (await fetch(address)).arrayBuffer();

function expect(is, what) {
  if (!is) throw new Error(`layered: ${what}`);
}

async function until(is, what) {
  for (let i = 0; i < 1200; i++) {
    if (is()) return;
    await sleep(50);
  }
  throw new Error(`layered: never ${what}`);
}

async function sendCanvas(canvas, name) {
  await fetch(`result/${name}`, { method: 'POST', body: await new Promise((done) => canvas.toBlob(done)) });
}

// A player as the page has one.
async function makePlayer({ width, height }) {
  const box = document.body.appendChild(Object.assign(document.createElement('div'), { id: 'player' }));
  const picture = box.appendChild(Object.assign(document.createElement('div'), { id: 'picture', tabIndex: 0 }));
  Object.assign(picture.style, { position: 'relative', width: `${width}px`, height: `${height}px` });
  const view = await (await fetch('view.json')).json();
  const player = new Player(box, document, { view, base: location.href, keys: document, isPage: true });
  player.viewer.wake(new Panorama());
  return player;
}

async function open(player, item) {
  let reason;
  player.viewer.addEventListener('failed', ({ detail }) => (reason = detail), { once: true });
  await player.viewer.open(item);
  expect(player.viewer.picture, reason);
}

async function draw({ looks, ...size }) {
  const player = await makePlayer(size);
  const { viewer } = player;
  for (const { name, item, time, ...look } of looks) {
    if (viewer.item !== item) await open(player, item);
    viewer.picture.film?.pause();
    viewer.picture.film?.show(time);
    viewer.set({ yaw: 0, pitch: 0, fov: 90, x: 0, y: 0, z: 0, mode: 'left', shift: 0, ...look });
    viewer.fit();
    viewer.paint(0, {});
    await sendCanvas(viewer.canvas, name);
  }
}

// --- keys, drags and links ------------------------------------------------------------------------------------------

const press = (key, shiftKey = false) => document.dispatchEvent(new KeyboardEvent('keydown', { key, shiftKey, bubbles: true, cancelable: true }));

function drag(element, [dx, dy], { shiftKey = false, pointers = 1 } = {}) {
  const at = (type, id, x, y) => element.dispatchEvent(new PointerEvent(type, { pointerId: id, clientX: x, clientY: y, shiftKey, bubbles: true, button: 0 }));
  element.setPointerCapture = () => {};
  for (let id = 1; id <= pointers; id++) at('pointerdown', id, 40 * id, 40);
  for (let id = 1; id <= pointers; id++) at('pointermove', id, 40 * id + dx, 40 + dy);
  for (let id = 1; id <= pointers; id++) at('pointerup', id, 40 * id + dx, 40 + dy);
}

async function move({ item, other, half, ...size }) {
  const player = await makePlayer(size);
  const { viewer, viewer: { state } } = player;
  await open(player, item);
  const at = () => [state.x, state.y, state.z].map((value) => Math.round(value * 1e4) / 1e4).join();
  const back = () => viewer.set({ x: 0, y: 0, z: 0, yaw: 0, pitch: 0 });
  const after = (keys, expected) => {
    back();
    for (const key of keys) press(key, key === 'W' || key === 'Q');
    expect(at() === expected, `${keys} lead to ${at()}`);
  };
  after('ww', '0,0,-0.02');
  after('saa', '-0.02,0,0.01');
  after('dee', '0.01,0.02,0');
  after('qWQ', '0,-0.012,-0.002');
  back();
  viewer.set({ yaw: 90 });
  press('w');
  expect(at() === '0.01,0,0', `ahead to the right is ${at()}`);
  expect(!state.planet && !state.swap && state.yaw === 90, 'the keys of pictures act, too');
  back();
  const { element } = viewer;
  const metre = (2 * Math.tan(Math.PI / 4)) / size.width; // of a pixel, a metre away
  drag(element, [10, 0], { shiftKey: true });
  expect(Math.abs(state.x + 10 * metre) < 1e-3 && state.yaw === 0, `Shift and a drag lead to ${at()}`);
  back();
  drag(element, [8, 6], { pointers: 2 });
  expect(Math.abs(state.x + 8 * metre) < 0.015 && Math.abs(state.y - 6 * metre) < 0.015, `two fingers lead to ${at()}`);
  back();
  drag(element, [10, 0]);
  expect(state.x === 0 && state.yaw < 0, 'a drag does not turn the head');
  back();
  for (let i = 0; i < 60; i++) press('e');
  expect(Math.abs(state.y - half) < 1e-6, `the box ends at ${state.y}`);
  press('0');
  expect(at() === '0,0,0', 'recentre does not lead to the middle');
  const { readState, writeState } = await import('./state.js');
  viewer.set({ x: 0.0525, z: -0.011 });
  const hash = writeState({ item, look: state, choice: {} });
  expect(/&x=0.053&z=-0.011&/.test(hash) && readState(hash).look.z === -0.011, `a link is ${hash}`);
  await player.help();
  expect(/Move the head \(Shift: finely\)/.test(document.getElementById('keys').textContent) && !/little planet/i.test(document.getElementById('keys').textContent), 'the help has other keys');
  document.getElementById('help').close();
  const isShown = (id) => !document.getElementById(`${id}-row`).hidden;
  expect(!isShown('planet') && !isShown('layout') && isShown('fov'), 'settings that do nothing');
  await open(player, other);
  expect(at() === '0,0,0' && isShown('planet'), 'another picture has the place of the scene');
  press('s');
  expect(state.swap, 'keys of pictures do nothing in pictures');
}

// --- files ----------------------------------------------------------------------------------------------------------

// Every compressed view is what its plain twin is; damaged ones are found, or are as long as they should be.
async function decodeAll({ item, plain }) {
  const glb = new Glb(await bytesOf(item));
  const twins = new Uint8Array(await bytesOf(plain));
  let at = 0;
  for (const i of glb.json.bufferViews.keys()) {
    const bytes = glb.view(i);
    if (!glb.json.bufferViews[i].extensions) continue;
    expect(bytes.every((byte, k) => byte === twins[at + k]), `view ${i} is another one`);
    at += bytes.length;
  }
  expect(at === twins.length && at > 1000, `${at} bytes, and not ${twins.length}`);
}

async function damage({ item, count }) {
  const whole = new Uint8Array(await bytesOf(item));
  let seed = 1;
  const random = (below) => {
    seed = (seed * 16807) % 2147483647;
    return seed % below;
  };
  let found = 0;
  for (let i = 0; i < count; i++) {
    const bytes = whole.slice(0, i % 5 ? whole.length : random(whole.length));
    for (let k = 0; k < 3; k++) bytes[random(i % 2 ? 6000 : bytes.length)] ^= 1 << random(8);
    try {
      readScene(bytes.buffer);
    } catch (error) {
      found++;
      expect(!error.message.includes('\n'), error.message);
    }
  }
  expect(found > count / 3, `${found} of ${count} damaged files are found`);
  return `${found} of ${count}`;
}

async function fail({ items, words, ...size }) {
  const player = await makePlayer(size);
  for (const [i, item] of items.entries()) {
    await player.viewer.open(item);
    const said = document.getElementById('message').textContent;
    expect(!player.viewer.picture && said.includes(words[i]) && !said.includes('\n'), `file ${i} says: ${said}`);
  }
}

// --- the element and the headset ------------------------------------------------------------------------------------

async function useElement({ src, name, width, height }) {
  await new Promise((done) => document.head.append(Object.assign(document.createElement('script'), { src: 'stereo-360.js', onload: done })));
  const element = Object.assign(document.createElement('stereo-360'), { src });
  Object.assign(element.style, { display: 'block', width: `${width}px`, height: `${height}px` });
  element.setAttribute('loading', 'eager');
  const failed = new Promise((done, fail) => element.addEventListener('error', ({ detail }) => fail(new Error(detail.message))));
  document.body.append(element);
  await Promise.race([failed, until(() => element.loaded, 'loads')]);
  element.lookAt({ x: 0.1, yaw: 10 });
  element.viewer.paint(0, {});
  await sendCanvas(element.viewer.canvas, name);
}

// position: metres from where the session began; walked: where it began.
async function wear({ item, looks, width, height }) {
  Object.defineProperties(window, { innerWidth: { value: width }, innerHeight: { value: height } }); // of the canvas
  const { XRDevice, metaQuest3 } = await import('./iwer.module.js');
  const device = new XRDevice(metaQuest3);
  device.installRuntime({ forceInstall: true });
  device.stereoEnabled = true;
  device.fovy = Math.PI / 2;
  const from = [3, 1.6, -2];
  const player = await makePlayer({ width, height });
  const { viewer } = player;
  await open(player, item);
  const headset = new Headset(viewer, {});
  const frames = (count) => new Promise((done) => {
    const next = () => (count-- > 0 && headset.session ? headset.session.requestAnimationFrame(next) : done());
    next();
  });
  const stand = ([x, y, z], yaw) => {
    device.position.set(from[0] + x, from[1] + y, from[2] + z);
    device.quaternion.set(0, Math.sin((-yaw * Math.PI) / 360), 0, Math.cos((-yaw * Math.PI) / 360));
  };
  stand([0, 0, 0], 0);
  await headset.toggle();
  await frames(3);
  await until(() => headset.panel, 'has a panel');
  for (const { name, at, yaw = 0, recentre, turn = 0, waits } of looks) {
    stand(at, yaw);
    await frames(3);
    if (recentre) headset.recentre();
    if (turn) headset.turnBy(turn);
    if (waits) await until(() => viewer.picture.fallback, 'has a fallback');
    await frames(3);
    await sendCanvas(viewer.canvas, name);
  }
  await headset.session.end();
  expect(Math.abs(viewer.state.x) <= 0.15, 'the desk is outside the box');
}

// --- films ----------------------------------------------------------------------------------------------------------

async function film({ item, looks, ...size }) {
  const player = await makePlayer(size);
  const { viewer } = player;
  await open(player, item);
  const { film: own } = viewer.picture;
  await until(() => own.time > 0.1, 'plays');
  press(' ');
  const { time } = own;
  await sleep(200);
  expect(own.time === time, 'Space does not pause it');
  for (const { name, time: at, ...look } of looks) {
    own.show(at);
    viewer.set({ yaw: 0, pitch: 0, fov: 90, mode: 'left', shift: 0, ...look });
    viewer.fit();
    viewer.paint(0, {});
    await sendCanvas(viewer.canvas, name);
  }
  own.show(0.99 * own.end);
  press(' ');
  await until(() => own.time < 0.5 * own.end, 'begins again');
  await useBar(player, own);
}

// The bar and the keys of videos.
async function useBar(player, own) {
  const { picture } = player.viewer;
  const is = (id) => player.find(id);
  const isAt = (frame, what) => expect(Math.abs(own.time - frame / picture.fps) < 1e-6 && is('seek').value === String(frame), `${what}: ${own.time}, ${is('seek').value}`);
  expect(!is('film').hidden && is('seek').max === String(picture.frames - 1) && picture.frames > 2, 'the bar is not that of a film');
  expect(player.controls.button('sound').hidden, 'it has no sound');
  press(' ');
  expect(own.paused && !player.element.classList.contains('playing'), 'Space does not pause it');
  Object.assign(is('seek'), { value: '1' }).dispatchEvent(new Event('input'));
  isAt(1, 'the bar');
  press('.');
  isAt(2, 'the next frame');
  press(',');
  isAt(1, 'the frame before');
  press('j');
  isAt(0, 'the beginning');
  press('l');
  expect(!is('loop').checked, 'l does not end the loop');
  press(' ');
  await until(() => own.paused && own.time === own.end, 'ends');
  press(' ');
  await until(() => !own.paused && own.time > 0 && own.time < own.end, 'begins once more');
  press('l');
  expect(is('loop').checked, 'l does not loop');
}

const PARTS = { film, draw, move, decode: decodeAll, damage, fail, element: useElement, wear };

export const testLayered = (job) => PARTS[job.layered](job);
