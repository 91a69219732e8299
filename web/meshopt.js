// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes the buffer views of EXT_meshopt_compression (its appendices A and B): attributes, plain or exponential,
// triangles and indices. Reads beyond the end of the data yield 0, and are noticed at the end of a block.
export class Fault extends Error {}

export function check(is, what) {
  if (!is) throw new Fault(what);
}

const intact = (is) => check(is, 'its compressed data is damaged');
const unzigzag = (value) => (value >>> 1) ^ -(value & 1);

// --- attributes: the bytes of elements as differences from the element before ---------------------------------------

const GROUP = 16; // elements
const TAIL = 32; // bytes, at least

// Reads the differences of a group; returns the position behind them.
function readGroup(source, at, mode, into) {
  if (mode === 0) {
    into.fill(0);
    return at;
  }
  if (mode === 3) {
    for (let i = 0; i < GROUP; i++) into[i] = source[at + i];
    return at + GROUP;
  }
  const bits = 2 * mode;
  const high = (1 << bits) - 1; // the difference is larger, and follows as a byte
  let more = at + 2 * bits;
  for (let i = 0; i < GROUP; i++) {
    const place = i * bits;
    const value = (source[at + (place >> 3)] >> (8 - bits - (place & 7))) & high;
    into[i] = value === high ? source[more++] : value;
  }
  return more;
}

function decodeAttributes(source, count, stride) {
  const end = source.length - Math.max(stride, TAIL);
  intact(source[0] === 0xa0 && end >= 1);
  const target = new Uint8Array(count * stride);
  const last = source.slice(-stride);
  const differences = new Uint8Array(GROUP);
  const step = Math.min((8192 / stride) & -GROUP, 256);
  let at = 1;
  for (let first = 0; first < count; first += step) {
    const size = Math.min(step, count - first);
    for (let byte = 0; byte < stride; byte++) {
      const modes = at;
      at += Math.ceil(size / (4 * GROUP));
      for (let i = 0; i < size; i++) {
        const group = i / GROUP;
        if (i % GROUP === 0) at = readGroup(source, at, (source[modes + (group >> 2)] >> (2 * (group & 3))) & 3, differences);
        last[byte] += unzigzag(differences[i % GROUP]);
        target[(first + i) * stride + byte] = last[byte];
      }
    }
    intact(at <= end);
  }
  intact(at === end);
  return target;
}

// Floats whose upper byte is an exponent of 2, and whose others are an integer.
function decodeExponents(bytes) {
  const whole = new Int32Array(bytes.buffer);
  const floats = new Float32Array(bytes.buffer);
  for (const [i, value] of whole.entries()) floats[i] = ((value << 8) >> 8) * 2 ** (value >> 24);
}

// --- indices --------------------------------------------------------------------------------------------------------

class Reader {
  constructor(source, at, end) {
    Object.assign(this, { source, at, end });
  }

  byte() {
    intact(this.at < this.end);
    return this.source[this.at++];
  }

  // A number in groups of 7 bits, the lowest first.
  number() {
    let value = 0;
    for (let shift = 0; shift < 35; shift += 7) {
      const byte = this.byte();
      value |= (byte & 127) << shift;
      if (byte < 128) return value >>> 0;
    }
    return intact(false);
  }
}

// The vertices and edges that were used last; those of a triangle are taken from them.
class Triangles {
  constructor(data) {
    Object.assign(this, { data, next: 0, last: 0, vertices: new Uint32Array(16), used: 0, edges: new Uint32Array(32), joined: 0 });
  }

  vertex(back) {
    return this.vertices[(this.used - 1 - back) & 15];
  }

  keepVertex(vertex) {
    this.vertices[this.used++ & 15] = vertex;
  }

  keepEdge(a, b) {
    this.edges.set([a, b], 2 * (this.joined++ & 15));
  }

  // A vertex as its difference from the last such one.
  explicit() {
    return (this.last = (this.last + unzigzag(this.data.number())) >>> 0);
  }

  // A triangle at an earlier edge.
  joinedTo(back, code) {
    const at = 2 * ((this.joined - 1 - back) & 15);
    const [a, b] = [this.edges[at], this.edges[at + 1]];
    let c;
    if (code === 0) c = this.next++;
    else if (code < 13) c = this.vertex(code);
    else if (code < 15) c = this.last = (this.last + (code === 13 ? -1 : 1)) >>> 0;
    else c = this.explicit();
    if (code === 0 || code > 12) this.keepVertex(c);
    this.keepEdge(c, b);
    this.keepEdge(a, c);
    return [a, b, c];
  }

  // A triangle with the origins of its second and third vertex, 0 to 15 each.
  free(origins, isFirstNew) {
    const vertexOf = (origin) => (origin === 0 ? this.next++ : origin < 15 ? this.vertex(origin - 1) : this.explicit());
    const isKept = (origin) => origin === 0 || origin === 15;
    const [second, third] = [origins >> 4, origins & 15];
    const a = isFirstNew ? this.next++ : this.explicit();
    const b = vertexOf(second);
    const c = vertexOf(third);
    this.keepVertex(a);
    if (isKept(second)) this.keepVertex(b);
    if (isKept(third)) this.keepVertex(c);
    this.keepEdge(b, a);
    this.keepEdge(c, b);
    this.keepEdge(a, c);
    return [a, b, c];
  }

  explicitTriangle(isFirstNew) {
    const origins = this.data.byte();
    if (origins === 0) this.next = 0;
    return this.free(origins, isFirstNew);
  }
}

function decodeTriangles(source, count, target) {
  const end = source.length - 16;
  const data = new Reader(source, 1 + count / 3, end);
  intact(source[0] === 0xe1 && data.at <= end);
  const triangles = new Triangles(data);
  for (let i = 0; i < count / 3; i++) {
    const code = source[1 + i];
    const [back, kind] = [code >> 4, code & 15];
    if (back < 15) target.set(triangles.joinedTo(back, kind), 3 * i);
    else if (kind < 14) target.set(triangles.free(source[end + kind], true), 3 * i);
    else target.set(triangles.explicitTriangle(kind === 14), 3 * i);
  }
  intact(data.at === end);
}

function decodeIndices(source, count, target) {
  const data = new Reader(source, 1, source.length - 4);
  intact(source[0] === 0xd1);
  const last = new Uint32Array(2);
  for (let i = 0; i < count; i++) {
    const value = data.number();
    last[value & 1] += unzigzag(value >>> 1);
    target[i] = last[value & 1];
  }
  intact(data.at === data.end);
}

// source: bytes. The rest as in the extension's JSON. Throws a Fault.
export function decodeMeshopt(source, { mode, count, byteStride: stride, filter = 'NONE' }) {
  check(filter === 'NONE' || filter === 'EXPONENTIAL', `it has data with the filter ${filter}, which this viewer does not read`);
  if (mode === 'ATTRIBUTES') {
    intact(stride > 0 && stride <= 256 && stride % 4 === 0);
    const bytes = decodeAttributes(source, count, stride);
    if (filter === 'EXPONENTIAL') decodeExponents(bytes);
    return bytes;
  }
  intact((mode === 'TRIANGLES' && count % 3 === 0) || mode === 'INDICES');
  intact(stride === 2 || stride === 4);
  const target = stride === 2 ? new Uint16Array(count) : new Uint32Array(count);
  (mode === 'TRIANGLES' ? decodeTriangles : decodeIndices)(source, count, target);
  return new Uint8Array(target.buffer);
}
