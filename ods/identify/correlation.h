// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cmath>

#include "ods/image/image.h"
#include "ods/kernel/math.h"

namespace ods {

// Pearson's correlation of two series.
class Correlation {
 public:
  void add(double a, double b) { count_++, a_ += a, b_ += b, aa_ += a * a, bb_ += b * b, ab_ += a * b; }
  double count() const { return count_; }
  // The correlation; -1 if the values hardly vary.
  float value() const {
    const double va = aa_ / count_ - a_ * a_ / count_ / count_, vb = bb_ / count_ - b_ * b_ / count_ / count_;
    if (!(va > 1e-4 && vb > 1e-4)) return -1.0f;
    return static_cast<float>((ab_ / count_ - a_ * b_ / count_ / count_) / std::sqrt(va * vb));
  }

 private:
  double count_ = 0.0, a_ = 0.0, b_ = 0.0, aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

// The value of an image of one channel at an image position, between its pixels.
inline double sample_at(const Image& image, vec2 uv) {
  const float x = uv.x * static_cast<float>(image.width) - 0.5f, y = uv.y * static_cast<float>(image.height) - 0.5f;
  const int x0 = std::clamp(static_cast<int>(x), 0, image.width - 2),
            y0 = std::clamp(static_cast<int>(y), 0, image.height - 2);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const float top = std::lerp(*image.at(x0, y0), *image.at(x0 + 1, y0), fx);
  return static_cast<double>(std::lerp(top, std::lerp(*image.at(x0, y0 + 1), *image.at(x0 + 1, y0 + 1), fx), fy));
}

}  // namespace ods
