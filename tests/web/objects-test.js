// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in a layered scene (objects-files.js), in a browser, against closed forms. testObjects(job) runs a
// part, and throws an error if it fails.
import { CENTER, COLORS, PILLAR, cubeGlb, roomGlb } from './objects-files.js';
import { Panorama } from './panorama.js';
import { Player } from './player.js';

const SIZE = { width: 240, height: 180 };
const EYE = 0.0315; // metres from the middle of the head
const BLACK = { pbrMetallicRoughness: { baseColorFactor: [0, 0, 0, 1], metallicFactor: 0 } };
const GLOWING = { ...BLACK, emissiveFactor: [0, 9, 0] };
const WHITE = { pbrMetallicRoughness: { metallicFactor: 0 } };
const Y0 = 0.282095;
const Y1 = 0.488603;

const sleep = (time) => new Promise((done) => setTimeout(done, time));
const files = new Map(); // what the page gets at an address
const sent = []; // what it posts

function expect(is, what) {
  if (!is) throw new Error(`objects: ${what}`);
}

async function until(is, what) {
  for (let i = 0; i < 1200; i++) {
    if (is()) return;
    await sleep(50);
  }
  throw new Error(`objects: never ${what}`);
}

const ask = window.fetch;
window.fetch = async (address, options) => {
  const path = new URL(address, location.href).pathname.replace(/^.*\/(?=item\/|objects$)/, '');
  if (options?.method === 'POST' && path === 'objects') {
    sent.push({ query: new URL(address, location.href).search, ...JSON.parse(options.body) });
    return new Response(JSON.stringify({ file: 'room.objects.json' }));
  }
  return files.has(path) ? new Response(files.get(path)) : ask(address, options);
};

// A player that has opened a room with objects: { file, at, turn } each.
async function open(objects, room = {}, more = {}) {
  document.getElementById('player')?.remove();
  files.set('item/0/picture.glb', await roomGlb(room));
  const listed = objects.map(({ file, ...place }, i) => {
    files.set(`item/0/object-${i}.glb`, file);
    return { file: `item/0/object-${i}.glb`, name: `thing ${i}.glb`, at: [0, 0, 0], turn: 0, ...place };
  });
  const item = { name: 'room.layers.glb', kind: 'layers', image: 'item/0/picture.glb', scene: 'room', objects: listed, ...more };
  const box = document.body.appendChild(Object.assign(document.createElement('div'), { id: 'player' }));
  const element = box.appendChild(Object.assign(document.createElement('div'), { id: 'picture', tabIndex: 0 }));
  Object.assign(element.style, { position: 'relative', width: `${SIZE.width}px`, height: `${SIZE.height}px` });
  const player = new Player(box, document, { view: { items: [item], live: true }, base: location.href, keys: document, isPage: true });
  const { viewer } = player;
  viewer.wake(new Panorama());
  let reason;
  viewer.addEventListener('failed', ({ detail }) => (reason = detail), { once: true });
  await viewer.open(0);
  expect(viewer.picture, reason);
  viewer.set({ mode: 'left', fov: 90 });
  await until(() => viewer.picture.objects?.hands, 'has its objects');
  return player;
}

