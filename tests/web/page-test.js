// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The page and <stereo-360> in a browser, as visitors and scripts use them. testPage(name) throws what is wrong.
// src/ has the page's own modules; the rest is an exported site.
import { testElements } from './element-test.js';
import { listen } from './src/ambisonics.js';
import { expect, sleep, until } from './wait.js';

const load = (tag, properties) => new Promise((done, fail) => {
  const element = Object.assign(document.createElement(tag), properties);
  element.onload = done;
  element.onerror = () => fail(new Error(`${properties.src ?? properties.href} did not load`));
  document.head.append(element);
});

const boxOf = (element) => element.getBoundingClientRect();

// None lies over another, and each is in the box of what holds them.
function testApart(holder, elements) {
  const hull = boxOf(holder);
  const boxes = elements.filter((each) => each.checkVisibility()).map((each) => [each, boxOf(each)]);
  expect(boxes.length > 1, 'nothing to compare');
  for (const [i, [one, a]] of boxes.entries()) {
    expect(a.left >= hull.left - 1 && a.right <= hull.right + 1 && a.top >= hull.top - 1 && a.bottom <= hull.bottom + 1, `${one.outerHTML.slice(0, 60)} sticks out`);
    for (const [other, b] of boxes.slice(i + 1)) {
      expect(a.right <= b.left + 0.5 || b.right <= a.left + 0.5 || a.bottom <= b.top + 0.5 || b.bottom <= a.top + 0.5, `${one.outerHTML.slice(0, 60)} lies over ${other.outerHTML.slice(0, 60)}`);
    }
  }
}

const press = (key, target = document, more = {}) => target.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true, composed: true, cancelable: true, ...more }));

// A pixel of a canvas, 0..1 from its upper left corner.
function pixelOf(canvas, x, y) {
  const copy = new OffscreenCanvas(canvas.width, canvas.height);
  const context = copy.getContext('2d');
  context.drawImage(canvas, 0, 0);
  return [...context.getImageData(Math.floor(x * canvas.width), Math.floor(y * canvas.height), 1, 1).data].slice(0, 3);
}

// --- the page -------------------------------------------------------------------------------------------------------

async function openPage(hash = '#controls=all') {
  location.hash = hash;
  await Promise.all([load('link', { rel: 'stylesheet', href: 'src/style.css' }), load('link', { rel: 'stylesheet', href: 'src/player.css' })]);
  document.body.insertAdjacentHTML('beforeend', '<div id="player"><div id="picture" tabindex="0"></div></div>');
  await import('./src/main.js');
  await until(() => window.omnistereo?.viewer.picture || !(find('message')?.hidden ?? true), 'opens a picture');
  expect(window.omnistereo?.viewer.picture, find('message')?.textContent);
  return window.omnistereo;
}

const find = (id) => document.getElementById(id);
const frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));

async function testHint() {
  expect(!find('hint').hidden && /wheel/.test(find('hint').textContent), 'no hint at the first visit');
  press('ArrowRight');
  expect(find('hint').hidden && localStorage.length === 1, 'the hint stays');
}

function testTips(player) {
  for (const button of player.element.querySelectorAll('#bar button, #title button')) {
    expect(button.dataset.tip && (button.ariaLabel || button.textContent.trim()), `${button.outerHTML.slice(0, 60)} says nothing`);
  }
  const swap = player.element.querySelector('[data-action="swap"]');
  press('Tab'); // a user of the keyboard
  swap.focus({ focusVisible: true });
  return until(() => find('tip').matches(':popover-open') && find('tip').textContent === 'Swap the eyesS', 'shows a tooltip with its key').then(() => {
    press('Escape', swap);
    expect(!find('tip').matches(':popover-open'), 'Escape leaves the tooltip');
  });
}

// Links name what they show: numbers change when a file joins the folder.
async function testLinks(player) {
  const { findItem, readState } = await import('./src/state.js');
  await until(() => /item=0&name=waves_360_TB.png&/.test(location.hash), 'names its item in its address');
  const items = ['a.png', 'b, c & d.png', 'e.png', 'b, c & d.png'].map((name) => ({ name }));
  const to = (hash) => findItem(items, readState(hash));
  expect(to('#item=0&name=b%2C+c+%26+d.png') === 1 && to('#item=3&name=b,%20c%20%26%20d.png') === 3, 'a name does not count');
  expect(to('#item=2') === 2 && to('#item=2&name=gone.png') === 2 && to('#item=9') === 3, 'a number does not help');
  expect(player.viewer.item === 0, 'another item is open');
}

async function testDegrees(player) {
  expect(find('look').hidden, 'degrees that nobody asked for');
  press('g');
  expect(!find('look').hidden && find('look').textContent.startsWith('yaw'), 'no degrees with the grid');
  press('g');
  await frame();
  expect(!player.viewer.state.grid, 'the grid stays');
}

