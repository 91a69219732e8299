// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/tables.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "ods/kernel/ggx.h"
#include "ods/kernel/scene_view.h"

namespace ods {

static void fill_srgb(float* table) {
  for (int i = 0; i < kSrgbSize; i++) {
    const double s = i / 255.0;
    table[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
}

// Four-term Blackman-Harris window of 3 pixels width, integrated from its centre to x in -1.5..1.5, -0.5..0.5 in all.
static double window_integral(double x) {
  constexpr double kTerms[4] = {0.35875, 0.48829, 0.14128, 0.01168};
  const double pi = std::acos(-1.0);
  double sum = kTerms[0] * x / 3.0;
  for (int k = 1; k < 4; k++) sum += kTerms[k] / (2.0 * pi * k) * std::sin(2.0 * pi * k * x / 3.0);
  return sum / kTerms[0];
}

static void fill_filter(float* table) {
  for (int i = 0; i < kFilterSize; i++) {
    const double target = static_cast<double>(i) / (kFilterSize - 1) - 0.5;
    double low = -1.5, high = 1.5;
    for (int step = 0; step < 60; step++) {
      const double middle = 0.5 * (low + high);
      (window_integral(middle) < target ? low : high) = middle;
    }
    table[i] = static_cast<float>(0.5 * (low + high));
  }
}

// Midpoints of an n x n grid stand in for random numbers: the integrands are smooth.
template <typename Function>
static void for_grid(int n, Function function) {
  for (int i = 0; i < n * n; i++) {
    function(vec2((static_cast<float>(i % n) + 0.5f) / static_cast<float>(n),
                  (static_cast<float>(i / n) + 0.5f) / static_cast<float>(n)));
  }
}

static vec3 viewer_at(float cosine) {
  const float c = max(cosine, 1e-3f);
  return vec3(sqrt(1.0f - c * c), 0.0f, c);
}

static void fill_ggx(float* table) {
  tbb::parallel_for(0, kGgxSize * kGgxSize, [&](int cell) {
    const float roughness = static_cast<float>(cell / kGgxSize) / static_cast<float>(kGgxSize - 1);
    const float alpha = max(roughness * roughness, 1e-4f);
    const vec3 wo = viewer_at(static_cast<float>(cell % kGgxSize) / static_cast<float>(kGgxSize - 1));
    double head_on = 0.0, grazing = 0.0;
    constexpr int kGrid = 32;
    for_grid(kGrid, [&](vec2 u) {
      const vec3 h = ggx_sample_visible(wo, alpha, u);
      const vec3 wi = h * (2.0f * dot(wo, h)) - wo;
      if (wi.z <= 0.0f) return;
      const float lambda = ggx_lambda(wo, alpha);
      const float kept = (1.0f + lambda) / (1.0f + lambda + ggx_lambda(wi, alpha));
      const float s = schlick(dot(wo, h));
      head_on += kept * (1.0f - s);
      grazing += kept * s;
    });
    table[2 * cell] = static_cast<float>(head_on / (kGrid * kGrid));
    table[2 * cell + 1] = static_cast<float>(grazing / (kGrid * kGrid));
  });
}

static void fill_glass(float* table) {
  constexpr int kRow = kGlassSize * kGlassSize;
  tbb::parallel_for(0, 2 * kGlassSize * kRow, [&](int cell) {
    const float reflectance = 0.5f * static_cast<float>(cell / kRow % kGlassSize) / static_cast<float>(kGlassSize - 1);
    const float ratio = (1.0f + reflectance) / (1.0f - reflectance);
    const float eta = cell < kGlassSize * kRow ? ratio : 1.0f / ratio;
    const float roughness = static_cast<float>(cell / kGlassSize % kGlassSize) / static_cast<float>(kGlassSize - 1);
    const float alpha = max(roughness * roughness, 1e-4f);
    const vec3 wo = viewer_at(static_cast<float>(cell % kGlassSize) / static_cast<float>(kGlassSize - 1));
    double sum = 0.0;
    constexpr int kGrid = 16;
    for_grid(kGrid, [&](vec2 u) {
      const vec3 h = ggx_sample_visible(wo, alpha, u);
      const float fresnel = fresnel_dielectric(dot(wo, h), eta);
      const float lambda = ggx_lambda(wo, alpha);
      const vec3 mirrored = h * (2.0f * dot(wo, h)) - wo;
      const vec3 through = refract_through(wo, h, eta);
      if (mirrored.z > 0.0f) sum += fresnel * (1.0f + lambda) / (1.0f + lambda + ggx_lambda(mirrored, alpha));
      if (through.z < 0.0f) sum += (1.0f - fresnel) * (1.0f + lambda) / (1.0f + lambda + ggx_lambda(through, alpha));
    });
    table[cell] = static_cast<float>(sum / (kGrid * kGrid));
  });
}

const std::vector<float>& kernel_tables() {
  static const std::vector<float> tables = [] {
    std::vector<float> all(kTablesSize);
    fill_srgb(all.data() + kSrgbTable);
    fill_filter(all.data() + kFilterTable);
    fill_ggx(all.data() + kGgxTable);
    fill_glass(all.data() + kGlassTable);
    return all;
  }();
  return tables;
}

}  // namespace ods
