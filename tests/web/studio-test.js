// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio's session, live pictures and panel against a server that is played here: what is sent, what can be undone,
// which frames are shown. testStudio() throws what is wrong.
import { Live } from './studio-live.js';
import { Panel } from './studio-panel.js';
import { progressOf } from './studio.js';
import { Session, sleep, valueAt } from './studio-session.js';

const merge = { mode: 'cosine', start: 60, end: 90, exponent: 1 };
export const SETTINGS = {
  sidecar: {
    picture: { layout: 'top-bottom' }, projection: { name: 'lat-long' }, position: [0, 1.5, 0], yaw: 0, pitch: 0, roll: 0, ipd: 0.065,
    neck: 0, merge_top: merge, merge_bottom: merge, axis: null, convergence: { mode: 'parallel', distance: 2 }, lens: { radius: 0, focus_distance: 2 },
  },
  exposure: 1, tone: 'neutral', env: 'auto', sun: { elevation: 35, azimuth: 120 }, turn: 0, strength: 1, variant: '', time: 0, width: 4096,
};

const camera = { projection: { center: [0, 0], span: [6.28, 3.14], angle: 3.14, lens_back: [0, 0, 1] } };
export const PROJECTIONS = [{ name: 'lat-long', camera }, { name: 'mirror-ball', camera }];
// The studio's part of view.json.
export const STUDIO = {
  scene: 'a.glb', settings: SETTINGS, ranges: { ipd: [0, 10] }, merges: ['none', 'cosine'], kernel_merges: { none: 0, cosine: 2 }, convergences: ['parallel', 'toe-in'],
  projections: ['lat-long', 'mirror-ball', 'fisheye-polynomial'], polynomial_lens: { sensor: [36, 24], polynomial: [0, 1, 2, 3, 4] },
  controls: { 'lat-long': ['range'], 'mirror-ball': ['fov', 'lens'], 'fisheye-polynomial': ['polynomial'] }, tones: ['neutral'], cameras: [{ name: 'Door', position: [1, 1.6, -2], yaw: -90 }, { name: 'Sofa', position: [0, 1.5, 0], yaw: 0 }], envs: ['auto'], variants: [], duration: 0,
};

const none = { width: 0, height: 0 };
export const CAMERA = { convergence: 0, projection: { kind: 0, span: [6.2831854, 3.1415927] }, merge_map: none, head_tilt_map: none };

// Plays the server: numbers revisions as ods view does, refuses what ods view refuses, and sends the frames it is given.
export class Server {
  constructor() {
    Object.assign(this, { sets: [], revision: 0, last: '', frames: [], waiting: [], delay: 0, prompt: false });
    const real = window.fetch;
    window.fetch = (path, options) => (String(path).startsWith('studio/') ? this.answer(String(path), options) : real(path, options));
  }

  async answer(path, options) {
    if (path === 'studio/set') {
      const settings = JSON.parse(options.body);
      this.sets.push({ settings, at: performance.now() });
      if (this.delay) await sleep(this.delay);
      if (settings.sidecar.merge_top.start >= settings.sidecar.merge_top.end) return new Response('merge_top.start must be below its end\n', { status: 400 });
      const text = JSON.stringify({ ...settings, look: 0 });
      if (text !== this.last) this.revision++;
      this.last = text;
      if (this.prompt) this.send({ revision: this.revision });
      return Response.json({ revision: this.revision, command: `ods render a.glb --yaw ${settings.sidecar.yaw} -o a.png`, end: '_360_TB.png' });
    }
    if (path.startsWith('studio/frame')) {
      const after = Number(path.split('=')[1]);
      for (;;) {
        const next = this.frames.find(({ number }) => number > after);
        if (next) return new Response(this.bytes(next));
        await new Promise((go, stop) => {
          this.waiting.push(go);
          options.signal?.addEventListener('abort', () => stop(options.signal.reason));
        });
      }
    }
    return Response.json({});
  }

