// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tours: their directions in closed form, at the desk, in <stereo-360>, and in an emulated headset. testTour(name) runs
// a part, and throws what is wrong. The tour is that of view_tour_test.cpp: hall, kitchen and garden on a line to the
// east, 3 m apart, with the headings 0, 90 and 200.
import { Panorama } from './panorama.js';
import { partsOf, placeOf } from './places.js';
import { Player } from './player.js';
import { neighboursOf, pixelOf, placesOf, seenBy, turnTo, waysOf } from './tour-ways.js';
import { expect, sleep, until } from './wait.js';

const HALF = 0.0325; // metres, of the eyes' distance
const RADIANS = Math.PI / 180;
const near = (a, b, by = 1e-9) => Math.abs(a - b) < by;
const same = (a, b, by) => a.length === b.length && a.every((x, i) => near(x, b[i], by));

// --- directions -----------------------------------------------------------------------------------------------------

const at = (name, place, more = {}) => ({ name, place, ...more });

function testWays() {
  const [way, ...others] = waysOf({ panoramas: [at('a', [1, 1.6, 2]), at('b', [4, 1.6, 2])] })[0];
  expect(others.length === 0 && way.to === 1 && near(way.yaw, 90) && same(way.foot, [3, -1.6, 0]) && near(way.at[1], -0.7), 'east is not on the right');
  const turned = waysOf({ panoramas: [at('a', [1, 1.6, 2], { heading: 30 }), at('b', [4, 1.6, 2])] });
  expect(near(turned[0][0].yaw, 60) && near(turned[1][0].yaw, -90), 'the heading does not count');
  for (const [metres, reach] of [[0.4, 1.5], [2, 2], [30, 4]]) {
    const [[{ foot }]] = waysOf({ panoramas: [at('a', [0, 1.5, 0]), at('b', [0, 1.5, -metres])] });
    expect(same(foot, [0, -1.5, -reach]), `${metres} m away, the sign is at ${foot}`);
  }
  const [[up], [down]] = waysOf({ panoramas: [at('a', [0, 1.6, 0]), at('b', [0, 4.6, -8], { floor: 3 })] });
  expect(same(up.foot, [0, -1.6 + 1.5, -4]) && same(down.foot, [0, -1.6 - 1.5, 4], 1e-6), 'stairs do not climb');
  const [[given], [flat]] = waysOf({ panoramas: [{ name: 'a', links: [{ to: 'b', yaw: 90, pitch: 30, distance: 2 }] }, { name: 'b', links: [{ to: 'a', yaw: 180, distance: 3 }] }] });
  expect(same(given.at, [2 * Math.cos(30 * RADIANS), 1, 0]) && !given.foot, 'a given direction does not count');
  expect(same(flat.foot, [0, -1.6, 3]), 'a given yaw is not on the floor');
}

function testNeighbours() {
  const line = neighboursOf([[0, 0, 0], [2, 0, 0], [4, 0, 0], null]);
  expect(JSON.stringify(line) === '[[1],[0,2],[1],[]]', `a line has ${JSON.stringify(line)}`);
  const random = (i) => (Math.sin(12.9898 * i) * 43758.5453) % 5;
  const many = neighboursOf(Array.from({ length: 40 }, (_, i) => [random(i + 1), 0, random(i + 101)]));
  const reached = new Set([0]);
  for (const i of reached) many[i].forEach((k) => reached.add(k));
  expect(reached.size === 40, `${reached.size} of 40 places can be reached`);
  expect(many.every((list, i) => list.every((k) => many[k].includes(i))), 'a way has no way back');
}

