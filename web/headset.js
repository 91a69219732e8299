// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture in a headset, by WebXR. Only the orientation of each eye's view counts: every direction shows exactly the
// picture's line of sight, at any position of the head; a layered scene asks for the positions, too. The panel
// (headset-panel.js) comes with the session. The page's canvas shows what the left eye sees.
import { clamp, degrees, radians } from './geometry.js';
import { turned } from './headset-room.js';
import { wornEye } from './modes.js';
import { raysOf } from './panorama.js';
import { Pace } from './pace.js';

const RATE = 90; // frames per second, if the headset supports it
const FOVEATION = 0.5; // reduction of resolution at the edge of the view, 0..1; the middle is drawn at full resolution
const HOLD = 800; // milliseconds until a trigger or a pinch counts as held
const STICK = 0.7; // fraction of the range of a stick
const MIRROR = 100; // milliseconds between pictures for the page
const MARKED = 4000; // milliseconds that a mark of the desk remains

// The rays of a view (panorama.js) from its orientation and its projection matrix.
export function raysOfView({ transform, projectionMatrix: p }, turn) {
  const m = transform.matrix;
  const [right, up, back] = [0, 4, 8].map((i) => turned(m.slice(i, i + 3), turn));
  const column = (x, y, z) => right.map((_, i) => right[i] * x + up[i] * y + back[i] * z);
  return [...column(1 / p[0], 0, 0), ...column(0, 1 / p[5], 0), ...column(p[8] / p[0], p[9] / p[5], -1)];
}

// The direction of a head in the picture: yaw, pitch, roll in degrees.
export function lookOf({ matrix: m }, turn) {
  const [yaw, pitch] = [Math.atan2(-m[8], m[10]), Math.asin(clamp(-m[9], -1, 1))];
  const [s, c] = [Math.sin(yaw), Math.cos(yaw)];
  const above = -m[0] * s * Math.sin(pitch) + m[1] * Math.cos(pitch) + m[2] * c * Math.sin(pitch);
  const roll = Math.atan2(-above, m[0] * c + m[2] * s);
  return { yaw: degrees(yaw + turn), pitch: degrees(pitch), roll: degrees(roll) };
}

// The menu needs a second layer, above the picture's.
function hasLayers(session) {
  return (session.enabledFeatures?.includes('layers') ?? true) && typeof XRWebGLBinding !== 'undefined' &&
    typeof XRWebGLBinding.prototype.createEquirectLayer === 'function' && (session.maxRenderLayers ?? 2) >= 2;
}

const indexOf = ({ eye }) => (eye === 'right' ? 1 : 0);

export class Headset {
  // wants.layers: use the browser's layers for pictures, too, if it has them and the picture's format allows it. Films
  // have them wherever they are true.
  constructor(viewer, wants = {}) {
    Object.assign(this, { viewer, wants, session: null, turn: 0, pose: null, layers: null, panel: null, marker: null });
  }

  // Sets the point that the desk marks: { yaw, pitch, eye }, or null.
  mark(marker) {
    Object.assign(this, { marker, marked: performance.now() });
  }

  async toggle() {
    if (this.session) return this.session.end();
    const { viewer } = this;
    const { gl } = viewer.panorama;
    const session = await navigator.xr.requestSession('immersive-vr', { optionalFeatures: ['local', 'hand-tracking', 'layers'] });
    session.addEventListener('end', () => this.ended());
    await gl.makeXRCompatible();
    if (viewer.studio) viewer.steering ??= new (await import('./studio-headset.js')).VrSteering(viewer.studio);
    this.space = await session.requestReferenceSpace('local');
    const isQuick = session.supportedFrameRates?.includes(RATE);
    if (isQuick) session.updateTargetFrameRate(RATE).catch(() => {});
    const framebufferScaleFactor = XRWebGLLayer.getNativeFramebufferScaleFactor?.(session) ?? 1;
    const layer = new XRWebGLLayer(session, gl, { alpha: false, antialias: false, depth: false, stencil: false, framebufferScaleFactor });
    if (typeof layer.fixedFoveation === 'number') layer.fixedFoveation = FOVEATION;
    session.updateRenderState({ baseLayer: layer });
    Object.assign(this, { session, turn: 0, held: new Map(), pressed: new Map(), gripped: new Map(), last: 0 });
    this.pace = new Pace({ period: 1000 / (isQuick ? RATE : (session.frameRate ?? RATE)) });
    this.listenToHands();
    this.watchWearer();
    viewer.session = session;
    this.viewer.say('change');
    await this.findLayers().catch((error) => console.warn('No layers:', error.message));
    import('./headset-panel.js').then(({ HeadsetPanel }) => {
      if (this.session === session) this.panel = new HeadsetPanel(this);
    }, (error) => console.warn('No panel in the headset:', error.message));
    session.requestAnimationFrame((...next) => this.frame(...next));
    this.mirror();
    return session;
  }