  bytes(meta) {
    const head = new TextEncoder().encode(JSON.stringify(meta));
    const bytes = new Uint8Array(4 + head.length + 6 * meta.width * meta.height);
    new DataView(bytes.buffer).setUint32(0, head.length, true);
    bytes.set(head, 4);
    return bytes;
  }

  send(meta) {
    const camera = { ...CAMERA, window: meta.window };
    this.frames.push({ number: this.frames.length + 1, width: 8, height: 4, eyes: 2, samples: 1, part: 'base', camera, ...meta });
    this.waiting.splice(0).forEach((go) => go());
  }
}

function expect(is, what) {
  if (!is) throw new Error(`studio: ${what}`);
}

async function until(is, what) {
  for (let i = 0; i < 300; i++) {
    if (is()) return;
    await sleep(20);
  }
  throw new Error(`studio: never ${what}`);
}

async function testHistory(server, session) {
  const yaw = () => session.settings.sidecar.yaw;
  const gesture = {};
  const before = server.sets.length;
  server.prompt = true;
  for (let i = 1; i <= 20; i++) {
    session.edit({ 'sidecar.yaw': i }, gesture, i < 20);
    await sleep(5);
  }
  await until(() => server.sets.at(-1)?.settings.sidecar.yaw === 20, 'sends the last value of a drag');
  server.prompt = false;
  for (let i = 1; i <= 10; i++) {
    session.edit({ 'sidecar.yaw': i === 10 ? 20 : i }, gesture);
    await sleep(5);
  }
  await until(() => session.side.sent === session.settings, 'sends the last edit');
  const times = server.sets.slice(before).map(({ at }) => at);
  expect(times.every((at, i) => i === 0 || at - times[i - 1] >= 28), 'sends more often than every 30 ms');
  expect(times.length < 30, 'sends every value of a drag');
  session.edit({ 'sidecar.yaw': 30 });
  session.step(-1);
  expect(yaw() === 20, 'undo does not take back one edit');
  session.step(-1);
  expect(yaw() === 0, 'undo does not take back a whole drag');
  session.step(1);
  session.step(1);
  expect(yaw() === 30 && !session.step(1), 'redo does not bring back what was undone');
}

async function testFrames(server, session, live) {
  await until(() => session.side.sent === session.settings, 'agrees with the server');
  const { side } = session;
  const shown = () => live.sides.get(side) ?? {};
  server.send({ revision: server.revision });
  await until(() => shown().base, 'shows a frame');
  server.send({ revision: server.revision, part: 'patch', window: 1 });
  await until(() => shown().patch, 'shows a patch');
  const old = server.revision;
  session.edit({ 'sidecar.yaw': 50 });
  await until(() => server.revision > old && session.revision === server.revision, 'sends an edit');
  server.send({ revision: old, samples: 64 });
  server.send({ revision: server.revision, samples: 2 });
  await until(() => shown().base.meta.samples === 2, 'shows the first frame of a revision');
  expect(!shown().patch, 'the patch of an old revision stays');
  expect(!live.taken.some(({ revision, samples }) => revision === old && samples === 64), 'shows a frame of an old revision');
  server.send({ revision: server.revision, width: 4, height: 2, samples: 9 });
  server.send({ revision: server.revision, samples: 1 });
  server.send({ revision: server.revision, samples: 3 });
  await until(() => shown().base.meta.samples === 3, 'shows finer frames');
  expect(live.least === 2, 'shows coarser frames');
}

// Another tab has set something else: this one shows it, and anything rendered, saved or picked here has this tab's
// settings again.
async function testOtherTabs(server, session) {
  await until(() => session.side.sent === session.settings && !session.sending, 'agrees with the server');
  let told = false;
  session.addEventListener('status', ({ detail }) => (told ||= detail.isOthers));
  server.last = 'of another tab';
  server.send({ revision: ++server.revision });
  await until(() => told, 'says that another tab has taken over');
  const before = server.sets.length;
  await session.settle();
  expect(server.sets.length > before && session.revision === server.revision, 'settles without sending its settings again');
}

