// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A canvas that shows an item of view.json: what is open, where the viewer looks, what is drawn and when. Knows no
// controls. Events: `change` (the state, or the video's), `loading` (detail: 0..1, null at the end), `open`, `failed`
// (detail: one line for people).
import { boxOf, modeOf } from './modes.js';
import { Panorama, bendOf, raysOf } from './panorama.js';
import { openPicture } from './picture.js';

const KEEP = 64e6; // texels: a smaller picture stays on screen until the next one is there

export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
export const wrapDegrees = (angle) => angle - 360 * Math.floor((angle + 180) / 360);

export class Viewer extends EventTarget {
  // base: the address that view.json's addresses are relative to.
  constructor(canvas, view, shader, base) {
    super();
    Object.assign(this, { canvas, view, base, picture: null, item: -1, session: null });
    this.state = { yaw: 0, pitch: 0, roll: 0, fov: 90, mode: 'left', swap: false, grid: false, planet: false, shift: 0 };
    this.compare = null; // compare.js
    this.scene = null; // of the studio: what is live instead of an item
    this.choice = {}; // layout, projection, exposure, tone, where they are not the item's own
    this.panorama = new Panorama(canvas, shader);
    this.waiting = false;
    this.watch();
  }

  watch() {
    const { canvas } = this;
    new ResizeObserver(() => this.resize()).observe(canvas);
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.picture = null;
      this.say('failed', 'The GPU was reset. The picture returns by itself; if it does not, reload the page.');
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.panorama.start();
      if (this.item >= 0) this.open(this.item, this.choice);
    });
    this.resize();
  }

  say(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  // An emulated headset draws into the canvas, whose size is then not ours to change.
  resize() {
    const { canvas } = this;
    if (this.session) return;
    const scale = window.devicePixelRatio || 1;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * scale));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * scale));
    if (this.picture) this.draw(performance.now());
  }

  // Changes parts of the state and draws.
  set(changes) {
    Object.assign(this.state, changes);
    const { state } = this;
    state.yaw = wrapDegrees(state.yaw);
    state.pitch = clamp(state.pitch, -90, 90);
    state.fov = clamp(state.fov, 5, state.planet ? 330 : 150);
    state.shift = clamp(state.shift, -5, 5);
    this.redraw();
    this.say('change');
  }

  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      this.draw(now);
      if (modeOf(this.state.mode).moves && !this.session) this.redraw();
    });
  }

  draw(now) {
    const { panorama, picture, canvas, state } = this;
    if (this.session) return;
    panorama.clear();
    if (!picture) return;
    picture.refresh?.();
    this.compare?.before(picture);
    const shift = (state.shift * Math.PI) / 360; // half of it for each eye
    for (const { at, eye, show } of modeOf(state.mode).parts(now)) {
      const box = boxOf(at, canvas);
      if (box[2] < 1 || box[3] < 1) continue;
      panorama.draw(picture, {
        rays: raysOf(state, box[2] / box[3]), box, eye, show, swap: state.swap, grid: state.grid, bend: bendOf(state), shift,
      });
    }
    this.compare?.after(now);
  }

  get about() {
    return this.scene ?? this.view.items[this.item];
  }

  // Opens an item by its index; a load that is under way is abandoned. Does not throw: says `open` or `failed`.
  async open(item, choice = {}) {
    this.loading?.abort();
    const loading = (this.loading = new AbortController());
    const texels = this.picture?.eyes.reduce((sum, eye) => sum + eye.size[0] * eye.size[1], 0);
    if (item !== this.item && texels > KEEP) this.close();
    Object.assign(this, { item, choice, scene: null });
    this.say('loading', 0);
    try {
      const picture = await openPicture(this.panorama, this.view, this.about, {
        base: this.base, choice, signal: loading.signal, progress: (part) => this.say('loading', part),
      });
      if (loading.signal.aborted) return picture.free();
      this.close();
      this.picture = picture;
      picture.changed = () => {
        this.redraw();
        this.say('change');
      };
      this.redraw();
      this.say('open');
    } catch (error) {
      if (loading.signal.aborted) return;
      this.close();
      this.redraw();
      this.say('failed', error.message);
    }
    this.say('loading', null);
  }

  close() {
    this.picture?.free();
    this.picture = null;
  }

  // The next or a former item, around.
  go(by) {
    const count = this.view.items.length;
    if (count > 1) this.open((this.item + by + count) % count, { exposure: this.choice.exposure, tone: this.choice.tone });
  }

  // A change of layout, projection, exposure or tone: loads the picture anew, where it is in the video.
  async choose(changes) {
    const at = this.picture?.video?.currentTime;
    await this.open(this.item, { ...this.choice, ...changes });
    if (at) this.picture?.seek?.(at);
  }

  // Where the server develops the picture: in stops, from what it is now.
  expose(by) {
    if (!this.about?.live) return false;
    const now = this.choice.exposure ?? this.about.exposure ?? 0;
    this.choose({ exposure: clamp(Math.round((now + by) * 100) / 100, -20, 20) });
    return true;
  }

  // What is on the canvas, as a PNG.
  async screenshot() {
    this.draw(performance.now());
    return new Promise((done) => (this.compare?.shown() ?? this.canvas).toBlob(done));
  }
}
