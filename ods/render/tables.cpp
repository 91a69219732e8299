// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/tables.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <mutex>

#include "ods/kernel/microfacets.h"
#include "ods/kernel/scene_view.h"

namespace ods {

// A thread that waits for its loop may start other work meanwhile. If that work called kernel_tables(), it would wait
// for the table that this thread is filling.
template <typename Function>
static void isolated_parallel_for(int count, Function function) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, count, function); });
}

static void fill_srgb(float* table) {
  for (int i = 0; i < kSrgbSize; i++) {
    const double s = i / 255.0;
    table[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
}

// Integral of a four-term Blackman-Harris window, 3 pixels wide, from its centre to x. x is in -1.5..1.5, the result in
// -0.5..0.5.
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

// The mean of function(u) over the unit square, by a lattice of n points. Light is lost where u.y is close to 1, so the
// points are denser there. width: 1/2 if u.x and 1 - u.x are mirror images, else 1.
template <typename Function>
static vec2 mean_over_normals(int n, float width, Function function) {
  glm::dvec2 sum(0.0);
  for (int i = 0; i < n; i++) {
    const float across = width * fract(0.618034f * (static_cast<float>(i) + 0.5f));
    const float rest = 1.0f - (static_cast<float>(i) + 0.5f) / static_cast<float>(n);
    sum += glm::dvec2(function(vec2(across, 1.0f - rest * rest)) * (2.0f * rest));
  }
  return vec2(sum / static_cast<double>(n));
}

static vec3 viewer_at(float cosine) {
  const float c = max(cosine, 1e-3f);
  return vec3(sqrt(1.0f - c * c), 0.0f, c);
}

// Alpha: float or vec2.
template <typename Alpha>
static vec2 microfacet_albedo(int points, float width, vec3 wo, Alpha alpha) {
  const float lambda = ggx_lambda(wo, alpha);
  return mean_over_normals(points, width, [&](vec2 u) {
    const vec3 h = ggx_sample_visible(wo, alpha, u);
    const vec3 wi = h * (2.0f * dot(wo, h)) - wo;
    if (wi.z <= 0.0f) return vec2(0.0f);
    const float s = schlick(dot(wo, h));
    return vec2(1.0f - s, s) * ((1.0f + lambda) / (1.0f + lambda + ggx_lambda(wi, alpha)));
  });
}

static void fill_ggx(float* table) {
  isolated_parallel_for(kGgxSize * kGgxSize, [&](int cell) {
    const float roughness = static_cast<float>(cell / kGgxSize) / static_cast<float>(kGgxSize - 1);
    const float alpha = max(roughness * roughness, 1e-4f);
    const vec3 wo = viewer_at(static_cast<float>(cell % kGgxSize) / static_cast<float>(kGgxSize - 1));
    const vec2 albedo = microfacet_albedo(610, 0.5f, wo, alpha);
    table[2 * cell] = albedo.x;
    table[2 * cell + 1] = albedo.y;
  });
}

// The inverse of glass_albedo()'s stretched cosine axis.
static float glass_cosine(float eta, float place) {
  if (eta >= 1.0f) return place * place;
  const float critical = sqrt(1.0f - eta * eta);
  if (place < 0.5f) return 4.0f * place * place * critical;
  return critical + (1.0f - critical) * (2.0f * place - 1.0f) * (2.0f * place - 1.0f);
}

static void fill_glass(float* table) {
  constexpr int kRow = kGlassSize * kGlassSize;
  isolated_parallel_for(2 * kGlassSize * kRow, [&](int cell) {
    const float row = static_cast<float>(cell / kRow % kGlassSize) / static_cast<float>(kGlassSize - 1);
    const float reflectance = 0.5f * row * row;
    const float ratio = (1.0f + reflectance) / (1.0f - reflectance);
    const float eta = cell < kGlassSize * kRow ? ratio : 1.0f / ratio;
    const float roughness = static_cast<float>(cell / kGlassSize % kGlassSize) / static_cast<float>(kGlassSize - 1);
    const float alpha = max(roughness * roughness, 1e-4f);
    const vec3 wo =
        viewer_at(glass_cosine(eta, static_cast<float>(cell % kGlassSize) / static_cast<float>(kGlassSize - 1)));
    table[cell] = mean_over_normals(256, 0.5f, [&](vec2 u) {
                    const vec3 h = ggx_sample_visible(wo, alpha, u);
                    const float fresnel = fresnel_dielectric(dot(wo, h), eta);
                    const float lambda = ggx_lambda(wo, alpha);
                    const vec3 mirrored = h * (2.0f * dot(wo, h)) - wo;
                    const vec3 through = refract_through(wo, h, eta);
                    float kept = 0.0f;
                    if (mirrored.z > 0.0f)
                      kept += fresnel * (1.0f + lambda) / (1.0f + lambda + ggx_lambda(mirrored, alpha));
                    if (through.z < 0.0f)
                      kept += (1.0f - fresnel) * (1.0f + lambda) / (1.0f + lambda + ggx_lambda(through, alpha));
                    return vec2(kept, 0.0f);
                  }).x;
  });
}

// The position of a node on an axis, 0..1.
static float node_at(int node, int size) {
  return static_cast<float>(node % size) / static_cast<float>(size - 1);
}

static void fill_anisotropic(float* table) {
  isolated_parallel_for(kAnisotropicCells, [&](int cell) {
    const int turned = cell / kAnisotropicSize, stretched = turned / kAnisotropicTurns;
    const float across = node_at(stretched / kAnisotropicAlong, kAnisotropicSize);
    const float along = mix(across, 1.0f, node_at(stretched, kAnisotropicAlong));
    const vec2 alpha = max(vec2(along * along, across * across), vec2(1e-4f));
    const vec3 turned_up = viewer_at(node_at(cell, kAnisotropicSize));
    const float x2 = node_at(turned, kAnisotropicTurns);
    const vec3 wo(turned_up.x * sqrt(x2), turned_up.x * sqrt(1.0f - x2), turned_up.z);
    const vec2 albedo = microfacet_albedo(377, 1.0f, wo, alpha);
    table[2 * cell] = albedo.x;
    table[2 * cell + 1] = albedo.y;
  });
}

// The integral of sheen_value() over the hemisphere. It varies fastest at grazing angles, so the points are denser
// there.
static float sheen_integral(vec3 wo, float alpha) {
  constexpr int kSteps = 64;
  double sum = 0.0;
  for (int i = 0; i < kSteps; i++) {
    const float t = (static_cast<float>(i) + 0.5f) / kSteps, z = t * t, r = sqrt(1.0f - z * z);
    const float masking = 1.0f + sheen_lambda(wo.z, alpha) + sheen_lambda(z, alpha);
    double ring = 0.0;
    for (int k = 0; k < kSteps; k++) {
      const float turn = kPi * (static_cast<float>(k) + 0.5f) / kSteps;
      const vec3 h = normalize(wo + vec3(r * cos(turn), r * sin(turn), z));
      ring += double{sheen_distribution(h.z, alpha)};
    }
    sum += ring * double{2.0f * t / masking};
  }
  return static_cast<float>(sum * 2.0 * double{kPi} / (kSteps * kSteps) / (4.0 * double{wo.z}));
}

static void fill_sheen(float* table) {
  isolated_parallel_for(kSheenSize * kSheenSize, [&](int cell) {
    const float roughness = node_at(cell / kSheenSize, kSheenSize);
    table[cell] = sheen_integral(viewer_at(node_at(cell, kSheenSize)), sheen_alpha(roughness));
  });
}

const std::vector<float>& kernel_tables(const TableNeeds& needs) {
  static std::vector<float> tables = [] {
    std::vector<float> all(kTablesSize);
    fill_srgb(all.data() + kSrgbTable);
    fill_filter(all.data() + kFilterTable);
    fill_ggx(all.data() + kGgxTable);
    return all;
  }();
  static std::once_flag glass, sheen, anisotropic;
  if (needs.glass) std::call_once(glass, [] { fill_glass(tables.data() + kGlassTable); });
  if (needs.sheen) std::call_once(sheen, [] { fill_sheen(tables.data() + kSheenTable); });
  if (needs.anisotropy) std::call_once(anisotropic, [] { fill_anisotropic(tables.data() + kAnisotropicTable); });
  return tables;
}

}  // namespace ods
