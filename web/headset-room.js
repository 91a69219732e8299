// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Flat objects in the room around the wearer, drawn over the picture. Each eye sees them from its own position, so they
// appear at their distances. Metres; a sheet has its centre `at` and its half axes u (right) and v (up).
import { dot } from './geometry.js';

export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const plus = (a, b, times = 1) => a.map((x, i) => x + times * b[i]);
export const scaled = (a, to) => a.map((x) => (x * to) / Math.hypot(...a)); // to a length

// A direction or a position turned to the right about the vertical axis.
export function turned([x, y, z], angle) {
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  return [x * c - z * s, y, z * c + x * s];
}

export function poseOf({ position: { x, y, z }, matrix: m }) {
  return { at: [x, y, z], right: [...m.slice(0, 3)], up: [...m.slice(4, 7)], back: [...m.slice(8, 11)] };
}

// The heading of a head, to the right of -Z; if it looks straight down, the heading of its crown.
export function headingOf({ up, back }) {
  const ahead = Math.abs(back[1]) > 0.95 ? up.map((x) => x * Math.sign(back[1])) : back.map((x) => -x);
  return Math.atan2(ahead[0], -ahead[2]);
}

// The turn from one heading to another, -pi..pi.
export const turnBetween = (from, to) => ((to - from + 3 * Math.PI) % (2 * Math.PI)) - Math.PI;

// A sheet that faces `from`, at a distance, lower by the angle `below`. Radians.
export function sheetAhead(from, heading, below, distance, [width, height]) {
  const [s, c, sb, cb] = [Math.sin(heading), Math.cos(heading), Math.sin(below), Math.cos(below)];
  const [right, ahead] = [[c, 0, s], [s * cb, -sb, -c * cb]];
  return { at: plus(from, ahead, distance), u: scaled(right, width / 2), v: scaled(cross(right, ahead), height / 2) };
}

// A round sheet that faces the eye.
export function facing(at, eye, radius) {
  const toward = plus(eye, at, -1);
  const right = cross([0, 1, 0], toward);
  return { at, u: scaled(right, radius), v: scaled(cross(toward, right), radius) };
}

// A thread between two points, turned so that the eye sees its full width.
export function thread(a, b, eye, width) {
  const along = plus(b, a, -1);
  return { at: plus(a, along, 0.5), u: along.map((x) => x / 2), v: scaled(cross(along, plus(eye, a, -1)), width / 2) };
}

// The intersection of a ray with the plane of a sheet: at, and x and y in half axes. Null behind the ray's origin.
export function meet({ at, u, v }, { from, along }) {
  const normal = cross(u, v);
  const way = dot(plus(at, from, -1), normal) / dot(along, normal);
  if (!(way > 0)) return null;
  const place = plus(from, along, way);
  const [x, y] = [u, v].map((axis) => dot(plus(place, at, -1), axis) / dot(axis, axis));
  return { at: place, x, y, isInside: Math.max(Math.abs(x), Math.abs(y)) <= 1 };
}

const VERTICES = `#version 300 es
uniform mat3 to_screen;
uniform vec3 at;
uniform vec3 u;
uniform vec3 v;
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec3 p = to_screen * (at + place.x * u + place.y * v);
  gl_Position = vec4(p.xy, 0.0, p.z);
}`;
const FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D face;
uniform vec4 color;   // premultiplied by its alpha; multiplies the face, if there is one
uniform vec4 kind;    // 1 with a face; 1 if round; inner radius; fraction of the turn
in vec2 place;
out vec4 result;
void main() {
  result = color;
  if (kind.x > 0.0) result *= texture(face, 0.5 + 0.5 * vec2(place.x, -place.y));
  float radius = length(place);
  float soft = fwidth(radius);
  float turn = atan(-place.x, -place.y) / 6.2831853 + 0.5;
  if (kind.y > 0.0) result *= smoothstep(kind.z - soft, kind.z, radius) * (1.0 - smoothstep(1.0 - soft, 1.0, radius)) * step(turn, kind.w);
}`;

// The inverse of a matrix, both given by columns.
export function inverse(m) {
  const [a, b, c] = [m.slice(0, 3), m.slice(3, 6), m.slice(6, 9)];
  const rows = [cross(b, c), cross(c, a), cross(a, b)].map((row) => row.map((x) => x / dot(a, cross(b, c))));
  return [0, 1, 2].flatMap((i) => rows.map((row) => row[i]));
}

export class Sheets {
  constructor(gl) {
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTICES], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
      gl.deleteShader(shader);
    }
    gl.linkProgram(this.program);
    this.where = (name) => gl.getUniformLocation(this.program, name);
  }

  // Fills a texture with a canvas.
  fill(texture, canvas) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, canvas);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    for (const way of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, way, gl.CLAMP_TO_EDGE);
  }

  // things: sheets, each with a color [r, g, b, alpha] and optionally a face (texture) and a ring [inner radius,
  // fraction of the turn]; a sheet without a position covers the view. rays: the view's, in the room (panorama.js).
  // eye: its position. box: in the target.
  draw(things, { rays, eye, box, target }) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(...box);
    gl.useProgram(this.program);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.activeTexture(gl.TEXTURE0);
    gl.uniform1i(this.where('face'), 0);
    gl.uniformMatrix3fv(this.where('to_screen'), false, inverse([...rays]));
    const whole = { at: plus(eye, rays.slice(6, 9)), u: rays.slice(0, 3), v: rays.slice(3, 6) };
    for (const thing of things) {
      const { at, u, v, color = [1, 1, 1, 1], face, ring } = thing.at ? thing : { ...thing, ...whole };
      gl.uniform3fv(this.where('at'), plus(at, eye, -1));
      gl.uniform3fv(this.where('u'), u);
      gl.uniform3fv(this.where('v'), v);
      gl.uniform4fv(this.where('color'), color.map((x, i) => (i < 3 ? x * color[3] : x)));
      gl.uniform4fv(this.where('kind'), [face ? 1 : 0, ring ? 1 : 0, ...(ring ?? [0, 1])]);
      if (face) gl.bindTexture(gl.TEXTURE_2D, face);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
    gl.disable(gl.BLEND);
  }

  free() {
    this.gl.deleteProgram(this.program);
  }
}
