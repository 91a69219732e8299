// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws stereo panoramas with WebGL 2. panorama.glsl finds the texels with the formulas of the renderer itself; this
// file makes a program of it for each projection, sets its uniforms and contains no formulas.
import { texelAngle } from './form.js';
import { radians } from './geometry.js';
import { SHADER } from './shader.js';

const TOE_IN = 1; // number of the kernel's convergence whose lines of sight are not linear across the view
const REDUCED = 1.2; // texels of a pixel, in the middle, from which mip levels matter
const CELLS = 16; // cells of the mesh for it, each way; half as many for a slow GPU
const VERTICES = `#version 300 es
out vec2 screen;
void main() {
  screen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(screen, 0.0, 1.0);
}`;

// Starts compiling; some browsers do so in the background until finish() is called.
function begin(gl, fragment, vertices) {
  const program = gl.createProgram();
  const shaders = [[gl.VERTEX_SHADER, vertices], [gl.FRAGMENT_SHADER, fragment]].map(([kind, text]) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  return { program, shaders };
}

function finish(gl, { program, shaders }) {
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const why = shaders.map((shader) => gl.getShaderInfoLog(shader)).join(' ') + gl.getProgramInfoLog(program);
    throw new Error(`This GPU's driver rejects the viewer's shader: ${why.split('\n')[0]}. Update the browser.`);
  }
  shaders.forEach((shader) => gl.deleteShader(shader));
  return program;
}

// Half of a view's longer side, in units of the scale straight ahead, and the angle of view for such a half side.
export const halfSide = ({ fov, planet }) => (planet ? 2 * Math.tan((fov * Math.PI) / 720) : Math.tan((fov * Math.PI) / 360));
export const fovOf = (half, planet) => (planet ? 4 * Math.atan(half / 2) : 2 * Math.atan(half)) * (180 / Math.PI);
// Half of a view's width. The angle of an upright view is that of its height; of a little planet, always of its width.
export const halfWidth = (state, aspect) => halfSide(state) * (state.planet ? 1 : Math.min(aspect, 1));
// The horizontal angle of a view, degrees.
export const angleAcross = (state, aspect) => fovOf(halfWidth(state, aspect), state.planet);
// The bend of the stereographic view (panorama.glsl); 0 for other views.
export const bendOf = ({ planet }) => (planet ? 0.25 : 0);

export const compile = (gl, fragment, vertices = VERTICES) => finish(gl, begin(gl, fragment, vertices));

// The columns of a matrix that converts a position on the screen (-1..1) to a direction. yaw to the right, pitch up,
// roll clockwise, in degrees; fov: the angle of the view's longer side, so that a phone may be turned; aspect: width over
// height. planet: the view is stereographic.
export function raysOf({ yaw = 0, pitch = 0, roll = 0, fov = 90, planet = false }, aspect) {
  const [y, p, r] = [yaw, pitch, roll].map(radians);
  const [sy, cy, sp, cp, sr, cr] = [Math.sin(y), Math.cos(y), Math.sin(p), Math.cos(p), Math.sin(r), Math.cos(r)];
  const right = [cy, 0, sy];
  const up = [-sy * sp, cp, cy * sp];
  const ahead = [sy * cp, sp, -cy * cp];
  const wide = halfWidth({ fov, planet }, aspect);
  const mix = (a, b, size) => right.map((x, i) => (x * a + up[i] * b) * size);
  return [...mix(cr, -sr, wide), ...mix(sr, cr, wide / aspect), ...ahead];
}