// The server's frame may come before its answer, and before the question where the page is new to a server.
async function testFastFrames(server, session, live) {
  server.delay = 200;
  session.edit({ 'sidecar.yaw': 60 });
  await sleep(20);
  server.send({ revision: server.revision + 1, samples: 7 });
  await until(() => live.sides.get(session.side).base.meta.samples === 7, 'shows a frame that is faster than its answer');
  server.send({ revision: server.revision + 1, samples: 6 });
  await sleep(100);
  session.edit({ 'sidecar.yaw': 61 });
  await until(() => live.sides.get(session.side).base.meta.samples === 6, 'shows a frame that came too early');
  server.delay = 0;
}

async function testSides(server, session, live) {
  const [a] = session.sides;
  session.swap();
  const b = session.side;
  expect(b !== a && valueAt(b.settings, 'sidecar.yaw') === 61, 'B does not begin as A');
  session.edit({ 'sidecar.merge_top.start': 30 });
  await until(() => b.sent === b.settings, 'sends B');
  server.send({ revision: server.revision, samples: 1 });
  await until(() => live.sides.get(b)?.base, 'shows B');
  expect(a.settings.sidecar.merge_top.start === 60, 'B changes A');
  session.swap();
  await until(() => session.revision === server.revision && a.revision === server.revision, 'sends A again');
  server.send({ revision: server.revision, samples: 1 });
  server.send({ revision: server.revision, samples: 8 });
  await until(() => live.sides.get(a).base.meta.samples === 8, 'shows A again');
  expect(live.least === 6, 'A begins anew on screen, though it was finer');
}

async function testPanel(server, session, panel) {
  const row = (path) => panel.element.querySelector(`[data-path="${path}"]`);
  const type = (path, text) => {
    const field = row(path).querySelector('input');
    field.value = text;
    field.dispatchEvent(new Event('change'));
  };
  type('sidecar.ipd', '120');
  expect(Math.abs(session.settings.sidecar.ipd - 0.12) < 1e-9, 'millimetres are not metres');
  expect(!row('sidecar.ipd').querySelector('.reset').hidden, 'no way back to the default');
  row('sidecar.ipd').querySelector('.reset').click();
  expect(session.settings.sidecar.ipd === 0.065 && row('sidecar.ipd').querySelector('.reset').hidden, 'reset does not reset');
  const place = row('scene-camera').querySelector('select');
  const choose = (value) => {
    place.value = value;
    place.dispatchEvent(new Event('change'));
  };
  session.edit({ 'sidecar.position': [0, 1.5, 0], 'sidecar.yaw': 0, 'sidecar.pitch': 0, 'sidecar.roll': 0 });
  const { sidecar: begun } = session.settings;
  expect(place.value === '1' && place.selectedOptions[0].textContent === 'Sofa', 'the camera does not stand at one of the scene’s');
  session.edit({ 'sidecar.pitch': 10 });
  expect(place.value === '', 'a tilted camera counts as the scene’s');
  choose('0');
  const { position, yaw, pitch } = session.settings.sidecar;
  expect(String(position) === '1,1.6,-2' && yaw === -90 && pitch === 0, `the scene’s camera stands at ${position}, yaw ${yaw}, pitch ${pitch}`);
  session.edit({ 'sidecar.yaw': 270 });
  expect(place.value === '0', 'a whole turn is another place');
  choose('');
  expect(place.value === '0', 'the entry for another place moved the camera');
  row('scene-camera').querySelector('.reset').click();
  expect(String(session.settings.sidecar.position) === String(begun.position) && session.settings.sidecar.yaw === begun.yaw, 'reset does not lead back');
  type('sidecar.ipd', 'wide');
  expect(row('sidecar.ipd').querySelector('input').value === '65', 'a word stays where a number belongs');
  type('sidecar.merge_top.start', '90');
  expect(session.settings.sidecar.merge_bottom.start === 90, 'linked merges differ');
  await until(() => row('sidecar.merge_top.start').classList.contains('wrong'), 'marks what is refused');
  expect(!panel.fault.hidden && panel.fault.textContent.includes('below its end'), 'does not say what is refused');
  session.step(-1);
  await until(() => panel.fault.hidden && !row('sidecar.merge_top.start').classList.contains('wrong'), 'forgets the fault');
  panel.complain('a.jpg: drop a .glb');
  const before = server.sets.length;
  session.edit({ 'sidecar.roll': 1 });
  await until(() => server.sets.length > before && session.side.sent === session.settings, 'sends an edit');
  expect(!panel.fault.hidden && panel.fault.checkVisibility(), 'a fault goes before somebody has read it');
  expect(!panel.element.contains(panel.fault), 'a fault goes with the panel');
  panel.fault.querySelector('button').click();
  expect(panel.fault.hidden, 'a fault cannot be closed');
  expect(row('sidecar.projection.fov').hidden && !row('sidecar.projection.longitude.0').hidden, 'controls of another projection');
  session.edit({ 'sidecar.projection.name': 'mirror-ball' });
  expect(!row('sidecar.projection.fov').hidden && !row('sidecar.projection.pan').hidden, 'a projection without its controls');
  expect(row('sidecar.projection.sensor.0').hidden && row('sidecar.projection.polynomial.0').hidden, 'a polynomial lens of another projection');
  session.edit({ 'sidecar.projection.name': 'fisheye-polynomial' });
  expect(!row('sidecar.projection.sensor.0').hidden && !row('sidecar.projection.polynomial.4').hidden, 'no controls of a polynomial lens');
  type('sidecar.projection.polynomial.1', '-0.05');
  expect(session.settings.sidecar.projection.polynomial.join() === '0,-0.05,2,3,4', 'the other numbers of the lens are lost');
  expect(row('sidecar.axis.0').hidden, 'an axis that nobody has chosen');
  const axis = row('sidecar.axis').querySelector('select');
  axis.value = 'own';
  axis.dispatchEvent(new Event('change'));
  expect(!row('sidecar.axis.0').hidden && session.settings.sidecar.axis.join() === '0,1,0', 'no axis of its own');
  type('sidecar.axis.2', '0.5');
  expect(session.settings.sidecar.axis.join() === '0,1,0.5', 'the axis does not follow its controls');
  session.edit({ 'sidecar.axis': null });
  expect(row('sidecar.axis').querySelector('select').value === 'camera', 'the axis is not given back');
  expect(row('sidecar.convergence.distance').hidden, 'a distance without convergence');
  session.edit({ 'sidecar.convergence.mode': 'toe-in' });
  expect(!row('sidecar.convergence.distance').hidden, 'no distance of convergence');
}

