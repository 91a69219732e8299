// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The camera on WebGL 2: compiled by the tests so that it stays valid GLSL ES 3.00. WebGL has no #include, so a C
// preprocessor comes first; the version line is added behind it.
precision highp float;
precision highp int;
#define inline
#include "ods/kernel/camera/merge.h"
#include "ods/kernel/camera/projection.h"
#include "ods/kernel/camera/camera.h"
#include "ods/kernel/camera/project.h"

uniform Camera camera;
uniform sampler2D merge_map;
in vec2 uv;
out vec4 color;

float merge_map_texel(Camera a_camera, int i) {
  return texelFetch(merge_map, ivec2(i % a_camera.map_width, i / a_camera.map_width), 0).x;
}

void main() {
  Ray ray = camera_ray(camera, kLeft, uv, uv, vec2(0.0));
  color = vec4(ray.origin + ray.direction, project_point(camera, kLeft, ray.origin + ray.direction).depth);
}