// Little planet: straight down is the middle of the planet; a drag of the edge turns around it.
async function testPlanet(player) {
  const { viewer } = player;
  const before = viewer.state.fov;
  press('w');
  expect(viewer.state.planet && viewer.state.pitch === -90 && viewer.state.fov === 260, 'no little planet');
  const { directionAt, placeOf, partsOf } = await import('./src/places.js');
  const { clientWidth: width, clientHeight: height } = viewer.canvas;
  expect(Math.abs(directionAt(viewer, width / 2, height / 2).pitch + 90) < 0.01, 'the nadir is not in the middle');
  const at = directionAt(viewer, width * 0.8, height * 0.3);
  const place = placeOf(viewer, at, partsOf(viewer)[0]);
  expect(Math.hypot(place[0] - width * 0.8, place[1] - height * 0.3) < 0.01, 'places and directions differ');
  // At the middle of the right edge one looks half the field of view away from the middle.
  const edge = directionAt(viewer, width - 0.001, height / 2);
  expect(Math.abs(90 + edge.pitch - 130) < 0.1, `the edge is ${90 + edge.pitch} degrees away`);
  press('w');
  expect(!viewer.state.planet && viewer.state.fov === before, 'one does not come back from the planet');
}

async function testShift(player) {
  const { viewer } = player;
  for (let i = 0; i < 30; i++) press(']');
  expect(Math.abs(viewer.state.shift - 3) < 1e-6, 'the depth does not move');
  const { canvas } = viewer;
  viewer.set({ mode: 'left', yaw: 10, pitch: 5, fov: 60 });
  viewer.draw(0);
  const shifted = pixelOf(canvas, 0.6, 0.4);
  viewer.set({ shift: 0, yaw: 11.5 });
  viewer.draw(0);
  const turned = pixelOf(canvas, 0.6, 0.4);
  expect(shifted.every((value, i) => Math.abs(value - turned[i]) < 12), `3 degrees do not turn the left eye by half of it: ${shifted}, ${turned}`);
  viewer.set({ yaw: 0, pitch: 0 });
}

async function testCompare(player) {
  const { viewer } = player;
  viewer.set({ mode: 'left', yaw: 0, pitch: 0, fov: 90 });
  press('x');
  await until(() => viewer.compare?.pin, 'compares');
  viewer.choose({ layout: 'bottom-top' });
  await until(() => viewer.choice.layout === 'bottom-top' && viewer.picture && find('loading').hidden, 'opens with another layout');
  const divider = find('divider');
  const draw = () => viewer.draw(performance.now());
  const at = (x) => pixelOf(viewer.canvas, x, 0.37);
  const alike = (a, b) => a.every((value, i) => Math.abs(value - b[i]) < 3);
  viewer.compare.moveTo(1);
  draw();
  const left = at(0.3);
  viewer.compare.moveTo(0);
  draw();
  const right = at(0.3);
  expect(!alike(left, right), 'both are the same');
  viewer.compare.moveTo(0.5);
  draw();
  expect(alike(at(0.3), left), 'left of the line is not the left picture');
  press('Home', divider);
  expect(viewer.compare.split === 0 && divider.ariaValueNow === '0', 'Home does not move the line');
  for (let i = 0; i < 3; i++) press('PageDown', divider);
  expect(Math.abs(viewer.compare.split - 0.3) < 1e-6, 'keys do not move the line');
  const way = (name) => document.querySelector(`[data-way="${name}"]`).click();
  way('difference');
  draw();
  const differs = pixelOf(document.querySelector('#compare canvas'), 0.3, 0.37);
  expect(differs.every((value, i) => Math.abs(value - Math.min(255, 4 * Math.abs(left[i] - right[i]))) < 12), `${differs} is not the difference of ${left} and ${right}`);
  way('blink');
  const seen = new Set();
  await until(() => seen.add(String(viewer.picture.split)).size === 2, 'blinks');
  way('slider');
  expect(/beside=0/.test(location.hash) || (await until(() => /beside=0/.test(location.hash), 'says in its address what is compared')) === undefined, '');
  press('x');
  expect(!viewer.compare && !find('compare'), 'the comparison does not end');
  viewer.choose({ layout: undefined });
  await until(() => viewer.choice.layout === undefined && viewer.picture, 'opens as before');
}

async function testNotes(player) {
  const { viewer } = player;
  await until(() => document.querySelector('.spot:not([hidden], .away)'), 'shows hotspots');
  expect(find('caption').textContent === 'A <b>card</b>', 'the caption is no text');
  viewer.set({ yaw: 20, pitch: 10 });
  const spot = document.querySelector('.spot');
  const box = spot.getBoundingClientRect();
  expect(Math.abs(box.left + box.width / 2 - innerWidth / 2) < 1.5, 'the hotspot is not where it belongs');
  spot.click();
  expect(!find('card').hidden && find('card').textContent === 'Lamp<i>On</i>' && !find('card').querySelector('i'), 'the card is not the text');
  press('Escape', spot);
  expect(find('card').hidden, 'the card stays');
  viewer.set({ yaw: 200 });
  expect(spot.classList.contains('away') && getComputedStyle(spot).clipPath !== 'none', 'a hotspot behind one is seen');
  spot.focus();
  expect(Math.round(viewer.state.yaw) === 20 && !spot.classList.contains('away'), 'the Tab key does not lead to a hotspot behind one');
  viewer.element.focus();
  viewer.set({ yaw: 0, pitch: 0 });
}

