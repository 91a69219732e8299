// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/simulated_camera.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ods/image/tone.h"
#include "ods/picture/save.h"
#include "tests/support/exact_projection.h"

namespace ods {

// The direction that a lens sees at `at`, in units of its radius from its centre, y downwards.
static vec3 direction_at(const FisheyeLens& lens, vec2 at) {
  ProjectionSetting curve;
  curve.kind = lens.kind, curve.fov = lens.fov;
  const vec3 own(exact_fisheye(curve, dvec2(0.5f + 0.5f * at)));
  const auto axes =
      orientation(glm::radians(static_cast<double>(lens.yaw)), glm::radians(static_cast<double>(lens.pitch)),
                  glm::radians(static_cast<double>(lens.roll)));
  return vec3(axes[0]) * own.x + vec3(axes[1]) * own.y + vec3(axes[2]) * own.z;
}

static float shown_at(const SimulatedCamera& camera, int which, vec2 pixel, const LensWorld& world) {
  const FisheyeLens& lens = camera.lenses[static_cast<size_t>(which)];
  const SensorFlaws& flaws = camera.flaws;
  const vec2 at = (pixel - lens.center) / lens.radius;
  const float r = length(at);
  const float around = flaws.black + flaws.glow * std::exp(-std::max(0.0f, r - 1.0f) / 0.06f);
  const float lit = std::clamp(0.5f + (1.0f - r) / flaws.soft, 0.0f, 1.0f);
  if (lit == 0.0f) return around;
  const float picture =
      world(which, direction_at(lens, r > 1.0f ? at / r : at)) * (1.0f - flaws.vignette * r * r * r * r);
  return std::max(flaws.black, std::lerp(around, picture, lit));
}

void write_raw_file(const std::string& path, const SimulatedCamera& camera, const LensWorld& world, int quality) {
  Picture picture;
  picture.eyes.resize(1);
  picture.eyes[0].eye = kMono;
  const Extent size = packed_size(camera.layout, camera.half, 2);
  Image& image = picture.eyes[0].radiance = Image(size.width, size.height, 3);
  for (const int which : {0, 1}) {
    const EyeCorner corner = eye_corner(camera.layout, camera.half, which);
    tbb::parallel_for(0, camera.half.height, [&](int y) {
      std::minstd_rand random(static_cast<unsigned>(1 + y + which * 10007));
      std::normal_distribution<float> noise(0.0f, 1.0f);
      for (int x = 0; x < camera.half.width; x++) {
        const vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        const float shown = shown_at(camera, which, pixel, world) + camera.flaws.noise * noise(random);
        std::fill_n(image.at(corner.x + x, corner.y + y), 3, srgb_decode(std::clamp(shown, 0.0f, 1.0f)));
      }
    });
  }
  SaveOptions options;
  options.layout = Layout::kSeparate, options.tone = ToneCurve::kLinear, options.jpeg_quality = quality;
  save_picture(picture, options, path);
}

}  // namespace ods