// The line of sight of an eye begins on the viewing circle, and meets the point.
function testEyes() {
  for (const point of [[0.3, -1.6, -2], [-3, 0.5, 1], [1, -0.2, 0]]) {
    for (const side of [1, 0, -1]) {
      const { yaw, pitch } = seenBy(side, point, { ipd: 2 * HALF });
      const [s, c] = [Math.sin(yaw * RADIANS), Math.cos(yaw * RADIANS)];
      const from = [-side * HALF * c, -side * HALF * s]; // to the left of where it looks
      const way = Math.hypot(point[0] - from[0], point[2] - from[1]);
      expect(near(from[0] + way * s, point[0]) && near(from[1] - way * c, point[2]) && near(Math.tan(pitch * RADIANS) * way, point[1]), `eye ${side} misses ${point}`);
    }
  }
  const merged = { mode: 2, start: 60 * RADIANS, end: 90 * RADIANS };
  const apart = (y) => seenBy(1, [0, y, -1], { bottom: merged }).yaw - seenBy(-1, [0, y, -1], { bottom: merged }).yaw;
  expect(near(apart(-1), apart(-0.1), 1e-3) && apart(-20) < 0.2 * apart(-1), 'the merge does not count');
}

function testPlans() {
  for (const heading of [0, 30, -90]) {
    const plan = { metres_per_pixel: 0.02, origin: [50, 60], heading };
    const [place] = placesOf({ panoramas: [{ on_plan: [70, 10], floor: 3 }], plan, height: 1.5 });
    expect(near(place[1], 4.5) && same(pixelOf(plan, place), [70, 10]), `a plan turned by ${heading} leads elsewhere`);
  }
  expect(same(pixelOf({ metres_per_pixel: 0.5, origin: [10, 10] }, [1, 0, 2]), [12, 14]), 'a plan has north above, east on the right');
  const links = [[{ to: 'b', yaw: 10 }], [{ to: 'a', yaw: 50 }]];
  const tour = { panoramas: ['a', 'b'].map((name, i) => ({ name, links: links[i] })) };
  expect(near(turnTo(tour, waysOf(tour), 0, 1), 220), 'who arrives does not look away from where he was');
}

// --- the page -------------------------------------------------------------------------------------------------------

async function makePlayer() {
  for (const href of ['style.css', 'player.css']) document.head.append(Object.assign(document.createElement('link'), { rel: 'stylesheet', href }));
  document.body.innerHTML = '<div id="player"><div id="picture" tabindex="0"></div></div>';
  const view = await (await fetch('view.json')).json();
  const player = new Player(document.getElementById('player'), document, { view, base: location.href, keys: document, isPage: true });
  player.viewer.wake(new Panorama());
  await player.viewer.open(0);
  await until(() => player.viewer.guide, 'has a guide');
  return player;
}

const heading = ({ guide }) => Math.round(guide.heading);
const signs = () => [...document.querySelectorAll('.way')].filter((way) => way.tabIndex === 0);
const middle = (element) => {
  const { left, top, width, height } = element.getBoundingClientRect();
  return [left + width / 2, top + height / 2];
};
const sleepFrame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

async function goBy(act, viewer, item) {
  act();
  await until(() => viewer.item === item && viewer.picture && viewer.guide.item === item, `goes to ${item}`);
}

