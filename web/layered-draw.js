// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Draws the triangles of a layered scene with WebGL 2: each eye into a target of its own with four samples a pixel and
// with depth, which the canvas lacks, and from there onto the canvas or into the headset, in the mode of the viewer.
import { inverse } from './headset-room.js';
import { compile } from './panorama.js';

export const NEAR = 0.02; // metres
const SAMPLES = 4;

// The place of a vertex is the same in all programs, so that what lies on a triangle passes the test of depth.
export const VERTICES = `#version 300 es
uniform mat4 to_world;
uniform mat3 to_screen;
uniform vec3 eye;
uniform bool is_sky;
uniform vec4 place;  // of the texture coordinates: scale, offset
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
out vec2 at;
out vec3 world;
invariant gl_Position;
void main() {
  at = uv * place.xy + place.zw;
  world = (to_world * vec4(position, 1.0)).xyz;
  vec3 p = to_screen * (world - eye);
  gl_Position = vec4(p.xy, is_sky ? 0.0 : p.z - ${2 * NEAR}, p.z);
}`;

// Alpha is coverage where there is a cutoff, with an edge as sharp as a pixel. Glass is blended by straight alpha, in light.
const FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D page;
uniform sampler2D next;  // light that follows,
uniform float part;      // and its share
uniform sampler2D change;  // of a still layer's light (LightChange in ods/layers/layered_scene.h),
uniform sampler2D change_next;
uniform float change_part;
uniform mat4x2 change_place;  // scale, offset, bounds
uniform bool is_changed;
uniform float cutoff;
uniform bool is_blended;
in vec2 at;
out vec4 color;
vec3 ratio(vec3 code) {
  return code / (1.0 - min(code, 0.999)) * (127.0 / 128.0);
}
void main() {
  color = texture(page, at);
  if (part > 0.0) color = mix(color, texture(next, at), part);
  if (is_changed) {
    vec2 p = clamp(at * change_place[0] + change_place[1], change_place[2], change_place[3]);
    vec3 by = mix(ratio(texture(change, p).rgb), ratio(texture(change_next, p).rgb), change_part);
    color.rgb = max((color.rgb + 0.01) * by - 0.01, 0.0);
  }
  if (is_blended) return;
  float edge = fwidth(color.a);
  color.a = cutoff > 0.0 ? clamp((color.a - cutoff) / max(edge, 0.001) + 0.5, 0.0, 1.0) : 1.0;
}`;

// encode() and the matrices are those of panorama.glsl.
const SHOW = `#version 300 es
precision highp float;
uniform sampler2D left;
uniform sampler2D right;
uniform ivec2 corner;
uniform int show;     // the left texture, an anaglyph, the difference
uniform float cover;  // over what is drawn below
uniform float grey;   // the part that is replaced by grey
in vec2 screen;
out vec4 color;
vec3 encode(vec3 light) {
  light = clamp(light, 0.0, 1.0);
  return mix(1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, 12.92 * light, vec3(lessThanEqual(light, vec3(0.0031308))));
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) - corner;
  vec3 a = texelFetch(left, at, 0).rgb;
  vec3 b = texelFetch(right, at, 0).rgb;
  vec3 both = mat3(0.437, -0.062, -0.048, 0.449, -0.062, -0.050, 0.164, -0.024, -0.017) * a +
              mat3(-0.011, 0.377, -0.026, -0.032, 0.761, -0.093, -0.007, 0.009, 1.234) * b;
  color = vec4(show == 2 ? abs(encode(a) - encode(b)) : encode(show == 1 ? both : a), cover);
  color.rgb = mix(color.rgb, vec3(0.1), grey);
}`;

export class LayeredDrawer {
  // other: shares its programs, and frees them.
  constructor(gl, other) {
    this.gl = gl;
    this.mesh = other?.mesh ?? this.named(compile(gl, FRAGMENT, VERTICES));
    this.show = other?.show ?? this.named(compile(gl, SHOW));
    this.size = [0, 0];
  }

  // A program with the places of its uniforms.
  named(program) {
    const { gl } = this;
    const at = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      at[name] = gl.getUniformLocation(program, name);
    }
    return { program, at };
  }

  // A vertex array of a mesh. buffers: { positions, uvs, indices }, as uploaded.
  arrayOf({ positions, uvs, indices }) {
    const { gl } = this;
    const before = gl.getParameter(gl.VERTEX_ARRAY_BINDING);
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    for (const [at, { buffer, components, type, normalized, stride, offset }] of [positions, uvs].entries()) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, components, type, normalized, stride, offset);
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indices.buffer);
    gl.bindVertexArray(before);
    return array;
  }

  // Targets for a view, not much larger than it; the texture of each eye holds light, so that edges are averaged as
  // light.
  fit([width, height]) {
    const { gl, size: [wide, high] } = this;
    this.view = [width, height];
    if (width <= wide && height <= high && 2 * width * height > wide * high) return;
    this.freeTargets();
    this.size = [width, height];
    const storage = (format) => {
      const buffer = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, SAMPLES, format, width, height);
      return buffer;
    };
    this.buffers = [storage(gl.SRGB8_ALPHA8), storage(gl.DEPTH24_STENCIL8)];
    this.target = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    for (const [i, place] of [gl.COLOR_ATTACHMENT0, gl.DEPTH_STENCIL_ATTACHMENT].entries()) {
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, this.buffers[i]);
    }
    this.eyes = [0, 1].map((eye) => {
      const texture = gl.createTexture();
      gl.activeTexture(gl.TEXTURE0 + eye);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.SRGB8_ALPHA8, width, height);
      for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
      const target = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, target);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
      return { texture, target };
    });
  }

  // Draws what an eye sees into the texture of its number. rays: as in panorama.js, in the world; at: the eye's place;
  // middle: the place from which the sky was made; part: of the target, all that is needed. meshes: in their order of
  // drawing. objects: draws more (objects-draw.js). alpha: of what nothing covers.
  drawEye(number, meshes, { rays, at, middle, part, objects, alpha = 1 }) {
    const { gl, view } = this;
    const before = gl.getParameter(gl.VERTEX_ARRAY_BINDING);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.viewport(0, 0, ...view);
    gl.scissor(...part);
    gl.enable(gl.SCISSOR_TEST);
    gl.clearColor(0.01 * alpha, 0.01 * alpha, 0.01 * alpha, alpha); // of light: the grey of an empty page
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    const toScreen = inverse(rays);
    const isPane = ({ isBlended }) => isBlended;
    this.drawMeshes(meshes.filter((mesh) => !isPane(mesh)), { toScreen, at, middle });
    objects?.draw({ toScreen, at, part, size: view });
    this.drawMeshes(meshes.filter(isPane), { toScreen, at, middle });
    for (const each of [gl.DEPTH_TEST, gl.CULL_FACE, gl.SAMPLE_ALPHA_TO_COVERAGE, gl.BLEND]) gl.disable(each);
    gl.depthMask(true);
    gl.bindVertexArray(before);
    this.resolve(this.eyes[number].target);
    gl.disable(gl.SCISSOR_TEST);
  }

  drawMeshes(meshes, { toScreen, at, middle }) {
    const { gl, mesh: { program, at: uniforms } } = this;
    gl.useProgram(program);
    gl.enable(gl.CULL_FACE);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ZERO, gl.ONE);
    gl.uniformMatrix3fv(uniforms.to_screen, false, toScreen);
    ['next', 'change', 'change_next'].forEach((name, i) => gl.uniform1i(uniforms[name], i + 1));
    for (const { array, texture, next = texture, part = 0, change, matrix, cutoff, isBlended, isSky, place, indices: { count, type, offset } } of meshes) {
      gl[isSky ? 'disable' : 'enable'](gl.DEPTH_TEST);
      gl[cutoff ? 'enable' : 'disable'](gl.SAMPLE_ALPHA_TO_COVERAGE);
      gl[isBlended ? 'enable' : 'disable'](gl.BLEND);
      gl.depthMask(!isBlended);
      gl.uniform1f(uniforms.cutoff, cutoff);
      gl.uniform1i(uniforms.is_blended, isBlended);
      gl.uniform1i(uniforms.is_sky, isSky);
      gl.uniform3fv(uniforms.eye, isSky ? middle : at);
      gl.uniform4fv(uniforms.place, place);
      gl.uniformMatrix4fv(uniforms.to_world, false, matrix);
      gl.uniform1f(uniforms.part, part);
      gl.uniform1i(uniforms.is_changed, Boolean(change));
      if (change) {
        gl.uniform1f(uniforms.change_part, change.part);
        gl.uniformMatrix4x2fv(uniforms.change_place, false, change.place);
      }
      [change?.next, change?.now, next, texture].forEach((each, i) => {
        gl.activeTexture(gl.TEXTURE3 - i);
        gl.bindTexture(gl.TEXTURE_2D, each ?? null);
      });
      gl.bindVertexArray(array);
      gl.drawElements(gl.TRIANGLES, count, type, offset);
    }
  }

  // Averages the samples; the tiles of a headset's GPU need not be written to memory.
  resolve(target) {
    const { gl, view } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.target);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, target);
    gl.blitFramebuffer(0, 0, ...view, 0, 0, ...view, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.invalidateFramebuffer(gl.READ_FRAMEBUFFER, [gl.COLOR_ATTACHMENT0, gl.DEPTH_STENCIL_ATTACHMENT]);
  }

  // Shows the eyes' textures in a box of a target. show: 0 for the first one, 1 for an anaglyph, 2 for the difference.
  showEyes({ box, clip, target, show, cover, grey }) {
    const { gl, show: { program, at: uniforms } } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(...box);
    gl.scissor(...clip);
    gl.enable(gl.SCISSOR_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(program);
    for (const [i, { texture }] of this.eyes.entries()) {
      gl.activeTexture(gl.TEXTURE0 + i);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.uniform1i(uniforms[i ? 'right' : 'left'], i);
    }
    gl.uniform2iv(uniforms.corner, box.slice(0, 2));
    gl.uniform1i(uniforms.show, show);
    gl.uniform1f(uniforms.cover, cover);
    gl.uniform1f(uniforms.grey, grey);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.disable(gl.BLEND);
    gl.disable(gl.SCISSOR_TEST);
  }

  freeTargets() {
    const { gl, buffers = [], eyes = [], target } = this;
    buffers.forEach((buffer) => gl.deleteRenderbuffer(buffer));
    for (const { texture, target: own } of eyes) {
      gl.deleteTexture(texture);
      gl.deleteFramebuffer(own);
    }
    if (target) gl.deleteFramebuffer(target);
  }

  free() {
    this.freeTargets();
    for (const { program } of [this.mesh, this.show]) this.gl.deleteProgram(program);
  }
}
