// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Views of scenes for eyes in the head box, and how alike two of them are.
#pragma once
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <string>
#include <vector>

#include "bench/subjects.h"
#include "ods/layers/layered_scene.h"
#include "ods/render/cpu/embree_scene.h"
#include "ods/render/lights.h"
#include "ods/scene/builtin/builder.h"

namespace ods {

inline constexpr int kGrid = 4;  // x kGrid samples of a pixel
inline constexpr vec3 kSky(0.5f, 0.6f, 0.7f);

// The unlit colours that rays meet.
class Colours {
 public:
  explicit Colours(const Scene& scene) : embree_(scene), lights_(without_lights(scene)) {
    set_scene(tracer_, scene, lights_);
    tracer_.ray_time = 0.5f;
  }

  // one_sided: surfaces are invisible from behind. Sets whether the ray meets anything.
  vec3 at(Ray ray, bool one_sided, bool& met, float* distance = nullptr) const {
    const vec3 from = ray.origin;
    PathTracer tracer = tracer_;
    for (int passed = 0; passed < 64; passed++) {
      tracer.start_path(ray, no_media(), 0u, 0u);
      const Hit hit = embree_.closest_hit(tracer, ray, kHalfAlphaRay);
      met = hit.t >= 0.0f;
      if (!met) return kSky;
      const Surface surface = tracer.surface_at(hit, ray.direction, false);
      if (distance) *distance = length(surface.position - from);
      if (surface.front || !one_sided) return surface.base_color;
      ray.origin = offset_point(surface.position, -surface.geometric);
    }
    return kSky;
  }

 private:
  EmbreeScene embree_;
  LightTable lights_;
  PathTracer tracer_;
};

struct Likeness {
  double squares = 0.0;
  size_t off = 0, holes = 0, pixels = 0, samples = 0;
  double decibels() const { return -10.0 * std::log10(squares / (3.0 * static_cast<double>(pixels))); }
  std::string text() const {
    return fmt::format("{:5.2f} dB, off {:.2f} %, holes {:.3f} %", decibels(),
                       100.0 * static_cast<double>(off) / static_cast<double>(pixels),
                       100.0 * static_cast<double>(holes) / static_cast<double>(samples));
  }
};

inline void save_ppm(const std::string& name, int size, const std::vector<vec3>& pixels) {
  std::ofstream file(name, std::ios::binary);
  file << "P6 " << size << " " << size << " 255\n";
  for (const vec3& p : pixels) {
    for (int c = 0; c < 3; c++) file.put(static_cast<char>(std::lrint(255.0f * shown(p[c]))));
  }
}

struct Pose {
  vec3 eye;
  glm::mat3 turn;
};

inline std::vector<Pose> poses_in(const HeadBox& box, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(-0.5f, 0.5f);
  std::vector<Pose> poses;
  for (int pose = 0; pose < count; pose++) {
    const vec3 eye = box.center + vec3(any(random), any(random), any(random)) * box.size;
    const glm::mat4 around = glm::rotate(glm::mat4(1.0f), 2.399963f * static_cast<float>(pose), vec3(0, 1, 0));
    poses.push_back({eye, glm::mat3(glm::rotate(around, 0.8f * any(random), vec3(1, 0, 0)))});
  }
  return poses;
}

// The ray through a point of a pose's view, 0..1 to the right and downwards.
inline Ray ray_at(const Pose& pose, float x, float y) {
  return {pose.eye, pose.turn * normalize(vec3(x * 2 - 1, 1 - y * 2, -1.0f))};
}

// The ray of one of the samples of a pixel.
inline Ray sample_ray(const Pose& pose, int size, int x, int y, int sample) {
  const auto at = [&](int pixel, int k) {
    return (static_cast<float>(pixel) + (static_cast<float>(k) + 0.5f) / kGrid) / static_cast<float>(size);
  };
  return ray_at(pose, at(x, sample % kGrid), at(y, sample / kGrid));
}

// One pose: its pixels by a function from a ray to a colour.
template <typename Look>
inline std::vector<vec3> view_from(const Pose& pose, int size, const Look& look) {
  std::vector<vec3> pixels(static_cast<size_t>(size * size));
  tbb::parallel_for(0, size, [&](int y) {
    for (int x = 0; x < size; x++) {
      vec3 sum(0.0f);
      for (int k = 0; k < kGrid * kGrid; k++) sum += look(sample_ray(pose, size, x, y, k));
      pixels[static_cast<size_t>(y * size + x)] = sum / static_cast<float>(kGrid * kGrid);
    }
  });
  return pixels;
}

inline void compare(const std::vector<vec3>& truth, const std::vector<vec3>& pixels, Likeness& likeness) {
  for (size_t i = 0; i < truth.size(); i++) {
    float most = 0.0f;
    for (int c = 0; c < 3; c++) {
      const float error = shown(truth[i][c]) - shown(pixels[i][c]);
      likeness.squares += double{error} * double{error};
      most = std::max(most, std::abs(error));
    }
    likeness.pixels++;
    if (most > 0.1f) likeness.off++;
  }
}

// Thin glass, upright, ahead and to the right of the box.
inline void add_pane(const HeadBox& box, Scene& scene) {
  Material sheet = glass(1.5f);
  sheet.thickness = 0.0f;
  sheet.double_sided = 1;
  const vec3 along = normalize(vec3(1.0f, 0.0f, 0.5f));
  add(scene, make_quad(box.center + vec3(0.0f, -0.6f, -1.0f), 0.9f * along, vec3(0, 1.1f, 0)),
      add_material(scene, sheet));
}

inline HeadBox box_in(const std::string& name, const Scene& scene) {
  HeadBox box;
  box.center = name == "atrium" ? kAtrium.position : name == "helmet" ? kHelmet.position : default_view(scene).position;
  return box;
}

inline Scene scene_named(const std::string& name) {
  const std::string base = name.substr(0, name.find('+'));
  Scene scene = base == "atrium" ? load(kAtrium) : base == "helmet" ? load(kHelmet) : load_scene(base, {});
  if (base != name) add_pane(box_in(base, scene), scene);
  return scene;
}

}  // namespace ods