async function testHelp(player) {
  press('?');
  await until(() => find('help').open, 'the help does not open');
  expect(!/frame/i.test(find('keys').textContent), 'the help is not of what is open');
  expect(find('keys').querySelector('h2').textContent === 'Look around', 'the help does not begin with what matters');
  find('help').close();
  expect(find('why').hidden === !find('reason').textContent, 'the reason');
  press('o');
  await until(() => find('settings').style.bottom, 'places the settings');
  const [settings, bar] = [find('settings').getBoundingClientRect(), find('bar').getBoundingClientRect()];
  expect(settings.bottom <= bar.top && settings.top >= 0 && settings.right <= innerWidth, `the settings are at ${settings.top} to ${settings.bottom}, the bar at ${bar.top}`);
  press('o');
}

async function testTurn(player) {
  const { yaw } = player.viewer.state;
  press('t');
  await until(() => player.viewer.state.yaw > yaw + 0.5, 'turns');
  press('ArrowLeft');
  expect(!player.turning, 'it turns on against the keys');
}

// All items with their thumbnails: chosen by keys and by clicks, as dark as the rest.
async function testList({ viewer, element }) {
  const { items } = viewer.view;
  items.push({ ...items[0], name: 'Again.png' }, { ...items[0], name: 'No thumbnail.png', thumbnail: 'nothing.jpg', kind: 'video' });
  viewer.say('open');
  element.querySelector('[data-action="list"]').click();
  await until(() => find('list')?.matches(':popover-open'), 'opens the list');
  const cells = [...find('list').children];
  const images = cells.map((cell) => cell.querySelector('img'));
  await until(() => images[1].naturalWidth === 256 && !images[2].hasAttribute('src'), 'has thumbnails, and none where there is none');
  expect(cells.length === 3 && cells[0].ariaCurrent === 'true' && document.activeElement === cells[0], 'the list does not begin with what is open');
  expect(testContrast(find('list')) >= 3, 'the list has no names');
  expect(cells.map((cell) => cell.querySelectorAll('svg').length).join() === '0,0,1', 'not the film alone has a sign');
  const { yaw } = viewer.state;
  press('ArrowRight', cells[0]);
  expect(document.activeElement === cells[1] && viewer.state.yaw === yaw, 'the keys do not lead to the next picture');
  cells[1].click();
  expect(!find('list').matches(':popover-open') && viewer.item === 1, 'the list does not open what is chosen');
  await until(() => viewer.picture && !viewer.picture.isPreview, 'shows what was chosen');
  press('y');
  await until(() => find('list').matches(':popover-open') && find('list').children[1].ariaCurrent === 'true', 'opens the list by its key');
  find('list').hidePopover();
  items.length = 1;
  viewer.open(0);
  await until(() => viewer.item === 0 && viewer.picture, 'leads back');
}

// WCAG 2.2: relative luminance and contrast ratio. Where a picture may be behind, it is black and it is white.
const channel = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const luminance = ([r, g, b]) => 0.2126 * channel(r / 255) + 0.7152 * channel(g / 255) + 0.0722 * channel(b / 255);

function colorOf(text) {
  const [r, g, b, a = 1] = text.match(/[\d.]+/g).map(Number);
  return [r, g, b, a];
}

const over = ([r, g, b, a], below) => [r, g, b].map((value, i) => value * a + below[i] * (1 - a));

// The backgrounds that an element's text can have.
function backgroundsOf(element) {
  const layers = [];
  for (let at = element; at; at = at.parentElement ?? at.getRootNode().host) {
    const color = colorOf(getComputedStyle(at).backgroundColor);
    if (color[3]) layers.unshift(color);
    if (color[3] === 1) return [layers.reduce((below, layer) => over(layer, below), [0, 0, 0])];
    if (at.id === 'player') break;
  }
  return [[0, 0, 0], [255, 255, 255]].map((picture) => layers.reduce((below, layer) => over(layer, below), picture));
}

const contrast = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);

// Throws for the first text that is hard to read; returns how many were looked at.
function testContrast(root) {
  let count = 0;
  for (const element of root.querySelectorAll('*')) {
    const isText = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim()) || element.matches('svg');
    if (!isText || !element.checkVisibility() || element.closest('#numbers, option, :disabled')) continue;
    const color = colorOf(getComputedStyle(element).color);
    const least = element.matches('svg') ? 3 : 4.5;
    for (const background of backgroundsOf(element)) {
      const ratio = contrast(luminance(over(color, background)), luminance(background));
      expect(ratio >= least, `${element.tagName} ${element.id || element.className} "${element.textContent.trim().slice(0, 30)}" has the contrast ${ratio.toFixed(2)} on ${background.map(Math.round)}`);
      count++;
    }
  }
  return count;
}

async function testColors(player) {
  press('o');
  press('x');
  await until(() => player.viewer.compare?.pin, 'compares');
  find('why').open = true;
  document.querySelector('.spot')?.click();
  player.toast('A word');
  player.fail('A fault');
  player.viewer.set({ grid: true });
  await sleep(400);
  let count = testContrast(document.body);
  player.fail('');
  press('o');
  press('x');
  press('?');
  await until(() => find('help').open, 'the help does not open');
  count += testContrast(document.body);
  find('help').close();
  expect(count > 60, `only ${count} texts`);
}

