// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The headset's panel in an emulated headset, against the server of ods view: every action of a hand, a pinch or a
// look, and the desk's view and actions. testHeadset(name) runs a part, and throws an error if it fails. The wearer's
// view is sent to result/NAME, both eyes side by side.
import { Headset } from './headset.js';
import { TEXT } from './headset-controls.js';
import { DISTANCE } from './headset-panel.js';
import { plus } from './headset-room.js';
import { Panorama, raysOf } from './panorama.js';
import { placeOf, partsOf } from './places.js';
import { Share } from './share.js';
import { Viewer } from './viewer.js';

const PATIENCE = 60000; // milliseconds, of a machine that is busy
const SMALL = [64, 32];
const MEDIUM = [256, 128];
const LARGE = [512, 256];
const sleep = (time) => new Promise((done) => setTimeout(done, time));
const degrees = (radians) => (radians * 180) / Math.PI;

function expect(is, what) {
  if (!is) throw new Error(`headset: ${what}`);
}

async function until(is, what, step = () => sleep(20)) {
  for (const end = performance.now() + PATIENCE; performance.now() < end;) {
    if (is()) return;
    await step();
  }
  throw new Error(`headset: never ${what}`);
}

async function makeViewer(size) {
  const element = document.body.appendChild(document.createElement('div'));
  Object.assign(element.style, { position: 'relative', width: `${size[0]}px`, height: `${size[1]}px` });
  const viewer = new Viewer(element, await (await fetch('view.json')).json(), location.href);
  viewer.wake(new Panorama());
  return viewer;
}

// The wearer of the headset: a head and two hands.
class Wearer {
  static async create(size = SMALL) {
    Object.defineProperties(window, { innerWidth: { value: size[0] }, innerHeight: { value: size[1] } }); // of the canvas
    const { XRDevice, metaQuest3 } = await import('./iwer.module.js');
    const device = new XRDevice(metaQuest3);
    device.installRuntime({ forceInstall: true });
    device.stereoEnabled = true;
    device.fovy = Math.PI / 2;
    device.position.set(3, 1.6, -2);
    const wearer = Object.assign(new Wearer(), { device, viewer: await makeViewer(size) });
    wearer.headset = new Headset(wearer.viewer, {});
    return wearer;
  }

  async enter() {
    this.look({});
    await this.headset.toggle();
    await until(() => this.panel?.head, 'has a panel');
  }

  get panel() {
    return this.headset.panel;
  }

  // Our callback comes after the headset's, which was asked for before.
  frames(count = 2) {
    const { headset } = this;
    return new Promise((done) => {
      const next = () => (count-- > 0 && headset.session ? headset.session.requestAnimationFrame(next) : done());
      next();
    });
  }

  async wait(time) {
    for (const end = performance.now() + time; performance.now() < end;) await this.frames(1);
  }

  look({ yaw = 0, pitch = 0 }, quaternion = this.device.quaternion) {
    const [y, p] = [-yaw, pitch].map((angle) => (angle * Math.PI) / 360);
    quaternion.set(Math.cos(y) * Math.sin(p), Math.sin(y) * Math.cos(p), -Math.sin(y) * Math.sin(p), Math.cos(y) * Math.cos(p));
  }

  // A place of the device's world, from one of the session's space.
  place(at) {
    const { x, y, z } = this.device.position;
    return plus(plus([x, y, z], at), this.panel.head.at, -1);
  }

  // A point of the panel or the handle: x and y in half axes.
  spot(x, y) {
    const { at, u, v } = this.panel.sheet;
    return this.place(plus(plus(at, u, x), v, y));
  }

  middle(id, part = 0.5) {
    const control = this.panel.content.controls.find((each) => each.id === id);
    expect(control, `there is no ${id}`);
    const [left, top, width, height] = control.box;
    const { width: wide, height: high } = this.panel.canvas;
    const x = control.drag ? left + 16 + part * (width - 32) : left + part * width;
    return this.spot((2 * x) / wide - 1, 1 - (2 * (top + height / 2)) / high);
  }

  turnTo(to, from, quaternion) {
    const [x, y, z] = plus(to, from, -1);
    this.look({ yaw: degrees(Math.atan2(x, -z)), pitch: degrees(Math.atan2(y, Math.hypot(x, z))) }, quaternion);
  }

  async aim(to, hand = this.device.controllers.right) {
    const { x, y, z } = this.device.position;
    hand.position.set(x + 0.2, y - 0.4, z - 0.3);
    this.turnTo(to, [x + 0.2, y - 0.4, z - 0.3], hand.quaternion);
    await this.frames();
  }

  async gaze(to) {
    const { x, y, z } = this.device.position;
    this.turnTo(to, [x, y, z], this.device.quaternion);
    await this.frames();
  }

  async press(is, hand = this.device.controllers.right, button = 'trigger') {
    if (hand.updatePinchValue) hand.updatePinchValue(is);
    else hand.updateButtonValue(button, is);
    await this.frames();
  }

  async click(id, hand) {
    await this.aim(this.middle(id), hand);
    await this.press(1, hand);
    await this.press(0, hand);
  }

  async hold(button, time, hand) {
    await this.press(1, hand, button);
    await this.wait(time);
    await this.press(0, hand, button);
  }

