// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws real-time objects into the targets of a layered scene (layered-draw.js), behind and in front of its triangles,
// with their shadows on these. An object is that of objects.js: file, at, matrix, middle, radius, pose and light.
import { FACES, dot } from './geometry.js';
import { cross, plus, scaled } from './headset-room.js';
import { multiplied } from './glb.js';
import { LayeredDrawer, NEAR, VERTICES } from './layered-draw.js';
import { CASTER, CASTER_VERTICES, LIGHT, OBJECT, OBJECT_VERTICES, ROUGHEN, SHADE } from './objects-shaders.js';
import { compile } from './panorama.js';

const BIAS = 0.002; // metres below an object where its shadow begins
const MAP = 512; // texels of a map of what an object covers
const MARGIN = 2; // half the width of the map, in radii of the object
const MIRROR = 128; // texels of a side of what it reflects
const LEVELS = 6; // of that, for six roughnesses
const SMOOTH = 0.95; // rougher objects reflect what the probes have

const mixed = (a, b, part) => (part ? a.map((value, i) => value + part * (b[i] - value)) : a);
const turnsOver = (m) => dot(cross([m[0], m[1], m[2]], [m[4], m[5], m[6]]), [m[8], m[9], m[10]]) < 0;

// The matrix from the world to what a light sees of an object: x and y within the margin, z 1 at the object's end that
// is nearest to the light, and -1 at its other end.
export function lightMatrix(toward, middle, radius) {
  const u = scaled(cross(Math.abs(toward[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], toward), 1);
  const rows = [u, cross(toward, u), toward].map((axis, i) => axis.map((value) => value / (radius * (i < 2 ? MARGIN : 1))));
  return [...[0, 1, 2].flatMap((i) => [...rows.map((row) => row[i]), 0]), ...rows.map((row) => -dot(row, middle)), 1];
}

// The part of a view, and of its own part, in which a box of the world is seen.
export function partOf([low, high], { toScreen, at, part: [x, y, width, height], size }) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((n) => {
    const p = low.map((value, i) => ((n >> i) & 1 ? high[i] : value) - at[i]);
    return [0, 1, 2].map((i) => toScreen[i] * p[0] + toScreen[3 + i] * p[1] + toScreen[6 + i] * p[2]);
  });
  if (corners.every(([, , z]) => z < NEAR)) return [x, y, 0, 0];
  if (corners.some(([, , z]) => z < NEAR)) return [x, y, width, height];
  const [from, to] = [Math.min, Math.max].map((pick) => [0, 1].map((i) => pick(...corners.map((p) => ((p[i] / p[2] + 1) / 2) * size[i]))));
  const [left, lower] = [Math.max(Math.floor(from[0]), x), Math.max(Math.floor(from[1]), y)];
  return [left, lower, Math.max(Math.min(Math.ceil(to[0]), x + width) - left, 0), Math.max(Math.min(Math.ceil(to[1]), y + height) - lower, 0)];
}

// From -1..1 to 0..1.
const HALVED = [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0.5, 0.5, 0.5, 1];

export class ObjectsDrawer {
  // drawer: the scene's. hasFloats: whether textures of halves can be drawn into. shaders: other ones.
  constructor(gl, drawer, hasFloats, shaders = {}) {
    Object.assign(this, { gl, drawer, format: hasFloats ? gl.RGBA16F : gl.RGBA8, target: gl.createFramebuffer() });
    const all = {
      object: [OBJECT(), OBJECT_VERTICES(2 * NEAR)], caster: [CASTER, CASTER_VERTICES], shade: [SHADE(BIAS), VERTICES],
      light: [LIGHT()], roughen: [ROUGHEN], ...shaders,
    };
    this.programs = Object.fromEntries(Object.entries(all).map(([name, texts]) => [name, drawer.named(compile(gl, ...texts))]));
    this.small = new LayeredDrawer(gl, drawer);
  }

  use(name) {
    const { program, at } = this.programs[name];
    this.gl.useProgram(program);
    return at;
  }

  bind(unit, texture, kind = this.gl.TEXTURE_2D) {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(kind, texture);
  }

