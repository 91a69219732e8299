// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in a stereo picture with depth, in a browser. testStage(job, tools) runs a part:
//   { stage: 'vertices', cases: [{ camera, eye, points: [[x, y, z], ...], seen: [[x, y, z], ...] }] } compares the shader's
//   vertices with the library's; it throws an error with the largest angle where that is above a tenth of a minute of arc.
//   { stage: 'looks', width, height, objects, looks: [{ name, shade, width, ...state }], rays: [{ along, eye, away }] }
//   sends the canvas at each look, perhaps of another width; from one without `shade` on, nothing is in the shadow. With
//   `rays` it sends the errors of the picture's distances as meets.json.
//   { stage: 'drag', ...looks, from, to } drags the object from one position on the page to the other, and sends its place.
//   { stage: 'wear', ...looks } sends both eyes of a headset.
import { Headset } from './headset.js';
import { cubeGlb } from './objects-files.js';
import { STAGE_VERTICES } from './objects-stage-shaders.js';
import { Panorama } from './panorama.js';
import { Player } from './player.js';

const GLOWING = { pbrMetallicRoughness: { baseColorFactor: [0, 0, 0, 1], metallicFactor: 0 }, emissiveFactor: [0, 9, 0] };
const WHITE = { pbrMetallicRoughness: { metallicFactor: 0 } };
const MINUTE = Math.PI / 180 / 60;

const sleep = (time) => new Promise((done) => setTimeout(done, time));

async function until(is, what) {
  for (let i = 0; i < 1200; i++) {
    if (is()) return;
    await sleep(50);
  }
  throw new Error(`stage: never ${what}`);
}

// --- vertices --------------------------------------------------------------------------------------------------------

// A program whose vertices write `seen` and `lost`.
function feedbackOf(gl, camera) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, STAGE_VERTICES(camera, 0.04)], [gl.FRAGMENT_SHADER, '#version 300 es\nvoid main() {}']]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.transformFeedbackVaryings(program, ['seen', 'lost'], gl.INTERLEAVED_ATTRIBS);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

function vertices({ cases }) {
  const panorama = new Panorama();
  const { gl } = panorama;
  gl.bindVertexArray(gl.createVertexArray());
  let worst = 0;
  for (const { camera, eye, points, seen } of cases) {
    const each = { program: feedbackOf(gl, camera), shaders: [] };
    const uniforms = panorama.use(each);
    panorama.bindMap(2, camera.merge_map);
    panorama.bindMap(3, camera.head_tilt_map);
    panorama.set(uniforms, {
      camera, merge_texels: 2, head_tilt_texels: 3, sides: [eye, eye], center: [0, 0, 0], frame: [1, 0, 0, 0, 1, 0, 0, 0, 1], to_screen: [1, 0, 0, 0, 1, 0, 0, 0, 1], part: 0,
    });
    gl.uniformMatrix4fv(gl.getUniformLocation(each.program, 'to_world'), false, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(points.flat()), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    const out = gl.createBuffer();
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, out);
    gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 16 * points.length, gl.STREAM_READ);
    gl.enable(gl.RASTERIZER_DISCARD);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, points.length);
    gl.endTransformFeedback();
    gl.disable(gl.RASTERIZER_DISCARD);
    const got = new Float32Array(4 * points.length);
    gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, got);
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
    points.forEach((point, i) => {
      const [a, b] = [[...got.subarray(4 * i, 4 * i + 3)], seen[i]];
      const size = (v) => Math.hypot(...v);
      const off = size(a.map((value, k) => value / size(a) - b[k] / size(b))) / MINUTE;
      const longer = Math.abs(size(a) - size(b));
      if (got[4 * i + 3] || !(off < 0.1) || !(longer < 1e-4 * size(b))) {
        throw new Error(`stage: ${point} is seen at ${a} by eye ${eye}, and not at ${b}: ${off} minutes of arc, ${longer} m; ${JSON.stringify(camera.top)}`);
      }
      worst = Math.max(worst, off);
    });
  }
  return fetch('result/worst', { method: 'POST', body: String(worst) });
}

// --- pictures ----------------------------------------------------------------------------------------------------------

const files = new Map();
const ask = window.fetch;
window.fetch = async (address, options) => {
  const path = new URL(address, location.href).pathname.replace(/^.*\/(?=item\/)/, '');
  return files.has(path) ? new Response(files.get(path)) : ask(address, options);
};