  // The view of both eyes, in more pixels than the test uses.
  async send(name, size = MEDIUM) {
    const { canvas } = this.viewer;
    [canvas.width, canvas.height] = size;
    await this.frames(1);
    const picture = new Promise((done) => canvas.toBlob(done));
    [canvas.width, canvas.height] = SMALL;
    await fetch(`result/${name}`, { method: 'POST', body: await picture });
  }

  leave() {
    return this.headset.session?.end();
  }
}

// --- opening and closing ---

async function testOpening(wearer) {
  const { viewer, device } = wearer;
  const { item } = viewer;
  for (const is of [true, false, true]) {
    await wearer.hold('squeeze', 900);
    expect(wearer.panel.isOpen === is, 'a held grip does not open the panel and close it again');
    expect(viewer.item === item, 'a held grip goes to the next picture');
  }
  await wearer.aim(wearer.spot(1.5, 1.5));
  await wearer.press(1);
  await wearer.press(0);
  expect(!wearer.panel.isOpen && viewer.item === item, 'a press beside the panel does not close it, and nothing else');
  await wearer.press(1);
  await wearer.press(0);
  expect(viewer.item === item + 1, 'a press without a panel is not the next picture');
  await wearer.hold('squeeze', 0, device.controllers.left);
  await until(() => viewer.item === item && viewer.picture, 'goes back by the left grip');
  await wearer.gaze(wearer.spot(0, 0));
  expect(wearer.panel.isSeen && !wearer.panel.isOpen, 'who looks down sees no handle');
  await wearer.send('handle');
  await wearer.aim(wearer.spot(0, 0));
  await wearer.press(1);
  await wearer.press(0);
  expect(wearer.panel.isOpen && viewer.item === item, 'the handle does not open the panel');
  wearer.look({});
  await wearer.click('close');
  expect(!wearer.panel.isOpen, 'the panel does not close');
}

async function open(wearer) {
  await wearer.frames();
  if (!wearer.panel.isOpen) wearer.panel.toggle();
  await wearer.frames();
  expect(wearer.panel.isOpen, 'the panel does not open');
}

// --- where it is ---

async function testPlace(wearer) {
  const { device, panel } = wearer;
  await open(wearer);
  const { sheet } = panel;
  expect(Math.abs(Math.hypot(...plus(sheet.at, panel.head.at, -1)) - DISTANCE) < 1e-6, 'the panel is not as far away as it says');
  const letters = 2 * degrees(Math.atan((TEXT / 2) * (Math.hypot(...sheet.u) * 2 / panel.canvas.width) / DISTANCE));
  expect(letters >= 1.2, `letters are ${letters} degrees high`);
  wearer.look({ yaw: 30, pitch: -20 });
  device.position.set(3.1, 1.6, -2);
  await wearer.wait(1300);
  expect(Math.hypot(...plus(panel.sheet.at, sheet.at, -1)) < 1e-6, 'the panel is fixed to the head');
  wearer.look({ yaw: 70 });
  await wearer.wait(600);
  expect(Math.hypot(...plus(panel.sheet.at, sheet.at, -1)) < 1e-6, 'the panel comes at once');
  await wearer.wait(2500);
  expect(Math.abs(degrees(panel.heading) - 70) < 3, 'the panel never comes');
  expect(Math.abs(Math.hypot(...plus(panel.sheet.at, panel.head.at, -1)) - DISTANCE) < 0.03, 'the panel comes to another place');
  wearer.look({});
  device.position.set(3, 1.6, -2);
  panel.close();
  await wearer.frames();
  await open(wearer);
}

// --- its controls, by a controller's ray ---

async function testControls(wearer) {
  const { viewer, headset, panel } = wearer;
  const { state } = viewer;
  await open(wearer);
  await wearer.aim(wearer.middle('swap'));
  expect(panel.hovered.has('swap'), 'what is pointed at does not show it');
  await wearer.click('swap');
  expect(state.swap, 'the eyes are not swapped');
  await wearer.click('swap');
  expect(!state.swap, 'the eyes stay swapped');
  for (const worn of ['left', 'right', 'stereo']) {
    await wearer.click('mode');
    expect(state.worn === worn, `the eyes see ${state.worn}, not ${worn}`);
  }
  await wearer.click('next');
  await until(() => viewer.item === 1 && viewer.picture, 'shows the next picture');
  await wearer.click('previous');
  await until(() => viewer.item === 0 && viewer.picture, 'shows the previous picture');
  await until(() => panel.content.controls.find(({ id }) => id === 'item-2')?.image?.width > 0, 'shows thumbnails in its list');
  await wearer.click('item-2');
  await until(() => viewer.item === 2 && viewer.picture, 'shows the picture that is chosen');
  await wearer.click('down');
  expect(panel.content.controls.some(({ id }) => id === 'item-3'), 'the list does not turn');
  await wearer.click('up');
  expect(panel.content.controls.some(({ id }) => id === 'item-0'), 'the list does not turn back');
  wearer.look({ yaw: 20 });
  await wearer.click('recentre');
  expect(Math.abs(degrees(headset.turn) + 20) < 0.5, 'recentre does not turn the picture');
  wearer.look({});
  headset.turn = 0;
}

