// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// An eye's picture that is too large for the GPU: a coarse picture of everything, and as many of the tiles needed by
// the view as fit. Loaded with the first such picture.
import { compile } from './panorama.js';
import { BORDER, EyeTexture, paintTile } from './tiles.js';

const TILE = 1024; // texels, without the border
const COARSE = 2048; // maximum texels of the coarse picture around the horizon
export const BUDGET = 120e6; // bytes of an eye's tiles
const ASKED = [96, 54]; // pixels of a reduced view for finding the needed tiles
const PAUSE = 100; // milliseconds between searches

// Means of step x step texels, in linear light: rendering into an sRGB texture encodes.
const SHRINK = `#version 300 es
precision highp float;
precision highp int;
uniform sampler2D tile;
uniform ivec2 origin;  // origin of the tile, in pixels of the target
uniform int step;
uniform ivec4 inside;  // texels of the tile that are used: its edges are repeated outwards
in vec2 screen;
out vec4 color;
void main() {
  ivec2 from = (ivec2(gl_FragCoord.xy) - origin) * step;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < step; y++) {
    for (int x = 0; x < step; x++) sum += texelFetch(tile, clamp(from + ivec2(x, y), inside.xy, inside.zw - 1), 0).rgb;
  }
  color = vec4(sum / float(step * step), 1.0);
}`;

export class PagedEye {
  // source: an ImageBitmap, in which the eye's picture begins at x, y.
  constructor(gl, source, [x, y, width, height], wraps, { tile = TILE, coarse = COARSE, budget = BUDGET } = {}) {
    Object.assign(this, { gl, source, corner: [x, y], size: [width, height], wraps, time: 0, done: new Set(), slots: [] });
    this.tile = [tile, tile];
    const side = tile + 2 * BORDER;
    this.layer = [side, side];
    this.columns = Math.ceil(width / tile);
    this.rows = Math.ceil(height / tile);
    this.down = Math.max(1, Math.ceil(Math.log2(width / coarse)));
    this.coarse = new EyeTexture(gl, Math.ceil(width / 2 ** this.down), Math.ceil(height / 2 ** this.down), wraps);
    this.uniforms = { size: this.size, tile: this.tile, columns: this.columns, down: this.down };
    const room = Math.floor(budget / (side * side * 4 * 1.34));
    this.slots = Array.from({ length: Math.max(1, Math.min(room, this.columns * this.rows)) }, () => ({ cell: -1, time: 0 }));
    this.texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.texture);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, this.down + 1, gl.SRGB8_ALPHA8, side, side, this.slots.length);
    for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D_ARRAY, axis, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    this.scratch = this.nearest();
    this.table = this.nearest();
    this.cells = new Int16Array(this.columns * this.rows).fill(-1);
    this.tell();
    this.program = compile(gl, SHRINK);
    this.target = gl.createFramebuffer();
    this.canvas = new OffscreenCanvas(side, side).getContext('2d', { alpha: false, willReadFrequently: true });
    this.canvas.imageSmoothingEnabled = false;
  }

  nearest() {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    return texture;
  }

  // Updates the shader's table of tiles.
  tell() {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.table);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 2);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R16I, this.columns, this.rows, 0, gl.RED_INTEGER, gl.SHORT, this.cells);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
  }

  // Shows a preview until the tiles have been loaded.
  async begin(preview, [x, y, width, height]) {
    const small = await createImageBitmap(preview, x, y, width, height, {
      resizeWidth: this.coarse.size[0], resizeHeight: this.coarse.size[1], resizeQuality: 'medium',
    });
    await this.coarse.fill(small, 0, 0);
    small.close();
  }

  // Renders the tile in `scratch` into a layer: `at` is the position of the tile's first texel, in target pixels.
  shrink(texture, layer, level, [x, y, width, height], at, step, inside) {
    const { gl } = this;
    const uniform = (name) => gl.getUniformLocation(this.program, name);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, texture, level, layer);
    gl.viewport(x, y, width, height);
    gl.useProgram(this.program);
    gl.uniform1i(uniform('tile'), 0);
    gl.uniform1i(uniform('step'), step);
    gl.uniform2iv(uniform('origin'), at);
    gl.uniform4iv(uniform('inside'), inside);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // Loads a cell's tile into the slot, and, the first time, into the coarse picture.
  load(cell, slot) {
    const { gl, canvas, layer: [side], tile: [tile], down } = this;
    const [column, row] = [cell % this.columns, Math.floor(cell / this.columns)];
    paintTile(this, canvas, this.source, ...this.corner, column * tile - BORDER, row * tile - BORDER);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.scratch);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, canvas.canvas);
    if (slot !== null) {
      for (let level = 0; level <= down; level++) {
        const size = side >> level;
        this.shrink(this.texture, slot, level, [0, 0, size, size], [0, 0], 2 ** level, [0, 0, side, side]);
      }
    }
    if (!this.done.has(cell)) this.intoCoarse(column, row);
    this.done.add(cell);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  // The tile's own texels; at the edges of the picture also beyond, and if it wraps around, at its other end.
  intoCoarse(column, row) {
    const { size, tile: [tile], down, coarse, columns, rows, wraps } = this;
    const part = 2 ** down;
    const [wide, high] = [Math.min(tile, size[0] - column * tile), Math.min(tile, size[1] - row * tile)];
    const top = row === 0 ? 0 : BORDER + (row * tile) / part;
    const bottom = row === rows - 1 ? coarse.layer[1] : BORDER + ((row + 1) * tile) / part;
    for (const turn of wraps ? [-1, 0, 1] : [0]) {
      const x = BORDER + (column * tile) / part + turn * coarse.size[0];
      const left = !wraps && column === 0 ? 0 : Math.max(0, x);
      const right = !wraps && column === columns - 1 ? coarse.layer[0] : Math.min(coarse.layer[0], x + Math.ceil(wide / part));
      if (right <= left) continue;
      this.shrink(coarse.texture, 0, 0, [left, top, right - left, bottom - top],
        [x - BORDER / part, BORDER + (row * tile - BORDER) / part], part, [BORDER, BORDER, BORDER + wide, BORDER + high]);
    }
  }

  // cells: needed by a view, the most important first. Loads up to `count` missing ones; returns whether there were
  // any.
  bring(cells, count = 1) {
    const now = ++this.time;
    const there = cells.slice(0, this.slots.length);
    for (const cell of there) if (this.cells[cell] >= 0) this.slots[this.cells[cell]].time = now;
    const missing = there.filter((cell) => this.cells[cell] < 0).slice(0, count);
    for (const cell of missing) {
      const oldest = this.slots.reduce((best, each) => (each.time < best.time ? each : best));
      const slot = this.slots.indexOf(oldest);
      if (oldest.cell >= 0) this.cells[oldest.cell] = -1;
      this.load(cell, slot);
      Object.assign(oldest, { cell, time: now });
      this.cells[cell] = slot;
    }
    if (missing.length) this.tell();
    return missing.length > 0;
  }

  // Adds another tile to the coarse picture. Returns false if it is complete.
  refine() {
    const cell = Array.from(this.cells.keys()).find((each) => !this.done.has(each));
    if (cell === undefined) return false;
    this.load(cell, null);
    if (this.done.size === this.cells.length) this.mips();
    return true;
  }

  mips() {
    this.coarse.bind();
    this.gl.generateMipmap(this.gl.TEXTURE_2D_ARRAY);
  }

  free() {
    const { gl } = this;
    this.coarse.free();
    for (const texture of [this.texture, this.scratch, this.table]) gl.deleteTexture(texture);
    gl.deleteFramebuffer(this.target);
    gl.deleteProgram(this.program);
  }
}

