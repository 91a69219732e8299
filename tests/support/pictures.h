// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders small pictures in tests, and examines them.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numbers>

#include "ods/picture/picture.h"
#include "ods/render/render_options.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace ods {

// One eye in the middle, box filter.
inline RenderOptions small_render(int width, int samples) {
  RenderOptions options;
  options.width = width;
  options.samples = samples;
  options.eyes = Eyes::kMonoEye;
  options.filter = PixelFilter::kBox;
  options.even_noise = false;
  return options;
}

// Every pixel's first channel; pixels are independent of each other.
inline Mean mean_of(const Image& image) {
  Mean mean;
  for (size_t i = 0; i < image.pixels.size(); i += static_cast<size_t>(image.channels)) {
    mean.add(double{image.pixels[i]});
  }
  return mean;
}

// The mean of a function of the direction over a pixel of the unturned mono camera.
inline double pixel_mean(int width, int x, int y, const std::function<double(glm::dvec3)>& value) {
  const int n = 16;
  const double pi = std::numbers::pi;
  double sum = 0.0;
  for (int i = 0; i < n * n; i++) {
    const double theta = 2.0 * pi * ((x + (i % n + 0.5) / n) / width - 0.5);
    const double phi = pi * (0.5 - (y + (i / n + 0.5) / n) / (width / 2));
    sum += value({std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi)});
  }
  return sum / (n * n);
}

// FNV-1a over the bits of every pixel of every layer.
inline uint64_t digest(const Picture& picture) {
  uint64_t hash = 14695981039346656037u;
  for (const EyeImage& eye : picture.eyes) {
    for (const Image* image : {&eye.radiance, &eye.depth, &eye.normal, &eye.albedo, &eye.variance, &eye.samples}) {
      for (float value : image->pixels) {
        uint32_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        for (int i = 0; i < 4; i++) hash = (hash ^ ((bits >> (8 * i)) & 255u)) * 1099511628211u;
      }
    }
  }
  return hash;
}

// A scene with every feature of the kernel: every kind of light and lobe, alpha, a volume, textures, mirrored
// instances.
inline Scene feature_scene() {
  Scene scene;
  Dice dice(1);
  scene.environment = {vec3(0.5f), 8, 4, {}};
  for (int i = 0; i < 32; i++) scene.environment.texels.push_back(vec3(dice.pair(), 0.5f));
  scene.textures.push_back({0, 4, 4, kWrapRepeat, kWrapMirror, 1, 0, kTexelBytes});
  for (int i = 0; i < 16; i++) scene.texels.push_back(static_cast<uint>(dice.engine()) | 0x80000000u);
  Material checker = default_material();
  checker.base_color_slot.texture = 0;
  checker.roughness = 0.4f;
  const int floor = add_material(scene, checker);
  Material glass = default_material();
  glass.transmission = glass.thickness = 1.0f;
  glass.attenuation_color = vec3(0.5f, 0.9f, 0.7f);
  glass.attenuation_distance = 0.3f;
  glass.roughness = 0.0f;
  Material frosted = glass;
  frosted.roughness = 0.4f;
  Material gold = default_material();
  gold.metallic = 1.0f;
  gold.roughness = 0.2f;
  gold.base_color = vec4(1.0f, 0.8f, 0.4f, 1.0f);
  Material veil = default_material();
  veil.alpha_mode = kAlphaBlend;
  veil.base_color = vec4(0.9f, 0.2f, 0.2f, 0.5f);
  Material lamp = default_material();
  lamp.emission = vec3(5.0f, 4.0f, 3.0f);
  add_rectangle(scene, vec3(-4, -1, 4), vec3(8, 0, 0), vec3(0, 0, -8), floor);
  add_sphere(scene, vec3(-1, -0.4f, -2), 0.5f, add_material(scene, glass), 12);
  add_sphere(scene, vec3(0.2f, -0.4f, -2), 0.5f, add_material(scene, frosted), 12);
  const int ball = add_sphere(scene, vec3(1.4f, -0.4f, -2), 0.5f, add_material(scene, gold), 12);
  glm::mat4 mirrored(1.0f);
  mirrored[0][0] = -1.0f;
  mirrored[3] = vec4(0.0f, -0.4f, 2.0f, 1.0f);
  add_instance(scene, ball, mirrored);
  add_rectangle(scene, vec3(-3, -1, -3), vec3(2, 0, 0), vec3(0, 2, 0), add_material(scene, veil));
  add_rectangle(scene, vec3(-1, 2, -3), vec3(1, 0, 0), vec3(0, 0, 1), add_material(scene, lamp));
  PunctualLight light;
  light.position = vec3(2.0f, 1.0f, 1.0f);
  scene.lights.push_back(light);
  light.kind = kLightSpot;
  light.direction = normalize(vec3(-1.0f, -1.0f, -1.0f));
  scene.lights.push_back(light);
  light.kind = kLightDirectional;
  scene.lights.push_back(light);
  return scene;
}

}  // namespace ods