// Fingers need 44 pixels (WCAG 2.5.5). The emulated phone has a coarse pointer only if the browser is told so.
function testTouch(player) {
  document.documentElement.style.setProperty('--side', '44px');
  for (const button of player.element.querySelectorAll('#bar button, #bar select, #title button')) {
    const { width, height } = button.getBoundingClientRect();
    expect(!button.checkVisibility() || Math.min(width, height) >= 44, `${button.dataset.action ?? button.id} is ${width} x ${height}`);
  }
  find('player').style.width = '360px'; // narrower than windows of a desktop can be
  for (const each of player.element.querySelectorAll('#bar, #bar button, #bar select')) {
    const { left, right } = each.getBoundingClientRect();
    expect(left >= 0 && right <= 360, `${each.id || each.dataset.action} is wider than the phone: ${left} to ${right}`);
  }
  // A folder of pictures with long names: the buttons, the name and the count beside each other.
  const { items } = player.viewer.view;
  items.push({ ...items[0] });
  items[0].name = 'a long name of a panorama from the harbour in the evening.png';
  player.viewer.say('open');
  testApart(find('title'), [...find('folder').children, find('name'), find('count')]);
  expect(find('count').textContent === '1 / 2' && find('count').scrollWidth <= find('count').offsetWidth, 'the count is cut off');
  document.documentElement.style.removeProperty('--side');
}

// If there is no room above or below the bar, the settings cover all of it.
async function testLowWindow(player) {
  find('player').style.bottom = '46vh';
  await frame();
  player.act('settings');
  await until(() => find('settings').style.maxHeight, 'places the settings');
  const [settings, bar] = [boxOf(find('settings')), boxOf(find('bar'))];
  expect(find('settings').scrollHeight <= find('settings').clientHeight, 'settings are cut off');
  expect(settings.top >= 0 && settings.bottom <= innerHeight, `the settings end at ${settings.bottom}`);
  expect(settings.top >= bar.bottom || settings.bottom <= bar.top || (settings.top <= bar.top && settings.bottom >= bar.bottom), 'the settings cover a part of the bar');
  player.act('settings');
}

const isScheme = (scheme) => expect(matchMedia(`(prefers-color-scheme: ${scheme})`).matches, `the browser is not ${scheme}`);

async function testThePage() {
  isScheme('dark');
  const player = await openPage('#yaw=0&shift=0&controls=all');
  await testHint(player);
  await testTips(player);
  await testLinks(player);
  await testDegrees(player);
  await testNotes(player);
  await testPlanet(player);
  await testShift(player);
  await testCompare(player);
  await testHelp(player);
  await testTurn(player);
  await testList(player);
  await testColors(player);
}

async function testLight() {
  isScheme('light');
  await testColors(await openPage());
}

async function testPhone() {
  const player = await openPage();
  testTouch(player);
  await testLowWindow(player);
}

// The bar of a video, and its subtitles.
async function testVideo() {
  const { viewer } = await openPage();
  expect(find('film').checkVisibility() && /frame 0/.test(find('time').textContent), 'no bar of the video');
  await until(() => find('subtitles'), 'reads the subtitles');
  viewer.picture.seek(0.4);
  await until(() => find('subtitles').textContent === 'First', 'shows the first subtitle');
  viewer.picture.seek(1.4);
  await until(() => find('subtitles').textContent === 'Second line', 'shows the second subtitle, without its HTML');
  expect(find('subtitles').getBoundingClientRect().bottom <= find('bar').getBoundingClientRect().top, 'subtitles are behind the bar');
  press('r');
  expect(find('subtitles').hidden, 'subtitles stay');
}

