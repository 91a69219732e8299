// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A small layered scene.
#pragma once
#include "ods/layers/layered_scene.h"

namespace ods {

// A smooth texture, which every codec stores well; the colours of two numbers differ. Alpha is 1 in the middle.
inline Image gradient(int size, int channels, int number) {
  Image image(size, size, channels);
  for (int y = 0; y < size; y++) {
    for (int x = 0; x < size; x++) {
      const float u = (float(x) + 0.5f) / float(size), v = (float(y) + 0.5f) / float(size);
      float* texel = image.at(x, y);
      texel[0] = u, texel[1] = v, texel[2] = 0.1f * float(number + 1);
      if (channels == 4) texel[3] = glm::length(vec2(u, v) - 0.5f) < 0.4f ? 1.0f : 0.0f;
    }
  }
  return image;
}

// A square of n x n squares of two triangles each, seen from the side where `right` x `up` points, with the whole
// texture.
inline LayerMesh square(LayerKind kind, vec3 middle, vec3 right, vec3 up, int n, int number) {
  LayerMesh mesh;
  mesh.kind = kind;
  mesh.noun = kind == LayerKind::kMasked    ? "charts"
              : kind == LayerKind::kBlended ? "panes"
              : kind == LayerKind::kSky     ? "sky"
                                            : "page";
  mesh.texture = gradient(64, has_alpha(kind) ? 4 : 3, number);
  for (int j = 0; j <= n; j++) {
    for (int i = 0; i <= n; i++) {
      const vec2 uv = vec2(i, j) / float(n);
      mesh.positions.push_back(middle + (2.0f * uv.x - 1.0f) * right + (1.0f - 2.0f * uv.y) * up);
      mesh.uvs.push_back(uv);
    }
  }
  for (uint j = 0; j < uint(n); j++) {
    for (uint i = 0; i < uint(n); i++) {
      const uint a = j * uint(n + 1) + i, b = a + 1, c = a + uint(n + 1), d = c + 1;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  }
  return mesh;
}

// A room of 4 x 3 x 5 m without its ceiling and one wall, a masked leaf in it, and the sky as two faces of a cube; the
// box in its middle is not at the origin.
inline LayeredScene layered_box() {
  LayeredScene scene;
  scene.box.center = vec3(1.1f, 1.4f, -2.3f);
  scene.box.size = vec3(0.3f, 0.3f, 0.4f);
  scene.yaw = 30.0f;
  scene.fallback = "box_360_TB.png";
  scene.name = "a room.glb";
  scene.light.exposure = 0.5f;
  scene.light.tone = ToneCurve::kLinear;
  LightProbes& probes = scene.light.probes;
  probes.origin = vec3(-0.5f, 0.25f, -4.0f);
  probes.step = vec3(1.5f, 1.0f, 1.25f);
  probes.count = {3, 2, 4};
  for (int i = 0; i < 24; i++) {
    LightProbe& probe = probes.probes.emplace_back();
    probe.weight = i % 5 == 0 ? 0.0f : 1.0f;
    probe.radiance[0] = vec3(float(i), 2.0f, 3.0f) * probe.weight;
    probe.radiance[8] = vec3(-0.25f, 0.5f, float(-i)) * probe.weight;
  }
  const vec3 c = scene.box.center, x(1.0f, 0.0f, 0.0f), y(0.0f, 1.0f, 0.0f), z(0.0f, 0.0f, 1.0f);
  using enum LayerKind;
  scene.meshes.push_back(square(kOpaque, c - 2.5f * z, 2.0f * x, 1.5f * y, 4, 0));   // in front
  scene.meshes.push_back(square(kOpaque, c + 2.0f * x, 2.5f * z, 1.5f * y, 4, 1));   // at the right
  scene.meshes.push_back(square(kOpaque, c - 2.0f * x, -2.5f * z, 1.5f * y, 4, 2));  // at the left
  scene.meshes.push_back(square(kOpaque, c - 1.5f * y, 2.0f * x, -2.5f * z, 4, 3));  // the floor
  scene.meshes.push_back(square(kMasked, c + vec3(0.3f, 0.1f, -0.8f), 0.2f * x, 0.2f * y, 2, 4));
  scene.meshes.push_back(square(kSky, y, x, z, 1, 5));
  scene.meshes.push_back(square(kSky, z, -x, y, 1, 6));
  return scene;
}

}  // namespace ods
