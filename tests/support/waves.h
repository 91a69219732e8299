// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A world that is visible in all directions, without repetition and without special places.
#pragma once
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

// A smooth random function of the direction, mostly within 0..1.
class Waves {
 public:
  explicit Waves(uint32_t seed = 5) {
    std::mt19937 engine(seed);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 60; i++) {
      const float frequency = 8.0f + static_cast<float>(i);
      const vec3 way(normal(engine), normal(engine), normal(engine));
      waves_.push_back({normalize(way) * frequency, 6.0f * normal(engine)});
    }
  }
  float operator()(vec3 d) const {
    float sum = 0.0f;
    for (const auto& [way, phase] : waves_) sum += std::sin(dot(way, d) + phase);
    return 0.5f + 0.04f * sum;
  }

 private:
  std::vector<std::pair<vec3, float>> waves_;
};

}  // namespace ods