// Keys and a click move the camera. The played scene has a floor at a height of 0, or a wall 2 m ahead.
async function testWalk({ studio, viewer }, answers) {
  const { session } = studio;
  const begun = [1, 1.5, 3];
  const standing = () => session.settings.sidecar.position;
  const near = (a, b) => a.every((value, i) => Math.abs(value - b[i]) < 1e-3);
  const radians = (angle) => (angle * Math.PI) / 180;
  let kind = 'floor';
  const found = answers['studio/pick'];
  answers['studio/pick'] = ({ yaw, pitch }) => {
    const [x, y, z] = standing();
    const d = [Math.sin(radians(yaw)) * Math.cos(radians(pitch)), Math.sin(radians(pitch)), -Math.cos(radians(yaw)) * Math.cos(radians(pitch))];
    const distance = kind === 'floor' ? -y / d[1] : 2 / Math.abs(d[2]);
    return distance > 0 ? { ...found, distance, point: [x + d[0] * distance, y + d[1] * distance, z + d[2] * distance] } : { nothing: true };
  };
  session.edit({ 'sidecar.position': begun, 'sidecar.yaw': 30 });
  viewer.set({ yaw: 60, pitch: 0 }); // together 90 degrees to the right: along x
  press('w');
  expect(near(standing(), [1.26, 1.5, 3]), `W leads to ${standing()}`);
  press('d');
  expect(near(standing(), [1.26, 1.5, 3.26]), `D leads to ${standing()}`);
  press('a');
  press('S', viewer.element, { shiftKey: true });
  press('s');
  expect(near(standing(), [0.948, 1.5, 3]), `S leads to ${standing()}`);
  session.step(-1);
  expect(near(standing(), begun), 'a walk is not undone as one');
  session.edit({ 'sidecar.yaw': 0 });
  viewer.set({ yaw: 0, pitch: -45 });
  const stand = () => [...find('pick').querySelectorAll('button')].find(({ textContent }) => textContent === 'Stand here');
  for (const pitch of [-45, -90]) {
    session.edit({ 'sidecar.position': begun });
    viewer.set({ yaw: 0, pitch });
    press('Enter');
    await until(() => stand(), `offers to stand at ${pitch}`);
    stand().click();
    await until(() => find('pick').hidden, 'stands there');
    expect(near(standing(), [1, 1.5, pitch === -45 ? 1.5 : 3]), `the click leads to ${standing()}`);
  }
  kind = 'wall';
  session.edit({ 'sidecar.position': begun });
  viewer.set({ yaw: 0, pitch: -30 });
  press('Enter');
  await until(() => stand(), 'offers to stand on what is below the eyes');
  stand().click();
  await until(() => find('pick').textContent.includes('too steep'), 'refuses a wall');
  expect(near(standing(), begun), 'a wall is stood on');
  press('Escape', document.activeElement);
  viewer.set({ yaw: 0, pitch: 30 });
  press('Enter');
  await until(() => find('pick').textContent.includes('Distance'), 'picks above');
  expect(!stand(), 'what is above the eyes is offered as a floor');
  press('Escape', document.activeElement);
  answers['studio/pick'] = found;
  viewer.set({ yaw: 0, pitch: 0 });
  session.edit({ 'sidecar.position': [0, 1.5, 0] });
}

// The studio's page against the server that studio-test.js plays.
async function openStudio() {
  const { CAMERA, STUDIO, Server } = await import('./studio-test.js');
  const view = { ...(await (await fetch('view.json')).json()), items: [], live: true, studio: STUDIO };
  const server = new Server();
  server.prompt = true;
  const { send } = server;
  server.send = (meta) => send.call(server, { seconds: 1, ...meta });
  const played = window.fetch;
  const found = { distance: 2, disparity: 3, left: [1, 2], right: null, point: [0, 0, -2] };
  const heat = new OffscreenCanvas(8, 4);
  heat.getContext('2d').fillRect(0, 0, 8, 4);
  const verdict = { level: 'caution', text: 'Most: the floor', worst: { yaw: 0, pitch: -80 }, auto: Array(180).fill(1), camera: CAMERA };
  const answers = { 'view.json': view, 'studio/pick': found, 'studio/comfort': verdict };
  let heats = 0;
  window.fetch = async (address, options) => {
    const path = String(address).replace(new URL('.', location).href, '');
    if (path.startsWith('studio/heat.png')) return ++heats && new Response(await heat.convertToBlob());
    const answer = answers[path];
    if (answer) return Response.json(typeof answer === 'function' ? answer(JSON.parse(options.body)) : answer);
    return played(path, options);
  };
  const player = await openPage();
  await until(() => player.studio && find('studio').checkVisibility() && getComputedStyle(find('studio')).position === 'fixed', 'has its panel');
  return { player, verdict, answers, heats: () => heats };
}

// The merge's curve: the nearest handle is dragged, where a finger need not be on it.
function testCurve({ session }) {
  const svg = document.querySelector('.curve svg');
  svg.setPointerCapture = () => {}; // there is no such pointer
  const box = boxOf(document.querySelectorAll('.handle')[0]); // where the upper merge starts
  const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
  const send = (type, by, down) => svg.dispatchEvent(new PointerEvent(type, { clientX: x + by, clientY: y + down, bubbles: true }));
  const degree = boxOf(svg).width * (264 / 280) / 180;
  const { start } = session.settings.sidecar.merge_top;
  send('pointerdown', 0, 14);
  send('pointermove', -20 * degree, 14);
  send('pointerup', -20 * degree, 14);
  expect(Math.abs(session.settings.sidecar.merge_top.start - start + 20) <= 1, `a handle that a finger nearly hits went from ${start} to ${session.settings.sidecar.merge_top.start}`);
  session.step(-1);
  send('pointerdown', 0, 60);
  send('pointermove', -20 * degree, 60);
  expect(session.settings.sidecar.merge_top.start === start, 'a handle moves that nobody meant');
}

// The fields' right edges are one line.
function testFields() {
  document.querySelectorAll('.rows details').forEach((each) => (each.open = true));
  const fields = [...document.querySelectorAll('.rows .row-of > :is(input, select)')].filter((each) => each.checkVisibility());
  const edges = new Set(fields.filter((each) => !each.closest('.parts') || each.parentElement === each.closest('.parts').lastElementChild).map((each) => Math.round(boxOf(each).right)));
  expect(fields.length > 8 && edges.size === 1, `fields end at ${[...edges]}`);
}

