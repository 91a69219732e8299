// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture in a headset, by WebXR. Only the orientation of each eye's view counts: every direction shows exactly the
// line of sight that the picture has there, wherever the head is.
import { Pace } from './pace.js';

// What the buttons do, for the page's help.
export const BUTTONS = [
  ['Trigger or pinch', 'play or pause; with a picture: next'],
  ['Hold trigger or pinch', 'recentre'],
  ['Stick left, right', 'back or ahead by 10 s; with a picture: previous, next'],
  ['Stick up, down', 'exposure (HDR and EXR on the live page)'],
  ['In the studio', 'stick left, right: where the merge starts; up, down: where it ends; trigger: settings A or B'],
  ['Press the stick', 'recentre'],
  ['Grip', 'next; of the left hand: previous'],
  ['A or X', 'swap the eyes'],
  ['B or Y', 'leave'],
];
const RATE = 90; // frames per second, where the headset offers it
const FOVEATION = 0.5; // how much coarser the edge of the view may be, 0..1: the middle is drawn pixel by pixel
const HOLD = 800; // milliseconds until a trigger or a pinch counts as held
const STICK = 0.7; // of its way

export async function hasHeadset() {
  return (await navigator.xr?.isSessionSupported('immersive-vr').catch(() => false)) ?? false;
}

// Directions turned to the right about the vertical axis.
function turned([x, y, z], angle) {
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  return [x * c - z * s, y, z * c + x * s];
}

// The rays of a view (panorama.js) from its orientation and its projection matrix.
export function raysOfView({ transform, projectionMatrix: p }, turn) {
  const m = transform.matrix;
  const [right, up, back] = [0, 4, 8].map((i) => turned(m.slice(i, i + 3), turn));
  const column = (x, y, z) => right.map((_, i) => right[i] * x + up[i] * y + back[i] * z);
  return [...column(1 / p[0], 0, 0), ...column(0, 1 / p[5], 0), ...column(p[8] / p[0], p[9] / p[5], -1)];
}

export class Headset {
  // wants.layers: equirect layers where the browser has them and the picture's form allows.
  constructor(viewer, wants = {}) {
    Object.assign(this, { viewer, wants, session: null, turn: 0, pose: null, layers: null, pressed: new Map() });
  }

  async toggle() {
    if (this.session) return this.session.end();
    const { gl } = this.viewer.panorama;
    const optionalFeatures = ['local', 'hand-tracking', ...(this.wants.layers ? ['layers'] : [])];
    const session = await navigator.xr.requestSession('immersive-vr', { optionalFeatures });
    session.addEventListener('end', () => this.ended());
    await gl.makeXRCompatible();
    this.space = await session.requestReferenceSpace('local');
    const isQuick = session.supportedFrameRates?.includes(RATE);
    if (isQuick) session.updateTargetFrameRate(RATE).catch(() => {});
    const framebufferScaleFactor = XRWebGLLayer.getNativeFramebufferScaleFactor?.(session) ?? 1;
    const layer = new XRWebGLLayer(session, gl, { alpha: false, antialias: false, depth: false, stencil: false, framebufferScaleFactor });
    if (typeof layer.fixedFoveation === 'number') layer.fixedFoveation = FOVEATION;
    session.updateRenderState({ baseLayer: layer });
    session.addEventListener('selectstart', ({ inputSource }) => this.pressed.set(inputSource, performance.now()));
    session.addEventListener('select', ({ inputSource }) => this.select(inputSource));
    session.addEventListener('squeeze', ({ inputSource }) => this.viewer.go(inputSource.handedness === 'left' ? -1 : 1));
    Object.assign(this, { session, turn: 0, held: new Map(), last: 0 });
    this.pace = new Pace(1000 / (isQuick ? RATE : (session.frameRate ?? RATE)));
    this.viewer.session = session;
    this.viewer.say('change');
    if (this.wants.layers) {
      const { EyeLayers, hasLayers } = await import('./layers.js');
      if (hasLayers(session)) this.layers = new EyeLayers(session, gl, this.space);
    }
    session.requestAnimationFrame((now, frame) => this.frame(frame, now));
    return session;
  }

