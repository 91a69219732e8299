// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The picture as a WebXR layer, which the headset's compositor samples by itself: films as media-layer.js says, and if
// they are wanted, pictures as a cube for cubes if the browser supports that, else equirect. The specification does not
// define which half of a stereo-top-bottom layer is the left eye's, and for pictures browsers differ; so each eye of a
// picture is requested by name, and drawn into the region that the browser returns.
import { FACES } from './geometry.js';
import { filmLayer, hasMediaLayers } from './media-layer.js';
import { wornEye } from './modes.js';

const LARGEST = 4096; // pixels of a layer around the horizon
const CUBES = [5, 6, 7, 8]; // numbers of the kernel's projections
const AROUND = [1, 0, 0, 0, 1, 0, 0, 0, -1];

export class EyeLayers {
  // all: pictures have layers, too, not only films.
  constructor(session, gl, space, all = true) {
    this.base = session.renderState.baseLayer; // for pictures without a layer
    Object.assign(this, { session, gl, space, all, layer: null, above: null, shown: null, isFilm: false, target: gl.createFramebuffer() });
    this.binding = new XRWebGLBinding(session, gl);
    this.media = hasMediaLayers() ? new XRMediaBinding(session) : null;
  }

  createCube([width, height]) {
    const { gl } = this;
    const side = Math.min(LARGEST / 4, gl.getParameter(gl.MAX_CUBE_MAP_TEXTURE_SIZE), Math.round(Math.sqrt((width * height) / 6)));
    return this.binding.createCubeLayer({ space: this.space, viewPixelWidth: side, viewPixelHeight: side, layout: 'stereo', isStatic: false });
  }

  createEquirect([across]) {
    const { gl } = this;
    const width = Math.min(LARGEST, gl.getParameter(gl.MAX_TEXTURE_SIZE) / 2, across);
    return this.binding.createEquirectLayer({
      space: this.space, viewPixelWidth: width, viewPixelHeight: width / 2, layout: 'stereo-left-right', isStatic: false,
      radius: 0, centralHorizontalAngle: 2 * Math.PI, upperVerticalAngle: Math.PI / 2, lowerVerticalAngle: -Math.PI / 2,
    });
  }

  create({ camera, video, eyes: [{ size }] }, film) {
    this.layer?.destroy?.();
    this.isCube = !film && CUBES.includes(camera.projection.kind) && Boolean(this.binding.createCubeLayer);
    this.layer = null;
    try {
      if (film) this.layer = this.media.createEquirectLayer(video, { space: this.space, ...film.init });
      else if (this.all) this.layer = this.isCube ? this.createCube(size) : this.createEquirect(size);
    } catch (error) {
      console.warn('No layer, so the shader draws:', error.message);
    }
    this.arrange(false);
  }

  arrange(isAbove) {
    this.isAbove = isAbove;
    const layers = isAbove ? [this.layer, this.above] : [this.layer];
    this.session.updateRenderState(this.layer ? { layers } : { baseLayer: this.base });
  }

  // Layers requested by arrange() are active from the next frame on.
  has(layer) {
    return layer && this.session.renderState.layers?.includes(layer);
  }

  // The shader draws what follows.
  drop() {
    if (!this.layer) return;
    this.layer.destroy?.();
    Object.assign(this, { layer: null, picture: null });
    this.arrange(false);
  }

  // Draws the eyes that changed. Returns false if the shader must draw, because there is no layer, or the browser does
  // not allow drawing into it.
  show(frame, viewer, turn) {
    const { panorama, picture, state } = viewer;
    const film = this.media && filmLayer(picture, state);
    if (this.picture !== picture || this.isFilm !== Boolean(film)) {
      Object.assign(this, { picture, isFilm: Boolean(film), shown: null });
      this.create(picture, film);
    }
    if (!this.has(this.layer)) return false;
    const half = (turn - (film?.heading ?? 0)) / 2;
    const [s, c] = [Math.sin(half), Math.cos(half)];
    if (this.isCube) this.layer.orientation = new DOMPointReadOnly(0, s, 0, c);
    else this.layer.transform = new XRRigidTransform({ x: 0, y: 0, z: 0 }, { x: 0, y: s, z: 0, w: c });
    if (!film) this.drawEyes(frame, panorama, picture, state);
    return true;
  }

  drawEyes(frame, panorama, picture, state) {
    const { gl } = this;
    picture.refresh?.();
    const what = `${state.swap} ${state.worn} ${state.grid} ${picture.frame?.()}`;
    if (this.shown === what && !this.layer.needsRedraw) return;
    this.shown = what;
    for (const [eye, name] of ['left', 'right'].entries()) {
      const part = this.binding.getSubImage(this.layer, frame, name);
      const { x, y, width, height } = part.viewport;
      for (const [face, rays] of (this.isCube ? FACES : [AROUND]).entries()) {
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, this.isCube ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : gl.TEXTURE_2D, part.colorTexture, 0);
        panorama.draw(picture, {
          rays, box: [x, y, width, height], eye: wornEye(state, eye), swap: state.swap, grid: state.grid,
          target: this.target, all: !this.isCube, moves: Boolean(picture.video),
        });
      }
    }
  }

  // Draws the objects in the room into a layer above the picture's. draw(view, box, target); null if there are none.
  drawAbove(draw, { views }) {
    const { gl } = this;
    if (draw) this.above ??= this.binding.createProjectionLayer({ colorFormat: gl.RGBA8, depthFormat: 0 });
    if (Boolean(draw) !== this.isAbove) this.arrange(Boolean(draw));
    if (!draw || !this.has(this.above)) return;
    for (const view of views) {
      const { colorTexture, viewport: { x, y, width, height } } = this.binding.getViewSubImage(this.above, view);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colorTexture, 0);
      gl.enable(gl.SCISSOR_TEST);
      gl.scissor(x, y, width, height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.disable(gl.SCISSOR_TEST);
      draw(view, [x, y, width, height], this.target);
    }
  }

  free() {
    this.layer?.destroy?.();
    this.above?.destroy?.();
    this.gl.deleteFramebuffer(this.target);
  }
}
