// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// An eye's picture as a texture: the layers of an array, each a tile with a border of the adjacent parts of the world.
// So pictures may be larger than the GPU's largest texture, and filters do not meet a seam.
export const BORDER = 16; // texels, as in panorama.glsl: two filter widths at the smallest mip level used close by
export const LEVELS = 6; // number of mip map levels
const STEP = 1 << (LEVELS - 1); // layers are a multiple of this, so that every level has whole texels
const PIECE = 1 << 19; // texels that are sent at once between frames
const LARGEST = 4096 + 2 * STEP; // side of a layer: larger ones have no benefit, and some browsers fail to fill them

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
  // responsive; with calm(), waits for it between pieces.
  async fill(source, x, y, calm) {
    const { gl } = this;
    const [width, height] = this.layer;
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext('2d', { alpha: false, willReadFrequently: true });
    context.imageSmoothingEnabled = false;
    for (const [layer, origin] of this.tiles.entries()) {
      paintTile(this, context, source, x, y, ...origin);
      const rows = calm ? Math.ceil(PIECE / width) : height;
      for (let top = 0; top < height; top += rows) {
        const high = Math.min(rows, height - top);
        const texels = calm ? context.getImageData(0, top, width, high).data : canvas;
        this.bind();
        gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, top, layer, width, high, 1, gl.RGBA, gl.UNSIGNED_BYTE, texels);
        await (calm ? calm() : new Promise((go) => setTimeout(go)));
      }
    }
    this.bind();
    gl.generateMipmap(gl.TEXTURE_2D_ARRAY);
  }

  free() {
    this.gl.deleteTexture(this.texture);
  }
}
