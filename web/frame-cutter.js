// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves a video's current frame, or a picture of light, into the textures of its eyes without leaving the GPU. What a view
// does not need of a frame is not made: the other eye, and mip levels of a picture that is magnified.
import { compile } from './panorama.js';
import { LEVELS } from './tiles.js';

// Copies an eye of a video's frame into a layer. Rendering into an sRGB texture encodes, so it decodes first. A frame of
// light has the high bytes of its halves in its left half, and the low ones in its right half.
const CUT = `#version 300 es
precision highp float;
precision highp int;
uniform sampler2D frame;
uniform ivec4 crop;    // the eye's part of the frame: x, y, width, height
uniform ivec2 origin;  // position of the layer in the eye's picture
uniform bool wraps;
uniform bool light;
in vec2 screen;
out vec4 color;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) + origin;
  at = ivec2(wraps ? (at.x % crop.z + crop.z) % crop.z : clamp(at.x, 0, crop.z - 1), clamp(at.y, 0, crop.w - 1));
  vec3 s = texelFetch(frame, crop.xy + at, 0).rgb;
  if (light) {
    uvec3 high = uvec3(s * 255.0 + 0.5);
    uvec3 low = uvec3(texelFetch(frame, crop.xy + at + ivec2(textureSize(frame, 0).x / 2, 0), 0).rgb * 255.0 + 0.5);
    uvec3 bits = high * 256u + low;
    color = vec4(unpackHalf2x16(bits.r).x, unpackHalf2x16(bits.g).x, unpackHalf2x16(bits.b).x, 1.0);
    return;
  }
  color = vec4(mix(pow((s + 0.055) / 1.055, vec3(2.4)), s / 12.92, vec3(lessThanEqual(s, vec3(0.04045)))), 1.0);
}`;

export class FrameCutter {
  constructor(gl, light = false) {
    this.gl = gl;
    this.light = light;
    this.program = compile(gl, CUT);
    this.at = (name) => gl.getUniformLocation(this.program, name);
    this.frame = gl.createTexture();
    this.target = gl.createFramebuffer();
    this.uncut = this.unlevelled = new Set(); // the eyes that lack a part of the frame
  }

  // frame: a video or an ImageBitmap, for the eyes that prepare() is called for.
  take(frame, eyes) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.frame);
    // With RGBA8, Chromium on a software GPU takes twice the time.
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, frame);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    this.uncut = new Set(eyes);
    this.unlevelled = new Set(eyes);
  }

  // Before an eye is drawn. crop: its part of the frame, [x, y, width, height]; isReduced: a pixel covers several texels.
  prepare(eye, crop, isReduced) {
    const { gl } = this;
    if (this.uncut.delete(eye)) this.cut(eye, crop);
    const levels = isReduced && this.unlevelled.delete(eye);
    eye.bind();
    if (levels) gl.generateMipmap(gl.TEXTURE_2D_ARRAY);
    gl.texParameteri(gl.TEXTURE_2D_ARRAY, gl.TEXTURE_MAX_LEVEL, this.unlevelled.has(eye) ? 0 : LEVELS - 1);
  }

  cut(eye, crop) {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.frame);
    gl.useProgram(this.program);
    gl.uniform1i(this.at('light'), this.light);
    gl.uniform4iv(this.at('crop'), crop);
    gl.uniform1i(this.at('wraps'), eye.wraps);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.target);
    gl.viewport(0, 0, ...eye.layer);
    eye.tiles.forEach((origin, layer) => {
      gl.framebufferTextureLayer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, eye.texture, 0, layer);
      gl.uniform2iv(this.at('origin'), origin);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  free() {
    this.gl.deleteTexture(this.frame);
    this.gl.deleteFramebuffer(this.target);
    this.gl.deleteProgram(this.program);
  }
}