async function testDesk() {
  const player = await makePlayer();
  const { viewer } = player;
  expect(document.getElementById('name').textContent === 'Hall' && document.getElementById('caption').textContent === 'Built in 1870.', 'no title, or no text');
  const [sign, ...others] = signs();
  expect(others.length === 0 && sign.ariaLabel === 'Go to Kitchen' && sign.textContent === 'Kitchen', 'the hall leads elsewhere');
  expect(sign.classList.contains('away'), 'a sign on the right is seen ahead');
  const [name] = document.querySelectorAll('#aside button');
  expect(name.checkVisibility() && name.textContent === 'Kitchen' && middle(name)[0] > innerWidth / 2, 'nothing names the way on the right');
  viewer.set({ yaw: 170 });
  expect(middle(name)[0] < innerWidth / 2, 'the way on the left is named on the right');
  name.click();
  await until(() => near(viewer.state.yaw, 90, 0.01), 'turns to the way');
  expect(!name.checkVisibility() && !sign.classList.contains('away'), 'what is seen is named');
  viewer.set({ yaw: 0, mode: 'side-by-side' });
  expect(!name.checkVisibility(), 'a name has no depth');
  viewer.set({ mode: 'left', pitch: 0 });
  sign.focus();
  expect(near(viewer.state.yaw, 90, 0.01) && !sign.classList.contains('away') && !document.querySelector('.ring').hidden, 'the Tab key does not turn to the sign');
  expect(near(middle(sign)[0], innerWidth / 2, 1), 'the sign is not where it belongs');
  for (const [mode, ways] of [['side-by-side', [1, -1]], ['cross-eyed', [-1, 1]]]) {
    viewer.set({ mode, shift: 1 });
    const seen = [...document.querySelectorAll('.way:not([hidden])')].map((each) => middle(each)[0]);
    ways.forEach((side, i) => {
      const [wanted] = placeOf(viewer, { yaw: 90 + side * (Math.asin(HALF / 3) / RADIANS - 0.5), pitch: Math.atan2(-0.7, 3) / RADIANS }, partsOf(viewer)[i]);
      expect(near(seen[i], wanted, 1), `${mode}: the sign is at ${seen[i]}, not at ${wanted}`);
    });
  }
  viewer.set({ mode: 'anaglyph', shift: 0 });
  const [red, cyan] = [...document.querySelectorAll('.way')];
  expect(red.matches('.red') && cyan.matches('.cyan') && middle(red)[0] - middle(cyan)[0] > 2, 'an anaglyph has no depth');
  viewer.set({ mode: 'left' });
  viewer.set({ yaw: 100, pitch: -7 });
  expect(document.getElementById('compass').ariaLabel.includes('100°'), 'the compass says another direction');
  await goBy(() => sign.click(), viewer, 1);
  expect(heading(viewer) === 100 && near(viewer.state.yaw, 10) && viewer.state.pitch === -7, 'who goes east looks elsewhere');
  expect(document.getElementById('name').textContent === 'Kitchen' && signs().map(({ textContent }) => textContent).join() === 'Hall,Garden', 'the kitchen leads elsewhere');
  expect(document.getElementById('spots').getAnimations({ subtree: true }).length === 0, 'something moves');
  viewer.set({ pitch: 0 });
  await testPlanOf(player);
  document.getElementById('compass').click();
  expect(heading(viewer) % 360 === 0 && near(viewer.state.yaw, 160), 'the compass does not look north');
  await goBy(() => player.act('next'), viewer, 0);
  expect(heading(viewer) % 360 === 0, 'the next one has another direction');
  player.toggleList();
  await until(() => document.querySelector('#list button'), 'lists');
  expect([...document.querySelectorAll('#list button')].map(({ textContent }) => textContent).join() === 'Hall,Kitchen,Garden', 'the list has no titles');
}

async function testPlanOf(player) {
  const { viewer } = player;
  const image = document.querySelector('#plan img');
  if (document.getElementById('plan').hidden) document.getElementById('plan-toggle').click();
  await until(() => image.naturalWidth, 'shows the plan');
  await sleepFrame();
  const dots = [...document.querySelectorAll('.dot')];
  const box = image.getBoundingClientRect();
  const [left, top] = middle(dots[1]);
  expect(near((left - box.left) / box.width, (10 + 30) / image.naturalWidth, 0.01) && near((top - box.top) / box.height, 20 / image.naturalHeight, 0.01), 'the kitchen is elsewhere on the plan');
  expect(dots.map((dot) => dot.getAttribute('aria-current')).join() === 'false,true,false', 'the plan shows another place');
  expect(document.querySelector('.cone').style.rotate === '100deg', `the cone is turned by ${document.querySelector('.cone').style.rotate}`);
  await goBy(() => dots[2].click(), viewer, 2);
  expect(heading(viewer) === 100 && near(viewer.state.yaw, -100), 'the plan turns who uses it');
}

// --- the element ----------------------------------------------------------------------------------------------------