async function testExposure(wearer, item) {
  const { viewer, panel } = wearer;
  await viewer.open(item);
  await open(wearer);
  const before = viewer.about.exposure ?? 0;
  for (const id of ['brighter', 'brighter', 'darker']) await wearer.click(id);
  await until(() => viewer.picture, 'shows the picture with another exposure');
  expect(viewer.choice.exposure === before + 0.5, `the exposure is ${viewer.choice.exposure}`);
  await wearer.frames();
  expect(panel.content.controls.some(({ text }) => text === '+0.5'), 'the exposure is not said');
}

async function testTurns(wearer) {
  const { headset } = wearer;
  const { turn } = headset;
  await wearer.click('turn-right');
  expect(Math.abs(headset.turn - turn - Math.PI / 6) < 1e-6, 'the wearer is not turned to the right');
  await wearer.click('turn-left');
  expect(Math.abs(headset.turn - turn) < 1e-6, 'the wearer is not turned back');
}

// They are in the room below the middle of the view, and come along when the wearer turns away.
async function testSubtitles(wearer) {
  const { viewer, panel } = wearer;
  viewer.subtitles = { text: '', isOn: true, toggle: () => (viewer.subtitles.text = '') };
  viewer.about.video.subtitles = 'WEBVTT';
  expect(!panel.subtitles.sheet, 'there is a subtitle without a text');
  viewer.subtitles.text = 'Hello there\nSecond line';
  await wearer.frames();
  const { sheet } = panel.subtitles;
  expect(sheet && sheet.at[1] < panel.head.at[1] && sheet.face, 'there is no subtitle');
  wearer.look({ yaw: 120 });
  await wearer.frames();
  expect(panel.subtitles.sheet.at[0] > sheet.at[0] + 0.5, 'the subtitle stays behind');
  wearer.look({});
  await wearer.frames();
  await wearer.click('subtitles');
  expect(!panel.subtitles.sheet, 'the subtitle stays on');
}

async function testFilm(wearer, item) {
  const { viewer } = wearer;
  await viewer.open(item);
  if (!viewer.picture) return 'this browser plays no H.264';
  await open(wearer);
  const { picture } = viewer;
  await wearer.aim(wearer.middle('seek', 0.25));
  await wearer.press(1);
  await wearer.aim(wearer.middle('seek', 0.75));
  await wearer.press(0);
  const wanted = Math.round(0.75 * (picture.frames - 1));
  await until(() => Math.abs(picture.frame() - wanted) <= 1, 'seeks where it is dragged');
  await wearer.send('film');
  picture.video.muted = true; // who has never clicked hears nothing
  await wearer.click('play');
  await until(() => !picture.video.paused, 'plays');
  await wearer.click('play');
  await until(() => picture.video.paused, 'pauses');
  await wearer.click('play');
  await until(() => !picture.video.paused, 'plays again');
  wearer.device.updateVisibilityState('hidden');
  await until(() => picture.video.paused, 'pauses when the headset is taken off');
  wearer.device.updateVisibilityState('visible');
  await until(() => !picture.video.paused, 'plays when it is put on again');
  await wearer.click('sound');
  expect(!picture.video.muted, 'the sound stays off');
  await wearer.click('sound');
  expect(picture.video.muted, 'the sound stays on');
  await testTurns(wearer);
  await testSubtitles(wearer);
  picture.video.pause();
  for (const state of ['hidden', 'visible']) {
    wearer.device.updateVisibilityState(state);
    await until(() => wearer.headset.session.visibilityState === state, `is ${state}`);
  }
  expect(picture.video.paused, 'what the wearer paused plays when the headset is put on');
  return 'ok';
}

// --- by gaze, hand, and by those who pinch what they look at ---

async function testGaze(wearer) {
  const { device, viewer: { state }, panel } = wearer;
  panel.close();
  for (const hand of Object.values(device.controllers)) hand.connected = false;
  await wearer.frames(3);
  await wearer.gaze(wearer.spot(0, 0));
  await wearer.wait(600);
  expect(!panel.isOpen && panel.dwell.for > 0, 'a look at the handle acts at once');
  await wearer.send('dwell');
  await until(() => panel.isOpen, 'opens by a long look', () => wearer.frames());
  wearer.look({});
  await wearer.frames();
  await wearer.gaze(wearer.middle('swap'));
  await until(() => state.swap, 'swaps by a long look', () => wearer.frames());
  await wearer.wait(2000);
  expect(state.swap, 'a look that stays acts again and again');
  wearer.look({ pitch: 30 });
  await wearer.frames();
  await wearer.gaze(wearer.middle('swap'));
  await until(() => !state.swap, 'swaps by another long look', () => wearer.frames());
  for (const hand of Object.values(device.controllers)) hand.connected = true;
  await wearer.frames(3);
  await wearer.gaze(wearer.middle('mode'));
  await wearer.wait(2000);
  expect(state.worn === 'stereo', 'a look chooses where a hand could point');
  wearer.look({});
}

async function testPinches(wearer) {
  const { device, viewer: { state }, panel } = wearer;
  device.primaryInputMode = 'hand';
  await wearer.frames(3);
  await open(wearer);
  await wearer.click('swap', device.hands.right);
  expect(state.swap, 'a pinch does not swap the eyes');
  await wearer.click('swap', device.hands.left);
  expect(!state.swap, 'a pinch of the left hand does not swap them back');
  // An input source as in visionOS: it exists during a pinch, and its ray begins in the direction of the look.
  const { right, left } = device.hands;
  Object.defineProperty(right.inputSource, 'targetRayMode', { value: 'transient-pointer' });
  right.connected = left.connected = false;
  await wearer.frames(3);
  right.connected = true;
  await wearer.click('swap', right);
  right.connected = false;
  await wearer.frames(3);
  expect(state.swap, 'a look and a pinch do not swap the eyes');
  await wearer.gaze(wearer.middle('swap'));
  await wearer.wait(2000);
  expect(state.swap, 'a look chooses for who pinches');
  expect(panel.pointers.length === 0, 'something points without a hand');
  state.swap = false;
  device.primaryInputMode = 'controller';
  wearer.look({});
  await wearer.frames(3);
}