// The pixels of the left eye's view, from the upper left corner: at(x, y) is a colour.
function look(viewer, state = {}) {
  viewer.set(state);
  viewer.fit();
  viewer.paint(0, {});
  const { canvas, panorama: { gl } } = viewer;
  const { width, height } = canvas;
  const bytes = new Uint8Array(4 * width * height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  const at = (x, y) => [...bytes.subarray(4 * (x + width * (height - 1 - y)), 4 * (x + width * (height - 1 - y)) + 3)];
  return { width, height, at };
}

// The ray of a left eye through a point of its view, of a head in the middle with a pitch.
function rayOf(x, y, { width, height }, pitch = 0) {
  const p = (pitch * Math.PI) / 180;
  const [a, b] = [(2 * x) / width - 1, (1 - (2 * y) / height) * (height / width)];
  return { from: [CENTER[0] - EYE, CENTER[1], CENTER[2]], along: [a, Math.sin(p) + b * Math.cos(p), b * Math.sin(p) - Math.cos(p)] };
}

// The distance to a cube that is not turned, or Infinity.
function cubeAt({ from, along }, at, half) {
  let [near, far] = [0, Infinity];
  for (let i = 0; i < 3; i++) {
    const ends = [-half, half].map((side) => (at[i] + side - from[i]) / along[i]);
    near = Math.max(near, Math.min(...ends));
    far = Math.min(far, Math.max(...ends));
  }
  return near < far ? near : Infinity;
}

const meets = ({ from, along }, distance) => from.map((value, i) => value + along[i] * distance);

function pillarAt(ray) {
  const distance = (PILLAR.z - ray.from[2]) / ray.along[2];
  const [x, y] = meets(ray, distance);
  return distance > 0 && x > PILLAR.x[0] && x < PILLAR.x[1] && y > PILLAR.y[0] && y < PILLAR.y[1] ? distance : Infinity;
}

// ods/image/tone.cpp.
function shown(light, tone = 'neutral') {
  let color = light;
  if (tone === 'neutral') {
    const low = Math.min(...color);
    color = color.map((value) => value - (low < 0.08 ? low - 6.25 * low * low : 0.04));
    const peak = Math.max(...color);
    if (peak >= 0.76) {
      const rolled = 1 - 0.0576 / (peak + 0.24 - 0.76);
      const colorful = 1 / (0.15 * (peak - rolled) + 1);
      color = color.map((value) => rolled + colorful * ((value * rolled) / peak - rolled));
    }
  }
  return color.map((value) => Math.min(Math.max(value, 0), 1)).map((value) => 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
}

const linear = (code) => (code / 255 <= 0.04045 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4);
// The inverse for a colour whose smallest part is above 0.04 and whose largest is below 0.76.
const untoned = (codes) => codes.map((code) => linear(code) + 0.04);
const near = (a, b, most) => a.every((value, i) => Math.abs(value - b[i]) <= most);
const same = (a, b) => near(a, b, 0);

// --- what is seen ----------------------------------------------------------------------------------------------------

// Half of a cube is behind the pillar: each pixel is of what is nearer.
async function hide() {
  const at = [0, 1.2, -1.5];
  const { viewer } = await open([{ file: cubeGlb({ material: GLOWING }), at }]);
  const view = look(viewer, { yaw: 0, pitch: 0 });
  const counts = { seen: 0, hidden: 0 };
  for (let y = 0; y < view.height; y++) {
    for (let x = 0; x < view.width; x++) {
      const kinds = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([dx, dy]) => {
        const ray = rayOf(x + dx, y + dy, view);
        const [cube, pillar] = [cubeAt(ray, at, 0.2), pillarAt(ray)];
        return cube < pillar ? 'seen' : cube < Infinity ? 'hidden' : 'other';
      });
      if (kinds.some((kind) => kind !== kinds[0])) continue; // an edge
      const [r, g, b] = view.at(x, y);
      const isGreen = g > 240 && r < 240 && b < 240;
      expect(isGreen === (kinds[0] === 'seen'), `pixel ${x}, ${y} is ${[r, g, b]}, and ${kinds[0]}`);
      counts[kinds[0]]++;
    }
  }
  expect(counts.seen > 300 && counts.hidden > 300, `the test sees little: ${JSON.stringify(counts)}`);
}

// A white diffuse object in constant light is as bright as the light, whatever its faces' directions; so is a rough
// metal one.
async function light() {
  const radiance = [0.5, 0.35, 0.2];
  const probe = [...radiance.map((value) => value / Y0), ...Array(24).fill(0)];
  const at = [-0.4, 1.1, -1];
  for (const [exposure, tone, material] of [[0, 'neutral', WHITE], [0.5, 'neutral', WHITE], [1.5, 'neutral', WHITE], [0.5, 'linear', WHITE], [0.5, 'neutral', {}]]) {
    const { viewer } = await open([{ file: cubeGlb({ material }), at, turn: 30 }], { light: { exposure, tone }, probe });
    const view = look(viewer);
    const wanted = shown(radiance.map((value) => value * 2 ** exposure), tone);
    const found = view.at(Math.round(view.width / 2 - 0.37 * (view.width / 2)), Math.round(view.height / 2 + 0.1 * (view.width / 2)));
    expect(near(found, wanted, 1.5), `light ${radiance} at ${exposure} stops, ${tone}, is ${found}, and not ${wanted}`);
  }
  const { viewer } = await open([{ file: cubeGlb({ material: WHITE }), at }]); // no probes
  const found = look(viewer).at(76, 102);
  expect(near(found, shown([0.5, 0.5, 0.5]), 1.5), `without probes it is ${found}`);
}

// A polished cube shows the wall on its top, and on its front, towards which nothing was baked, what the probes have.
async function mirror() {
  const around = [0.3, 0.3, 0.6];
  const probe = [...around.map((value) => value / Y0), ...Array(24).fill(0)];
  const polished = { pbrMetallicRoughness: { roughnessFactor: 0 } };
  const { viewer } = await open([{ file: cubeGlb({ material: polished }), at: [0, 1, -1.6] }], { probe });
  await until(() => viewer.picture.objects.all[0].mirrored, 'reflects');
  const front = look(viewer, { pitch: 0 }).at(112, 107);
  expect(near(front, shown(around), 3), `the front is ${front}, and not ${shown(around)}`);
  const height = 0.15; // of the eye, above the middle
  const [x, y] = placeOf([0, 1.2 - height, -1.6], SIZE, 0).map(Math.round);
  const top = look(viewer, { y: height }).at(x, y);
  expect(near(top, COLORS.wall, 4), `the top at ${x}, ${y} is ${top}, and not ${COLORS.wall}`);
}

// Light from one side and from everywhere: the floor in the middle of the shadow is what the second leaves; nothing else
// changes. The floor's two halves overlap there, and are not darkened twice.
async function shade() {
  const toward = [0.6, 0.8, 0];
  const [sun, around] = [1.2, 0.1]; // irradiance, radiance
  const zeroth = around / Y0 + sun * Y0;
  const probe = [zeroth, toward[1] * sun * Y1, 0, toward[0] * sun * Y1, 0, 0, 0, 0, 0].flatMap((value) => [value, value, value]);
  const at = [0.2, 0.5, -1.6];
  const half = 0.2;
  const { viewer } = await open([{ file: cubeGlb({ half, material: GLOWING }), at }], { probe });
  const state = { yaw: 0, pitch: -30 };
  const after = look(viewer, state);
  const { objects } = viewer.picture;
  const all = objects.all.splice(0);
  const before = look(viewer, state);
  objects.all.push(...all);
  const left = (Math.PI * around) / (Math.PI * around + sun * toward[1]);
  const umbra = shown(untoned(COLORS.floor).map((value) => value * left));
  const counts = { umbra: 0, outside: 0, pillar: 0 };
  for (let y = 0; y < after.height; y++) {
    for (let x = 0; x < after.width; x++) {
      const ray = rayOf(x + 0.5, y + 0.5, after, -30);
      if (cubeAt(ray, at, half + 0.03) < Infinity) continue;
      const [now, was] = [after.at(x, y), before.at(x, y)];
      const where = `pixel ${x}, ${y} was ${was} and is ${now}`;
      const distance = -ray.from[1] / ray.along[1];
      const [, , z] = meets(ray, distance);
      const isFloor = distance > 0 && z > -3 && pillarAt(ray) > distance;
      expect(now.every((value, i) => value <= was[i]), `${where}: brighter`);
      if (!isFloor) {
        if (pillarAt(ray) < Infinity) counts.pillar++;
        expect(same(now, was), `${where}: not of the floor`);
        continue;
      }
      // Where the ray from the floor to the sun passes the middle of the cube.
      const from = meets(ray, distance);
      const up = { from, along: toward };
      const below = cubeAt({ from, along: [1e-9, 1, 1e-9] }, at, 2.2 * half) < Infinity;
      if (cubeAt(up, at, 0.3 * half) < Infinity && cubeAt({ from, along: [1e-9, 1, 1e-9] }, at, 1.4 * half) === Infinity) {
        counts.umbra++;
        expect(near(now, umbra, 6), `${where}: in the shadow it should be ${umbra}`);
      } else if (!below && cubeAt(up, at, 2.3 * half) === Infinity) {
        counts.outside++;
        expect(same(now, was), `${where}: outside of the shadow`);
      }
    }
  }
  expect(counts.umbra > 20 && counts.outside > 1000 && counts.pillar > 500, `the test sees little: ${JSON.stringify(counts)}`);
}

// --- what moves ------------------------------------------------------------------------------------------------------

const glowAt = (view) => {
  let [sum, count] = [0, 0];
  for (let y = 0; y < view.height; y++) {
    for (let x = 0; x < view.width; x++) {
      const [r, g] = view.at(x, y);
      if (g > 240 && r < 240) [sum, count] = [sum + x, count + 1];
    }
  }
  return { x: sum / count, count };
};

// Objects move and deform by their frames, pause, and one that does not move costs nothing.
async function animate() {
  const shifts = [[-0.3, 0, 0], [0.3, 0, 0], [0.3, 0, 0], [-0.3, 0, 0]];
  const { viewer } = await open([{ file: cubeGlb({ material: GLOWING, shifts, rate: 0.001 }), at: [-0.5, 1.3, -1.5] }]);
  const [object] = viewer.picture.objects.all;
  const at = (time) => {
    object.time = time;
    viewer.picture.refresh();
    return glowAt(look(viewer, { yaw: 0, pitch: 0 }));
  };
  const places = [0, 0.5, 1, 2.5].map(at);
  expect(places.every(({ count }) => count > 100), 'it is not there');
  const across = places[2].x - places[0].x;
  expect(across > 20 && Math.abs(places[1].x - places[0].x - across / 2) < 2 && Math.abs(places[3].x - places[1].x) < 2, `it is at ${places.map(({ x }) => x)}`);
  let drawn = 0;
  const draw = viewer.draw.bind(viewer);
  viewer.draw = (now) => {
    drawn++;
    draw(now);
  };
  await until(() => drawn > 5, 'continues by itself');
  document.dispatchEvent(new KeyboardEvent('keydown', { key: ' ', bubbles: true, cancelable: true }));
  await sleep(500);
  drawn = 0;
  await sleep(800);
  expect(drawn === 0, `it paused, and ${drawn} pictures are drawn`);
  const grown = await open([{ file: cubeGlb({ material: GLOWING, grows: [1, 2], rate: 0.001 }), at: [-0.5, 1.3, -1.5] }]);
  const [first, second] = [0, 0.999].map((time) => {
    grown.viewer.picture.objects.all[0].time = time;
    grown.viewer.picture.refresh();
    return glowAt(look(grown.viewer)).count;
  });
  expect(second > 3.3 * first && second < 5.5 * first, `it grows from ${first} to ${second} pixels`);
  const still = await open([{ file: cubeGlb({ material: GLOWING }), at: [-0.5, 1.3, -1.5] }]);
  await sleep(1500);
  let count = 0;
  const again = still.viewer.draw.bind(still.viewer);
  still.viewer.draw = (now) => {
    count++;
    again(now);
  };
  await sleep(800);
  expect(count === 0, `nothing moves, and ${count} pictures are drawn`);
}

// --- hands and keys --------------------------------------------------------------------------------------------------

const press = (key, shiftKey = false) => document.dispatchEvent(new KeyboardEvent('keydown', { key, shiftKey, bubbles: true, cancelable: true }));

function pointer(element, type, [x, y], more = {}) {
  const { left, top } = element.getBoundingClientRect();
  element.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: left + x, clientY: top + y, bubbles: true, cancelable: true, button: 0, ...more }));
}