// Loads the tiles that views need, while they are visible.
export class Pager {
  constructor(panorama, picture) {
    const { gl } = panorama;
    Object.assign(this, { panorama, picture, last: 0 });
    this.target = gl.createFramebuffer();
    this.pixels = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.pixels);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, ...ASKED);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.pixels, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  // The cells of an eye that a part of the view needs, starting in its middle.
  ask(options, side) {
    const { panorama, picture } = this;
    const { gl } = panorama;
    panorama.drawOne(picture, {
      ...options, ask: true, moves: true, show: 'eye', eye: side, clip: undefined, target: this.target, grid: false,
      box: [0, 0, ...ASKED], askScale: ASKED[0] / options.box[2],
    });
    const bytes = new Uint8Array(4 * ASKED[0] * ASKED[1]);
    gl.readPixels(0, 0, ...ASKED, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const nearest = new Map();
    const { columns } = picture.eyes[side];
    for (let i = 0; i < bytes.length; i += 4) {
      if (!bytes[i + 2]) continue;
      const cell = bytes[i] + bytes[i + 1] * columns;
      const off = Math.hypot((i / 4) % ASKED[0] - ASKED[0] / 2, Math.floor(i / 4 / ASKED[0]) - ASKED[1] / 2);
      nearest.set(cell, Math.min(nearest.get(cell) ?? off, off));
    }
    return [...nearest].sort((a, b) => a[1] - b[1]).map(([cell]) => cell);
  }

  // parts: options of panorama.draw(). Loads at most `count` tiles of each eye; returns whether it did.
  look(parts, count = 1) {
    const { picture } = this;
    const eyes = [...new Set(picture.eyes)];
    const wanted = eyes.map(() => []);
    for (const options of parts) {
      for (const shown of options.show && options.show !== 'eye' ? [0, 1] : [options.eye ?? 0]) {
        const side = options.swap ? 1 - shown : shown;
        wanted[eyes.indexOf(picture.eyes[side])].push(...this.ask({ ...options, swap: false }, side));
      }
    }
    return eyes.map((eye, i) => eye.bring(wanted[i], count)).some(Boolean);
  }

  // Extends the coarse picture; returns whether it was incomplete.
  refine() {
    return [...new Set(this.picture.eyes)].map((eye) => eye.refine()).some(Boolean);
  }

  // Called while the view moves; acts at intervals.
  follow(parts, now) {
    if (now - this.last < PAUSE) return;
    this.last = now;
    if (this.look(parts) || this.refine()) this.picture.changed?.();
  }

  free() {
    this.panorama.gl.deleteTexture(this.pixels);
    this.panorama.gl.deleteFramebuffer(this.target);
  }
}