export class Panorama {
  // canvas: where to draw. lost() and restored() are called if the GPU is reset. Throws an Error with advice if there is
  // no WebGL 2.
  constructor(canvas = document.createElement('canvas')) {
    const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error('This browser has no WebGL 2. Switch on hardware acceleration, or use a newer browser.');
    this.gl = gl;
    this.canvas = canvas;
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.lost?.();
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.start();
      this.restored?.();
    });
    this.start();
  }

  // Frees what belongs to the pictures that were drawn.
  forget() {
    this.kept?.source.close(); // picture.js
    this.maps.forEach((texture) => this.gl.deleteTexture(texture));
    this.maps.clear();
    Object.assign(this, { kept: null, lost: null, restored: null });
  }

  // Also called after the context was lost with all its objects.
  start() {
    const { gl } = this;
    this.background = gl.getExtension('KHR_parallel_shader_compile');
    this.hasLight = Boolean(gl.getExtension('EXT_color_buffer_float')); // textures of halves can be drawn into
    this.cheap = null;
    this.programs = new Map();
    this.maps = new Map();
    gl.bindVertexArray(gl.createVertexArray());
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    const mesh = (cells) => Array.from({ length: cells * cells }, (_, i) => i + Math.floor(i / cells)).flatMap((i) => [i, i + 1, i + cells + 1, i + cells + 1, i + 1, i + cells + 2]);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array([...mesh(CELLS), ...mesh(CELLS / 2)]), gl.STATIC_DRAW);
  }

  // A slow GPU need not mix two mip levels.
  bindSamplers(cheap) {
    const { gl } = this;
    if (cheap && !this.cheap) {
      this.cheap = gl.createSampler();
      gl.samplerParameteri(this.cheap, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
      for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.samplerParameteri(this.cheap, axis, gl.CLAMP_TO_EDGE);
    }
    for (const unit of [0, 1]) gl.bindSampler(unit, cheap ? this.cheap : null);
  }

  // The program for a picture and options of drawOne(), compiled on first use.
  programFor({ camera, below, light = false, pager }, { show = 'eye', moves = false, all = false, planet = false, grid = false, cheap = false, ask = false }) {
    const { gl } = this;
    const about = {
      KIND: camera.projection.kind, CONVERGENCE: camera.convergence, BOTH: show !== 'eye', MOVES: moves, OVER: Boolean(below),
      AROUND: all, PLANET: planet, GRID: grid, CHEAP: cheap, LIGHT: light, PAGED: Boolean(pager), ASK: ask,
    };
    const key = Object.values(about).join();
    if (!this.programs.has(key)) {
      const defined = Object.entries(about).map(([name, value]) => `#define ODS_${name} ${value}\n`).join('');
      const text = (more) => SHADER.replace('\n', `\n${defined}${more}`);
      this.programs.set(key, begin(gl, text(''), text('#define ODS_VERTEX\n')));
    }
    return this.programs.get(key);
  }

  // Returns whether drawing would not wait for a compiler.
  isReady(picture, options) {
    if (picture.draw) return true;
    const each = this.programFor(picture, options);
    return Boolean(each.uniforms) || !this.background ||
      this.gl.getProgramParameter(each.program, this.background.COMPLETION_STATUS_KHR);
  }

  use(each) {
    const { gl } = this;
    if (!each.uniforms) {
      finish(gl, each);
      each.uniforms = Array.from({ length: gl.getProgramParameter(each.program, gl.ACTIVE_UNIFORMS) }, (_, i) => {
        const { name, type } = gl.getActiveUniform(each.program, i);
        return { path: name.split(/[.[\]]+/), type, at: gl.getUniformLocation(each.program, name) };
      });
    }
    gl.useProgram(each.program);
    return each.uniforms;
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

  // Sets every uniform to the value of its name in nested objects and arrays. Values missing in view.json stay 0:
  // drivers may keep uniforms that no pixel needs.
  set(uniforms, values) {
    const { gl } = this;
    const setters = {
      [gl.FLOAT]: gl.uniform1f, [gl.FLOAT_VEC2]: gl.uniform2fv, [gl.FLOAT_VEC3]: gl.uniform3fv,
      [gl.INT]: gl.uniform1i, [gl.INT_VEC2]: gl.uniform2iv, [gl.BOOL]: gl.uniform1i, [gl.SAMPLER_2D_ARRAY]: gl.uniform1i,
      [gl.SAMPLER_2D]: gl.uniform1i, [gl.INT_SAMPLER_2D]: gl.uniform1i,
    };
    for (const { path, type, at } of uniforms) {
      const value = path.reduce((from, key) => from?.[key], values);
      if (value === undefined) continue;
      if (type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(at, false, value);
      else setters[type].call(gl, at, value);
    }
  }

  // Draws a view of a picture (picture.js) like drawOne(), and the pictures that belong to it: `over`, a finer window,
  // and `beside`, another picture to the right of the fraction `split` of the box. A layered scene draws itself.
  draw(picture, options) {
    if (picture.draw) picture.draw(this, options);
    else this.drawOne(picture, options);
    if (picture.over) this.drawOne(picture.over, options);
    if (!picture.beside || options.target) return;
    const [x, , width] = options.box;
    const [, y, , height] = options.clip ?? options.box;
    const left = Math.round(picture.split * width);
    this.draw(picture.beside, { ...options, clip: [x + left, y, width - left, height] });
  }

  // Draws a view of a picture: `show` is eye, anaglyph or difference; `eye` is 0 for left, 1 for right.
  // rays: from raysOf(). box: x, y, width, height in pixels of the target, from its lower left corner. swap: exchanges
  // the eyes. moves: quickly, with the GPU's filter; cheap: with less of it. target: a framebuffer, or null for the
  // canvas. clip: the part of the box to draw. all: the whole sphere as a lat-long picture instead; planet: a
  // stereographic view. shift: radians by which the left eye's picture turns to the left, and the right eye's to the
  // right. ask: draws the needed tiles instead, for a view that is askScale times as wide.
  drawOne(picture, options) {
    const { rays, box, clip = box, show = 'eye', eye = 0, swap = false, moves = false, cheap = false, target = null, all = false, planet = false, shift = 0, askScale = 1 } = options;
    const { gl } = this;
    const shown = show === 'eye' ? [eye, eye] : [0, 1];
    const eyes = shown.map((side) => picture.eyes[swap ? 1 - side : side]);
    if (picture.prepare) {
      const pixel = all ? (2 * Math.PI) / box[2] : (2 * Math.hypot(...rays.slice(0, 3))) / box[2]; // radians, in the middle
      for (const each of eyes) picture.prepare(each, !moves || planet || pixel > REDUCED * texelAngle(picture.camera, each.size[0]));
    }
    const cells = moves && !all && !planet && picture.camera.convergence === TOE_IN ? CELLS / (cheap ? 2 : 1) : 0;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(...box);
    gl.scissor(...clip);
    gl.enable(gl.SCISSOR_TEST);
    if (picture.below) gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    const uniforms = this.use(this.programFor(picture, options));
    eyes.forEach((each, i) => {
      gl.activeTexture(gl.TEXTURE0 + i);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, each.texture);
    });
    this.bindSamplers(cheap);
    if (picture.pager) this.bindPages(eyes);
    this.bindMap(2, picture.camera.merge_map);
    this.bindMap(3, picture.camera.head_tilt_map);
    const turn = picture.mono ? 0 : shift;
    this.set(uniforms, {
      camera: picture.camera, merge_texels: 2, head_tilt_texels: 3, eyes: eyes.map((each) => each.uniforms), tiles_0: 0, tiles_1: 1,
      sides: picture.mono ? [2, 2] : shown, rays, viewport: box.slice(2), difference: show === 'difference', below: picture.below, cells,
      shift: [Math.cos(turn), Math.sin(turn)], coarse_0: 4, coarse_1: 5, slots_0: 6, slots_1: 7, ask_scale: askScale,
      exposure: 2 ** (picture.stops ?? 0), neutral: picture.tone !== 'linear',
    });
    if (cells) gl.drawElements(gl.TRIANGLES, 6 * cells * cells, gl.UNSIGNED_SHORT, cells < CELLS ? 12 * CELLS * CELLS : 0);
    else gl.drawArrays(gl.TRIANGLES, 0, 3);
    this.bindSamplers(false);
    gl.disable(gl.SCISSOR_TEST);
    gl.disable(gl.BLEND);
  }

  // Binds the textures of pages.js to their own units.
  bindPages(eyes) {
    const { gl } = this;
    eyes.forEach((each, i) => {
      gl.activeTexture(gl.TEXTURE4 + i);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, each.coarse.texture);
      gl.activeTexture(gl.TEXTURE6 + i);
      gl.bindTexture(gl.TEXTURE_2D, each.table);
    });
  }

  // Waits until the GPU has finished drawing; returns the milliseconds.
  async finished(nextFrame) {
    const { gl } = this;
    const since = performance.now();
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    do await nextFrame(); while (fence && gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED);
    gl.deleteSync(fence);
    return performance.now() - since;
  }

  clear(target = null) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.clearColor(0.1, 0.1, 0.1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }
}
