// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// An eye's picture as a texture: the layers of an array, each a tile with a border of the adjacent parts of the world.
// So pictures may be larger than the GPU's largest texture, and filters do not meet a seam.
import { compile } from './panorama.js';

export const BORDER = 16; // texels, as in panorama.glsl: two filter widths at the smallest mip level used close by
const LEVELS = 6; // number of mip map levels
const STEP = 1 << (LEVELS - 1); // layers are a multiple of this, so that every level has whole texels
const LARGEST = 4096 + 2 * STEP; // side of a layer: larger ones have no benefit, and some browsers fail to fill them

// Copies an eye of a video's frame into a layer. Rendering into an sRGB texture encodes, so it decodes first. A frame of
// light has the high bytes of its halves in its left half, and the low ones in its right half.
const CUT = `#version 300 es
precision highp float;
precision highp int;
uniform sampler2D frame;
uniform ivec4 crop;    // the eye's part of the frame: x, y, width, height
uniform ivec2 origin;  // position of the layer in the eye's picture
uniform bool wraps;
uniform bool light;
in vec2 screen;
out vec4 color;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) + origin;
  at = ivec2(wraps ? (at.x % crop.z + crop.z) % crop.z : clamp(at.x, 0, crop.z - 1), clamp(at.y, 0, crop.w - 1));
  vec3 s = texelFetch(frame, crop.xy + at, 0).rgb;
  if (light) {
    uvec3 high = uvec3(s * 255.0 + 0.5);
    uvec3 low = uvec3(texelFetch(frame, crop.xy + at + ivec2(textureSize(frame, 0).x / 2, 0), 0).rgb * 255.0 + 0.5);
    uvec3 bits = high * 256u + low;
    color = vec4(unpackHalf2x16(bits.r).x, unpackHalf2x16(bits.g).x, unpackHalf2x16(bits.b).x, 1.0);
    return;
  }
  color = vec4(mix(pow((s + 0.055) / 1.055, vec3(2.4)), s / 12.92, vec3(lessThanEqual(s, vec3(0.04045)))), 1.0);
}`;

const upTo = (size, step) => Math.ceil(size / step) * step;

// Draws a tile of an eye, then repeats the edges outwards where the picture ends. The eye begins in the source at x, y,
// the tile in the eye at left, top.
export function paintTile({ layer, size: [whole, high], wraps }, context, source, x, y, left, top) {
  const [width, height] = layer;
  const first = wraps ? Math.floor(left / whole) : 0;
  const last = wraps ? Math.floor((left + width - 1) / whole) : 0;
  const [y0, y1] = [Math.max(top, 0), Math.min(top + height, high)];
  for (let turn = first; turn <= last; turn++) {
    const x0 = Math.max(left, turn * whole);
    const x1 = Math.min(left + width, (turn + 1) * whole);
    const size = [x1 - x0, y1 - y0];
    context.drawImage(source, x + x0 - turn * whole, y + y0, ...size, x0 - left, y0 - top, ...size);
  }
  const { canvas } = context;
  const repeat = (x0, x1, edge) => {
    if (x1 > x0) context.drawImage(canvas, edge, 0, 1, height, x0, 0, x1 - x0, height);
  };
  if (!wraps) {
    repeat(0, -left, -left);
    repeat(whole - left, width, whole - left - 1);
  }
  if (top < 0) context.drawImage(canvas, 0, -top, width, 1, 0, 0, width, -top);
  const bottom = high - top;
  if (bottom < height) context.drawImage(canvas, 0, bottom - 1, width, 1, 0, bottom, width, height - bottom);
}

export class EyeTexture {
  // width, height: of the eye's picture. wraps: its right edge continues at its left edge. light: halves, scene-linear.
  constructor(gl, width, height, wraps, light = false) {
    const most = Math.min(LARGEST, gl.getParameter(gl.MAX_TEXTURE_SIZE)) - 2 * BORDER;
    this.gl = gl;
    this.size = [width, height];
    this.wraps = wraps;
    const columns = Math.ceil(width / most);
    const rows = Math.ceil(height / most);
    this.tile = [Math.ceil(width / columns), Math.ceil(height / rows)];
    this.layer = this.tile.map((side) => upTo(side + 2 * BORDER, STEP));
    this.tiles = [];
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        this.tiles.push([column * this.tile[0] - BORDER, row * this.tile[1] - BORDER]);
      }
    }
    this.uniforms = { size: this.size, tile: this.tile, columns };
    this.texture = gl.createTexture();
    this.bind();
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, LEVELS, light ? gl.RGBA16F : gl.SRGB8_ALPHA8, ...this.layer, this.tiles.length);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    const sharp = gl.getExtension('EXT_texture_filter_anisotropic');
    if (sharp) gl.texParameterf(gl.TEXTURE_2D_ARRAY, sharp.TEXTURE_MAX_ANISOTROPY_EXT, 4);
  }

  bind() {
    this.gl.activeTexture(this.gl.TEXTURE0);
    this.gl.bindTexture(this.gl.TEXTURE_2D_ARRAY, this.texture);
  }

  // source: an ImageBitmap; x, y: where the eye's picture begins in it. Yields between tiles, so that the page stays
  // responsive.
  async fill(source, x, y) {
    const { gl } = this;
    const [width, height] = this.layer;
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext('2d', { alpha: false, willReadFrequently: true });
    context.imageSmoothingEnabled = false;
    for (const [layer, origin] of this.tiles.entries()) {
      paintTile(this, context, source, x, y, ...origin);
      this.bind();
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, layer, width, height, 1, gl.RGBA, gl.UNSIGNED_BYTE, canvas);
      await new Promise((go) => setTimeout(go));
    }
    this.bind();
    gl.generateMipmap(gl.TEXTURE_2D_ARRAY);
  }

  free() {
    this.gl.deleteTexture(this.texture);
  }
}

// Moves a video's current frame, or a picture of light, into the textures of its eyes without leaving the GPU.
export class FrameCutter {
  constructor(gl, light = false) {
    this.gl = gl;
    this.light = light;
    this.program = compile(gl, CUT);
    this.at = (name) => gl.getUniformLocation(this.program, name);
    this.frame = gl.createTexture();
    this.target = gl.createFramebuffer();
  }

  // eyes: textures, each with its crop [x, y, width, height] of the frame, which is a video or an ImageBitmap.
  cut(frame, eyes, crops) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.frame);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, frame);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.useProgram(this.program);
    gl.uniform1i(this.at('light'), this.light);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    for (const eye of new Set(eyes)) {
      gl.viewport(0, 0, ...eye.layer);
      gl.uniform4iv(this.at('crop'), crops[eyes.indexOf(eye)]);
      gl.uniform1i(this.at('wraps'), eye.wraps);
      eye.tiles.forEach((origin, layer) => {
        gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, eye.texture, 0, layer);
        gl.uniform2iv(this.at('origin'), origin);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
      });
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    for (const eye of new Set(eyes)) {
      eye.bind();
      gl.generateMipmap(gl.TEXTURE_2D_ARRAY);
    }
  }

  free() {
    this.gl.deleteTexture(this.frame);
    this.gl.deleteFramebuffer(this.target);
    this.gl.deleteProgram(this.program);
  }
}
