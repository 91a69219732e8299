// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The panel in the headset, and its pointers: the rays of controllers and hands, the gaze while pinching, and without
// any other pointer, the head, which selects by dwelling. While the panel is hidden, a handle low in front opens it.
// Neither is fixed to the head: the panel stays in the room until the wearer has turned away from it.
import { clamp, radians } from './geometry.js';
import { TEXT, WIDE, controlsOf, paint } from './headset-controls.js';
import { HeadsetSubtitles } from './headset-subtitles.js';
import { Sheets, facing, headingOf, meet, plus, poseOf, sheetAhead, thread, turnBetween } from './headset-room.js';
import { directionAt } from './places.js';
import { t } from './translate.js';

export const DISTANCE = 1.2; // metres: a headset focuses at about 1.3, so eyes that converge on the panel see it sharply
const PIXEL = 0.8 / WIDE; // metres
const BELOW = radians(20); // pitch of the middle of the panel, downwards: over the ground, which is farther away there
const HANDLE_BELOW = radians(50); // out of sight when looking ahead
const HANDLE = [300, 104]; // pixels
const LOW = radians(-28); // pitch of a head that looks for the handle
const LOST = radians(45); // from the panel, or
const LEFT = 0.5; // metres from the position where it was opened
const PATIENCE = 1000; // milliseconds until the panel follows
const DWELL = 1200; // milliseconds of dwelling for a selection
const DIM = [0, 0, 0, 0.65]; // the picture behind: closer objects covered by the panel must not compete with it
const ACCENT = [1, 0.71, 0.28];
const MARK = 2; // metres: for the mark of the desk, whose distance is unknown

export class HeadsetPanel {
  constructor(headset) {
    const { gl } = headset.viewer.panorama;
    Object.assign(this, { headset, gl, isOpen: false, first: 0, message: '', pointers: [], thumbnails: new Map(), held: new Map(), dwell: { for: 0 }, hovered: new Set(), painted: '' });
    this.sheets = new Sheets(gl);
    this.subtitles = new HeadsetSubtitles(this.sheets, gl);
    this.canvas = new OffscreenCanvas(WIDE, TEXT);
    [this.face, this.label] = [gl.createTexture(), gl.createTexture()];
    paint(this.canvas, { high: HANDLE[1], controls: [{ box: [0, 0, ...HANDLE], icon: 'menu', text: t('Menu') }] }, this.hovered, HANDLE[0]);
    this.sheets.fill(this.label, this.canvas);
    this.listen(headset.viewer);
  }

  listen(viewer) {
    this.heard = new AbortController();
    const on = (target, event, run) => target.addEventListener(event, run, { signal: this.heard.signal });
    on(viewer, 'failed', ({ detail }) => {
      this.message = detail;
      if (this.head && !this.isOpen) this.open();
    });
    on(viewer, 'loading', ({ detail }) => (this.message = detail === null ? this.message : t('Loading … {} %', Math.round(100 * detail))));
    on(viewer, 'open', () => (this.message = ''));
    on(viewer.element, 'pointermove', ({ offsetX, offsetY }) => this.headset.mark(directionAt(viewer, offsetX, offsetY)));
    on(viewer.element, 'pointerleave', () => this.headset.mark(null));
  }

  free() {
    this.heard.abort();
    this.subtitles.free();
    this.spots?.free();
    this.sheets.free();
    for (const texture of [this.face, this.label]) this.gl.deleteTexture(texture);
  }

  // An image; null until it is loaded.
  thumbnail(address) {
    if (!address) return null;
    const { thumbnails, headset: { viewer } } = this;
    if (!thumbnails.has(address)) {
      thumbnails.set(address, null);
      fetch(new URL(address, viewer.base)).then((answer) => answer.blob()).then(createImageBitmap)
        .then((image) => thumbnails.set(address, image)).catch(() => {}); // the name is enough without it
    }
    return thumbnails.get(address);
  }

  open() {
    this.first = Math.max(this.headset.viewer.item - 1, 0);
    Object.assign(this, { isOpen: true, painted: '', lostSince: 0, heading: headingOf(this.head), from: this.head.at });
    this.place();
  }

  close() {
    this.isOpen = false;
    this.held.clear();
  }

  toggle() {
    if (this.isOpen) this.close();
    else if (this.head) this.open();
  }

  // --- position ---

  place() {
    const [below, size] = this.isOpen ? [BELOW, [WIDE, this.canvas.height]] : [HANDLE_BELOW, HANDLE];
    this.sheet = sheetAhead(this.from, this.heading, below, DISTANCE, size.map((pixels) => pixels * PIXEL));
  }