async function testHolding(wearer) {
  const { headset, panel } = wearer;
  panel.close();
  wearer.look({ yaw: -40 });
  await wearer.aim(wearer.place(plus(panel.head.at, [0, 2, -1])));
  await wearer.hold('trigger', 900);
  expect(Math.abs(degrees(headset.turn) - 40) < 0.5, 'a held trigger does not recentre');
  headset.turn = 0;
  wearer.look({});
}

async function testFailure(wearer) {
  const { viewer, panel } = wearer;
  panel.close();
  viewer.say('failed', 'It is damaged');
  await wearer.frames();
  expect(panel.isOpen && panel.content.controls[0].text === 'It is damaged', 'who wears the headset hears of no failure');
  viewer.say('open');
}

// --- what the desk sees and does with the same page ---

async function testMirror(wearer) {
  const { viewer, viewer: { panorama: { gl }, canvas }, headset } = wearer;
  const { prototype } = window.XRWebGLLayer;
  const own = Object.getOwnPropertyDescriptor(prototype, 'framebuffer');
  const target = gl.createFramebuffer(); // as a real headset has one of its own
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, ...MEDIUM);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
  Object.defineProperty(prototype, 'framebuffer', { get: () => target, configurable: true });
  wearer.look({ yaw: 25, pitch: 10 });
  headset.panel.close();
  viewer.set({ fov: 90 });
  [canvas.width, canvas.height] = [128, 128];
  await wearer.wait(400);
  expect(Math.abs(viewer.state.yaw - 25) < 0.1 && Math.abs(viewer.state.pitch - 10) < 0.1, 'the desk looks elsewhere');
  // The emulated headset clears what was bound last with each frame: taken as soon as it is drawn.
  const mirror = new Promise((done) => {
    headset.drawMirror = (now) => {
      Headset.prototype.drawMirror.call(headset, now);
      canvas.toBlob(done);
    };
  });
  await fetch('result/mirror', { method: 'POST', body: await mirror });
  delete headset.drawMirror;
  Object.defineProperty(prototype, 'framebuffer', own);
  [canvas.width, canvas.height] = SMALL;
  await wearer.wait(200);
  const { left, top, width, height } = viewer.element.getBoundingClientRect();
  viewer.element.dispatchEvent(new PointerEvent('pointermove', { clientX: left + width / 2, clientY: top + height / 2 }));
  expect(Math.abs(headset.marker.yaw - 25) < 0.5 && Math.abs(headset.marker.pitch - 10) < 0.5, 'the wearer sees nothing of the desk’s pointer');
  await wearer.send('marker');
  viewer.element.dispatchEvent(new PointerEvent('pointerleave'));
  expect(!headset.marker, 'the mark stays');
  headset.mark({ yaw: 0, pitch: 0, eye: 'left' });
  await wearer.wait(4500);
  expect(!headset.marker, 'a mark stays for ever');
  wearer.look({});
}

async function testPictures(wearer) {
  const { viewer, panel } = wearer;
  await viewer.open(0);
  panel.close();
  await open(wearer);
  await wearer.frames();
  await wearer.gaze(wearer.spot(0, 0));
  await wearer.aim(wearer.middle('swap'));
  await wearer.send('panel', LARGE);
  viewer.set({ worn: 'left' });
  panel.close();
  await wearer.send('left');
  viewer.set({ worn: 'stereo' });
  wearer.look({});
}

async function testLeaving(wearer) {
  await open(wearer);
  await wearer.aim(wearer.middle('leave'));
  await wearer.press(1);
  wearer.press(0); // no frame comes after it
  await until(() => !wearer.headset.session && !wearer.viewer.session, 'leaves');
  expect(wearer.viewer.state.roll === 0, 'the page stays tilted');
}

// --- the studio ---

async function testStudio() {
  const wearer = await Wearer.create();
  const { viewer, headset } = wearer;
  const { startStudio } = await import('./studio.js');
  const page = { viewer, headset, element: document.body, toast() {}, fail() {} };
  startStudio(page);
  const { session } = page.studio;
  await until(() => viewer.picture, 'shows the scene');
  await wearer.enter();
  await open(wearer);
  const drag = async (id, from, to) => {
    await wearer.aim(wearer.middle(id, from));
    await wearer.press(1);
    for (const part of [0.7 * from + 0.3 * to, 0.3 * from + 0.7 * to, to]) await wearer.aim(wearer.middle(id, part));
    await wearer.press(0);
  };
  const steps = session.side.past.length;
  await drag('merge-start', 0.2, 0.4);
  expect(session.settings.sidecar.merge_top.start === 36, `the merge starts at ${session.settings.sidecar.merge_top.start}`);
  await drag('merge-end', 0.9, 0.8);
  const { merge_top: top, merge_bottom: bottom } = session.settings.sidecar;
  expect(top.end === 72 && bottom.end === 72 && top.mode !== 'none', 'the merge does not end where it is dragged');
  expect(session.side.past.length === steps + 2, 'a drag is many steps to undo');
  await until(() => session.side.sent === session.settings, 'sends the merge');
  expect(/--merge\S* \S*36/.test(session.side.command), `the command is ${session.side.command}`);
  const { exposure } = session.settings;
  await wearer.click('brighter');
  expect(session.settings.exposure === exposure + 0.5, 'the exposure stays');
  await wearer.aim(wearer.middle('sides'));
  await wearer.send('studio');
  await wearer.click('sides');
  expect(session.active === 1, 'the settings are not B');
  await testSharedSettings(wearer, session);
  await wearer.leave();
}

