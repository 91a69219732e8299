// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The studio in the headset: the stick moves the start and the end of the merge, the trigger swaps A and B, and a line
// of text in view reports it. Called by headset.js.
import { PROJECTIONS } from './formats.js';
import { clamp, dot, wrapDegrees } from './geometry.js';
import { EyeTexture } from './tiles.js';

const DEAD = 0.25; // fraction of the range of the stick
const SPEED = 30; // degrees per second, with the stick fully out
const SHOWN = 2500; // milliseconds
const TEXT = [512, 96]; // pixels
const WIDE = 0.5; // radians
const BELOW = -0.26;

const halves = (degrees) => Math.round(degrees * 2) / 2;
const axes = (m) => [m.slice(0, 3), m.slice(4, 7), m.slice(8, 11)];

export class VrSteering {
  constructor(studio) {
    Object.assign(this, { studio, last: 0, gesture: null, label: null, until: 0, values: null });
  }

  // The stick of a controller, right and down positive. Changes are one undo step until the stick is released.
  stick(x = 0, y = 0) {
    const now = performance.now();
    const time = Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    const push = (value) => (Math.abs(value) < DEAD ? 0 : (value - Math.sign(value) * DEAD) / (1 - DEAD));
    const [right, up] = [push(x), -push(y)];
    const { session } = this.studio;
    if (!right && !up) {
      if (this.gesture) session.edit({}, this.gesture);
      this.gesture = null;
      return;
    }
    const { merge_top: top } = session.settings.sidecar;
    if (!this.gesture) Object.assign(this, { gesture: {}, values: { start: top.start, end: top.end } });
    const { values } = this;
    if (right) values.start = clamp(values.start + right * SPEED * time, 0, values.end - 1);
    if (up) values.end = Math.max(Math.min(values.end + up * SPEED * time, 90), values.start + 1);
    this.merge(values, this.gesture, true);
    this.say(`Merge ${halves(values.start).toFixed(1)}° – ${halves(values.end).toFixed(1)}°`);
  }

  merge({ start, end }, gesture, dragging) {
    const { session, panel: { linked } } = this.studio;
    const { merge_top: top, merge_bottom: bottom } = session.settings.sidecar;
    const mode = top.mode === 'none' ? 'cosine' : top.mode;
    const merged = (each) => ({ ...each, mode, start: halves(start), end: halves(end) });
    session.edit({ merge_limit: null, 'sidecar.merge_top': merged(top), ...(linked && { 'sidecar.merge_bottom': merged(bottom) }) }, gesture, dragging);
  }

  // Start and end of the merge, for the panel. set(value, isLast).
  numbers() {
    const { start, end } = this.studio.session.settings.sidecar.merge_top;
    const set = (values) => (value, isLast) => {
      this.dragged ??= {};
      this.merge(values(value), this.dragged, !isLast);
      if (isLast) this.dragged = null;
    };
    return [
      { id: 'merge-start', text: 'Merge from', value: start, least: 0, most: 90, set: set((value) => ({ start: Math.min(value, end - 1), end })) },
      { id: 'merge-end', text: 'Merge to', value: end, least: 0, most: 90, set: set((value) => ({ start, end: Math.max(value, start + 1) })) },
    ];
  }

  get exposure() {
    return this.studio.session.settings.exposure;
  }

  expose(stops) {
    this.studio.session.edit({ exposure: Math.round((this.exposure + stops) * 100) / 100 });
  }

  get side() {
    return this.studio.session.active ? 'B' : 'A';
  }

  select() {
    this.studio.session.swap();
    this.say(`Settings ${this.side}`);
  }

  // The direction of the head, which is refined first.
  head({ yaw, pitch }) {
    this.studio.headLook = { yaw: wrapDegrees(yaw), pitch, fov: 100, aspect: 1 };
    this.studio.watchLook();
  }

  async say(text) {
    this.text = text;
    if (this.painting) return;
    this.painting = true;
    while (this.painted !== this.text) await this.paint(this.text);
    Object.assign(this, { painting: false, until: performance.now() + SHOWN });
  }

  async paint(text) {
    const { viewer } = this.studio.page;
    const canvas = new OffscreenCanvas(...TEXT);
    const context = canvas.getContext('2d');
    context.fillStyle = '#202225';
    context.fillRect(0, 0, ...TEXT);
    Object.assign(context, { fillStyle: '#f1f1ef', font: '44px system-ui, sans-serif', textAlign: 'center', textBaseline: 'middle' });
    context.fillText(text, TEXT[0] / 2, TEXT[1] / 2);
    const texture = new EyeTexture(viewer.panorama.gl, ...TEXT, false);
    await texture.fill(canvas, 0, 0);
    this.label?.eyes[0].free();
    this.label = this.picture(texture);
    Object.assign(this, { painted: text, until: performance.now() + SHOWN });
  }

  // A window of the sphere, below the middle of the view.
  picture(texture) {
    const { camera } = PROJECTIONS.find(({ name }) => name === 'lat-long');
    const high = (WIDE * TEXT[1]) / TEXT[0];
    const window = { ...camera, projection: { ...camera.projection, center: [0, BELOW], span: [WIDE, high] } };
    return { eyes: [texture, texture], camera: window, below: window.projection, mono: true };
  }

  // Draws the text if it is due. rays: the view's in the room; pose: the head's.
  draw(panorama, rays, pose, options) {
    if (!this.label || performance.now() > this.until) return;
    const head = axes(pose.transform.matrix);
    const inHead = [0, 3, 6].flatMap((i) => head.map((axis) => dot(axis, rays.slice(i, i + 3))));
    panorama.draw(this.label, { ...options, rays: inHead, swap: false, grid: false });
  }
}
