// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the file of a real-time object, a .glb that ods view makes of a scene file: parts with one material each, which
// may move as wholes (a matrix per frame) and deform (vertices per frame).
import { Glb, packed } from './glb.js';
import { check } from './meshopt.js';

const MAX_FRAMES = 10000;
const INDICES = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array };

function indicesOf(glb, index, vertices) {
  const accessor = glb.accessor(index);
  check(INDICES[accessor.type] && accessor.components === 1 && accessor.count % 3 === 0, 'its triangles are damaged');
  const values = Uint32Array.from(new INDICES[accessor.type](packed(accessor)));
  check(values.every((value) => value < vertices), 'its triangles are damaged');
  return values;
}

function materialOf(glb, number) {
  const material = number === undefined ? {} : glb.of('materials', number);
  const { baseColorFactor: base = [1, 1, 1, 1], metallicFactor: metal = 1, roughnessFactor: rough = 1, baseColorTexture } = material.pbrMetallicRoughness ?? {};
  const { emissiveFactor: emitted = [0, 0, 0], alphaMode = 'OPAQUE', alphaCutoff = 0.5, doubleSided = false } = material;
  check([...base, ...emitted, metal, rough, alphaCutoff].every(Number.isFinite) && base.length === 4 && emitted.length === 3, 'it has a damaged material');
  return {
    base, emitted, metal, rough, isDouble: doubleSided === true, blends: alphaMode === 'BLEND',
    cutoff: alphaMode === 'MASK' ? alphaCutoff : 0, image: baseColorTexture && glb.imageOf(baseColorTexture.index),
  };
}

// A part: positions and normals of each frame, or of one; matrices, too.
function partOf(glb, { attributes, indices, material, mode = 4, extras }, matrices, frames) {
  check(mode === 4 && indices !== undefined, 'it has something else than triangles with indices');
  const moving = extras?.omnistereo?.frames;
  check(!moving || moving.length === frames, 'its animation is damaged');
  const each = moving ?? [attributes];
  const positions = each.map(({ POSITION }) => glb.floats(POSITION, 3));
  const normals = each.map(({ NORMAL }) => glb.floats(NORMAL, 3));
  const { length } = positions[0];
  check(length > 0 && [...positions, ...normals].every((list) => list.length === length), 'its vertices are damaged');
  const uvs = attributes.TEXCOORD_0 === undefined ? null : glb.floats(attributes.TEXCOORD_0, 2);
  check(!uvs || 3 * uvs.length === 2 * length, 'its vertices are damaged');
  const own = materialOf(glb, material);
  if (!uvs) own.image = undefined;
  return { positions, normals, uvs, matrices, indices: indicesOf(glb, indices, length / 3), material: own };
}

// A point by a matrix, both as glTF has them.
export const transformed = (m, [x, y, z]) => [0, 1, 2].map((i) => m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i]);

// The corners of a box around all frames.
function boundsOf(parts, frames) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { positions, matrices } of parts) {
    for (let frame = 0; frame < (positions.length > 1 || matrices.length > 1 ? frames : 1); frame++) {
      const list = positions[frame] ?? positions[0];
      const m = matrices[frame] ?? matrices[0];
      for (let k = 0; k < list.length; k += 3) {
        for (let i = 0; i < 3; i++) {
          const value = m[i] * list[k] + m[4 + i] * list[k + 1] + m[8 + i] * list[k + 2] + m[12 + i];
          if (value < low[i]) low[i] = value;
          if (value > high[i]) high[i] = value;
        }
      }
    }
  }
  return { low, high };
}

// { glb, parts, frames, rate, low, high }: the last are the corners of a box around it, in its own coordinates. Throws
// a Fault, or what damaged JSON throws.
export function readObject(buffer) {
  const glb = new Glb(buffer);
  const { object, frames = 1, rate = 1 } = glb.json.asset?.extras?.omnistereo ?? {};
  check(object === 1, 'it is not an object that ods view has made');
  check(Number.isInteger(frames) && frames > 0 && frames <= MAX_FRAMES && rate > 0, 'its animation is damaged');
  const parts = glb.nodes().flatMap(({ node, matrix, mesh }) => {
    const moving = node.extras?.omnistereo?.matrices;
    let matrices = [matrix];
    if (moving !== undefined) {
      const whole = glb.floats(moving, 16);
      check(whole.length === 16 * frames, 'its animation is damaged');
      matrices = Array.from({ length: frames }, (_, i) => whole.subarray(16 * i, 16 * i + 16));
    }
    return mesh.primitives.map((primitive) => partOf(glb, primitive, matrices, frames));
  });
  check(parts.length > 0, 'it has no triangles');
  const isMoving = parts.some(({ positions, matrices }) => positions.length > 1 || matrices.length > 1);
  return { glb, parts, frames: isMoving ? frames : 1, rate, ...boundsOf(parts, frames) };
}