// A page at the desk, of which only what it shares is there.
async function testSharedSettings({ viewer, headset }, session) {
  const other = { settings: structuredClone(session.settings), use: (settings) => (other.settings = settings) };
  const desk = {
    item: -1, choice: {}, state: {}, view: viewer.view, element: document.createElement('div'), picture: null,
    set: (state) => Object.assign(desk.state, state), studio: { session: other },
  };
  const shares = [new Share({ viewer, headset }), new Share({ viewer: desk, headset: { mark() {} } })];
  session.edit({ 'sidecar.ipd': 0.07 });
  await until(() => other.settings.sidecar.ipd === 0.07, 'gives the desk the settings');
  other.settings = { ...other.settings, exposure: 2 };
  await until(() => session.settings.exposure === 2 && session.side.sent === session.settings, 'takes the settings of the desk');
  expect(session.settings.sidecar.ipd === 0.07, 'loses what the wearer has set');
  for (const share of shares) share.end();
  testLies(viewer, headset);
}

// A message of another page may be anything: it neither throws nor outlasts the next change.
function testLies(viewer, headset) {
  const share = new Share({ viewer, headset });
  const { swap } = viewer.state;
  const say = (clock, value = !swap, by = 'zz') => share.take('liar', { fields: { swap: { value, clock, by } } });
  for (const clock of [1e300, -1, 0.5, 2 ** 32, NaN, null, '9', [], {}]) say(clock);
  for (const value of [null, 1, 'true', {}]) say(9, value);
  say(9, !swap, null);
  const numbers = [null, 1, 'x', [], { yaw: null }, { yaw: 1e300, pitch: 0, roll: 0 }];
  for (const part of numbers) share.take('liar', { fields: part, look: part, point: part, time: part });
  for (const part of numbers) share.take('liar', { fields: Object.fromEntries(['shown', 'film', 'settings', 'worn', 'constructor', '__proto__'].map((name) => [name, { value: part, clock: 9, by: 'zz' }])) });
  expect(viewer.state.swap === swap, 'takes what has not the form of a change');
  for (const clock of [2 ** 31 - 1, 2 ** 32 - 2, 2 ** 32 - 1]) {
    say(clock);
    viewer.set({ swap });
    share.tick();
    const { clock: next } = share.known.swap;
    expect(next !== clock && share.known.swap.by === share.id, `counts no further than ${clock}`);
    say(clock);
    expect(viewer.state.swap === swap, `an old change comes back after ${clock}`);
  }
  share.end();
}

// --- two pages of one server ---

// The page of the desk, as index.html is.
async function openPage() {
  const page = new DOMParser().parseFromString(await (await fetch('index.html')).text(), 'text/html');
  document.body.append(...page.body.childNodes);
  Object.assign(document.getElementById('picture').style, { position: 'relative', width: '160px', height: '90px' });
  document.body.append(Object.assign(document.createElement('script'), { src: 'main.js' })); // no module
  await until(() => window.omnistereo?.viewer.picture, 'opens the page');
  return window.omnistereo;
}

async function testSharing(items) {
  const page = await openPage();
  const desk = page.viewer;
  const wearer = await Wearer.create();
  const { viewer, headset } = wearer;
  await viewer.open(0);
  await desk.open(1);
  await sleep(2500);
  expect(!page.sharing, 'pages share though nobody wears a headset');
  await wearer.enter();
  const worn = new Share({ viewer, headset });
  await until(() => page.share, 'shares with who wears a headset', () => wearer.frames());
  let pages;
  await until(() => pages === 2, 'counts both pages', async () => ({ pages } = await (await fetch('alive')).json()));
  wearer.look({ yaw: 40, pitch: -15 });
  await until(() => desk.item === 0 && desk.picture, 'shows the desk what is worn', () => wearer.frames());
  expect(viewer.item === 0, 'who comes later changes what is worn');
  await until(() => Math.abs(desk.state.yaw - 40) < 0.2 && Math.abs(desk.state.pitch + 15) < 0.2, 'looks where the wearer does', () => wearer.frames());
  viewer.set({ swap: true });
  await until(() => desk.state.swap, 'swaps at the desk', () => wearer.frames());
  desk.set({ swap: false, worn: 'right' });
  await until(() => !viewer.state.swap && viewer.state.worn === 'right', 'swaps back in the headset', () => wearer.frames());
  desk.open(2);
  await until(() => viewer.item === 2 && viewer.picture, 'loads what the desk loads', () => wearer.frames());
  const direction = { yaw: 50, pitch: -10 };
  const [x, y] = placeOf(desk, direction, partsOf(desk)[0]);
  const { left, top } = desk.element.getBoundingClientRect();
  const move = new PointerEvent('pointermove', { clientX: left + x, clientY: top + y });
  await until(() => {
    desk.element.dispatchEvent(move);
    return headset.marker && Math.abs(headset.marker.yaw - 50) < 1 && Math.abs(headset.marker.pitch + 10) < 1;
  }, 'marks what the desk points at', () => wearer.frames());
  desk.element.dispatchEvent(new PointerEvent('pointerleave'));
  await until(() => !headset.marker, 'forgets what the desk pointed at', () => wearer.frames());
  desk.element.dispatchEvent(new PointerEvent('pointerdown'));
  wearer.look({ yaw: -60 });
  await wearer.wait(700);
  expect(Math.abs(desk.state.yaw - 40) < 1, 'who looks elsewhere is taken along');
  const button = document.getElementById('follow');
  expect(button && !button.hidden && button.ariaPressed === 'false', 'there is no way back to the wearer');
  button.click();
  await until(() => Math.abs(desk.state.yaw + 60) < 0.2, 'comes back to the wearer', () => wearer.frames());
  const film = await shareFilm(wearer, desk, items - 1);
  await wearer.leave();
  await until(() => button.hidden, 'notices that nobody wears the headset');
  for (const share of [worn, page.share]) share.end();
  return film;
}

