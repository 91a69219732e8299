// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The triangles of a layered scene on this side of the GPU, in its axes and metres: what a ray meets, and what is near.
import { cross, plus } from './headset-room.js';

const BLOCK = 64; // triangles that share a box
const READ = { 5120: ['getInt8', 127], 5121: ['getUint8', 255], 5122: ['getInt16', 32767], 5123: ['getUint16', 65535], 5126: ['getFloat32', 1] };
const INDICES = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array };

function positionsOf({ bytes, offset, stride, count, type, normalized }, m) {
  const [get, most] = READ[type];
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const size = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5126: 4 }[type];
  const scale = normalized ? 1 / most : 1;
  const to = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) {
    const [x, y, z] = [0, 1, 2].map((k) => view[get](offset + i * stride + k * size, true) * scale);
    for (let k = 0; k < 3; k++) to[3 * i + k] = m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k];
  }
  return to;
}

const indicesOf = ({ bytes, offset, count, size, type }) => new INDICES[type](bytes.slice(offset, offset + count * size).buffer);

// The smallest and largest coordinates of triangles `from` to `to`.
function boxOf({ positions, indices }, from, to) {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let k = 3 * from; k < 3 * to; k++) {
    for (let i = 0; i < 3; i++) {
      const value = positions[3 * indices[k] + i];
      if (value < box[i]) box[i] = value;
      if (value > box[3 + i]) box[3 + i] = value;
    }
  }
  return box;
}

// Returns whether a ray comes into a box before a distance.
function enters(box, from, along, most) {
  let near = 0;
  let far = most;
  for (let i = 0; i < 3; i++) {
    const a = (box[i] - from[i]) / along[i];
    const b = (box[3 + i] - from[i]) / along[i];
    if (Number.isNaN(a + b)) continue; // in the plane of a side
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  return near <= far;
}

// The distance to a triangle that a ray meets, in lengths of `along`, or Infinity (Moeller and Trumbore 1997). Without
// arrays: a ray tests thousands.
function met(p, a, b, c, [fx, fy, fz], [dx, dy, dz], isDouble) {
  const [i, j, k] = [3 * a, 3 * b, 3 * c];
  const ux = p[j] - p[i], uy = p[j + 1] - p[i + 1], uz = p[j + 2] - p[i + 2];
  const vx = p[k] - p[i], vy = p[k + 1] - p[i + 1], vz = p[k + 2] - p[i + 2];
  const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
  const whole = ux * px + uy * py + uz * pz;
  if (isDouble ? whole === 0 : whole <= 0) return Infinity; // from behind
  const ax = fx - p[i], ay = fy - p[i + 1], az = fz - p[i + 2];
  const x = (ax * px + ay * py + az * pz) / whole;
  if (!(x >= 0 && x <= 1)) return Infinity;
  const qx = ay * uz - az * uy, qy = az * ux - ax * uz, qz = ax * uy - ay * ux;
  const y = (dx * qx + dy * qy + dz * qz) / whole;
  const distance = (vx * qx + vy * qy + vz * qz) / whole;
  return y >= 0 && x + y <= 1 && distance > 0 ? distance : Infinity;
}

// The nearest triangle of { positions, indices } that a ray meets: { distance, first }, `first` the place of its indices.
export function castOne({ positions, indices }, from, along, { begin = 0, end = indices.length, most = Infinity, isDouble = false } = {}) {
  let found = { distance: most, first: -1 };
  for (let k = begin; k < end; k += 3) {
    const distance = met(positions, indices[k], indices[k + 1], indices[k + 2], from, along, isDouble);
    if (distance < found.distance) found = { distance, first: k };
  }
  return found;
}

export class Surfaces {
  // meshes: as layered.js reads them, with their bytes.
  constructor(meshes) {
    this.meshes = meshes.map(({ positions, indices, matrix }) => {
      const mesh = { positions: positionsOf(positions, matrix), indices: indicesOf(indices) };
      const triangles = mesh.indices.length / 3;
      mesh.boxes = Array.from({ length: Math.ceil(triangles / BLOCK) }, (_, i) => boxOf(mesh, i * BLOCK, Math.min((i + 1) * BLOCK, triangles)));
      return mesh;
    });
  }

  // The first triangle that a ray meets, seen from its front: { distance, at, normal }, or null. along: of length 1.
  cast(from, along) {
    let found = { distance: Infinity };
    for (const mesh of this.meshes) {
      for (const [i, box] of mesh.boxes.entries()) {
        if (!enters(box, from, along, found.distance)) continue;
        const here = castOne(mesh, from, along, { begin: 3 * BLOCK * i, end: Math.min(3 * BLOCK * (i + 1), mesh.indices.length), most: found.distance });
        if (here.first >= 0) found = { ...here, mesh };
      }
    }
    if (!found.mesh) return null;
    const { mesh: { positions, indices }, distance, first } = found;
    const [a, b, c] = [0, 1, 2].map((i) => [...positions.subarray(3 * indices[first + i], 3 * indices[first + i] + 3)]);
    const normal = cross(plus(b, a, -1), plus(c, a, -1));
    return { distance, at: plus(from, along, distance), normal: normal.map((value) => value / Math.hypot(...normal)) };
  }

  // The indices of each mesh's triangles whose boxes meet a box.
  near(low, high) {
    const meets = (box) => low.every((value, i) => box[3 + i] >= value && box[i] <= high[i]);
    return this.meshes.map((mesh) => {
      const found = [];
      for (const [i, box] of mesh.boxes.entries()) {
        if (!meets(box)) continue;
        const end = Math.min((i + 1) * BLOCK, mesh.indices.length / 3);
        for (let k = i * BLOCK; k < end; k++) if (meets(boxOf(mesh, k, k + 1))) found.push(...mesh.indices.subarray(3 * k, 3 * k + 3));
      }
      return Uint32Array.from(found);
    });
  }
}