// A player that has opened the picture with cubes in it: { half, at, turn, isWhite } each.
async function open({ width, height, objects }) {
  const view = await (await fetch('view.json')).json();
  const [item] = view.items;
  item.objects = objects.map(({ half, isWhite, at, turn = 0 }, i) => {
    files.set(`item/0/object-${i}.glb`, cubeGlb({ half, material: isWhite ? WHITE : GLOWING }));
    return { file: `item/0/object-${i}.glb`, name: `thing ${i}.glb`, at, turn };
  });
  const box = document.body.appendChild(Object.assign(document.createElement('div'), { id: 'player' }));
  const element = box.appendChild(Object.assign(document.createElement('div'), { id: 'picture', tabIndex: 0 }));
  Object.assign(element.style, { position: 'relative', width: `${width}px`, height: `${height}px` });
  const player = new Player(box, document, { view: { ...view, live: true }, base: location.href, keys: document, isPage: true });
  const { viewer } = player;
  viewer.wake(new Panorama());
  let reason;
  viewer.addEventListener('failed', ({ detail }) => (reason = detail), { once: true });
  await viewer.open(0);
  if (!viewer.picture) throw new Error(reason);
  await until(() => viewer.picture.objects?.hands, 'has its objects');
  const fault = document.querySelector('#objects [role="alert"]').textContent;
  if (fault) throw new Error(fault);
  return viewer;
}

const send = async (canvas, name) => ask(`result/${name}`, { method: 'POST', body: await new Promise((done) => canvas.toBlob(done)) });

async function looks(job) {
  const viewer = await open(job);
  for (const { name, moves = false, shade = true, width = job.width, ...state } of job.looks) {
    if (!shade) viewer.picture.objects.drawer.shade = () => {};
    viewer.element.style.width = `${width}px`;
    viewer.set({ yaw: 0, pitch: 0, fov: 90, mode: 'left', swap: false, shift: 0, ...state });
    viewer.fit();
    viewer.paint(0, { moves });
    await send(viewer.canvas, name);
  }
  if (job.rays) await meets(viewer.picture, job.rays);
  return viewer;
}

function meets({ stage }, rays) {
  const errors = rays.map(({ along, eye, away }) => {
    const { found, at, from } = stage.meet(along, eye);
    return found ? Math.abs(Math.hypot(...at.map((value, i) => value - from[i])) - away) : 1e9;
  });
  return ask('result/meets.json', { method: 'POST', body: JSON.stringify(errors) });
}

function pointer(element, type, [x, y], more = {}) {
  const { left, top } = element.getBoundingClientRect();
  element.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: left + x, clientY: top + y, bubbles: true, cancelable: true, button: 0, ...more }));
}

async function drag(job) {
  const viewer = await looks(job);
  const { element, picture: { objects } } = viewer;
  element.setPointerCapture = () => {};
  pointer(element, 'pointermove', job.from);
  if (element.style.cursor !== 'move') throw new Error('stage: the pointer does not show that it can be grabbed');
  pointer(element, 'pointerdown', job.from);
  if (!objects.chosen) throw new Error('stage: it is not chosen');
  pointer(element, 'pointermove', job.to, { buttons: 1 });
  pointer(element, 'pointerup', job.to);
  await ask('result/place', { method: 'POST', body: JSON.stringify({ at: objects.chosen.at, command: objects.command().join(' ') }) });
}

async function wear(job) {
  Object.defineProperties(window, { innerWidth: { value: job.width }, innerHeight: { value: job.height } });
  const { XRDevice, metaQuest3 } = await import('./iwer.module.js');
  const device = new XRDevice(metaQuest3);
  device.installRuntime({ forceInstall: true });
  XRWebGLLayer.prototype.fixedFoveation = 0;
  device.stereoEnabled = true;
  device.fovy = Math.PI / 2;
  const viewer = await open(job);
  const headset = new Headset(viewer, {});
  await headset.toggle();
  const frames = (count) => new Promise((done) => {
    const next = () => (count-- > 0 ? headset.session.requestAnimationFrame(next) : done());
    next();
  });
  for (const { name, yaw } of job.looks) {
    device.quaternion.set(0, Math.sin((-yaw * Math.PI) / 360), 0, Math.cos((yaw * Math.PI) / 360));
    await frames(4);
    await send(viewer.canvas, name);
  }
  await headset.session.end();
}

const PARTS = { vertices, looks, drag, wear };

export const testStage = (job) => PARTS[job.stage](job);
