// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws stereo panoramas with WebGL 2. panorama.frag finds the texels with the formulas of the renderer itself; this
// file sets its uniforms and knows no projection.

const MODES = { eye: 0, anaglyph: 1, difference: 2 };
const VERTICES = `#version 300 es
out vec2 screen;
void main() {
  screen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(screen, 0.0, 1.0);
}`;

// The text of the fragment shader, which lies beside this module.
export async function loadShader(base = import.meta.url) {
  const answer = await fetch(new URL('panorama.frag', base));
  if (!answer.ok) throw new Error(`panorama.frag did not load (${answer.status}). Reload the page.`);
  return answer.text();
}

export function compile(gl, fragment) {
  const program = gl.createProgram();
  const shaders = [[gl.VERTEX_SHADER, VERTICES], [gl.FRAGMENT_SHADER, fragment]].map(([kind, text]) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const why = shaders.map((shader) => gl.getShaderInfoLog(shader)).join(' ') + gl.getProgramInfoLog(program);
    throw new Error(`This GPU's driver rejects the viewer's shader: ${why.split('\n')[0]}. Update the browser.`);
  }
  shaders.forEach((shader) => gl.deleteShader(shader));
  return program;
}

// Half of a view's width where what is straight ahead has the scale 1, and the angle of view of one.
export const halfWidth = (fov, planet) => (planet ? 2 * Math.tan((fov * Math.PI) / 720) : Math.tan((fov * Math.PI) / 360));
export const fovOf = (wide, planet) => (planet ? 4 * Math.atan(wide / 2) : 2 * Math.atan(wide)) * (180 / Math.PI);
// Of the stereographic view (panorama.frag); 0: none.
export const bendOf = ({ planet }) => (planet ? 0.25 : 0);

// The columns of a matrix that turns a place on the screen (-1..1) into a direction. yaw to the right, pitch up, roll
// clockwise, in degrees; fov: the horizontal angle of view; aspect: width over height. planet: the view is stereographic.
export function raysOf({ yaw = 0, pitch = 0, roll = 0, fov = 90, planet = false }, aspect) {
  const [y, p, r] = [yaw, pitch, roll].map((angle) => (angle * Math.PI) / 180);
  const [sy, cy, sp, cp, sr, cr] = [Math.sin(y), Math.cos(y), Math.sin(p), Math.cos(p), Math.sin(r), Math.cos(r)];
  const right = [cy, 0, sy];
  const up = [-sy * sp, cp, cy * sp];
  const ahead = [sy * cp, sp, -cy * cp];
  const wide = halfWidth(fov, planet);
  const mix = (a, b, size) => right.map((x, i) => (x * a + up[i] * b) * size);
  return [...mix(cr, -sr, wide), ...mix(sr, cr, wide / aspect), ...ahead];
}

export class Panorama {
  // canvas: where to draw. Throws an Error that says what to try where WebGL 2 is missing.
  constructor(canvas, shader) {
    const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error('This browser has no WebGL 2. Switch on hardware acceleration, or use a newer browser.');
    this.gl = gl;
    this.canvas = canvas;
    this.shader = shader;
    this.start();
  }

  // Also after a lost context, which takes everything with it.
  start() {
    const { gl } = this;
    this.program = compile(gl, this.shader);
    this.uniforms = [];
    const count = gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS);
    for (let i = 0; i < count; i++) {
      const { name, type } = gl.getActiveUniform(this.program, i);
      this.uniforms.push({ path: name.split(/[.[\]]+/), type, at: gl.getUniformLocation(this.program, name) });
    }
    gl.bindVertexArray(gl.createVertexArray());
    this.maps = new Map();
  }

  // Binds a map of the camera (camera.merge_map, camera.head_tilt_map) to a texture unit.
  bindMap(unit, { width, height, texels }) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, this.maps.get(texels) ?? null);
    if (!texels || this.maps.has(texels)) return;
    this.maps.set(texels, gl.createTexture());
    gl.bindTexture(gl.TEXTURE_2D, this.maps.get(texels));
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, width, height, 0, gl.RED, gl.FLOAT, new Float32Array(texels));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  }

  // Sets every uniform to the value of its name in nested objects and arrays. What view.json leaves out stays 0: drivers
  // may keep uniforms that no pixel needs.
  set(values) {
    const { gl } = this;
    const setters = {
      [gl.FLOAT]: gl.uniform1f, [gl.FLOAT_VEC2]: gl.uniform2fv, [gl.FLOAT_VEC3]: gl.uniform3fv,
      [gl.INT]: gl.uniform1i, [gl.BOOL]: gl.uniform1i, [gl.SAMPLER_2D_ARRAY]: gl.uniform1i,
      [gl.SAMPLER_2D]: gl.uniform1i,
    };
    for (const { path, type, at } of this.uniforms) {
      const value = path.reduce((from, key) => from?.[key], values);
      if (value === undefined) continue;
      if (type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(at, false, value);
      else setters[type].call(gl, at, value);
    }
  }

  // Draws a view of a picture (picture.js) as drawOne() does, and what belongs to it: `over`, a finer window, and
  // `beside`, another picture to the right of the fraction `split` of the box.
  draw(picture, options) {
    this.drawOne(picture, options);
    if (picture.over) this.drawOne(picture.over, options);
    if (!picture.beside || options.target) return;
    const [x, y, width, height] = options.box;
    const left = Math.round(picture.split * width);
    this.draw(picture.beside, { ...options, clip: [x + left, y, width - left, height] });
  }

  // Draws a view of a picture: `show` is eye, anaglyph or difference; `eye` is 0 for left, 1 for right.
  // rays: as raysOf(). box: x, y, width, height in pixels of the target, from its lower left corner. swap: exchanges
  // the eyes. target: a framebuffer, or null for the canvas. clip: a part of the box, for all that is drawn. bend: bendOf().
  // shift: radians by which the left eye's picture turns to the left, and the right eye's to the right.
  drawOne(picture, { rays, box, clip = box, show = 'eye', eye = 0, swap = false, grid = false, fast = false, target = null, all = false, bend = 0, shift = 0 }) {
    const { gl } = this;
    const eyes = swap ? [picture.eyes[1], picture.eyes[0]] : picture.eyes;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(...box);
    gl.scissor(...clip);
    gl.enable(gl.SCISSOR_TEST);
    if (picture.below) gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(this.program);
    eyes.forEach((each, i) => {
      gl.activeTexture(gl.TEXTURE0 + i);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, each.texture);
    });
    this.bindMap(2, picture.camera.merge_map);
    this.bindMap(3, picture.camera.head_tilt_map);
    this.set({
      camera: picture.camera, merge_texels: 2, head_tilt_texels: 3, eyes: eyes.map((each) => each.uniforms), left_tiles: 0, right_tiles: 1, rays,
      all_around: all, viewport: box.slice(2), mode: MODES[show], eye, mono: picture.mono, fast, grid, bend, shift: picture.mono ? 0 : shift,
      over: Boolean(picture.below), below: picture.below ?? picture.camera.projection,
    });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.SCISSOR_TEST);
    gl.disable(gl.BLEND);
  }

  clear() {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.clearColor(0.1, 0.1, 0.1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }
}
