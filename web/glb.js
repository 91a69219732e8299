// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads a binary glTF file (.glb): what layered scenes and objects in them need of it, and everything that it names is
// checked to be there. Faults are one line each.
import { check, decodeMeshopt } from './meshopt.js';

const MAX_BYTES = 2 ** 29; // of a decoded buffer view
const MAX_NODES = 4096;
const SIZES = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 }; // bytes, by component type
const COMPONENTS = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const isCount = (value) => Number.isInteger(value) && value >= 0 && value < 2 ** 31;

// The matrices are given by columns.
export const multiplied = (a, b) => IDENTITY.map((_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + (i % 4)] * b[4 * Math.floor(i / 4) + k], 0));

export function matrixOf({ matrix, translation: t = [0, 0, 0], rotation: [x, y, z, w] = [0, 0, 0, 1], scale: s = [1, 1, 1] }) {
  if (matrix) return matrix;
  const rows = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
    [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
    [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
  ];
  return [...rows.flatMap((row, i) => [...row.map((value) => value * s[i]), 0]), ...t, 1];
}

// The bytes of an accessor's elements, without what is between them.
export function packed({ bytes, offset, stride, size, count }) {
  if (stride === size) return bytes.slice(offset, offset + count * size).buffer;
  const to = new Uint8Array(count * size);
  for (let i = 0; i < count; i++) to.set(bytes.subarray(offset + i * stride, offset + i * stride + size), i * size);
  return to.buffer;
}

export class Glb {
  // buffer: the file's bytes. Throws a Fault.
  constructor(buffer) {
    const head = new DataView(buffer);
    const size = buffer.byteLength;
    check(size >= 20 && head.getUint32(0, true) === 0x46546c67 && head.getUint32(4, true) === 2, 'it is not a binary glTF 2.0 file');
    const length = head.getUint32(12, true);
    check(head.getUint32(16, true) === 0x4e4f534a && head.getUint32(8, true) <= size && 20 + length <= size, 'it is cut off');
    this.json = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, length)));
    const begin = 28 + length;
    const binary = size >= begin ? head.getUint32(begin - 8, true) : 0;
    check(begin + binary <= size || binary === 0, 'it is cut off');
    this.binary = new Uint8Array(buffer, Math.min(begin, size), binary);
    this.decoded = new Map();
  }

  // A member of one of the file's lists.
  of(list, index) {
    const found = this.json[list]?.[index];
    check(found && typeof found === 'object', `it has no ${list}[${index}]`);
    return found;
  }

  bytes({ buffer, byteOffset = 0, byteLength }) {
    check(buffer === 0 && isCount(byteOffset) && isCount(byteLength) && byteOffset + byteLength <= this.binary.length, 'a part of its data is missing');
    return this.binary.subarray(byteOffset, byteOffset + byteLength);
  }

  view(index) {
    if (!this.decoded.has(index)) {
      const view = this.of('bufferViews', index);
      const packed = view.extensions?.EXT_meshopt_compression;
      if (packed) check(isCount(packed.count) && isCount(packed.byteStride) && packed.count * packed.byteStride <= MAX_BYTES, 'its data is too large');
      this.decoded.set(index, packed ? decodeMeshopt(this.bytes(packed), packed) : this.bytes(view));
    }
    return this.decoded.get(index);
  }

  // The numbers of an accessor, as WebGL wants them.
  accessor(index) {
    const { bufferView, byteOffset = 0, componentType, normalized = false, count, type } = this.of('accessors', index);
    const components = COMPONENTS[type];
    const size = components * SIZES[componentType];
    check(size > 0 && isCount(count) && isCount(byteOffset), `it has a damaged accessors[${index}]`);
    const bytes = this.view(bufferView);
    const stride = this.of('bufferViews', bufferView).byteStride ?? size;
    const isAligned = [byteOffset, stride].every((bytesBefore) => bytesBefore % SIZES[componentType] === 0);
    check(isCount(stride) && stride >= size && stride < 256 && isAligned, `it has a damaged accessors[${index}]`);
    check(count === 0 || byteOffset + (count - 1) * stride + size <= bytes.length, 'a part of its data is missing');
    return { view: bufferView, bytes, offset: byteOffset, stride, size, components, type: componentType, normalized, count };
  }

  // The numbers of an accessor of floats.
  floats(index, components) {
    const accessor = this.accessor(index);
    check(accessor.type === 5126 && accessor.components === components, 'its numbers are damaged');
    const values = new Float32Array(packed(accessor));
    check(values.every(Number.isFinite), 'its numbers are damaged');
    return values;
  }

  // An image as a file of its own.
  image(index) {
    const { bufferView, mimeType = '' } = this.of('images', index);
    return new Blob([this.view(bufferView)], { type: mimeType });
  }

  // The nodes of the scene that have meshes: { node, index, above, matrix, mesh }; above: the matrix of what it is part of.
  nodes() {
    const found = [];
    const seen = new Set();
    const waiting = (this.of('scenes', this.json.scene ?? 0).nodes ?? []).map((index) => [index, IDENTITY]);
    while (waiting.length) {
      const [index, above] = waiting.pop();
      check(!seen.has(index) && seen.add(index).size <= MAX_NODES, 'its nodes are not a tree');
      const node = this.of('nodes', index);
      const matrix = multiplied(above, matrixOf(node));
      check(matrix.length === 16 && matrix.every(Number.isFinite), `it has a damaged nodes[${index}]`);
      waiting.push(...(node.children ?? []).map((child) => [child, matrix]));
      if (node.mesh !== undefined) found.push({ node, index, above, matrix, mesh: this.of('meshes', node.mesh) });
    }
    return found;
  }

  // The image of a texture: WebP has an extension of its own.
  imageOf(texture) {
    const { source, extensions } = this.of('textures', texture);
    return extensions?.EXT_texture_webp?.source ?? source;
  }
}