// Numbers may have units. The panel says which number is invalid, or beyond its limits.
function testNumbers({ session, panel }) {
  const field = panel.rows.find(({ spec }) => spec.path === 'sidecar.position.0').control.element.querySelector('input');
  const x = () => session.settings.sidecar.position[0];
  const before = x();
  const type = (text) => {
    field.value = text;
    field.dispatchEvent(new Event('change'));
    return panel.said.textContent;
  };
  expect(type('150 cm') === '' && x() === 1.5, `150 cm are ${x()}`);
  expect(type('abc') === 'Position X: “abc” is not a number of km, m, cm, mm, ft, in' && x() === 1.5, `abc: ${panel.said.textContent}`);
  expect(type('5 kg').includes('not a number') && x() === 1.5, `5 kg are ${x()}`);
  expect(type('1e9') === 'Position X is between -100000 and 100000 m' && x() === 1e5, `1e9 is ${x()}: ${panel.said.textContent}`);
  expect(type(String(before)) === '' && x() === before, 'a right number leaves the message');
  expect(panel.withLabels('merge_top.start must be below its end') === '“Start” must be below its end', panel.withLabels('merge_top.start must be below its end'));
}

// The curve that the depth allows is used by a button, and can be undone.
async function testAutoCurve({ session, panel }) {
  const shares = document.querySelector('.curve-line').getAttribute('points');
  await panel.followDepth();
  expect(panel.useAuto.checkVisibility(), 'the dotted curve cannot be used');
  panel.useAuto.click();
  const [row] = panel.rows.filter(({ spec }) => spec.path === 'sidecar.merge_top.mode').map(({ control }) => control.element.querySelector('select'));
  expect(session.settings.merge_limit === 25.6 && row.value === 'auto', 'the dotted curve is not used');
  expect(!panel.useAuto.checkVisibility() && !panel.box.checkVisibility() && !panel.below.checkVisibility(), 'controls that have no effect');
  session.say('status', { part: 'base', side: session.side, merge: Array(180).fill(0.5) });
  const levels = new Set(document.querySelector('.curve-line').getAttribute('points').split(' ').map((point) => point.split(',')[1]));
  expect(levels.size === 1, 'the curve is not what the picture has');
  row.value = 'cosine';
  row.dispatchEvent(new Event('change'));
  expect(session.settings.merge_limit === null, 'another curve is not used');
  row.value = 'auto';
  row.dispatchEvent(new Event('change'));
  expect(session.settings.merge_limit === 25.6, 'the depth is not used');
  for (let i = 0; i < 3; i++) session.step(-1);
  expect(!session.settings.merge_limit && document.querySelector('.curve-line').getAttribute('points') === shares, 'it is not undone');
}

async function testStudioPhone() {
  const { player } = await openStudio();
  const { viewer, studio } = player;
  testFields();
  testCurve(studio);
  studio.session.edit({ 'sidecar.yaw': 3, 'sidecar.position.0': 2, 'sidecar.ipd': 0.07 });
  for (const button of document.querySelectorAll('#studio :is(button, summary, select, .check)')) {
    const { width, height } = boxOf(button);
    expect(!button.checkVisibility() || Math.min(width, height) >= 44, `${button.outerHTML.slice(0, 80)} is ${width} x ${height}`);
  }
  for (const row of document.querySelectorAll('.many')) {
    if (row.checkVisibility()) testApart(row, [...row.querySelectorAll('input, .reset')]);
  }
  const { top, bottom } = boxOf(document.querySelector('#studio .primary'));
  expect(top > boxOf(find('player')).bottom && bottom <= innerHeight, 'what renders is out of sight');
  press('q');
  await until(() => viewer.compare, 'shows what strains the eyes');
  const ways = find('ways');
  testApart(ways, [...ways.querySelectorAll('button, .legend')]);
  expect(boxOf(ways.querySelector('.legend')).top >= boxOf(ways.lastElementChild).bottom, 'the cross is among the colours');
  expect(boxOf(ways).bottom <= boxOf(find('divider').children[1]).top, 'the verdict is below its panel');
  viewer.compare.end();
  press('Enter');
  await until(() => find('pick').textContent.includes('2.00 m'), 'picks');
  testApart(find('pick'), [...find('pick').querySelectorAll('button')]);
  press('i');
  await frame();
  testApart(find('player'), [find('bar'), document.querySelector('.fold')]);
}

