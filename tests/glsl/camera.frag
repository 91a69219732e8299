// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera on WebGL 2: compiled by the tests so that it stays valid GLSL ES 3.00. WebGL has no #include, so a C
// preprocessor comes first; the version line is added behind it.
precision highp float;
precision highp int;
#define inline
#include "ods/kernel/camera/angles.h"
#include "ods/kernel/camera/merge.h"
#include "ods/kernel/camera/projection.h"
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/camera/line.h"
#include "ods/kernel/camera/project.h"

uniform Camera camera;
uniform sampler2D merge_map;
uniform sampler2D head_tilt_map;
in vec2 uv;
out vec4 color;

float camera_map_texel(Camera a_camera, int which, int i) {
  int width = which == kMapOfMerge ? a_camera.merge_map.width : a_camera.head_tilt_map.width;
  ivec2 at = ivec2(i % width, i / width);
  return which == kMapOfMerge ? texelFetch(merge_map, at, 0).x : texelFetch(head_tilt_map, at, 0).x;
}

void main() {
  Ray ray = camera_ray(camera, kLeft, uv, uv, vec2(0.0));
  color = vec4(ray.origin + ray.direction, project_point(camera, kLeft, ray.origin + ray.direction).depth);
  color.xy += place_of_line(camera, kLeft, ray.direction).uv;
}
