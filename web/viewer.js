// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shows an item of view.json in an element, with the open picture, the look, and the drawing. It contains no controls.
// It draws on the canvas of a panorama (panorama.js), which it has while it is awake; asleep, it shows its last frame.
// Events: `change` (the state, or the video's), `loading` (detail: 0..1, null at the end), `open`, `failed` (detail:
// one line for users), `sleep`.
import { clamp, radians, wrapDegrees } from './geometry.js';
import { boxOf, modeOf } from './modes.js';
import { Pace, firstLevel, keepLevel } from './pace.js';
import { raysOf } from './panorama.js';
import { openPicture } from './picture.js';

const REST = 150; // milliseconds without movement until the view is drawn exactly
const STILL = 960; // pixels: the widest last frame that is kept
const KEEP = 64e6; // texels: a smaller picture stays on screen until the next one is loaded

const keyOf = (item, choice) => `${item} ${JSON.stringify(choice)}`; // of ahead.js

// The first field of view, and the widest.
export const FOV = 90;
export const widest = ({ planet }) => (planet ? 330 : 150);

export class Viewer extends EventTarget {
  // element: contains the canvas, and hears of pointers and keys; its position is not static. base: the address that
  // view.json's addresses are relative to.
  constructor(element, view, base) {
    super();
    Object.assign(this, { element, view, base, panorama: null, picture: null, item: -1, session: null });
    this.state = { yaw: 0, pitch: 0, roll: 0, fov: FOV, mode: 'left', swap: false, grid: false, planet: false, shift: 0, x: 0, y: 0, z: 0 };
    this.compare = null; // compare.js
    this.scene = null; // the studio's live scene, shown instead of an item
    this.choice = {}; // layout, projection, exposure, tone, if they differ from the item
    this.pace = null; // since the first panorama
    this.inline = null; // a session of inline-stereo.js, which draws instead
    this.ahead = null; // ahead.js, once there are pictures to fetch
    this.guide = null; // tour.js, if there are hotspots or a tour
    this.waiting = false;
    this.isProvisional = false; // better pictures follow soon: a slow GPU does not draw this one exactly
    this.settling = null; // a token of the exact drawing in progress
    this.canvas = this.still = this.place(document.createElement('canvas'));
    new ResizeObserver(() => this.resize()).observe(element);
  }

  place(canvas) {
    Object.assign(canvas.style, { position: 'absolute', inset: 0, width: '100%', height: '100%' });
    this.element.prepend(canvas); // below the last frame
    return canvas;
  }

  // Draws on a panorama's canvas from now on, and opens the item again, at the time at which its video stopped.
  async wake(panorama) {
    const { slept } = this;
    this.panorama = panorama;
    this.pace ??= new Pace({ level: firstLevel(panorama.gl) });
    this.canvas = this.place(panorama.canvas);
    panorama.lost = () => {
      this.picture = null;
      this.ahead?.keep([]);
      this.say('failed', 'The GPU was reset. The picture returns by itself; if it does not, reload the page.');
    };
    panorama.restored = () => this.item >= 0 && this.open(this.item, this.choice);
    this.resize();
    if (this.item < 0) return;
    await this.open(this.item, this.choice);
    const { video } = this.picture ?? {};
    if (!slept || !video) return;
    this.picture.seek(slept.time);
    this.picture.loop(slept.loops);
    video.muted = slept.muted;
    if (slept.playing) video.play().catch(() => {});
    else video.pause(); // a film of layers plays at once
  }

  // Frees the picture and returns the panorama, for another viewer.
  sleep() {
    const { panorama, picture } = this;
    if (!panorama) return null;
    const video = picture?.video;
    this.slept = video && { time: video.currentTime, playing: !video.paused, muted: video.muted, loops: picture.loops };
    this.loading?.abort();
    clearTimeout(this.rest);
    this.settling = this.inline = null;
    this.ahead?.keep([]);
    this.compare?.end();
    if (picture) this.keepFrame();
    this.close();
    this.panorama = null;
    this.canvas.remove();
    this.canvas = this.still;
    panorama.forget();
    this.say('sleep');
    this.say('change');
    return panorama;
  }

  keepFrame() {
    const { canvas, still } = this;
    this.fit();
    this.paint(performance.now(), { moves: true }); // the open picture may not have been drawn yet
    const scale = Math.min(1, STILL / canvas.width);
    [still.width, still.height] = [canvas.width, canvas.height].map((side) => Math.ceil(side * scale));
    still.getContext('2d').drawImage(canvas, 0, 0, still.width, still.height);
    this.element.append(still);
  }