  // The handle stays ahead until the wearer looks for it; the panel follows wearers who have turned or moved away.
  follow(now, seconds) {
    const { head } = this;
    if (!this.isOpen) {
      this.isSought = Math.asin(-head.back[1]) < LOW;
      if (!this.isSought || !this.from) Object.assign(this, { heading: headingOf(head), from: head.at });
      return this.place();
    }
    const by = turnBetween(this.heading, headingOf(head));
    const way = Math.hypot(...plus(head.at, this.from, -1));
    const isLost = Math.abs(by) > LOST || way > LEFT;
    if (!isLost && !this.isComing) this.lostSince = now;
    this.isComing = !this.held.size && (this.isComing ? Math.abs(by) > 0.02 || way > 0.02 : now - this.lostSince > PATIENCE);
    if (this.isComing) {
      const part = 1 - Math.exp(-seconds / 0.15);
      this.heading += part * by;
      this.from = plus(this.from, plus(head.at, this.from, -1), part);
    }
    this.place();
  }

  // --- pointers ---

  pointer(source, { transform }) {
    const { at, back } = poseOf(transform);
    const pointer = { source, from: at, along: back.map((x) => -x) };
    const hit = this.sheet && meet(this.sheet, pointer);
    if (!hit?.isInside && !this.isOpen) Object.assign(pointer, this.spots?.find(pointer, this.head.at));
    if (pointer.control) return pointer;
    return { ...pointer, hit, control: hit?.isInside ? this.controlAt(hit) : null };
  }

  pixel({ x, y }) {
    const { width, height } = this.canvas;
    return [((x + 1) / 2) * width, ((1 - y) / 2) * height];
  }

  controlAt(hit) {
    if (!this.isOpen) return { id: 'handle', run: () => this.open() };
    const [x, y] = this.pixel(hit);
    const isIn = ({ box: [left, top, width, height] }) => x >= left && x < left + width && y >= top && y < top + height;
    return this.content?.controls.find((control) => (control.run || control.drag) && isIn(control)) ?? null;
  }

  // Dwell selection works only if no hand points and nothing was pinched; otherwise it would select unasked.
  point(frame, pose, seconds) {
    const { session, space } = this.headset;
    const sources = [...session.inputSources].filter(({ targetRayMode }) => targetRayMode !== 'screen');
    this.pinchesLook ||= sources.some(({ targetRayMode }) => targetRayMode === 'transient-pointer');
    const isPointing = ({ targetRayMode, hand }) => targetRayMode !== 'gaze' && !(hand && targetRayMode === 'tracked-pointer' && this.pinchesLook);
    const poses = sources.filter(isPointing).map((source) => [source, frame.getPose(source.targetRaySpace, space)]);
    this.pointers = poses.filter(([, where]) => where).map(([source, where]) => this.pointer(source, where));
    const isLed = this.pointers.length || this.pinchesLook;
    const gaze = this.pointer(null, pose);
    if (!isLed) this.pointers = [gaze];
    this.stay(!isLed || !(this.isOpen || gaze.control?.isSpot) ? gaze : { control: null }, seconds);
    for (const { source, hit } of this.pointers) {
      const held = this.held.get(source);
      if (hit && held?.drag) this.drag(Object.assign(held, { hit }), hit, false);
    }
  }

  // Acts once per dwelling, or repeatedly where that makes sense.
  stay(gaze, seconds) {
    const { control } = gaze;
    const { item } = this.headset.viewer;
    const rests = control?.isSpot && this.dwell.id && this.dwell.item !== item; // one look leads on only once
    if (rests) Object.assign(this.dwell, { id: control.id, isDone: true });
    else if (control?.id !== this.dwell.id) this.dwell = { id: control?.id, item, for: 0, isDone: false };
    if (!control || this.dwell.isDone) return;
    this.dwell.at = control.isSpot ? gaze.hit.at : null;
    this.dwell.for += 1000 * seconds;
    if (this.dwell.for < DWELL) return;
    Object.assign(this.dwell, { for: 0, isDone: !control.repeats });
    if (control.drag) this.drag(control, gaze.hit, true);
    else control.run();
  }

  drag({ id }, hit, isLast) {
    const control = this.content.controls.find((each) => each.id === id);
    if (!control) return;
    const [left, , width] = control.box;
    control.drag(clamp((this.pixel(hit)[0] - left - 16) / (width - 32), 0, 1), isLast);
  }

