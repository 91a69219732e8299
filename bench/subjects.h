// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The scenes of benchmarks, and the price of a picture: its CPU time and its noise.
//
// The shared scenes have no light of their own and get a white sky of 1. If they are missing, the built-in fractal
// replaces them. Built-in scenes have their own light and viewpoint.
#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "ods/image/tone.h"
#include "ods/picture/picture.h"
#include "ods/render/render_options.h"
#include "ods/scene/load/load.h"
#include "tests/support/places.h"

struct Subject {
  const char* name;
  const char* file = "";  // below shared_scenes(); empty for the built-in scene of that name
  ods::vec3 position{0.0f};
  double noise = 0.0;  // target RMSE of the equal-noise figure

  bool is_builtin() const { return !*file; }
  std::string path() const { return ods::shared_scenes() + "/" + file; }
};

inline constexpr Subject kAtrium{"atrium", "atrium.glb", {0.0f, 1.6f, 0.0f}, 0.005};
inline constexpr Subject kHelmet{"helmet", "DamagedHelmet.glb", {0.0f, 0.0f, 1.5f}, 0.002};

inline ods::Scene load(const Subject& subject) {
  if (subject.is_builtin()) return ods::load_scene(subject.name, {});
  ods::Scene scene = ods::load_scene(std::filesystem::exists(subject.path()) ? subject.path() : "fractal", {});
  scene.environment = ods::Environment();
  scene.environment.radiance = ods::vec3(1.0f);
  return scene;
}

inline ods::StereoCamera camera_of(const Subject& subject, const ods::Scene& scene) {
  ods::StereoCamera stereo;
  stereo.position = subject.is_builtin() ? ods::default_view(scene).position : subject.position;
  return stereo;
}

inline ods::RenderOptions options_of(int width, int samples) {
  ods::RenderOptions options;
  options.width = width;
  options.samples = samples;
  options.filter = ods::PixelFilter::kBox;
  options.even_noise = false;  // every pixel counts the same
  options.layers = false;
  return options;
}

// The light values to compare: unchanged, or as displayed.
using LightView = float (*)(float light);
inline float linear(float light) {
  return light;
}
inline float shown(float light) {
  return ods::srgb_encode(std::clamp(light, 0.0f, 1.0f));
}

// RMS over all eyes' red, green and blue.
inline double difference(const ods::Picture& a, const ods::Picture& b, LightView view = linear) {
  double sum = 0.0;
  size_t count = 0;
  for (size_t eye = 0; eye < a.eyes.size(); eye++) {
    const ods::Image &p = a.eyes[eye].radiance, &q = b.eyes[eye].radiance;
    for (int i = 0; i < p.width * p.height; i++) {
      const float *one = p.at(i % p.width, i / p.width), *other = q.at(i % p.width, i / p.width);
      for (int c = 0; c < 3; c++) sum += std::pow(double{view(one[c])} - double{view(other[c])}, 2.0);
    }
    count += 3 * static_cast<size_t>(p.width) * static_cast<size_t>(p.height);
  }
  return std::sqrt(sum / static_cast<double>(count));
}

// Variance is inversely proportional to the time, so their product is the price.
struct Price {
  double seconds = 0.0;  // CPU time of a picture
  double variance = 0.0;
  double shown_variance = 0.0;
  double samples = 0.0;  // per pixel, on average
  double product() const { return seconds * variance; }
};

// Computes the price from two pictures with different seeds, made in this time. They differ by twice the variance of
// each.
inline Price price_of(const ods::Picture& a, const ods::Picture& b, double seconds) {
  const ods::Image& one = a.eyes[0].radiance;
  const double pixels = 1.0 * one.width * one.height * static_cast<double>(a.eyes.size());
  return {0.5 * seconds, 0.5 * std::pow(difference(a, b), 2.0), 0.5 * std::pow(difference(a, b, shown), 2.0),
          a.samples_taken / pixels};
}

inline Price price_of(ods::RenderOptions options,
                      const std::function<ods::Picture(const ods::RenderOptions& options)>& render) {
  std::vector<ods::Picture> pictures;
  const double start = cpu_seconds();
  for (const uint32_t seed : {1u, 2u}) {
    options.seed = seed;
    pictures.push_back(render(options));
  }
  return price_of(pictures[0], pictures[1], cpu_seconds() - start);
}
