// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws looks with the page's own modules and sends them to the server that asks for them: jobs.json is
//   [{ item, choice, width, height, looks: [{ name, eye, yaw, pitch, fov, show, swap, moves, cheap }] }, ...]
// where item is an index of view.json. Every look is sent to result/NAME as PNG, the end, or what failed, to done.
// A job may have `paging` (pages.js), as if its picture were too large for the GPU. The job { item, rest: true } throws
// where the viewer does not become exact at rest.
// Looks at a video may have its `frame`, and `step` where it is to be reached by so many steps from the last one.
// The job { item, layers: NAME } sends the layer of a picture, as a headset's browser would be given it; `cube` is for a
// browser that has cube layers, which are sent as lat-long pictures.
// A job with `headset` shows its looks in an emulated headset instead; both eyes are sent, side by side. Its looks may
// have `press` and `stick`: what a hand does to its controller first. The job { studio: true } runs studio-test.js instead,
// { page: NAME } a test of page-test.js, { panel: NAME } a part of headset-test.js, { layered: NAME } one of
// layered-test.js, { objects: NAME } one of objects-test.js, { tour: NAME } one of tour-test.js, and
// { stage: NAME } one of stage-test.js.
import { Headset } from './headset.js';
import { Pace } from './pace.js';
import { Panorama, compile, raysOf } from './panorama.js';
import { openPicture } from './picture.js';
import { Viewer } from './viewer.js';

const json = async (path) => (await fetch(path)).json();
const post = (path, body) => fetch(path, { method: 'POST', body });
const sendCanvas = async (canvas, name) => post(`result/${name}`, await new Promise((done) => canvas.toBlob(done)));

function makeCanvas({ width, height }) {
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  document.body.append(canvas);
  return canvas;
}

function makeViewer(view, { width, height }) {
  const element = document.body.appendChild(document.createElement('div'));
  Object.assign(element.style, { position: 'relative', width: `${width}px`, height: `${height}px` });
  const viewer = new Viewer(element, view, location.href);
  viewer.wake(new Panorama());
  return viewer;
}

let drawing; // one for all pictures: software compiles the shader for seconds

async function draw(view, { item, choice, width, height, looks, paging }) {
  drawing ??= new Panorama(makeCanvas({ width, height }));
  const panorama = drawing;
  const { canvas } = panorama;
  Object.assign(canvas, { width, height });
  const picture = await openPicture(panorama, view, view.items[item], { choice, paging });
  if (paging) while (picture.pager.refine());
  for (const { name, eye = 0, show, swap, frame, step, moves, cheap, ...look } of looks) {
    if (frame !== undefined) await reach(picture, frame, step);
    picture.refresh?.();
    const options = { rays: raysOf(look, width / height), box: [0, 0, width, height], show, eye, swap, moves, cheap };
    while (picture.pager?.look([options], 4));
    panorama.draw(picture, options);
    await sendCanvas(canvas, name);
  }
  picture.free();
}

// Until the frame is there, and has been copied again as the page does when a seek has settled.
async function reach(picture, frame, step) {
  const there = new Promise((done) => {
    picture.changed = () => picture.frame() === frame && !picture.video.seeking && done();
  });
  if (step) picture.step(step);
  else picture.seek((frame + 0.5) / picture.fps);
  await there;
  await new Promise((done) => setTimeout(done, 500));
}

// The picture of a cube map that a compositor shows in each direction.
const CUBE = `#version 300 es
precision highp float;
uniform samplerCube cube;
in vec2 screen;
out vec4 color;
void main() {
  vec2 a = screen * vec2(3.14159265, 1.57079633);
  color = texture(cube, vec3(sin(a.x) * cos(a.y), sin(a.y), -cos(a.x) * cos(a.y)));
}`;