  say(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  resize() {
    if (!this.panorama) return;
    if (this.picture) this.draw(performance.now());
    else this.fit();
  }

  // An emulated headset draws into the canvas, whose size must then not change. across: the views beside each other.
  // Returns whether it has changed.
  fit(part = 1, across = 1) {
    const { canvas, element } = this;
    if (this.session) return false;
    const scale = part * (window.devicePixelRatio || 1);
    const size = [element.clientWidth * across, element.clientHeight].map((pixels) => Math.max(1, Math.round(pixels * scale)));
    if (canvas.width === size[0] && canvas.height === size[1]) return false;
    [canvas.width, canvas.height] = size;
    return true;
  }

  // Changes parts of the state and draws.
  set(changes) {
    Object.assign(this.state, changes);
    const { state } = this;
    state.yaw = wrapDegrees(state.yaw);
    state.pitch = clamp(state.pitch, -90, 90);
    state.fov = clamp(state.fov, 5, widest(state));
    state.shift = clamp(state.shift, -5, 5);
    this.picture?.hold?.(state);
    this.redraw();
    this.say('change');
  }

  redraw() {
    if (this.waiting || !this.panorama) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      if (!this.panorama) return;
      this.draw(now);
      requestAnimationFrame((next) => this.pace.took(next - now));
      if (modeOf(this.state.mode).moves && !this.session) this.redraw();
    });
  }

  // Draws quickly, and exactly as soon as nothing moves.
  draw(now) {
    if (this.session || this.inline || !this.panorama) return;
    this.settling = null;
    clearTimeout(this.rest);
    this.fit(this.pace.how.scale);
    this.picture?.refresh?.();
    this.paint(now, { moves: true, cheap: this.pace.how.cheap });
    if (this.picture) this.still.remove();
    for (const { pager } of this.pictures()) pager?.follow(this.parts(now), now);
    if (this.picture) this.rest = setTimeout(() => this.settle(), REST);
  }

  // rows: a strip of the canvas, from its lower edge: [first, count]; all if missing.
  paint(now, how, rows) {
    const { panorama, picture, canvas } = this;
    if (!rows) panorama.clear();
    if (!picture) return;
    this.compare?.before(picture);
    for (const options of this.parts(now)) {
      const [x, y, width, height] = options.box;
      panorama.draw(picture, { ...options, ...how, clip: rows ? [x, rows[0], width, rows[1]] : [x, y, width, height] });
    }
    this.compare?.after(now, how, rows);
  }

  // The open picture, and the one compared with it.
  pictures() {
    return [this.picture, this.picture?.beside].filter(Boolean);
  }

  // The options of panorama.draw() for each part of the view; all are as high as the canvas.
  parts(now, canvas = this.canvas) {
    const { state } = this;
    const shift = radians(state.shift) / 2; // for each eye
    return modeOf(state.mode).parts(now).map(({ at, eye, show }) => {
      const box = boxOf(at, canvas);
      return { rays: raysOf(state, box[2] / box[3]), box, eye, show, swap: state.swap, grid: state.grid, planet: state.planet, shift, state };
    }).filter(({ box }) => box[2] > 0 && box[3] > 0);
  }

  // is: whether better pictures follow soon. The last one is drawn exactly.
  expectBetter(is) {
    if (is === this.isProvisional) return;
    this.isProvisional = is;
    if (!is) this.redraw();
  }

  // Draws exactly, strip by strip: a slow GPU is never busy for long, and movements need not wait for the rest.
  async settle() {
    const { panorama, canvas } = this;
    if (this.isProvisional && this.pace.isSlow) return;
    if (!this.picture?.isPreview) this.openAhead().catch((error) => console.warn(error.message));
    const mark = (this.settling = {});
    const goesOn = () => this.settling === mark && this.picture && !this.session;
    const nextFrame = () => new Promise(requestAnimationFrame);
    if (this.fit()) this.paint(performance.now(), { moves: true });
    const anyOf = (run) => this.pictures().map(({ pager }) => Boolean(pager && run(pager))).some(Boolean);
    while (goesOn() && anyOf((pager) => pager.look(this.parts(0), 2))) {
      this.paint(performance.now(), { moves: true });
      await nextFrame();
    }
    const isReady = () => this.parts(0).every((options) => this.pictures().every((picture) => panorama.isReady(picture, options)));
    while (goesOn() && !isReady()) await nextFrame();
    for (let y = 0, count = Math.ceil(canvas.height / (this.pace.isSlow ? 32 : 8)); goesOn() && y < canvas.height;) {
      this.paint(performance.now(), {}, [y, count]);
      y += count;
      const took = await panorama.finished(nextFrame);
      if (took < 20) count *= 2;
      if (took > 50) count = Math.ceil(count / 2);
    }
    let isBetter = false;
    while (goesOn() && anyOf((pager) => pager.refine())) {
      isBetter = true;
      await nextFrame();
    }
    if (!goesOn()) return;
    if (isBetter) return this.redraw();
    keepLevel(this.pace.level);
    this.say('settled');
  }

  // Opens the pictures beside the present one, unless the visitor saves data.
  async openAhead() {
    const { view, base, panorama } = this;
    const { items } = view;
    if (this.scene || this.session || items.length < 2 || navigator.connection?.saveData) return;
    const { Ahead } = await import('./ahead.js');
    if (!panorama || this.panorama !== panorama) return;
    this.ahead ??= new Ahead();
    const choice = this.lasting();
    const next = this.guide?.next() ?? [1, -1].map((by) => (this.item + by + items.length) % items.length);
    this.ahead.keep(next.filter((i) => items[i].kind === 'picture' && !items[i].light).map((i) => ({
      key: keyOf(i, choice),
      open: (how) => openPicture(panorama, view, items[i], { base, choice, ...how }),
    })));
  }

  get about() {
    return this.scene ?? this.view.items[this.item];
  }

  // Opens an item by its index; a load in progress is aborted. Does not throw: fires `open` or `failed`.
  async open(item, choice = {}) {
    this.loading?.abort();
    if (!this.panorama) return Object.assign(this, { item, choice });
    const loading = (this.loading = new AbortController());
    const texels = this.picture?.eyes.reduce((sum, eye) => sum + eye.size[0] * eye.size[1], 0);
    if (item !== this.item && texels > KEEP) this.close();
    if (item !== this.item && this.item >= 0) Object.assign(this.state, { x: 0, y: 0, z: 0 });
    Object.assign(this, { item, choice, scene: null });
    this.say('loading', 0);
    try {
      const picture = await openPicture(this.panorama, this.view, this.about, {
        base: this.base, choice, signal: loading.signal, ahead: this.ahead?.take(keyOf(item, choice)), progress: (part) => this.say('loading', part),
        early: (preview) => this.take(Object.assign(preview, { isPreview: true }), loading.signal),
      });
      const isPlain = this.about.kind === 'picture' && !picture.light && !picture.pager && !picture.enter;
      if (isPlain) picture.key = keyOf(item, choice);
      this.take(picture, loading.signal);
    } catch (error) {
      if (loading.signal.aborted) return;
      this.close();
      this.redraw();
      this.say('failed', error.message);
    }
    this.say('loading', null);
  }

  take(picture, signal) {
    if (signal.aborted) return picture.free();
    const left = this.picture; // it is beside the new one, perhaps
    if (left?.key && !this.compare && this.ahead?.give(left.key, left)) this.picture = null;
    this.close();
    this.picture = picture;
    picture.hold?.(this.state);
    picture.changed = () => {
      this.redraw();
      this.say('change');
    };
    picture.enter?.(this);
    this.redraw();
    this.say('open');
  }

  close() {
    this.picture?.free();
    this.picture = null;
  }

  // Goes to the next or a previous item, with wrap-around.
  go(by) {
    const count = this.view.items.length;
    if (count > 1) this.open((this.item + by + count) % count, this.lasting());
  }

  // The part of the choice that stays from one item to the next.
  lasting() {
    const { exposure, tone } = this.choice;
    return { exposure, tone };
  }

  // Changes layout, projection, exposure or tone: loads the picture again, at the present time of a video. Light is
  // developed here.
  async choose(changes) {
    if (this.picture?.light && !('layout' in changes) && !('projection' in changes)) {
      this.choice = { ...this.choice, ...changes };
      this.picture.develop(this.choice);
      this.redraw();
      return this.say('open');
    }
    const at = this.picture?.video?.currentTime;
    await this.open(this.item, { ...this.choice, ...changes });
    if (at) this.picture?.seek?.(at);
  }

  // For light: changes the exposure by stops from its present value.
  expose(by) {
    if (!this.about?.live) return false;
    const now = this.choice.exposure ?? this.about.exposure ?? 0;
    this.choose({ exposure: clamp(Math.round((now + by) * 100) / 100, -20, 20) });
    return true;
  }

  // The canvas as a PNG.
  async screenshot() {
    if (this.panorama) {
      this.fit();
      this.paint(performance.now(), {});
    }
    return new Promise((done) => (this.compare?.shown() ?? this.canvas).toBlob(done));
  }
}