// The place of the view at which a point of the scene is seen.
function placeOf(at, { width, height }, pitch) {
  const p = (pitch * Math.PI) / 180;
  const [x, y, z] = at.map((value, i) => value - [CENTER[0] - EYE, CENTER[1], CENTER[2]][i]);
  const [up, ahead] = [y * Math.cos(p) + z * Math.sin(p), y * Math.sin(p) - z * Math.cos(p)];
  return [((x / ahead + 1) / 2) * width, height / 2 - (up / ahead) * (width / 2)];
}

async function drag() {
  const half = 0.15;
  const from = [-0.4, half, -1.6];
  const player = await open([{ file: cubeGlb({ half, material: GLOWING }), at: from, turn: 0 }, { file: cubeGlb({ half: 0.05 }), at: [-1.2, 0.05, -1.6] }]);
  const { viewer, viewer: { element, picture: { objects } } } = player;
  element.setPointerCapture = () => {};
  viewer.set({ pitch: -30 });
  const [object] = objects.all;
  const seen = (at) => placeOf(at, SIZE, -30);
  const start = seen(from);
  const yaw = () => viewer.state.yaw;
  pointer(element, 'pointermove', start);
  expect(element.style.cursor === 'move', 'the pointer does not show that it can be grabbed');
  pointer(element, 'pointerdown', start);
  expect(objects.chosen === object, 'it is not chosen');
  // The pointer goes as its foot goes, from one place of the floor to the other.
  const to = [-0.9, half, -1.4];
  const feet = [from, to].map(([x, , z]) => seen([x, 0, z]));
  const end = start.map((value, i) => value + feet[1][i] - feet[0][i]);
  pointer(element, 'pointermove', start.map((value, i) => (value + end[i]) / 2), { buttons: 1 });
  pointer(element, 'pointermove', end, { buttons: 1 });
  pointer(element, 'pointerup', end);
  expect(yaw() === 0, 'the view turns, too');
  expect(near(object.at, to, 0.03) && Math.abs(object.at[1] - half) < 0.002, `it is at ${object.at}, and not at ${to}`);
  await until(() => sent.length, 'saves');
  expect(sent[0].query === '?item=0' && sent[0].objects.length === 2 && same(sent[0].objects[0].at, object.at) && sent[0].objects[0].name === 'thing 0.glb', `it sends ${JSON.stringify(sent[0])}`);
  // Against the wall.
  const middle = seen(object.at);
  pointer(element, 'pointerdown', middle);
  pointer(element, 'pointermove', [60, 12], { buttons: 1 });
  pointer(element, 'pointerup', [60, 12]);
  expect(Math.abs(object.at[2] - (-3 + half)) < 0.002 && object.at[1] > 0.3, `at the wall it is at ${object.at}`);
  // Escape ends a drag where it began.
  const held = [...object.at];
  pointer(element, 'pointerdown', seen(object.at));
  pointer(element, 'pointermove', [100, 160], { buttons: 1 });
  expect(!same(object.at, held), 'the drag does nothing');
  press('Escape');
  pointer(element, 'pointerup', [100, 160]);
  expect(same(object.at, held), 'Escape does not lead back');
  objects.undo();
  expect(near(object.at, to, 0.03), `undone it is at ${object.at}`);
  element.dispatchEvent(new WheelEvent('wheel', { deltaY: -40, clientX: element.getBoundingClientRect().left + seen(object.at)[0], clientY: element.getBoundingClientRect().top + seen(object.at)[1], bubbles: true, cancelable: true }));
  expect(object.turn === 355 && viewer.state.fov === 90, `the wheel turns it to ${object.turn}, and the field of view is ${viewer.state.fov}`);
  // Beside it, the view turns.
  pointer(element, 'pointerdown', [200, 20]);
  pointer(element, 'pointermove', [210, 20], { buttons: 1 });
  pointer(element, 'pointerup', [210, 20]);
  expect(yaw() !== 0 && !objects.chosen, 'a drag beside it does not turn the view');
  // A thing behind the pillar cannot be grabbed.
  viewer.set({ yaw: 0, pitch: 0 });
  objects.move(object, { at: [0.25, 1.1, -1.6] });
  pointer(element, 'pointerdown', placeOf([0.25, 1.1, -1.6], SIZE, 0));
  pointer(element, 'pointerup', [0, 0]);
  expect(!objects.chosen, 'it is grabbed through the pillar');
}