async function shareFilm({ viewer }, desk, item) {
  await viewer.open(item);
  if (!viewer.picture) return 'this browser plays no H.264';
  await until(() => desk.item === item && desk.picture?.video, 'opens the film at the desk');
  viewer.picture.seek(1.25);
  await until(() => Math.abs(desk.picture.video.currentTime - viewer.picture.video.currentTime) < 0.01, 'shows the same frame');
  for (const { picture } of [viewer, desk]) picture.video.muted = true; // who has never clicked hears nothing
  desk.picture.toggle();
  await until(() => !viewer.picture.video.paused, 'plays what the desk plays');
  await sleep(300);
  desk.picture.toggle();
  await until(() => viewer.picture.video.paused && desk.picture.video.paused, 'pauses what the desk pauses');
  await sleep(500);
  expect(viewer.picture.video.paused && desk.picture.video.paused, 'goes on after a pause');
  return 'ok';
}

// Plays a browser that has layers: the panel is above the picture's, and clear where nothing is.
async function testLayers() {
  const viewer = await makeViewer(SMALL);
  const { gl } = viewer.panorama;
  const textures = { equirect: gl.createTexture(), above: gl.createTexture() };
  for (const [name, size] of [['equirect', [16, 8]], ['above', [8, 4]]]) {
    gl.bindTexture(gl.TEXTURE_2D, textures[name]);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, ...size);
  }
  const box = (eye, width, height) => ({ x: eye === 'left' ? 0 : width, y: 0, width, height });
  window.XRRigidTransform = class {};
  window.XRWebGLBinding = class {
    createEquirectLayer() { return { is: 'equirect' }; }

    createProjectionLayer(init) { return { is: 'above', init }; }

    getSubImage(layer, frame, eye) { return { colorTexture: textures.equirect, viewport: box(eye, 8, 8) }; }

    getViewSubImage(layer, { eye }) { return { colorTexture: textures.above, viewport: box(eye, 4, 4) }; }
  };
  const { EyeLayers } = await import('./layers.js');
  let asked = {};
  const session = { renderState: {}, updateRenderState: (state) => (asked = state) }; // what is asked for comes with the next frame
  const layers = new EyeLayers(session, gl, 'local');
  const next = () => Object.assign(session, { renderState: asked });
  const shown = () => session.renderState.layers?.map(({ is }) => is).join();
  const pose = { views: [{ eye: 'left' }, { eye: 'right' }] };
  await viewer.open(0);
  expect(!layers.show(null, viewer, 0), 'draws into a layer that is not there yet');
  next();
  expect(layers.show(null, viewer, 0) && shown() === 'equirect', 'the picture has no layer');
  const drawn = [];
  const draw = (view, where, target) => {
    drawn.push(`${view.eye} ${where}`);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(where[0], 0, 1, 1);
    gl.clearColor(0, 1, 0, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.disable(gl.SCISSOR_TEST);
  };
  layers.drawAbove(draw, pose);
  expect(!drawn.length, 'draws into the layer above before it is there');
  next();
  layers.show(null, viewer, 0);
  layers.drawAbove(draw, pose);
  expect(shown() === 'equirect,above' && drawn.join('; ') === 'left 0,0,4,4; right 4,0,4,4', `draws ${drawn.join('; ')} above ${shown()}`);
  const pixels = new Uint8Array(4 * 8);
  gl.readPixels(0, 0, 8, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  expect([...pixels.filter((x, i) => i % 4 === 3)].join() === '255,0,0,0,255,0,0,0', 'the layer above covers the picture');
  layers.drawAbove(null, pose);
  next();
  expect(shown() === 'equirect', 'the layer above stays when nothing is there');
}

// Plays the compositor of a browser that shows a film's halves to the eyes in its own order: left on top, or on the left.
function composed({ frame, init, transform }, eye, [x, y, z]) {
  const { canvas } = frame;
  const { orientation: { y: s, w: c } } = transform;
  const turn = 2 * Math.atan2(s, c); // of the layer, counter-clockwise from above
  const theta = Math.atan2(x, -z) + turn;
  const around = theta - 2 * Math.PI * Math.round(theta / (2 * Math.PI));
  const u = 0.5 + around / init.centralHorizontalAngle;
  const v = (init.upperVerticalAngle - Math.asin(y)) / (init.upperVerticalAngle - init.lowerVerticalAngle);
  const [left, top, width, height] = {
    mono: [0, 0, 1, 1], 'stereo-top-bottom': [0, eye / 2, 1, 0.5], 'stereo-left-right': [eye / 2, 0, 0.5, 1],
  }[init.layout];
  return [...frame.getImageData((left + u * width) * canvas.width, (top + v * height) * canvas.height, 1, 1).data].slice(0, 3);
}

const far = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));

