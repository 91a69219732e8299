// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A stereo picture around the scene of another renderer (three.js): each pixel finds its place in an eye's picture with
// the kernel's formulas. The filter is the GPU's own. The build prepares this file like panorama.glsl.
precision highp float;
precision highp int;
#define inline
#include "ods/kernel/camera/angles.h"
#include "ods/kernel/camera/merge.h"
#include "ods/kernel/camera/projection.h"
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/camera/line.h"

uniform Camera camera;
uniform sampler2D merge_texels;
uniform sampler2D head_tilt_texels;
uniform sampler2D picture;  // both eyes
uniform vec4 part;          // of the picture that is the eye's: left, top, width, height
uniform int side;           // the eye; 2 for a picture of one eye
uniform bool is_upside_down;  // the first row of the texture is the lowest
uniform int transfer;         // -1: code values become linear light; 1: linear light becomes code values
in vec3 direction;            // in the picture's frame
out vec4 color;

float camera_map_texel(Camera a_camera, int which, int i) {
  int width = which == kMapOfMerge ? a_camera.merge_map.width : a_camera.head_tilt_map.width;
  ivec2 at = ivec2(i % width, i / width);
  return which == kMapOfMerge ? texelFetch(merge_texels, at, 0).x : texelFetch(head_tilt_texels, at, 0).x;
}

vec3 encoded(vec3 light) {
  return mix(1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, 12.92 * light, vec3(lessThanEqual(light, vec3(0.0031308))));
}

vec3 decoded(vec3 code) {
  return mix(pow((code + 0.055) / 1.055, vec3(2.4)), code / 12.92, vec3(lessThanEqual(code, vec3(0.04045))));
}

// Texels of the eye's picture over a radian, near its middle.
float density(vec2 eye) {
  int kind = camera.projection.kind;
  if (has_range(kind)) return eye.x / camera.projection.span.x;
  if (is_cube(kind)) return eye.x / (float(cube_columns(kind)) * 0.5 * kPi);
  return eye.x / camera.projection.angle;
}

void main() {
  vec3 line = normalize(direction);
  float pixel = max(length(dFdx(line)), length(dFdy(line)));  // radians
  ImagePoint point = place_of_line(camera, side, line);
  color = vec4(0.0, 0.0, 0.0, 1.0);
  if (!point.seen) return;
  // Half a texel inside, because the next eye begins at the edge.
  vec2 eye = part.zw * vec2(textureSize(picture, 0));
  vec2 margin = 0.5 / eye;
  vec2 uv = part.xy + part.zw * clamp(point.uv, margin, 1.0 - margin);
  if (is_upside_down) uv.y = 1.0 - uv.y;
  vec3 found = textureLod(picture, uv, log2(max(pixel * density(eye), 1.0))).rgb;
  if (transfer > 0) found = encoded(found);
  if (transfer < 0) found = decoded(found);
  color.rgb = found;
}
