// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/kernel/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/kernel/random.h"
#include "ods/scene/tables.h"
#include "tests/statistics.h"

namespace ods {
namespace {

BsdfEvaluator make_kernel() {
  BsdfEvaluator kernel;
  kernel.tables = kernel_tables().data();
  return kernel;
}

Surface white_surface(float roughness) {
  Surface surface{};
  surface.geometric = surface.normal = vec3(0.0f, 0.0f, 1.0f);
  surface.front = true;
  surface.base_color = vec3(1.0f);
  surface.roughness = roughness;
  surface.ior = 1.5f;
  return surface;
}

vec3 viewer(float cosine) {
  return vec3(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
}

const float kRoughness[] = {0.0f, 0.02f, 0.05f, 0.1f, 0.2f, 0.3f, 0.4f, 0.55f, 0.7f, 0.85f, 1.0f};
const float kCosines[] = {1.0f, 0.95f, 0.85f, 0.7f, 0.55f, 0.4f, 0.25f, 0.15f, 0.08f};

// What a surface returns of light that comes from everywhere.
double whiteness(BsdfEvaluator& kernel, const Surface& surface, float cosine, float eta, int samples = 1 << 14) {
  const Bsdf bsdf = kernel.make_bsdf(surface, -viewer(cosine), eta);
  double sum = 0.0;
  for (int i = 0; i < samples; i++) {
    const uint index = static_cast<uint>(i);
    const BsdfSample found = kernel.sample_bsdf(bsdf, random_pair(1, index, 0).x, random_pair(1, index, 1));
    EXPECT_TRUE(found.weight.x >= 0.0f && std::isfinite(found.weight.x));
    sum += static_cast<double>(found.weight.x);
  }
  return sum / samples;
}

double worst_loss(const char* name, float metallic, float transmission, bool volume, float eta) {
  BsdfEvaluator kernel = make_kernel();
  double worst = 0.0;
  for (float roughness : kRoughness) {
    for (float cosine : kCosines) {
      Surface surface = white_surface(roughness);
      surface.metallic = metallic;
      surface.transmission = transmission;
      surface.volume = volume;
      const double loss = 1.0 - whiteness(kernel, surface, cosine, eta);
      if (std::abs(loss) > std::abs(worst)) worst = loss;
      if(std::abs(loss)>0.003) printf("%s eta %g rough %g cos %g loss %g\n", name, eta, roughness, cosine, loss);
    }
  }
  printf("%s %g worst %g\n", name, eta, worst);
  return std::abs(worst);
}

TEST(WhiteFurnace, Reflection) {
  EXPECT_LT(worst_loss("dielectric", 0, 0, false, 1.5f), 3e-3);
  EXPECT_LT(worst_loss("metal", 1, 0, false, 1.5f), 3e-3);
  EXPECT_LT(worst_loss("mixture", 0.5f, 0, false, 1.5f), 3e-3);
}

TEST(WhiteFurnace, Glass) {
  EXPECT_LT(worst_loss("thin", 0, 1, false, 1.5f), 3e-3);
  for (float eta : {1.05f, 1.1f, 1.33f, 1.5f, 1.8f, 2.4f}) {
    EXPECT_LT(worst_loss("in", 0, 1, true, eta), 1e-2) << eta;
    EXPECT_LT(worst_loss("out", 0, 1, true, 1.0f / eta), 1e-2) << eta;
  }
  EXPECT_LT(worst_loss("part", 0.2f, 0.5f, true, 1.5f), 1e-2);
}

}  // namespace
}  // namespace ods
