// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/denoise/other_view.h"

#include <algorithm>
#include <cmath>

#include "ods/kernel/camera/project.h"

namespace ods {

static float nearness_at(const EyeImage& eye, size_t pixel) {
  const float depth = eye.depth.pixels[pixel];
  return depth > 0.0f && depth < kFarDepth ? 1.0f / depth : 0.0f;  // also rejects NaN
}

static vec2 size_of(const NoisyPicture& noisy) {
  return {static_cast<float>(noisy.width()), static_cast<float>(noisy.height())};
}

// The change of nearness from a pixel to the next on one surface: the smaller of the steps to both sides.
static float step_at(const NoisyView& view, const Cell& cell, int x, int y, bool down) {
  const NoisyPicture& noisy = view.noisy;
  const float here = nearness_at(noisy.eye(view.eye), noisy.index(x, y));
  float minimum = 1e30f;
  for (const int way : {-1, 1}) {
    const int nx = down ? x : x + way, ny = down ? y + way : y;
    const auto next = neighbour_of(noisy, view.eye, cell, nx, ny);
    if (!next) continue;
    minimum =
        std::min(minimum, std::abs(nearness_at(noisy.eye(next->source_eye), noisy.index(next->x, next->y)) - here));
  }
  return minimum < 1e30f ? minimum : 0.0f;
}

std::optional<vec3> surface_at(const NoisyPicture& noisy, int eye, int x, int y) {
  const float nearness = nearness_at(noisy.eye(eye), noisy.index(x, y));
  if (nearness == 0.0f) return {};
  const vec2 uv = (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / size_of(noisy);
  const Ray ray = camera_ray(noisy.camera, noisy.eye(eye).eye, uv);
  return ray.origin + ray.direction * (1.0f / nearness);
}

std::optional<ViewPlace> place_in_view(const NoisyView& view, vec3 surface) {
  const NoisyPicture& noisy = view.noisy;
  const ImagePosition found = project_point(noisy.camera, noisy.eye(view.eye).eye, surface);
  if (!found.seen) return {};
  ViewPlace place{found.uv * size_of(noisy), {}};
  place.cell = cell_of(noisy.camera.projection, noisy.shape.size, place.at);
  const int px = std::clamp(static_cast<int>(place.at.x), 0, noisy.width() - 1);
  const int py = std::clamp(static_cast<int>(place.at.y), 0, noisy.height() - 1);
  const float there = nearness_at(noisy.eye(view.eye), noisy.index(px, py)), expected = 1.0f / found.depth;
  const float slack = 0.02f * std::max(there, expected) +
                      0.7f * (step_at(view, place.cell, px, py, false) + step_at(view, place.cell, px, py, true));
  if (std::abs(there - expected) > slack) return {};
  return place;
}

}  // namespace ods