// The colours that the shader shows to each eye, in directions in which the eyes differ.
function drawnLooks({ panorama, picture }) {
  const { gl } = panorama;
  const pixel = new Uint8Array(4);
  const looks = [];
  for (let yaw = -60; yaw <= 60; yaw += 3) {
    for (let pitch = -40; pitch <= 40; pitch += 4) {
      const eyes = [0, 1].map((eye) => {
        panorama.draw(picture, { rays: raysOf({ yaw, pitch, fov: 4 }, 1), box: [0, 0, 8, 8], eye });
        gl.readPixels(4, 4, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return [...pixel.subarray(0, 3)];
      });
      if (far(...eyes) > 30) looks.push({ yaw: (yaw * Math.PI) / 180, pitch: (pitch * Math.PI) / 180, eyes });
    }
  }
  expect(looks.length > 20, `only ${looks.length} directions tell the eyes apart`);
  return looks;
}

// The mean differences of a layer from the shader's views, code values: of the same eye, and of the other one.
function misses(layer, looks, turn) {
  const sums = [0, 0];
  for (const { yaw, pitch, eyes } of looks) {
    const heading = yaw - turn; // of the head: lookOf()
    const ahead = [Math.sin(heading) * Math.cos(pitch), Math.sin(pitch), -Math.cos(heading) * Math.cos(pitch)];
    for (const eye of [0, 1]) {
      const seen = composed(layer, eye, ahead);
      sums[0] += far(seen, eyes[eye]);
      sums[1] += far(seen, eyes[1 - eye]);
    }
  }
  return sums.map((sum) => sum / (2 * looks.length));
}

// Plays a browser that shows films by itself. The layer's directions and eyes are those of the shader; whatever such a
// layer cannot show is the shader's.
async function testFilms() {
  const viewer = await makeViewer(SMALL);
  const { gl } = viewer.panorama;
  const made = [];
  window.XRRigidTransform = class {
    constructor(position, orientation) { Object.assign(this, { position, orientation }); }
  };
  window.XRWebGLBinding = class {
    createEquirectLayer() { throw new Error('a film was drawn'); }

    createProjectionLayer() { return { is: 'above' }; }

    getViewSubImage() { return { colorTexture: null, viewport: { x: 0, y: 0, width: 4, height: 4 } }; }
  };
  window.XRMediaBinding = class {
    createEquirectLayer(video, init) {
      if (this.refuses) throw new Error('refused');
      const frame = new OffscreenCanvas(video.videoWidth, video.videoHeight).getContext('2d', { willReadFrequently: true });
      frame.drawImage(video, 0, 0);
      made.push({ is: 'film', frame, init });
      return made.at(-1);
    }
  };
  const { EyeLayers } = await import('./layers.js');
  let asked = {};
  const session = { renderState: { baseLayer: 'base' }, updateRenderState: (state) => (asked = state) };
  const layers = new EyeLayers(session, gl, 'local', false);
  const show = (turn = 0) => {
    layers.show(null, viewer, turn);
    session.renderState = asked;
    return layers.show(null, viewer, turn);
  };
  const { items } = viewer.view;
  for (const [i, { name }] of items.entries()) {
    await viewer.open(i);
    if (viewer.picture?.video) await until(() => viewer.picture.video.readyState >= 2, 'has a frame');
    viewer.picture?.refresh?.();
    if (!viewer.picture) return 'no films';
    if (!/film/.test(name)) {
      expect(!show() && session.renderState.baseLayer === 'base', `${name} has a layer`);
      continue;
    }
    const looks = drawnLooks(viewer);
    for (const turn of [0, 0.7]) {
      expect(show(turn) && session.renderState.layers?.[0] === made.at(-1), `${name} has no layer`);
      const layer = made.at(-1);
      expect(layer.init.space === 'local' && layer.init.radius === 0, `${name} is not far away`);
      const [own, other] = misses(layer, looks, turn);
      expect(own < 0.6 * other, `${name}, turned by ${turn}: an eye is off by ${own}, from the other one by ${other}`);
      const [elsewhere] = misses({ ...layer, transform: { orientation: { y: Math.sin(turn / 2 + 0.05), w: Math.cos(turn / 2 + 0.05) } } }, looks, turn);
      expect(own < 0.6 * elsewhere, `${name}, turned by ${turn}: off by ${own}, in another direction by ${elsewhere}`);
    }
    const drawn = [];
    layers.drawAbove((view) => drawn.push(view), { views: ['left'] });
    session.renderState = asked;
    layers.drawAbove((view) => drawn.push(view), { views: ['left'] });
    expect(asked.layers.map(({ is }) => is).join() === 'film,above' && drawn.length === 1, `the menu is not above ${name}`);
    for (const changes of [{ swap: true }, { swap: false, grid: true }, { grid: false, worn: 'left' }]) {
      viewer.set(changes);
      expect(!show() && session.renderState.baseLayer === 'base', `${name} has a layer with ${JSON.stringify(changes)}`);
    }
    viewer.set({ worn: 'stereo' });
    expect(show(), `${name} has no layer any more`);
    await viewer.choose({ layout: 'bottom-top' });
    await until(() => viewer.picture?.video, 'opens it again');
    expect(!show(), `${name} has a layer of swapped halves`);
    await viewer.choose({ layout: undefined, projection: 'cube-3x2' });
    await until(() => viewer.picture?.video, 'opens it again');
    expect(!show(), `${name} has a layer for a cube`);
    layers.media.refuses = true;
    await viewer.choose({ projection: undefined });
    await until(() => viewer.picture?.video, 'opens it again');
    expect(!show() && session.renderState.baseLayer === 'base', `${name} has a layer that was refused`);
    layers.media.refuses = false;
  }
  expect(new Set(made.map(({ init: { layout, centralHorizontalAngle } }) => `${layout} ${centralHorizontalAngle.toFixed(2)}`)).size === 2, 'not both formats were shown');
}

// Plays a browser that shows a page's canvas to both eyes: the right eye's part is beside the left one's.
async function testInline() {
  const viewer = await makeViewer(SMALL);
  const [width, height] = SMALL;
  const { canvas, gl } = viewer.panorama;
  const asked = [];
  let isThere = false;
  let next = null;
  const session = Object.assign(new EventTarget(), {
    renderState: {},
    updateRenderState: (state) => Object.assign(session.renderState, state),
    requestReferenceSpace: async (space) => space,
    requestAnimationFrame: (run) => (next = run),
    end: async () => session.dispatchEvent(new Event('end')),
  });
  Object.defineProperty(navigator, 'xr', { configurable: true, value: {
    async requestSession(mode, { requiredFeatures }) {
      asked.push(`${mode} ${requiredFeatures}`);
      if (!isThere) throw new DOMException('no', 'NotSupportedError');
      return session;
    },
  } });
  window.XRWebGLLayer = class {
    framebuffer = null;

    getViewport({ eye }) { return { x: eye === 'right' ? canvas.width / 2 : 0, y: 0, width: canvas.width / 2, height: canvas.height }; }
  };
  const { InlineStereo } = await import('./inline-stereo.js');
  const told = [];
  new InlineStereo(viewer, (is) => told.push(is)); // eslint-disable-line no-new
  await viewer.open(0);
  await sleep(200);
  expect(asked.join() === 'inline inline-stereo' && !told.length, `asks for ${asked}, and tells ${told}`);
  await viewer.open(1);
  await sleep(200);
  expect(asked.length === 1 && !viewer.inline, 'asks a browser that has refused');
  isThere = true;
  const later = await makeViewer(SMALL);
  Object.assign(later, { panorama: viewer.panorama, canvas });
  viewer.panorama = null;
  new InlineStereo(later, (is) => told.push(is)); // eslint-disable-line no-new
  await later.open(0);
  await until(() => next, 'begins');
  const run = () => next(performance.now(), { getViewerPose: () => ({ views: [{ eye: 'right' }, { eye: 'left' }] }) });
  const pixels = (x) => {
    const all = new Uint8Array(4 * width * height);
    gl.readPixels(x, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all);
    return all.join();
  };
  const expected = (look) => {
    later.panorama.draw(later.picture, { rays: raysOf(look, width / height), box: [0, 0, width, height], moves: true, ...look });
    return pixels(0);
  };
  for (const look of [{ yaw: 0 }, { yaw: 40, pitch: -10 }]) {
    later.set(look);
    run();
    expect(canvas.width === 2 * width && canvas.height === height, 'an eye has less than the page has');
    const seen = [0, width].map(pixels);
    for (const eye of [0, 1]) expect(seen[eye] === expected({ ...later.state, eye }), `eye ${eye} sees something else`);
    expect(seen[0] !== seen[1], 'both eyes see the same');
  }
  later.set({ mode: 'right' });
  run();
  expect(pixels(0) === pixels(width), 'one eye is not for both');
  await session.end();
  expect(told.join() === 'true,false' && !later.inline && canvas.width === width, `does not end: ${told}, ${canvas.width}`);
}

async function testPanel() {
  const wearer = await Wearer.create();
  const { viewer } = wearer;
  const { items } = viewer.view;
  const named = (end) => items.findIndex(({ name }) => name.endsWith(end));
  await viewer.open(0);
  await wearer.enter();
  for (const test of [testOpening, testPlace, testControls, testGaze, testPinches, testHolding, testFailure, testMirror, testPictures]) {
    await test(wearer);
  }
  await testExposure(wearer, named('.exr'));
  const film = await testFilm(wearer, named('.mp4'));
  await testLeaving(wearer);
  return film;
}

// Runs one of the tests; each returns whether videos could be tested.
export async function testHeadset(name) {
  const tests = { panel: testPanel, studio: testStudio, layers: testLayers, films: testFilms, inline: testInline, sharing: async () => testSharing((await (await fetch('view.json')).json()).items.length) };
  const film = await tests[name]();
  await fetch('result/said', { method: 'POST', body: film ?? 'ok' });
}