// Draws cube maps side by side as lat-long pictures.
function flatten(gl, cubes, target, [width, height]) {
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  const flat = gl.getParameter(gl.TEXTURE_BINDING_2D);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, 2 * width, height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, flat, 0);
  gl.useProgram(compile(gl, CUBE));
  gl.activeTexture(gl.TEXTURE0);
  for (const [i, cube] of cubes.entries()) {
    gl.bindTexture(gl.TEXTURE_CUBE_MAP, cube);
    gl.viewport(i * width, 0, width, height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

// Plays the browser's part of the WebXR Layers API, which no browser has without a headset: one texture for both eyes, or a
// cube map for each.
async function layOut(view, { item, layers: name, cube }) {
  const { EyeLayers } = await import('./layers.js');
  const panorama = new Panorama(makeCanvas({ width: 64, height: 64 }));
  const { gl } = panorama;
  const texture = gl.createTexture();
  let asked;
  window.XRRigidTransform = class { constructor(position, orientation) { Object.assign(this, { position, orientation }); } };
  window.XRWebGLBinding = class {
    createEquirectLayer(init) {
      asked = init;
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, 2 * init.viewPixelWidth, init.viewPixelHeight);
      return { needsRedraw: true };
    }

    getSubImage(layer, frame, eye) {
      const { viewPixelWidth: width, viewPixelHeight: height } = asked;
      return { colorTexture: texture, viewport: { x: eye === 'left' ? 0 : width, y: 0, width, height } };
    }
  };
  const cubes = [gl.createTexture(), gl.createTexture()];
  if (cube) {
    XRWebGLBinding.prototype.createCubeLayer = (init) => {
      asked = init;
      for (const each of cubes) {
        gl.bindTexture(gl.TEXTURE_CUBE_MAP, each);
        gl.texStorage2D(gl.TEXTURE_CUBE_MAP, 1, gl.RGBA8, init.viewPixelWidth, init.viewPixelHeight);
        gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
      }
      return { needsRedraw: true };
    };
    XRWebGLBinding.prototype.getSubImage = (layer, frame, eye) => ({
      colorTexture: cubes[eye === 'left' ? 0 : 1], viewport: { x: 0, y: 0, width: asked.viewPixelWidth, height: asked.viewPixelHeight },
    });
  }
  const session = { renderState: { baseLayer: null }, updateRenderState: (state) => Object.assign(session.renderState, state) };
  const picture = await openPicture(panorama, view, view.items[item], {});
  const layer = new EyeLayers(session, gl, 'local');
  if (!layer.show(null, { panorama, picture, state: { swap: false, grid: false } }, Math.PI / 2)) throw new Error('no layer');
  const [shown] = session.renderState.layers;
  const { x, y, z, w } = cube ? shown.orientation : shown.transform.orientation;
  await post(`result/${name}.json`, JSON.stringify({ ...asked, orientation: [x, y, z, w] }));
  const [width, height] = cube ? [8 * asked.viewPixelWidth, 2 * asked.viewPixelWidth] : [2 * asked.viewPixelWidth, asked.viewPixelHeight];
  if (cube) flatten(gl, cubes, layer.target, [width / 2, height]);
  const pixels = new Uint8ClampedArray(4 * width * height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, layer.target); // has the texture
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(pixels.buffer));
  const flat = makeCanvas({ width, height });
  const rows = flat.getContext('2d');
  for (let row = 0; row < height; row++) {
    rows.putImageData(new ImageData(pixels.slice(4 * width * row, 4 * width * (row + 1)), width, 1), 0, height - 1 - row);
  }
  await sendCanvas(flat, name);
}

// The device's orientation: a turn to the right by yaw, after a turn up by pitch.
function orient(quaternion, { yaw = 0, pitch = 0 }) {
  const [y, p] = [-yaw, pitch].map((angle) => (angle * Math.PI) / 360);
  const [sy, cy, sp, cp] = [Math.sin(y), Math.cos(y), Math.sin(p), Math.cos(p)];
  quaternion.set(cy * sp, sy * cp, -sy * sp, cy * cp);
}

