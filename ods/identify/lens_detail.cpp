// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/lens_detail.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ods {

namespace {

// Sums over squares of an image, by the sums of all rectangles from its corner.
class SquareSums {
 public:
  explicit SquareSums(const Image& image) : size_{image.width, image.height}, sums_(at(0, image.height + 1)) {
    for (int y = 0; y < image.height; y++) {
      double row = 0.0;
      for (int x = 0; x < image.width; x++) {
        row += static_cast<double>(*image.at(x, y));
        sums_[at(x + 1, y + 1)] = sums_[at(x + 1, y)] + row;
      }
    }
  }

  double around(int x, int y, int reach) const {
    const int left = std::max(0, x - reach), right = std::min(size_.width, x + reach + 1);
    const int top = std::max(0, y - reach), bottom = std::min(size_.height, y + reach + 1);
    return sums_[at(right, bottom)] - sums_[at(left, bottom)] - sums_[at(right, top)] + sums_[at(left, top)];
  }

 private:
  size_t at(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(size_.width + 1) + static_cast<size_t>(x);
  }

  Extent size_;
  std::vector<double> sums_;
};

template <typename Function>
Image each_pixel(Extent size, Function value) {
  Image image(size.width, size.height, 1);
  for (int y = 0; y < size.height; y++) {
    for (int x = 0; x < size.width; x++) *image.at(x, y) = static_cast<float>(value(x, y));
  }
  return image;
}

}  // namespace

// The logarithm of the light inside the circle without what is the same all around: a lens darkens towards its rim.
static Image evenly_lit(const Image& image, const Image& inside, const FisheyeLens& lens) {
  constexpr float kBlack = 0.03f;
  std::vector<double> sums(static_cast<size_t>(lens.radius) + 2), counts(sums.size());
  const auto ring = [&](int x, int y) {
    return static_cast<size_t>(length(vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) - lens.center));
  };
  const auto light = [&](int x, int y) {
    return std::log(static_cast<double>(std::max(0.0f, *image.at(x, y)) + kBlack));
  };
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      if (*inside.at(x, y) > 0.0f) sums[ring(x, y)] += light(x, y), counts[ring(x, y)] += 1.0;
    }
  }
  return each_pixel({image.width, image.height}, [&](int x, int y) {
    return *inside.at(x, y) > 0.0f ? light(x, y) - sums[ring(x, y)] / counts[ring(x, y)] : 0.0;
  });
}

Image lens_detail(const Image& image, const FisheyeLens& lens, const DetailScale& scale) {
  constexpr float kInside = 0.985f;         // the outermost rim is dark
  constexpr double kVisible = 0.03 * 0.03;  // variance of what is left of noise
  const Extent size{image.width, image.height};
  const int smooth = static_cast<int>(std::lround(0.5f * scale.smooth * lens.radius));
  const int wide = std::max(2, static_cast<int>(std::lround(0.5f * scale.wide * lens.radius)));
  const Image inside = each_pixel(size, [&](int x, int y) {
    const vec2 off = vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) - lens.center;
    return length(off) < kInside * lens.radius ? 1.0f : 0.0f;
  });
  const SquareSums count(inside), light(evenly_lit(image, inside, lens));
  const auto mean = [&](const SquareSums& sums, int x, int y, int reach) {
    return sums.around(x, y, reach) / std::max(1.0, count.around(x, y, reach));
  };
  const Image smoothed =
      each_pixel(size, [&](int x, int y) { return *inside.at(x, y) > 0.0f ? mean(light, x, y, smooth) : 0.0; });
  const SquareSums levels(smoothed);
  const SquareSums squares(each_pixel(size, [&](int x, int y) { return *smoothed.at(x, y) * *smoothed.at(x, y); }));
  return each_pixel(size, [&](int x, int y) {
    if (*inside.at(x, y) == 0.0f) return 0.0;
    const double level = mean(levels, x, y, wide), square = mean(squares, x, y, wide);
    const double spread = std::max(0.0, square - level * level);
    return (static_cast<double>(*smoothed.at(x, y)) - level) / std::sqrt(spread + kVisible);
  });
}

}  // namespace ods