async function testElement() {
  await import('./stereo-360.js');
  const element = document.createElement('stereo-360');
  for (const [name, value] of Object.entries({ tour: 'files/own-tour.json', loading: 'eager', yaw: 90 })) element.setAttribute(name, value);
  Object.assign(element.style, { width: '480px', height: '270px' });
  document.body.append(element);
  await until(() => element.loaded && element.viewer.guide, 'loads a tour');
  const find = (selector) => element.shadowRoot.querySelector(selector);
  await until(() => find('.way'), 'has signs');
  expect(find('.way').textContent === 'kitchen' && getComputedStyle(find('.way')).position === 'absolute', 'the sign is not a sign');
  await goBy(() => find('.way').click(), element.viewer, 1);
  expect(near(element.yaw, 0) && find('#name').textContent === 'kitchen', 'the element does not go on');
  element.remove();
  const broken = document.createElement('stereo-360');
  for (const [name, value] of Object.entries({ tour: 'files/broken-tour.json', loading: 'eager' })) broken.setAttribute(name, value);
  const said = new Promise((done) => broken.addEventListener('error', ({ detail }) => done(detail.message)));
  document.body.append(broken);
  expect((await said) === "broken-tour.json: panoramas.0 leads to 'cellar', which is not the name of a panorama", await said);
}

// --- the headset ----------------------------------------------------------------------------------------------------

async function wear() {
  Object.defineProperties(window, { innerWidth: { value: 512 }, innerHeight: { value: 256 } });
  const { XRDevice, metaQuest3 } = await import('./iwer.module.js');
  const device = new XRDevice(metaQuest3);
  device.installRuntime({ forceInstall: true });
  Object.assign(device, { stereoEnabled: true, fovy: Math.PI / 2 });
  device.position.set(3, 1.6, -2);
  const player = await makePlayer();
  player.viewer.guide.read = { text: 600e3, letter: 0 }; // a busy machine needs longer
  await player.enterHeadset();
  await until(() => player.headset.panel?.spots, 'has signs in the headset');
  return { device, player, headset: player.headset, viewer: player.viewer };
}

const frames = ({ headset }, count = 3) => new Promise((done) => {
  const next = () => (count-- > 0 && headset.session ? headset.session.requestAnimationFrame(next) : done());
  next();
});

// yaw to the right, pitch up, in the room, degrees.
function look(quaternion, yaw, pitch) {
  const [y, p] = [-yaw, pitch].map((angle) => (angle * RADIANS) / 2);
  quaternion.set(Math.cos(y) * Math.sin(p), Math.sin(y) * Math.cos(p), -Math.sin(y) * Math.sin(p), Math.cos(y) * Math.cos(p));
}

const angles = ([x, y, z]) => [Math.atan2(x, -z) / RADIANS, Math.atan2(y, Math.hypot(x, z)) / RADIANS];

async function send({ viewer: { canvas } }, name) {
  await fetch(`result/${name}`, { method: 'POST', body: await new Promise((done) => canvas.toBlob(done)) });
}

// A controller at the head's place, which aims at a spot.
async function aim(worn, i) {
  const hand = worn.device.controllers.right;
  const { x, y, z } = worn.device.position;
  hand.position.set(x, y, z);
  look(hand.quaternion, ...angles(worn.headset.panel.spots.seen(0, worn.viewer.guide.spots[i].at)));
  await frames(worn);
}

async function press(worn) {
  for (const value of [1, 0]) {
    worn.device.controllers.right.updateButtonValue('trigger', value);
    await frames(worn);
  }
}

// By the controller: both eyes see the sign where they see the floor there, and the direction in the room stays.
async function testRay(worn) {
  const { device, headset, viewer } = worn;
  const { spots } = headset.panel;
  const from = [0.1, 0.2, 0.3];
  const [left, right] = [0, 1].map((index) => spots.things({ eye: from, index }, new Set()).map(({ at: place }) => angles(place.map((x, i) => x - from[i]))));
  expect(left.length === 3, `there are ${left.length} sheets`);
  left.slice(0, 2).forEach(([yaw], i) => expect(near(yaw - right[i][0], (2 * Math.asin(HALF / 3)) / RADIANS, 1e-6), 'the eyes see the sign at another distance'));
  expect(headset.panel.subtitles.text === 'Hall\nBuilt in 1870.', `the headset says ${headset.panel.subtitles.text}`);
  look(device.quaternion, 60, -20);
  await frames(worn);
  await aim(worn, 0);
  await send(worn, 'sign.png');
  const room = headset.turn / RADIANS + 0; // of the hall, whose heading is 0
  await press(worn);
  await until(() => viewer.item === 1 && viewer.guide.item === 1, 'a press leads on');
  await frames(worn);
  expect(near(headset.turn / RADIANS + 90, room, 1e-6), 'the room turns about the wearer');
  expect(headset.panel.subtitles.text === 'Kitchen', `the kitchen says ${headset.panel.subtitles.text}`);
  look(device.controllers.right.quaternion, 0, 60);
  await frames(worn);
  await press(worn);
  await sleep(300);
  expect(viewer.item === 1, 'a press beside the signs leads on');
}