async function keys() {
  const player = await open([{ file: cubeGlb(), at: [0, 0.5, -1.5], turn: 10 }, { file: cubeGlb({ half: 0.05 }), at: [1, 0, -1] }], {}, { scene: 'my room.glb' });
  const { viewer, viewer: { picture: { objects } } } = player;
  const [object] = objects.all;
  press('ArrowLeft');
  expect(viewer.state.yaw === 355 || viewer.state.yaw === -5, 'the arrows do not turn the head');
  viewer.set({ yaw: 90 });
  press('b');
  expect(objects.chosen === object, 'B does not choose');
  press('ArrowUp');
  press('ArrowRight', true);
  press('PageUp');
  press('j');
  press('K', true);
  expect(same(object.at, [0.05, 0.55, -1.495]) && object.turn === 24, `keys lead to ${object.at} and ${object.turn}`);
  press('z');
  press('z');
  expect(object.turn === 10, `undone, it is turned by ${object.turn}`);
  press('Escape');
  expect(!objects.chosen, 'Escape does not leave it');
  await player.help();
  expect(/choose an object/i.test(document.getElementById('keys').textContent), 'the help does not name it');
  document.getElementById('help').close();
  const panel = document.getElementById('objects');
  const button = (text) => [...panel.querySelectorAll('button')].find(({ textContent }) => textContent === text);
  press('b');
  button('Turn left').click();
  expect(object.turn === 25 && /25°/.test(panel.querySelector('output').textContent), 'the panel does not turn it');
  button('Command').click();
  const command = panel.querySelector('code').textContent;
  const wanted = "ods render 'my room.glb' --position 0,1.2,0 --with 'thing 0.glb' --at 0.05,0.55,-1.495 --turn 25 --with 'thing 1.glb' --at 1,0,-1 -o 'my room_360_TB.png'";
  expect(command === wanted, `the command is ${command}`);
  expect([...panel.querySelectorAll('button, select, output, code')].every((each) => each.textContent || each.ariaLabel), 'a control has no name');
  await until(() => sent.length, 'saves');
}