  buffer(kind, values) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    gl.bindBuffer(kind, buffer);
    gl.bufferData(kind, values, gl.STATIC_DRAW);
    return buffer;
  }

  // Uploads the parts of a file. textures: of its images, by their numbers.
  upload(object, textures) {
    const { gl } = this;
    const before = gl.getParameter(gl.VERTEX_ARRAY_BINDING);
    object.parts = object.file.parts.map((part) => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      const [positions, normals] = [part.positions, part.normals].map((lists) => lists.map((list) => this.buffer(gl.ARRAY_BUFFER, list)));
      const buffers = [...positions, ...normals, this.buffer(gl.ELEMENT_ARRAY_BUFFER, part.indices)];
      if (part.uvs) {
        buffers.push(this.buffer(gl.ARRAY_BUFFER, part.uvs));
        gl.enableVertexAttribArray(1);
        gl.vertexAttribPointer(1, 2, gl.FLOAT, false, 0, 0);
      }
      const { material, matrices } = part;
      return { array, positions, normals, buffers, material, matrices, count: part.indices.length, texture: textures.get(material.image) };
    });
    gl.bindVertexArray(before);
    object.textures = [...textures.values()];
    object.maps = [0, 1].map(() => this.texture(gl.TEXTURE_2D, this.format, MAP, 1 + Math.log2(MAP)));
    object.isSmooth = object.parts.some(({ material: { metal, rough } }) => metal > 0 || rough < SMOOTH);
  }

  texture(kind, format, side, levels) {
    const { gl } = this;
    const texture = gl.createTexture();
    this.bind(0, texture, kind);
    gl.texStorage2D(kind, levels, format, side, side);
    gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(kind, axis, gl.CLAMP_TO_EDGE);
    return texture;
  }

  // Binds a part at the pose of its object.
  pose({ array, positions, normals }, { frame, next }) {
    const { gl } = this;
    gl.bindVertexArray(array);
    const at = (list, number) => list[number] ?? list[0];
    for (const [place, buffer] of [[0, at(positions, frame)], [2, at(normals, frame)], [3, at(positions, next)], [4, at(normals, next)]]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    }
  }

  matrixOf({ matrices }, { matrix, pose: { frame, next, part } }) {
    return multiplied(matrix, mixed([...(matrices[frame] ?? matrices[0])], matrices[next] ?? matrices[0], part));
  }

  // --- what is drawn before the eyes' views --------------------------------------------------------------------------

  // Draws what an object covers, as seen from its light and from above, and lists the triangles that may be darker.
  cast(object, surfaces, meshes) {
    const { gl } = this;
    const { light: { sun }, middle, radius } = object;
    const matrices = [sun.toward, [0, 1, 0]].map((toward) => lightMatrix(toward, middle, radius));
    const before = gl.getParameter(gl.VERTEX_ARRAY_BINDING);
    const at = this.use('caster');
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.viewport(0, 0, MAP, MAP);
    gl.clearColor(0, 0, 0, 0);
    gl.blendEquation(gl.MAX);
    gl.uniform1f(at.part, object.pose.part);
    for (const [i, map] of object.maps.entries()) {
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, map, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.enable(gl.BLEND);
      for (const part of object.parts) {
        const { base, cutoff } = part.material;
        this.pose(part, object.pose);
        this.bind(0, part.texture ?? null);
        gl.uniformMatrix4fv(at.to_map, false, multiplied(matrices[i], this.matrixOf(part, object)));
        gl.uniform1f(at.alpha, cutoff || part.material.blends ? base[3] : 1);
        gl.uniform1i(at.has_page, Boolean(part.texture && (cutoff || part.material.blends)));
        gl.uniform1f(at.cutoff, cutoff);
        gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
      }
      gl.disable(gl.BLEND);
      this.bind(0, map);
      gl.generateMipmap(gl.TEXTURE_2D);
    }
    gl.blendEquation(gl.FUNC_ADD);
    gl.bindVertexArray(before);
    object.matrices = matrices.map((matrix) => multiplied(HALVED, matrix));
    this.list(object, surfaces, meshes);
  }

  // The box that an object's shadows may darken.
  within({ light: { sun }, middle, radius, reach }) {
    const ends = [plus(middle, sun.toward, -(radius + reach[0])), plus(middle, [0, -1, 0], radius + reach[1]), middle];
    return [Math.min, Math.max].map((pick, side) => middle.map((_, i) => pick(...ends.map((end) => end[i])) + (2 * side - 1) * MARGIN * radius));
  }

  list(object, surfaces, meshes) {
    const { gl } = this;
    const within = this.within(object);
    this.freeList(object);
    object.within = within;
    object.darker = surfaces.near(...within).flatMap((indices, i) => {
      if (!indices.length) return [];
      const mesh = meshes[i];
      gl.bindVertexArray(null);
      const buffer = this.buffer(gl.ELEMENT_ARRAY_BUFFER, indices);
      return { mesh, buffer, count: indices.length, array: this.drawer.arrayOf({ ...mesh, indices: { buffer } }) };
    });
  }

  freeList({ darker = [] }) {
    for (const { array, buffer } of darker) {
      this.gl.deleteVertexArray(array);
      this.gl.deleteBuffer(buffer);
    }
  }

  // Draws a face of what is around an object into the first target of `small`.
  drawAround(rays, size, object, meshes, middle) {
    this.small.drawEye(0, meshes, { rays, at: object.middle, middle, part: [0, 0, size, size], alpha: 0 });
  }

  // Draws what an object reflects: the scene from the object's place. middle: of the box.
  reflect(object, meshes, middle) {
    const { gl, small } = this;
    if (!object.isSmooth) return;
    object.mirror ??= this.texture(gl.TEXTURE_CUBE_MAP, this.format, MIRROR, LEVELS);
    const light = this.texture(gl.TEXTURE_CUBE_MAP, this.format, MIRROR, 1 + Math.log2(MIRROR));
    small.fit([MIRROR, MIRROR]);
    const onto = (cube, face, level) => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, cube, level);
      gl.viewport(0, 0, MIRROR >> level, MIRROR >> level);
    };
    for (const [face, rays] of FACES.entries()) {
      this.drawAround(rays, MIRROR, object, meshes, middle);
      const at = this.use('light');
      gl.uniformMatrix3fv(at.rays, false, rays);
      gl.uniform3fv(at['terms[0]'], object.light.around);
      gl.uniform1i(at.neutral, object.light.neutral);
      this.bind(0, small.eyes[0].texture);
      for (const cube of [light, object.mirror]) {
        onto(cube, face, 0);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
      }
    }
    this.bind(0, light, gl.TEXTURE_CUBE_MAP);
    gl.generateMipmap(gl.TEXTURE_CUBE_MAP);
    const at = this.use('roughen');
    gl.uniform1f(at.side, MIRROR);
    for (let level = 1; level < LEVELS; level++) {
      gl.uniform1f(at.rough, level / (LEVELS - 1));
      for (const [face, rays] of FACES.entries()) {
        onto(object.mirror, face, level);
        gl.uniformMatrix3fv(at.rays, false, rays);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
      }
    }
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, null, 0);
    gl.deleteTexture(light);
  }

  // --- in the views ----------------------------------------------------------------------------------------------------

  // view: { toScreen, at, part, size } of layered-draw.js.
  draw(objects, view) {
    const { gl } = this;
    gl.enable(gl.DEPTH_TEST);
    this.shade(objects, view);
    const parts = objects.flatMap((object) => object.parts.map((part) => ({ object, part })));
    const at = this.begin(view);
    gl.uniform1i(at.page, 0);
    gl.uniform1i(at.mirror, 1);
    gl.uniform1f(at.levels, LEVELS);
    for (const blends of [false, true]) {
      gl.depthMask(!blends);
      if (blends) gl.enable(gl.BLEND);
      gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      for (const { object, part } of parts) if (part.material.blends === blends) this.drawPart(object, part, at);
    }
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.frontFace(gl.CCW);
  }

  // Sets up the program of the objects for a view.
  begin(view) {
    const { gl } = this;
    const at = this.use('object');
    gl.uniformMatrix3fv(at.to_screen, false, view.toScreen);
    gl.uniform3fv(at.eye, view.at);
    return at;
  }

  drawPart(object, part, at) {
    const { gl } = this;
    const { material } = part;
    const matrix = this.matrixOf(part, object);
    this.pose(part, object.pose);
    gl[material.isDouble ? 'disable' : 'enable'](gl.CULL_FACE);
    gl[material.cutoff || (this.isCovered && !material.blends) ? 'enable' : 'disable'](gl.SAMPLE_ALPHA_TO_COVERAGE);
    gl.frontFace(turnsOver(matrix) ? gl.CW : gl.CCW);
    this.bind(1, object.mirror ?? null, gl.TEXTURE_CUBE_MAP);
    this.bind(0, part.texture ?? null);
    gl.uniformMatrix4fv(at.to_world, false, matrix);
    gl.uniform1f(at.part, object.pose.part);
    gl.uniform3fv(at['terms[0]'], object.light.terms);
    gl.uniform1i(at.neutral, object.light.neutral);
    gl.uniform1i(at.has_mirror, Boolean(object.mirror));
    gl.uniform1i(at.has_page, Boolean(part.texture));
    gl.uniform4fv(at.base, material.base);
    gl.uniform2f(at.kind, material.metal, material.rough);
    gl.uniform3fv(at.emitted, material.emitted.map((value) => value * object.light.exposure));
    gl.uniform1f(at.cutoff, material.cutoff);
    gl.uniform1i(at.blends, material.blends);
    gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
  }

  // Multiplies the triangles near the objects with what remains of their light, each sample once per object: triangles
  // that overlap are not darkened twice.
  shade(objects, view) {
    const { gl } = this;
    const { toScreen, at: eye, part } = view;
    const at = this.use('shade');
    gl.uniformMatrix3fv(at.to_screen, false, toScreen);
    gl.uniform3fv(at.eye, eye);
    gl.uniform1i(at.is_sky, false);
    for (const [unit, name] of ['page', 'from_sun', 'from_above'].entries()) gl.uniform1i(at[name], unit);
    gl.enable(gl.CULL_FACE);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.REPLACE);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.ZERO, gl.SRC_COLOR, gl.ZERO, gl.ONE);
    gl.depthMask(false);
    for (const [i, object] of objects.entries()) {
      const own = partOf(object.within, view);
      if (own[2] === 0 || own[3] === 0) continue;
      gl.scissor(...own);
      gl.stencilFunc(gl.NOTEQUAL, 1 + (i % 255), 0xff);
      this.shadeBelow(object, at);
    }
    gl.scissor(...part);
    gl.disable(gl.STENCIL_TEST);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
  }

  setShade({ matrices, light: { sun, neutral }, radius, reach, spread }, at) {
    const { gl } = this;
    gl.uniformMatrix4fv(at.to_sun, false, matrices[0]);
    gl.uniformMatrix4fv(at.to_above, false, matrices[1]);
    gl.uniform3fv(at.toward, sun.toward);
    gl.uniform3fv(at.sun, sun.sun);
    gl.uniform3fv(at.ambient, sun.ambient);
    gl.uniform1i(at.neutral, neutral);
    gl.uniform1f(at.size, 2 * MARGIN * radius);
    gl.uniform1f(at.deep, 2 * radius);
    gl.uniform2fv(at.spread, spread);
    gl.uniform2f(at.soft, 0.004, 0.4 * radius);
    gl.uniform2fv(at.reach, reach);
  }

  shadeBelow(object, at) {
    const { gl } = this;
    const { darker, maps } = object;
    this.setShade(object, at);
    this.bind(2, maps[1]);
    this.bind(1, maps[0]);
    for (const { mesh, array, count } of darker) {
      this.bind(0, mesh.texture);
      gl[mesh.cutoff ? 'enable' : 'disable'](gl.SAMPLE_ALPHA_TO_COVERAGE);
      gl.uniform1f(at.cutoff, mesh.cutoff);
      gl.uniform4fv(at.place, mesh.place);
      gl.uniformMatrix4fv(at.to_world, false, mesh.matrix);
      gl.bindVertexArray(array);
      gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
    }
  }

  freeObject(object) {
    const { gl } = this;
    this.freeList(object);
    for (const { array, buffers } of object.parts ?? []) {
      gl.deleteVertexArray(array);
      buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    }
    for (const texture of [...(object.textures ?? []), ...(object.maps ?? []), object.mirror]) if (texture) gl.deleteTexture(texture);
  }

  free() {
    const { gl } = this;
    this.small.freeTargets();
    gl.deleteFramebuffer(this.target);
    for (const { program } of Object.values(this.programs)) gl.deleteProgram(program);
  }
}