async function testStudioPage() {
  const { player, verdict, answers, heats } = await openStudio();
  const { viewer, studio } = player;
  testFields();
  testCurve(studio);
  testNumbers(studio);
  await testAutoCurve(studio);
  const foot = find('studio').querySelector('footer');
  const code = foot.querySelector('code');
  expect(foot.offsetHeight < 64 && !code.checkVisibility(), `the foot is ${foot.offsetHeight} high`);
  foot.querySelector('.unfold').click();
  expect(code.checkVisibility() && foot.querySelector('.unfold').ariaExpanded === 'true', 'the foot does not open');
  await until(() => find('player').querySelector('.status').textContent.startsWith('picture 8 × 4'), 'says what is shown');
  const undo = find('studio').querySelector('[data-action="undo"]');
  expect(undo.dataset.tip === 'Undo' && undo.dataset.key === 'Ctrl-Z' && undo.ariaLabel === 'Undo', 'undo has no tooltip');
  press('Enter');
  await until(() => find('pick').textContent.includes('2.00 m'), 'picks by the keyboard');
  expect(find('pick').contains(document.activeElement), 'what can be done with it is not next');
  press('Escape', document.activeElement);
  expect(find('pick').hidden && document.activeElement === viewer.element, 'Escape does not lead back');
  await testWalk(player, answers);
  press('x');
  await until(() => viewer.compare && studio.session.sides[1], 'compares A and B');
  press('Home', find('divider'));
  viewer.draw(0);
  expect(viewer.picture.split === 0 && find('divider').querySelector('.now').textContent === 'B', 'the line does not move, or B is not marked');
  await until(() => viewer.picture.beside, 'has B beside A');
  expect(testContrast(document.body) > 60, 'few texts');
  press('x');
  expect(!viewer.compare && viewer.picture, 'the comparison does not end');
  press('q');
  await until(() => viewer.compare && heats() === 2, 'shows what strains the eyes');
  expect(viewer.compare.split === 0 && /Comfort: caution/.test(find('divider').textContent), 'the layer of comfort does not say its verdict');
  find('ways').querySelector('button:not([data-way]):not([aria-label])').click();
  expect(viewer.state.pitch === -80 && find('ways').querySelectorAll('.legend > span').length === 3, 'the worst place, or what colours mean, is not there');
  verdict.level = 'warn';
  studio.session.edit({ 'sidecar.yaw': 3 });
  await until(() => heats() >= 4 && /Comfort: warn/.test(find('divider').textContent), 'judges again what is changed');
  press('x');
  await until(() => studio.comparing && !/Comfort/.test(find('divider').textContent), 'leaves comfort to compare A and B');
  press('q');
  expect(studio.comparing, 'comfort lies over two settings');
  press('x');
  expect(!viewer.compare, 'the comparison does not end');
  press('?');
  await until(() => find('help').open, 'the help does not open');
  expect(find('keys').querySelector('h2').textContent === 'Studio', 'the help does not begin with the studio');
  find('help').close();
}

// --- <stereo-360> ---------------------------------------------------------------------------------------------------

async function makeElement(attributes) {
  const element = document.createElement('stereo-360');
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.style.width = '320px';
  document.body.append(element);
  return element;
}

async function testElement() {
  await load('script', { src: 'stereo-360.js' });
  const heard = [];
  const element = await makeElement({ item: '0', yaw: '20', mode: 'anaglyph', poster: 'item/0/poster.jpg' });
  for (const name of ['ready', 'load', 'look', 'progress', 'error']) element.addEventListener(name, ({ detail }) => heard.push([name, detail]));
  const root = element.shadowRoot;
  expect(!root.getElementById('poster').hidden, 'no poster');
  await until(() => element.loaded, 'loads what is in view');
  expect(root.getElementById('poster').hidden, 'the poster stays');
  const names = heard.map(([name]) => name);
  expect(names.includes('ready') && names.includes('load') && names.includes('progress') && !names.includes('error'), `events: ${names}`);
  expect(element.yaw === 20 && element.mode === 'anaglyph' && element.fov === 90, 'properties do not follow');
  element.yaw = 50;
  expect(element.viewer.state.yaw === 50, 'an attribute does not turn it');
  element.lookAt({ yaw: 70, fov: 60 });
  expect(element.yaw === 70 && heard.some(([name, detail]) => name === 'look' && detail.yaw === 70), 'lookAt');
  expect((await element.screenshot()).type === 'image/png', 'no screenshot');
  expect(root.querySelectorAll('#bar button svg').length >= 4 && root.querySelector('#tools [data-action="swap"]').dataset.key === 'S', 'another bar than the page');
  press('s', element.viewer.canvas);
  expect(element.viewer.state.swap, 'its keys do nothing');
  press('s', document.body);
  expect(element.viewer.state.swap, 'it takes the keys of the page');
  const wheel = new WheelEvent('wheel', { deltaY: 100, cancelable: true });
  element.viewer.element.dispatchEvent(wheel);
  expect(!wheel.defaultPrevented && element.fov === 60, 'it takes the wheel of the page');
  element.remove();
  expect(!element.loaded, 'it keeps its picture');

  const far = await makeElement({ item: '0' });
  far.style.marginTop = '5000px'; // the server's policy allows no attribute of style
  await sleep(300);
  expect(!far.viewer, 'it loads what nobody sees');
  far.scrollIntoView();
  await until(() => far.loaded, 'loads when it comes into view');
  far.remove();

  const wrong = await makeElement({ src: 'no-such.jpg', loading: 'eager' });
  const reason = await new Promise((done) => wrong.addEventListener('error', ({ detail }) => done(detail.message), { once: true }));
  const words = wrong.shadowRoot.getElementById('message').textContent;
  expect(/404/.test(reason) && /did not load/.test(words) && !/404|ods|JPEG/.test(words), `visitors read: ${words}; scripts: ${reason}`);
  wrong.shadowRoot.getElementById('again').click();
  expect(await new Promise((done) => wrong.addEventListener('error', () => done(true), { once: true })), 'it does not try again');
  wrong.remove();

  const clicked = await makeElement({ item: '0', reveal: 'click', autorotate: '' });
  await until(() => clicked.shadowRoot.getElementById('reveal'), 'offers to begin');
  expect(!clicked.loaded && clicked.shadowRoot.getElementById('poster').src.endsWith('item/0/poster.jpg'), 'no poster of its own');
  clicked.shadowRoot.getElementById('reveal').click();
  await until(() => clicked.loaded && clicked.yaw > 0.2, 'turns slowly');
  clicked.remove();
}

