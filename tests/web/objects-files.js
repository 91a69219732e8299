// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Files for objects-test.js: a layered scene of a floor, a wall and a pillar, each of one colour, and objects in it.
export const CENTER = [0, 1.2, 0];
export const PILLAR = { x: [0, 0.5], y: [0, 1.5], z: -1 }; // seen from the box
export const WALL = -3; // its z
export const COLORS = { floor: [180, 180, 180], wall: [120, 140, 160], pillar: [200, 60, 60] };

class Writer {
  constructor(json) {
    Object.assign(this, { json: { asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [] }], ...json }, bytes: [], size: 0 });
    for (const list of ['nodes', 'meshes', 'materials', 'accessors', 'bufferViews', 'images', 'textures']) this.json[list] = [];
  }

  add(list, value) {
    return this.json[list].push(value) - 1;
  }

  view(bytes) {
    const padded = new Uint8Array(4 * Math.ceil(bytes.byteLength / 4));
    padded.set(new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset ?? 0, bytes.byteLength));
    this.bytes.push(padded);
    this.size += padded.length;
    return this.add('bufferViews', { buffer: 0, byteOffset: this.size - padded.length, byteLength: bytes.byteLength });
  }

  accessor(values, type, components) {
    const isIndex = values instanceof Uint32Array;
    return this.add('accessors', { bufferView: this.view(values), componentType: isIndex ? 5125 : 5126, count: values.length / components, type });
  }

  node(mesh, more) {
    this.json.scenes[0].nodes.push(this.add('nodes', { mesh, ...more }));
  }

  glb() {
    this.json.buffers = [{ byteLength: this.size }];
    const text = new TextEncoder().encode(JSON.stringify(this.json));
    const length = 4 * Math.ceil(text.length / 4);
    const whole = new Uint8Array(28 + length + this.size).fill(32, 20, 20 + length);
    const head = new DataView(whole.buffer);
    [0x46546c67, 2, whole.length, length, 0x4e4f534a].forEach((word, i) => head.setUint32(4 * i, word, true));
    whole.set(text, 20);
    head.setUint32(20 + length, this.size, true);
    head.setUint32(24 + length, 0x004e4942, true);
    let at = 28 + length;
    for (const part of this.bytes) {
      whole.set(part, at);
      at += part.length;
    }
    return whole.buffer;
  }
}

async function png([r, g, b]) {
  const canvas = new OffscreenCanvas(4, 4);
  const draw = canvas.getContext('2d');
  draw.fillStyle = `rgb(${r} ${g} ${b})`;
  draw.fillRect(0, 0, 4, 4);
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

const quad = (corner, across, down) => [corner, corner.map((x, i) => x + across[i]), corner.map((x, i) => x + down[i]), corner.map((x, i) => x + across[i] + down[i])].flat();

// light: of the file; probe: its 27 coefficients, at every place, or missing. The floor's two halves overlap.
export async function roomGlb({ light = {}, probe } = {}) {
  const file = new Writer();
  const sheets = [
    ['wall', quad([-3, 3, WALL], [6, 0, 0], [0, -3, 0])],
    ['floor', quad([-3, 0, WALL], [3.1, 0, 0], [0, 0, 5])], ['floor', quad([-0.1, 0, WALL], [3.1, 0, 0], [0, 0, 5])],
    ['pillar', quad([PILLAR.x[0], PILLAR.y[1], PILLAR.z], [0.5, 0, 0], [0, -1.5, 0])],
  ];
  const uvs = new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]);
  for (const [name, positions] of sheets) {
    const image = file.add('images', { bufferView: file.view(await png(COLORS[name])), mimeType: 'image/png' });
    const texture = file.add('textures', { source: image });
    const material = file.add('materials', { pbrMetallicRoughness: { baseColorTexture: { index: texture } } });
    const attributes = { POSITION: file.accessor(new Float32Array(positions), 'VEC3', 3), TEXCOORD_0: file.accessor(uvs, 'VEC2', 2) };
    const indices = file.accessor(new Uint32Array([0, 2, 1, 1, 2, 3]), 'SCALAR', 1);
    file.node(file.add('meshes', { primitives: [{ attributes, indices, material }] }));
  }
  const about = { layers: 1, center: CENTER, box: [0.3, 0.3, 0.3], yaw: 0, scene: 'room', light: { exposure: 0, tone: 'neutral', ...light } };
  if (probe) {
    const values = new Float32Array(8 * 28);
    for (let i = 0; i < 8; i++) values.set([i === 7 ? 0 : 1, ...(i === 7 ? probe.map(() => 99) : probe)], 28 * i); // one is to be left out
    about.light.probes = { origin: [-2, 0, -3], step: [4, 3, 5], count: [2, 2, 2], bufferView: file.view(values) };
  }
  file.json.asset.extras = { omnistereo: about };
  return file.glb();
}

// The faces of a cube around the origin, with normals.
function cube(half) {
  const positions = [];
  const normals = [];
  const indices = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      const first = positions.length / 3;
      for (const [a, b] of [[-1, -1], [1, -1], [-1, 1], [1, 1]]) {
        const place = [0, 0, 0];
        Object.assign(place, { [axis]: side, [(axis + 1) % 3]: a, [(axis + 2) % 3]: b });
        positions.push(...place.map((x) => x * half));
        normals.push(...[0, 1, 2].map((i) => (i === axis ? side : 0)));
      }
      indices.push(...(side > 0 ? [0, 1, 2, 1, 3, 2] : [0, 2, 1, 1, 2, 3]).map((i) => first + i));
    }
  }
  return { positions: new Float32Array(positions), normals: new Float32Array(normals), indices: new Uint32Array(indices) };
}

// A cube of one material. shifts: of its frames, metres, as a node that moves; grows: of its frames, as a primitive that
// deforms.
export function cubeGlb({ half = 0.2, material = {}, shifts, grows, rate = 10 } = {}) {
  const frames = (shifts ?? grows)?.length ?? 1;
  const file = new Writer();
  file.json.asset.extras = { omnistereo: { object: 1, frames, rate } };
  const { positions, normals, indices } = cube(half);
  const attributesOf = (scale) => ({
    POSITION: file.accessor(positions.map((x) => x * scale), 'VEC3', 3), NORMAL: file.accessor(normals, 'VEC3', 3),
  });
  const primitive = { attributes: attributesOf(1), indices: file.accessor(indices, 'SCALAR', 1), material: file.add('materials', material) };
  if (grows) primitive.extras = { omnistereo: { frames: grows.map(attributesOf) } };
  const more = {};
  if (shifts) {
    const matrices = shifts.flatMap(([x, y, z]) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1]);
    more.extras = { omnistereo: { matrices: file.accessor(new Float32Array(matrices), 'MAT4', 16) } };
  }
  file.node(file.add('meshes', { primitives: [primitive] }), more);
  return file.glb();
}
