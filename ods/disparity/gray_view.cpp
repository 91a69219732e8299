// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/disparity/gray_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ods/camera/pixel.h"
#include "ods/image/tone.h"

namespace ods {

// The number of pixels of the eye per 360 degrees around the horizon, extrapolated if it covers less.
static double pixels_around(const ProjectionSetting& setting, int width) {
  return 2.0 * std::numbers::pi * pixels_per_radian(setting, width);
}

// Scene-linear light has no upper limit: scales it so that its geometric mean becomes a middle grey.
static float exposure_of(const std::vector<Image>& eyes) {
  double sum = 0.0;
  int64_t count = 0;
  for (const Image& eye : eyes) {
    for (size_t i = 0; i < eye.pixels.size(); i += 61) {
      const float light = eye.pixels[i];
      if (!(light > 0.0f && light < 1e30f)) continue;
      sum += std::log(static_cast<double>(light));
      count++;
    }
  }
  return count > 0 ? static_cast<float>(0.25 / std::exp(sum / static_cast<double>(count))) : 1.0f;
}

namespace {

constexpr int kOutside = -1;

// The pixels of an eye at n x n points inside a pixel of the view.
class Sampler {
 public:
  Sampler(const ProjectionSetting& setting, const Image& eye, int width)
      : projection_(make_projection(setting)),
        eye_(eye),
        width_(width),
        n_(std::clamp(static_cast<int>(std::ceil(pixels_around(setting, eye.width) / width)), 2, 8)) {
    if (setting.kind != kLatLong) return;
    const vec2 middle = projection_.center;
    for (int i = 0; i < n_ * width_; i++) columns_.push_back(pixel_at(theta_of(i), middle.y).x);
    for (int i = 0; i < n_ * width_ / 2; i++) rows_.push_back(pixel_at(middle.x, phi_of(i)).y);
  }

  // The indices of the pixels in reading order. Empty if one is outside the picture.
  void find(int x, int y, std::vector<size_t>& found) const {
    found.clear();
    for (int i = 0; i < n_ * n_; i++) {
      const glm::ivec2 pixel = pixel_of(n_ * x + i % n_, n_ * y + i / n_);
      if (pixel.x == kOutside || pixel.y == kOutside) return found.clear();
      found.push_back(static_cast<size_t>(pixel.y) * static_cast<size_t>(eye_.width) + static_cast<size_t>(pixel.x));
    }
  }

 private:
  float theta_of(int i) const { return turn((i + 0.5) / (n_ * width_) - 0.5); }
  float phi_of(int i) const { return turn(0.25 - 0.5 * (i + 0.5) / (n_ * width_ / 2)); }
  static float turn(double turns) { return static_cast<float>(2.0 * std::numbers::pi * turns); }

  // Columns and rows of a lat-long picture are in tables, because computing each point is slow.
  glm::ivec2 pixel_of(int i, int j) const {
    if (columns_.empty()) return pixel_at(theta_of(i), phi_of(j));
    return {columns_[static_cast<size_t>(i)], rows_[static_cast<size_t>(j)]};
  }

  glm::ivec2 pixel_at(float theta, float phi) const {
    const ImagePoint place = place_of(projection_, look_at_angles(theta, phi).direction);
    if (!place.seen) return glm::ivec2(kOutside);
    return ods::pixel_at(place.uv, eye_);
  }

  Projection projection_;
  const Image& eye_;
  int width_;
  int n_;
  std::vector<int> columns_, rows_;
};

}  // namespace

static float mean_grey(const Image& eye, const std::vector<size_t>& places, float exposure) {
  float sum = 0.0f;
  for (size_t place : places) {
    const float light = eye.pixels[place] * exposure;
    sum += std::isinf(light) ? std::numeric_limits<float>::quiet_NaN() : std::min(light, 1.0f);
  }
  return srgb_encode(sum / static_cast<float>(places.size()));  // NaN if there are no pixels
}

std::vector<GrayView> make_gray_views(const std::vector<Image>& eyes, const ProjectionSetting& projection,
                                      bool is_float, int max_width) {
  assert(!eyes.empty() && eyes[0].channels == 1);
  const int detail = static_cast<int>(pixels_around(projection, eyes[0].width));
  const int width = std::clamp(detail / 4 * 4, 4, max_width);
  const Sampler sampler(projection, eyes[0], width);
  const float exposure = is_float ? exposure_of(eyes) : 1.0f;
  std::vector<GrayView> views(eyes.size(), GrayView(width, width / 2, 1));
  tbb::parallel_for(0, width / 2, [&](int y) {
    std::vector<size_t> places;
    for (int x = 0; x < width; x++) {
      sampler.find(x, y, places);
      for (size_t i = 0; i < eyes.size(); i++) *views[i].at(x, y) = mean_grey(eyes[i], places, exposure);
    }
  });
  return views;
}

double seen_around(const GrayView& view) {
  const float* row = view.at(0, view.height / 2);
  return static_cast<double>(std::count_if(row, row + view.width, [](float v) { return !std::isnan(v); })) / view.width;
}

}  // namespace ods