  async findLayers() {
    const { session, viewer, wants } = this;
    if (!hasLayers(session)) return;
    const { EyeLayers } = await import('./layers.js');
    this.layers = new EyeLayers(session, viewer.panorama.gl, this.space, Boolean(wants.layers));
  }

  ended() {
    this.layers?.free();
    this.panel?.free();
    Object.assign(this, { session: null, layers: null, panel: null, pose: null, marker: null });
    this.viewer.session = null;
    this.viewer.resize();
    this.viewer.set({ roll: 0 });
  }

  frame(now, frame) {
    const { session, viewer } = this;
    session.requestAnimationFrame((...next) => this.frame(...next));
    if (this.last) this.pace.took(now - this.last, now);
    this.last = now;
    this.listen();
    this.pose = frame.getViewerPose(this.space) ?? this.pose;
    if (!this.pose || !this.session) return;
    if (now - this.marked > MARKED) this.marker = null;
    this.panel?.update(frame, this.pose, now);
    const { picture, panorama } = viewer;
    const look = lookOf(this.pose.transform, this.turn);
    if (viewer.scene) viewer.steering?.head(look);
    if (!(now - this.looked < MIRROR)) this.lookAt(now, look);
    if (this.showLayers(frame)) return;
    picture?.refresh?.();
    const layer = session.renderState.baseLayer;
    if (!layer) return;
    const { gl } = panorama;
    gl.bindFramebuffer(gl.FRAMEBUFFER, layer.framebuffer);
    gl.clearColor(0.1, 0.1, 0.1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const parts = [];
    for (const view of this.pose.views) {
      view.requestViewportScale?.(this.pace.how.scale);
      const { x, y, width, height } = layer.getViewport(view);
      if (picture) parts.push(this.drawPicture(view, [x, y, width, height], layer.framebuffer));
      this.drawPanel(view, [x, y, width, height], layer.framebuffer);
    }
    picture?.pager?.follow(parts, now);
  }

  // Shows the picture by the browser's layers. Returns false if the shader must draw; for the rest of the session, if
  // the browser refuses what it seemed to allow.
  showLayers(frame) {
    const { viewer, viewer: { picture }, layers, panel } = this;
    if (!layers) return false;
    try {
      if (!picture || picture.draw || viewer.scene) {
        layers.drop();
        return false;
      }
      if (!layers.show(frame, viewer, this.turn)) return false;
      layers.drawAbove(panel?.isSeen ? (...view) => this.drawPanel(...view) : null, this.pose);
      return true;
    } catch (error) {
      console.warn('No layers, so the shader draws:', error.message);
      this.session.updateRenderState({ baseLayer: layers.base });
      layers.free();
      this.layers = null;
      return false;
    }
  }

  // Turns the page's view to the direction of the head.
  lookAt(now, look) {
    this.looked = now;
    this.viewer.set(look);
  }

  drawPicture(view, box, target) {
    const { viewer, viewer: { picture, panorama, state } } = this;
    const options = {
      rays: raysOfView(view, this.turn), box, eye: wornEye(state, indexOf(view)), swap: state.swap, grid: state.grid,
      moves: true, cheap: this.pace.how.cheap, target, state, worn: this,
    };
    panorama.draw(picture, options);
    if (viewer.scene) viewer.steering?.draw(panorama, raysOfView(view, 0), this.pose, options);
    return options;
  }

  drawPanel(view, box, target) {
    const { x, y, z } = view.transform.position;
    this.panel?.draw({ rays: raysOfView(view, 0), eye: [x, y, z], index: indexOf(view), box, target });
  }

  // Shows the left eye's view on the page, if the page is visible: then browsers give it frames of its own. An emulated
  // headset draws into the page's canvas itself.
  mirror() {
    const { session } = this;
    if (!session) return;
    setTimeout(() => requestAnimationFrame((now) => {
      if (this.pose && session.renderState.baseLayer?.framebuffer !== null) this.drawMirror(now);
      this.mirror();
    }), MIRROR);
  }

  drawMirror(now) {
    const { viewer, viewer: { picture, panorama, state } } = this;
    const { x, y, z } = this.pose.views[0].transform.position;
    picture?.refresh?.();
    panorama.clear();
    for (const options of viewer.parts(now)) {
      const { box } = options;
      if (picture) panorama.draw(picture, { ...options, shift: 0, moves: true });
      if (state.planet) continue;
      const rays = raysOf({ ...state, yaw: state.yaw - degrees(this.turn) }, box[2] / box[3]);
      this.panel?.draw({ rays, eye: [x, y, z], index: 0, box, target: null });
    }
  }

  // Turns the picture so that its middle is in the direction of the head.
  recentre() {
    if (!this.pose) return;
    const m = this.pose.transform.matrix;
    Object.assign(this, { turn: -Math.atan2(-m[8], m[10]), centred: this.pose });
  }

  // Turns the wearer by degrees, to the right: those who sit see what is behind them.
  turnBy(angle) {
    this.turn += radians(angle);
  }

  // A video pauses while the headset is taken off.
  watchWearer() {
    const { session, viewer } = this;
    let stopped = null;
    session.addEventListener('visibilitychange', () => {
      const video = viewer.picture?.video;
      if (session.visibilityState === 'hidden') {
        stopped = video && !video.paused ? video : null;
        stopped?.pause();
      } else if (session.visibilityState === 'visible') {
        if (stopped && stopped === video) video.play().catch(() => {});
        stopped = null;
      }
    });
  }

  // A press that ends with `select` was released; otherwise it was cancelled, for example by the system's own gestures.
  listenToHands() {
    const { session } = this;
    const on = (event, run) => session.addEventListener(event, run);
    const done = { select: new Set(), squeeze: new Set() };
    const poseOf = ({ frame, inputSource }) => frame.getPose(inputSource.targetRaySpace, this.space);
    for (const name of Object.keys(done)) on(name, ({ inputSource }) => done[name].add(inputSource));
    on('selectstart', (event) => {
      this.pressed.set(event.inputSource, { since: performance.now(), isPanels: this.panel?.press(event.inputSource, poseOf(event)) });
    });
    on('selectend', (event) => {
      const { inputSource: source } = event;
      const { since, isPanels } = this.pressed.get(source) ?? { since: performance.now() };
      const isDone = done.select.delete(source);
      if (isPanels) this.panel?.release(source, poseOf(event), isDone);
      else if (isDone) this.select(performance.now() - since > HOLD);
    });
    on('squeezestart', ({ inputSource }) => this.gripped.set(inputSource, performance.now()));
    on('squeezeend', ({ inputSource }) => {
      if (done.squeeze.delete(inputSource) && this.gripped.delete(inputSource)) this.viewer.go(inputSource.handedness === 'left' ? -1 : 1);
    });
  }

  select(isLong) {
    const { picture } = this.viewer;
    if (isLong) this.recentre();
    else if (this.panel?.isOpen) this.panel.close();
    else if (this.viewer.scene) this.viewer.steering.select();
    else if (picture?.video) picture.toggle();
    else if (!this.viewer.view.tour) this.viewer.go(1);
  }

  // Buttons and sticks have no events; a new press acts once.
  listen() {
    const { viewer } = this;
    for (const [source, since] of this.gripped) {
      if (performance.now() - since > HOLD && this.gripped.delete(source)) this.panel?.toggle();
    }
    const along = (by) => {
      const { picture } = viewer;
      if (picture?.video) picture.seek(picture.video.currentTime + 10 * by);
      else viewer.go(by);
    };
    const stick = [0, 0]; // sum of both hands
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
