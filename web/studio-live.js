// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of the studio as pictures on the GPU: for each side the whole picture (base) and the finer window in view
// (patch), which is drawn over it.
import { isRound } from './form.js';
import { EyeTexture } from './tiles.js';

// pixels: R, G, B in rows from the top, eye by eye. Returns a picture for panorama.js.
async function pictureOf(gl, { width, height, eyes: count, camera }, pixels) {
  const size = width * height;
  const eyes = [];
  for (let eye = 0; eye < count; eye++) {
    const image = new ImageData(width, height);
    const texels = new Uint32Array(image.data.buffer);
    for (let i = 0, from = 3 * eye * size; i < size; i++, from += 3) {
      texels[i] = 0xff000000 | (pixels[from + 2] << 16) | (pixels[from + 1] << 8) | pixels[from];
    }
    const source = await createImageBitmap(image, { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
    const texture = new EyeTexture(gl, width, height, isRound(camera));
    await texture.fill(source, 0, 0);
    source.close();
    eyes.push(texture);
  }
  const free = () => eyes.forEach((texture) => texture.free());
  return { eyes: count === 1 ? [eyes[0], eyes[0]] : eyes, camera, mono: count === 1, free };
}

// Returns whether a frame is worse than another one of the same settings.
function isWorse(meta, than) {
  if (meta.part === 'patch' && JSON.stringify(meta.camera) !== JSON.stringify(than.camera)) return false;
  return meta.width < than.width || (meta.width === than.width && meta.samples < than.samples);
}

export class Live {
  constructor(gl) {
    this.gl = gl;
    this.sides = new Map();
  }

  // Takes a frame for a side. A new revision's first frame replaces everything.
  async take(meta, pixels, side) {
    const shown = this.sides.get(side) ?? {};
    const before = shown[meta.part];
    if (before && before.meta.revision === meta.revision && isWorse(meta, before.meta)) return;
    if (meta.part === 'patch' && shown.base?.meta.revision !== meta.revision) return;
    const picture = await pictureOf(this.gl, meta, pixels);
    before?.picture.free();
    const next = { ...shown, [meta.part]: { meta, picture, settings: side.sent } };
    if (meta.part === 'base' && before?.meta.revision !== meta.revision) {
      shown.patch?.picture.free();
      delete next.patch;
    }
    this.sides.set(side, next);
  }

  // If the same settings have a new number, the existing pictures are kept until a better one arrives.
  renumber(side) {
    const { base, patch } = this.sides.get(side) ?? {};
    for (const part of [base, patch]) if (part?.settings === side.sent) part.meta.revision = side.revision;
  }

  // Known numbers will not be used again.
  expire() {
    for (const { base, patch } of this.sides.values()) for (const part of [base, patch]) if (part) part.meta.revision = -1;
  }

  // A picture of a side for the viewer, which does not own it; null if there is none yet. beside: another side, whose
  // picture is drawn to the right of the fraction `split` of the view.
  picture(side, beside = null, split = 1) {
    const { base, patch } = this.sides.get(side) ?? {};
    if (!base) return null;
    const over = patch && { ...patch.picture, below: base.picture.camera.projection };
    return { ...base.picture, over, beside: beside && this.picture(beside), split, free() {}, changed() {} };
  }

  free(side) {
    const { base, patch } = this.sides.get(side) ?? {};
    for (const part of [base, patch]) part?.picture.free();
    this.sides.delete(side);
  }

  // Called when the GPU has lost all textures.
  forget() {
    this.sides.clear();
  }
}