// In a page of A-Frame: both draw, and neither disturbs the other.
async function testAframe() {
  await load('script', { src: 'npm/aframe/dist/aframe-master.min.js' });
  await load('script', { src: 'stereo-360.js' });
  document.body.insertAdjacentHTML('beforeend', '<a-scene embedded style="display: block; width: 200px; height: 100px"><a-box position="0 1.6 -2" color="#f00" material="shader: flat"></a-box></a-scene>');
  const scene = document.querySelector('a-scene');
  const element = await makeElement({ item: '0' });
  await until(() => element.loaded && scene.hasLoaded && scene.renderer, 'shows both');
  scene.renderer.render(scene.object3D, scene.camera);
  expect(pixelOf(scene.canvas, 0.5, 0.5).join() === '255,0,0', `the box is ${pixelOf(scene.canvas, 0.5, 0.5)}`);
  element.viewer.draw(0);
  expect(pixelOf(element.viewer.canvas, 0.5, 0.6).some((value) => value > 40), 'the panorama is dark');
  press('s', element.viewer.canvas);
  expect(element.viewer.state.swap, 'keys do not arrive');
}

// In a page of three.js: its picture on a box is the panorama's canvas.
async function testThree() {
  const THREE = await import('./npm/three/build/three.module.js');
  await load('script', { src: 'stereo-360.js' });
  const element = await makeElement({ item: '0' });
  await until(() => element.loaded, 'loads');
  element.viewer.draw(0);
  const canvas = document.body.appendChild(Object.assign(document.createElement('canvas'), { width: 64, height: 64 }));
  const renderer = new THREE.WebGLRenderer({ canvas, preserveDrawingBuffer: true });
  const scene = new THREE.Scene();
  const camera = new THREE.OrthographicCamera(-0.5, 0.5, 0.5, -0.5, 0, 2);
  const texture = new THREE.CanvasTexture(element.viewer.canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(1, 1), new THREE.MeshBasicMaterial({ map: texture })));
  scene.children[0].position.z = -1;
  renderer.render(scene, camera);
  const [ours, theirs] = [pixelOf(element.viewer.canvas, 0.25, 0.75), pixelOf(canvas, 0.25, 0.75)];
  expect(ours.every((value, i) => Math.abs(value - theirs[i]) < 40) && ours.some((value) => value > 20), `${ours} became ${theirs}`);
}

// --- sound ----------------------------------------------------------------------------------------------------------

// The loudness of a wave from a direction (unit, AmbiX axes: ahead, left, up) in each ear of a head that looks along
// `ahead`.
async function ears([x, y, z], ahead) {
  const context = new OfflineAudioContext(2, 24000, 48000);
  const sound = context.createBuffer(4, 24000, 48000);
  let seed = 1;
  for (let i = 0; i < sound.length; i++) {
    seed = (seed * 16807) % 2147483647;
    const wave = (seed / 2147483647 - 0.5) * 0.5;
    [1, y, z, x].forEach((part, channel) => (sound.getChannelData(channel)[i] = wave * part));
  }
  const source = new AudioBufferSourceNode(context, { buffer: sound });
  listen(context, source)(ahead, [0, 1, 0]);
  source.start();
  const heard = await context.startRendering();
  return [0, 1].map((ear) => Math.sqrt(heard.getChannelData(ear).reduce((sum, value) => sum + value * value, 0) / heard.length));
}

async function testSound() {
  const [fromLeft, fromRight, fromAhead, turned, behind] = [
    await ears([0, 1, 0], [0, 0, -1]), await ears([0, -1, 0], [0, 0, -1]), await ears([1, 0, 0], [0, 0, -1]),
    await ears([0, 1, 0], [-1, 0, 0]), await ears([0, 1, 0], [0, 0, 1])];
  const balance = ([left, right]) => 20 * Math.log10(left / right);
  expect(balance(fromLeft) > 4 && balance(fromRight) < -4, `from the left ${balance(fromLeft)} dB, from the right ${balance(fromRight)} dB`);
  expect(Math.abs(balance(fromAhead)) < 1 && Math.abs(balance(turned)) < 1, `from ahead ${balance(fromAhead)} dB, when one turns to it ${balance(turned)} dB`);
  expect(balance(behind) < -4, `to who looks back, the left is right: ${balance(behind)} dB`);
  const power = (pair) => pair[0] ** 2 + pair[1] ** 2;
  expect(Math.abs(10 * Math.log10(power(fromLeft) / power(fromAhead))) < 4, 'directions differ in loudness');
}

const TESTS = { page: testThePage, light: testLight, phone: testPhone, video: testVideo, studio: testStudioPage, 'studio-phone': testStudioPhone, element: testElement, elements: ({ test }) => testElements(test), aframe: testAframe, three: testThree, sound: testSound };

export async function testPage(job) {
  if (job.page === 'elements') for (const i of [1, 2]) await load('script', { src: `stereo-360.js?${i}` }); // twice
  return TESTS[job.page](job);
}