  // Handles a source's press. Returns false if it has another meaning.
  press(source, pose) {
    if (!pose) return false;
    const { hit, control } = this.pointer(source, pose);
    if (!hit?.isInside || !(this.isOpen || this.isSought || control?.isSpot)) return false;
    this.held.set(source, { ...control, hit });
    if (control?.drag) this.drag(control, hit, false);
    return true;
  }

  // isDone: the source was released, not cancelled. Its pose may be missing by then; the last one is used.
  release(source, pose, isDone) {
    const held = this.held.get(source);
    this.held.delete(source);
    if (!held) return;
    const { hit, control } = pose ? this.pointer(source, pose) : held;
    if (held.drag) this.drag(held, hit ?? held.hit, true);
    else if (isDone && held.run && (control?.id === held.id || source.targetRayMode === 'transient-pointer')) held.run();
  }

  // --- drawing ---

  update(frame, pose, now) {
    const seconds = Math.min((now - (this.last ?? now)) / 1000, 0.1);
    this.last = now;
    this.head = poseOf(pose.transform);
    const { subtitles, guide } = this.headset.viewer;
    this.spots ??= guide?.wear(this);
    this.subtitles.update(subtitles?.text || (!this.isOpen && guide?.text) || '', this.head);
    if (this.isOpen) this.content = controlsOf(this.headset, this);
    this.follow(now, seconds);
    this.point(frame, pose, seconds);
    if (this.isOpen) this.repaint();
  }

  // The controls at which pointers aim, or that they hold.
  aimed() {
    return new Set(this.pointers.map(({ source, control }) => this.held.get(source)?.id ?? control?.id));
  }

  repaint() {
    this.hovered = this.aimed();
    const { content } = this;
    const what = JSON.stringify([content, ...this.hovered]);
    if (what === this.painted) return;
    this.painted = what;
    paint(this.canvas, content, this.hovered);
    this.sheets.fill(this.face, this.canvas);
    this.place();
  }

  // The objects to draw for an eye, over the picture.
  things({ eye, index }) {
    const things = this.subtitles.sheet ? [this.subtitles.sheet] : [];
    const spots = !this.isOpen && this.spots;
    if (spots) things.unshift(...spots.things({ eye, index }, this.aimed()));
    const isMenu = this.isOpen || this.isSought || spots?.isSeen;
    if (this.isOpen) things.push({ color: DIM }, { ...this.sheet, face: this.face });
    else if (this.isSought) things.push({ ...this.sheet, face: this.label, color: [1, 1, 1, this.pointers.some(({ control }) => control) || this.dwell.id ? 1 : 0.6] });
    if (isMenu) for (const pointer of this.pointers) things.push(...this.traces(pointer, eye));
    const { dwell } = this;
    if (isMenu && dwell.id && !dwell.isDone) {
      const at = dwell.at ?? plus(this.head.at, this.head.back, -0.98 * DISTANCE);
      things.push({ ...facing(at, eye, (0.03 * Math.hypot(...plus(at, eye, -1))) / DISTANCE), color: [...ACCENT, 1], ring: [0.7, dwell.for / DWELL] });
    }
    const { marker, turn } = this.headset;
    if (marker && index === (marker.eye === 'right' ? 1 : 0)) this.mark = eye;
    if (marker && this.mark) {
      const spot = sheetAhead(this.mark, radians(marker.yaw) - turn, -radians(marker.pitch), MARK, [1, 1]);
      things.push({ ...facing(spot.at, eye, 0.07), color: [...ACCENT, 0.9], ring: [0.8, 1] });
    }
    return things;
  }

  traces({ source, from, along, hit }, eye) {
    const end = hit?.isInside ? hit.at : plus(from, along, source ? 0.6 : DISTANCE);
    const dot = { ...facing(end, eye, 0.008), color: [1, 1, 1, 1], ring: [0, 1] };
    return source && source.targetRayMode === 'tracked-pointer' ? [{ ...thread(from, end, eye, 0.003), color: [...ACCENT, 0.6] }, dot] : [dot];
  }

  get isSeen() {
    return Boolean(this.isOpen || this.isSought || this.spots?.isSeen || this.subtitles.sheet || this.headset.marker);
  }

  // view: { rays, eye, index, box, target }, see Sheets.draw(); index: 0 for the left eye.
  draw(view) {
    if (this.isSeen) this.sheets.draw(this.things(view), view);
  }
}