  ended() {
    this.layers?.free();
    Object.assign(this, { session: null, layers: null, pose: null });
    this.viewer.session = null;
    this.viewer.resize();
    this.viewer.redraw();
    this.viewer.say('change');
  }

  frame(frame, now) {
    const { session, viewer } = this;
    session.requestAnimationFrame((then, next) => this.frame(next, then));
    if (this.last) this.pace.took(now - this.last, now);
    this.last = now;
    this.listen();
    this.pose = frame.getViewerPose(this.space) ?? this.pose;
    const { picture, panorama, state } = viewer;
    const steering = viewer.scene && this.pose ? viewer.steering : null; // the studio's
    steering?.head(this.pose, this.turn);
    picture?.refresh?.();
    if (picture && !viewer.scene && this.layers?.show(frame, viewer, this.turn)) return;
    const layer = session.renderState.baseLayer;
    if (!layer || !this.pose) return;
    const { gl } = panorama;
    gl.bindFramebuffer(gl.FRAMEBUFFER, layer.framebuffer);
    gl.clearColor(0.1, 0.1, 0.1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (!picture) return;
    const parts = [];
    for (const view of this.pose.views) {
      view.requestViewportScale?.(this.pace.how.scale);
      const { x, y, width, height } = layer.getViewport(view);
      const options = {
        rays: raysOfView(view, this.turn), box: [x, y, width, height], eye: view.eye === 'right' ? 1 : 0,
        swap: state.swap, grid: state.grid, moves: true, cheap: this.pace.how.cheap, target: layer.framebuffer,
      };
      panorama.draw(picture, options);
      parts.push(options);
      steering?.draw(panorama, raysOfView(view, 0), this.pose, options);
    }
    picture.pager?.follow(parts, now);
  }

  // Turns the picture so that its middle is where the head points.
  recentre() {
    if (!this.pose) return;
    const m = this.pose.transform.matrix;
    this.turn = -Math.atan2(-m[8], m[10]);
  }

  select(source) {
    const since = this.pressed.get(source) ?? performance.now();
    if (performance.now() - since > HOLD) return this.recentre();
    const { picture } = this.viewer;
    if (this.viewer.scene) this.viewer.steering.select();
    else if (picture?.video) picture.toggle();
    else this.viewer.go(1);
  }

  // Buttons and sticks have no events: what is newly pressed acts once.
  listen() {
    const { viewer } = this;
    const along = (by) => {
      const { picture } = viewer;
      if (picture?.video) picture.seek(picture.video.currentTime + 10 * by);
      else viewer.go(by);
    };
    const stick = [0, 0]; // of both hands
    for (const source of this.session.inputSources) {
      const { buttons, axes, mapping } = source.gamepad ?? {};
      if (mapping !== 'xr-standard') continue;
      const now = {
        press: buttons[3]?.pressed, swap: buttons[4]?.pressed, leave: buttons[5]?.pressed,
        left: axes[2] < -STICK, right: axes[2] > STICK, up: axes[3] < -STICK, down: axes[3] > STICK,
      };
      const before = this.held.get(source) ?? {};
      this.held.set(source, now);
      const begins = (name) => now[name] && !before[name];
      if (begins('leave')) return this.session.end();
      if (begins('press')) this.recentre();
      if (begins('swap')) viewer.set({ swap: !viewer.state.swap });
      if (viewer.scene) {
        stick[0] += axes[2];
        stick[1] += axes[3];
        continue;
      }
      if (begins('left')) along(-1);
      if (begins('right')) along(1);
      if (begins('up')) viewer.expose(0.5);
      if (begins('down')) viewer.expose(-0.5);
    }
    if (viewer.scene) viewer.steering.stick(...stick);
  }
}