// --- faults ----------------------------------------------------------------------------------------------------------

async function fail() {
  const good = cubeGlb({ material: GLOWING });
  const cut = good.slice(0, good.byteLength / 2);
  const other = await roomGlb();
  const indices = new Uint8Array(good.slice(0));
  for (let i = indices.length - 100; i < indices.length; i++) indices[i] = 255;
  const words = [[cut, 'cut off'], [new TextEncoder().encode('what?'), 'not a binary glTF'], [other, 'not an object'], [indices.buffer, 'triangles are damaged']];
  for (const [file, word] of words) {
    const { viewer } = await open([{ file }, { file: good, at: [-0.5, 1.3, -1.5] }]);
    const line = document.querySelector('#objects [role="alert"]').textContent;
    expect(line.startsWith('thing 0.glb cannot be shown: ') && line.includes(word) && !line.includes('\n'), `it says: ${line}`);
    expect(glowAt(look(viewer)).count > 100 && document.getElementById('message').hidden, 'the scene or the other object is gone');
  }
  const { viewer } = await open([{ file: good, at: [-0.5, 1.3, -1.5] }], { light: { probes: { origin: [0, 0, 0], step: [1, 1, 1], count: [90, 90, 90], bufferView: 0 } } });
  expect(/light.*damaged/.test(document.querySelector('#objects [role="alert"]').textContent) && glowAt(look(viewer)).count > 100, 'damaged light');
}

// The GPU is reset: the objects return, where they were put.
async function lose() {
  const { viewer } = await open([{ file: cubeGlb({ material: GLOWING }), at: [-0.5, 1.3, -1.5] }]);
  const { gl } = viewer.panorama;
  viewer.picture.objects.move(viewer.picture.objects.all[0], { at: [-0.3, 1.3, -1.5] });
  const was = glowAt(look(viewer));
  const extension = gl.getExtension('WEBGL_lose_context');
  extension.loseContext();
  await until(() => !viewer.picture, 'loses');
  await sleep(100);
  extension.restoreContext();
  await until(() => viewer.picture?.objects?.hands, 'returns');
  const now = glowAt(look(viewer));
  expect(now.count === was.count && now.x === was.x && document.querySelectorAll('#objects').length === 1, `it was ${JSON.stringify(was)} and is ${JSON.stringify(now)}`);
}

const PARTS = { hide, light, mirror, shade, animate, drag, keys, fail, lose };

export const testObjects = (job) => PARTS[job.objects](job);