// By the gaze: a long look leads on, but only once, although the garden's sign is in the same direction as the kitchen's.
async function testGaze(worn) {
  const { device, headset, viewer } = worn;
  const spotTo = (item) => viewer.guide.spots.findIndex(({ to }) => to === item);
  const gaze = (item) => look(device.quaternion, ...angles(headset.panel.spots.seen(0, viewer.guide.spots[spotTo(item)].at)));
  for (const hand of Object.values(device.controllers)) hand.connected = false;
  look(device.quaternion, 0, 60);
  await goBy(() => viewer.guide.go(0), viewer, 0);
  await frames(worn);
  gaze(1);
  await frames(worn);
  expect(headset.panel.dwell.id === `spot-${spotTo(1)}` && viewer.item === 0, 'a look acts at once, or not at all');
  await until(() => viewer.item === 1 && viewer.guide.item === 1, 'a long look leads on');
  for (const end = performance.now() + 2500; performance.now() < end;) await frames(worn, 1);
  expect(viewer.item === 1 && headset.panel.pointers[0].control?.id === `spot-${spotTo(2)}`, 'one look leads on twice');
  look(device.quaternion, 0, 60);
  await frames(worn);
  gaze(2);
  await until(() => viewer.item === 2 && viewer.guide.item === 2, 'another look leads on');
  look(device.quaternion, 0, 60);
  await frames(worn);
  for (const hand of Object.values(device.controllers)) hand.connected = true;
  await frames(worn);
}

async function testMenu(worn) {
  const { device, headset, viewer } = worn;
  await goBy(() => viewer.guide.go(0), viewer, 0);
  look(device.quaternion, 0, -20);
  await frames(worn);
  headset.panel.toggle();
  await frames(worn);
  const control = (id) => headset.panel.content.controls.find((each) => each.id === id);
  expect(control('compass').text === `${heading(viewer) % 360}°`, `the menu's compass says ${control('compass').text}`);
  await until(() => control('place-2'), 'has a plan in the menu');
  const [hall, middlemost, garden] = [0, 1, 2].map((i) => control(`place-${i}`).box);
  expect(near(middlemost[0] - hall[0], garden[0] - middlemost[0], 1e-6) && garden[0] > hall[0] && near(hall[1], garden[1], 1e-6), 'the places are not in a row');
  expect(control('place-0').on && !control('place-1').on && !control('item-0'), 'the plan shows another place, or there is a list, too');
  await send(worn, 'menu.png');
  control('place-1').run();
  await until(() => viewer.item === 1 && viewer.guide.item === 1, 'the plan leads on');
  await goBy(() => viewer.guide.go(0), viewer, 0);
  viewer.guide.text = '';
  control('text').run();
  await frames(worn);
  expect(headset.panel.subtitles.text === 'Hall\nBuilt in 1870.' && !headset.panel.isOpen, 'the menu does not tell the text');
  const lamp = viewer.guide.spots.findIndex(({ title }) => title === 'Lamp');
  await aim(worn, lamp);
  await press(worn);
  await frames(worn);
  expect(headset.panel.subtitles.text === 'Lamp\nMade of brass.', `the lamp says ${headset.panel.subtitles.text}`);
  look(device.quaternion, 0, -10);
  await frames(worn);
  await send(worn, 'lamp.png');
}

async function testWorn() {
  const worn = await wear();
  await testRay(worn);
  await testGaze(worn);
  await testMenu(worn);
  await worn.headset.session.end();
  expect(!worn.viewer.guide.worn, 'the signs stay in the room');
}

const TESTS = {
  ways: () => [testWays, testNeighbours, testEyes, testPlans].forEach((test) => test()),
  desk: testDesk, element: testElement, worn: testWorn,
};

export const testTour = (name) => TESTS[name]();