async function wear(view, job) {
  // The runtime makes the canvas as large as the window.
  Object.defineProperties(window, { innerWidth: { value: job.width }, innerHeight: { value: job.height } });
  const { XRDevice, metaQuest3 } = await import('./iwer.module.js');
  const device = new XRDevice(metaQuest3);
  device.installRuntime({ forceInstall: true });
  XRWebGLLayer.prototype.fixedFoveation = 0; // which the emulation lacks
  device.stereoEnabled = true;
  device.fovy = Math.PI / 2;
  device.position.set(3, 1.6, -2); // which must not matter
  const viewer = makeViewer(view, job);
  const { canvas } = viewer;
  await viewer.open(job.item, job.choice);
  if (!viewer.picture) throw new Error('the picture did not open');
  const headset = new Headset(viewer, {});
  await headset.toggle();
  // Our callback comes after the headset's, which was asked for before.
  const frames = (count) => new Promise((done) => {
    const next = () => (count-- > 0 && headset.session ? headset.session.requestAnimationFrame(next) : done());
    next();
  });
  await frames(2);
  const { frameRate, renderState: { baseLayer } } = headset.session;
  if (frameRate !== 90) throw new Error(`the headset shows ${frameRate} pictures per second`);
  if (!(baseLayer.fixedFoveation > 0)) throw new Error('the edge of the view is drawn as finely as its middle');
  for (const { name, press, stick, ...look } of job.looks) {
    orient(device.quaternion, look);
    await frames(2);
    const hand = device.controllers.right;
    if (press) {
      hand.updateButtonValue(press, 1);
      await frames(2);
      hand.updateButtonValue(press, 0);
    }
    if (stick) {
      hand.updateAxes('thumbstick', ...stick);
      await frames(2);
      hand.updateAxes('thumbstick', 0, 0);
    }
    await frames(2);
    if (headset.session) await sendCanvas(canvas, name);
    else await post(`result/${name}`, 'left');
  }
  if (headset.session) await headset.session.end();
  await post('result/ended', String(viewer.session));
}

// Steps down where frames are late, as far as it helps, and up again where there is time.
function testPace() {
  let now = 0;
  const after = (pace, frames, time) => {
    for (let i = 0; i < frames; i++) {
      now += time(pace.how);
      pace.took(time(pace.how), now);
    }
    return pace.level;
  };
  const pace = new Pace();
  if (after(pace, 100, () => 17) !== 0) throw new Error('pace: steps down without need');
  if (after(pace, 100, ({ scale, cheap }) => (cheap ? 40 : 80) * scale * scale + 2) !== 2) throw new Error('pace: does not find the first level in time');
  if (after(pace, 1000, () => 17) !== 0) throw new Error('pace: does not step up again');
  if (after(new Pace(), 200, () => 50) > 1) throw new Error('pace: goes on where it does not help');
  const strange = new Pace();
  for (let i = 0; i < 500; i++) if (after(strange, 1, () => 5 + ((i * 37) % 90)) > 3 || !strange.how) throw new Error('pace: no such level');
}