function testProgress() {
  const frame = { part: 'base', width: 512, height: 256, samples: 2, seconds: 0.52, next: { part: 'patch', width: 410, samples: 4 } };
  expect(progressOf(frame) === 'picture 512 × 256, 2 samples per pixel, 0.5 s; next: view 410 wide, 4 samples', 'does not say what is shown and what comes');
  expect(progressOf({ ...frame, part: 'patch', next: null }).endsWith(': finished'), 'does not say when it is finished');
}

export async function testStudio() {
  testProgress();
  const server = new Server();
  const live = new Live(document.createElement('canvas').getContext('webgl2'));
  Object.assign(live, { taken: [], least: 0 });
  const take = async (meta, pixels, side) => {
    live.taken.push(meta);
    await live.take(meta, pixels, side);
    const { base } = live.sides.get(side);
    if (side === session.sides[0]) live.least = meta.samples === 2 ? 2 : Math.min(live.least, base.meta.width < 8 ? 0 : base.meta.samples);
  };
  const session = new Session(SETTINGS, () => ({ yaw: 0, pitch: 0, fov: 90, aspect: 1 }), take);
  session.addEventListener('accepted', ({ detail }) => live.renumber(detail));
  session.start();
  await testHistory(server, session);
  await testFrames(server, session, live);
  await testFastFrames(server, session, live);
  await testOtherTabs(server, session);
  live.least = 6;
  await testSides(server, session, live);
  const element = document.createElement('div');
  document.body.append(element);
  await testPanel(server, session, new Panel(element, { projections: PROJECTIONS, studio: STUDIO }, session));
}
