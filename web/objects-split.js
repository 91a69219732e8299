// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Divides the triangles of an object for a stereo picture, in which only vertices are exact: between two of them, seen
// at an angle a from each other at a distance d, the error is r a^2 / (8 d), r half of the distance of the eyes. With
// edges of 0.1 m it is 1 minute of arc at 0.5 m, and 8 times less at 1 m.
const EDGE = 0.1; // metres
const MOST = 500000; // triangles of a part, from which it is not divided any more

// The largest factor by which a matrix stretches along an axis.
const scaleOf = (m) => Math.max(...[0, 4, 8].map((k) => Math.hypot(m[k], m[k + 1], m[k + 2])));

// A list of `size` numbers per vertex, with the middles of pairs of vertices after it.
function grown(list, size, pairs) {
  const to = new Float32Array(list.length + size * pairs.length);
  to.set(list);
  pairs.forEach(([a, b], i) => {
    for (let k = 0; k < size; k++) to[list.length + size * i + k] = (list[size * a + k] + list[size * b + k]) / 2;
  });
  return to;
}

// Every edge that is too long, in any frame, gets a vertex in its middle, from both of its sides.
function splitOnce(part, most) {
  const { positions, indices } = part;
  const isLong = (a, b) => positions.some((p) => Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]) > most);
  const middles = new Map();
  const pairs = [];
  const first = positions[0].length / 3;
  const middleOf = (a, b) => {
    const key = a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a;
    if (!middles.has(key)) middles.set(key, isLong(a, b) ? first + pairs.push([Math.min(a, b), Math.max(a, b)]) - 1 : -1);
    return middles.get(key);
  };
  const all = [];
  for (let k = 0; k < indices.length; k += 3) {
    let corners = [...indices.subarray(k, k + 3)];
    let cuts = corners.map((corner, i) => middleOf(corner, corners[(i + 1) % 3]));
    const count = cuts.filter((cut) => cut >= 0).length;
    // The cut edges come first.
    while (count && count < 3 && !(cuts[0] >= 0 && cuts[2] < 0)) [corners, cuts] = [corners, cuts].map(([x, y, z]) => [y, z, x]);
    const [[a, b, c], [ab, bc, ca]] = [corners, cuts];
    if (count === 0) all.push(a, b, c);
    else if (count === 1) all.push(a, ab, c, ab, b, c);
    else if (count === 2) all.push(ab, b, bc, a, ab, bc, a, bc, c);
    else all.push(a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca);
  }
  if (!pairs.length) return false;
  part.positions = positions.map((list) => grown(list, 3, pairs));
  part.normals = part.normals.map((list) => grown(list, 3, pairs));
  part.uvs &&= grown(part.uvs, 2, pairs);
  part.indices = Uint32Array.from(all);
  return true;
}

// Divides a part of an object (objects-file.js).
export function split(part) {
  const most = EDGE / Math.max(...part.matrices.map(scaleOf), 1e-9);
  while (part.indices.length < 3 * MOST && splitOnce(part, most));
}