function pixelsOf({ canvas, panorama: { gl } }) {
  const bytes = new Uint8Array(4 * canvas.width * canvas.height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  return bytes.join();
}

// The next picture of a folder is opened while the viewer rests: then it is in the next frame, and nothing is fetched,
// decoded or sent to the GPU for it. The one that is left is kept, for the way back.
async function testAhead(viewer, item) {
  const { gl } = viewer.panorama;
  const asked = { fetch: 0, createImageBitmap: 0, texSubImage3D: 0, generateMipmap: 0 };
  for (const name of Object.keys(asked)) {
    const owner = name in gl ? gl : window;
    const own = owner[name].bind(owner);
    owner[name] = (...values) => (asked[name]++, own(...values));
  }
  const counts = () => Object.values(asked).join();
  viewer.view = { ...viewer.view, items: [item, { ...item }, { ...item }] };
  const shown = () => {
    viewer.fit();
    viewer.paint(0, { moves: true });
    return pixelsOf(viewer);
  };
  await viewer.open(1);
  const wanted = shown();
  await viewer.openAhead();
  const kept = () => Promise.all([...viewer.ahead.kept.values()].map(({ picture }) => picture));
  const pictures = await kept();
  if (pictures.length !== 2 || pictures.some((each) => !each?.eyes)) throw new Error('ahead: the pictures beside are not open');
  if (!asked.texSubImage3D || !asked.generateMipmap) throw new Error('ahead: nothing is sent to the GPU');
  for (const [by, next] of [[1, pictures[0]], [-1, viewer.picture]]) {
    const before = counts();
    viewer.go(by);
    await new Promise(requestAnimationFrame);
    await new Promise((go) => setTimeout(go)); // until all has run that waited for the frame
    if (viewer.picture !== next || viewer.waiting) throw new Error('ahead: the next frame does not show the picture');
    if (shown() !== wanted) throw new Error('ahead: a picture is not what it is when it is opened at once');
    if (counts() !== before) throw new Error(`ahead: ${Object.keys(asked)} were ${before}, then ${counts()}`);
  }
  await viewer.openAhead();
  if ((await kept()).length !== 2) throw new Error('ahead: keeps other pictures than those beside');
  viewer.ahead.keep([]);
  await new Promise(requestAnimationFrame);
  if (pictures.some(({ eyes }) => eyes.some(({ texture }) => viewer.picture.eyes[0].texture !== texture && gl.isTexture(texture)))) throw new Error('ahead: does not free its pictures');
}

// The viewer draws quickly at first, and at rest exactly what one exact drawing shows; a movement interrupts it.
async function rest(view, { item }) {
  testPace();
  const viewer = makeViewer(view, { width: 200, height: 150 });
  const { canvas } = viewer;
  const settled = () => new Promise((done) => viewer.addEventListener('settled', done, { once: true }));
  const pixels = () => pixelsOf(viewer);
  for (const mode of ['left', 'side-by-side', 'anaglyph']) {
    viewer.set({ mode, yaw: 20 });
    if (!viewer.picture) await viewer.open(item);
    await settled();
    const atRest = pixels();
    viewer.paint(0, {});
    if (pixels() !== atRest) throw new Error(`${mode}: not exact at rest`);
    viewer.set({ yaw: 40 });
    await new Promise((done) => viewer.panorama.finished(() => new Promise(requestAnimationFrame)).then(done));
    const moving = pixels();
    viewer.paint(0, {});
    if (pixels() === moving) throw new Error(`${mode}: exact while it moves`);
  }
  await testAhead(viewer, view.items[item]);
}

async function run() {
  const jobs = await json('jobs.json');
  if (jobs[0]?.page) return (await import('./page-test.js')).testPage(jobs[0]);
  if (jobs[0]?.panel) return (await import('./headset-test.js')).testHeadset(jobs[0].panel);
  if (jobs[0]?.layered) return (await import('./layered-test.js')).testLayered(jobs[0]);
  if (jobs[0]?.tour) return (await import('./tour-test.js')).testTour(jobs[0].tour);
  if (jobs[0]?.stage) return (await import('./stage-test.js')).testStage(jobs[0]);
  if (jobs[0]?.objects) return (await import('./objects-test.js')).testObjects(jobs[0]);
  if (jobs[0]?.studio) return (await import('./studio-test.js')).testStudio();
  const view = await json('view.json');
  for (const job of jobs) await (job.headset ? wear : job.rest ? rest : job.layers ? layOut : draw)(view, job);
}

run().then(() => post('done', 'ok'), (error) => post('done', `${error.message}\n${error.stack}`));
