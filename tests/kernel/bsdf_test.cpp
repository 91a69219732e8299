// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/kernel/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/kernel/random.h"
#include "ods/render/tables.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

BsdfEvaluator make_kernel() {
  BsdfEvaluator kernel;
  kernel.tables = kernel_tables({.glass = true}).data();
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

// The share of uniform light that a surface reflects.
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

// The greatest share of light lost or gained over all roughnesses and angles.
double worst_loss(float metallic, float transmission, bool volume, float eta) {
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
    }
  }
  return std::abs(worst);
}

// The error of the tables' interpolation, and of this test's noise: 0.2 %.
TEST(WhiteFurnace, Reflection) {
  EXPECT_LT(worst_loss(0, 0, false, 1.5f), 4e-3);
  EXPECT_LT(worst_loss(1, 0, false, 1.5f), 4e-3);
  EXPECT_LT(worst_loss(0.5f, 0, false, 1.5f), 4e-3);
  EXPECT_LT(worst_loss(0, 1, false, 1.5f), 4e-3);  // thin glass
}

// From inside, the table is coarse for very rough glass where total reflection starts.
TEST(WhiteFurnace, Glass) {
  for (float eta : {1.05f, 1.33f, 1.5f, 2.4f}) {
    EXPECT_LT(worst_loss(0, 1, true, eta), 8e-3) << eta;
    EXPECT_LT(worst_loss(0, 1, true, 1.0f / eta), 3.5e-2) << eta;
  }
  EXPECT_LT(worst_loss(0.2f, 0.5f, true, 1.5f), 1e-2);
}

// Smooth glass reflects Fresnel's share, lets through the rest in Snell's direction, and loses nothing.
TEST(Glass, SmoothIsFresnelAndSnell) {
  BsdfEvaluator kernel = make_kernel();
  for (float eta : {1.5f, 1.0f / 1.5f, 1.33f}) {
    for (float cosine : kCosines) {
      Surface surface = white_surface(0.0f);
      surface.transmission = 1.0f;
      surface.volume = true;
      surface.base_color = vec3(0.5f, 1.0f, 0.25f);
      const Bsdf bsdf = kernel.make_bsdf(surface, -viewer(cosine), eta);
      const double c = double{cosine}, n = double{eta}, sin2 = (1.0 - c * c) / (n * n);
      const double t = std::sqrt(std::max(1.0 - sin2, 0.0));
      const double rs = (c - n * t) / (c + n * t), rp = (n * c - t) / (n * c + t);
      const double reflectance = sin2 >= 1.0 ? 1.0 : 0.5 * (rs * rs + rp * rp);
      int reflected = 0;
      const int count = 1 << 14;
      for (int i = 0; i < count; i++) {
        const float pick = (static_cast<float>(i) + 0.5f) / count;
        const BsdfSample found = kernel.sample_bsdf(bsdf, pick, vec2(0.3f));
        ASSERT_EQ(found.pdf, 0.0f);
        const vec3 tint = found.through ? surface.base_color : vec3(1.0f);
        ASSERT_LT(length(found.weight - tint), 1e-6f);
        const vec3 wo = viewer(cosine);
        const vec3 expected = found.through ? vec3(-wo.x / eta, 0.0f, -t) : vec3(-wo.x, 0.0f, wo.z);
        ASSERT_LT(length(found.direction - expected), 1e-5f);
        reflected += !found.through;
      }
      EXPECT_NEAR(static_cast<double>(reflected) / count, reflectance, 1.0 / count) << eta << ' ' << cosine;
    }
  }
}

TEST(Glass, ThinSheetGoesStraightThrough) {
  BsdfEvaluator kernel = make_kernel();
  Surface surface = white_surface(0.0f);
  surface.transmission = 1.0f;
  const Bsdf bsdf = kernel.make_bsdf(surface, -viewer(0.6f), surface.ior);
  const BsdfSample found = kernel.sample_bsdf(bsdf, 0.999f, vec2(0.5f));
  EXPECT_TRUE(found.through);
  EXPECT_LT(length(found.direction + viewer(0.6f)), 1e-6f);
}

// An interface between equal indices is not there, however rough.
TEST(Glass, EqualIndicesDoNothing) {
  BsdfEvaluator kernel = make_kernel();
  for (float roughness : kRoughness) {
    for (float cosine : kCosines) {
      Surface surface = white_surface(roughness);
      surface.transmission = 1.0f;
      surface.volume = true;
      surface.ior = 1.0f;
      const Bsdf bsdf = kernel.make_bsdf(surface, -viewer(cosine), 1.0f);
      const BsdfSample found = kernel.sample_bsdf(bsdf, 0.5f, vec2(0.4f, 0.7f));
      EXPECT_TRUE(found.through);
      EXPECT_LT(length(found.weight - vec3(1.0f)), 1e-5f) << roughness;
      EXPECT_LT(length(found.direction + viewer(cosine)), 1e-5f);
    }
  }
}

// Half of it is glass that is not there; the other half stays the rough surface that it is.
TEST(Glass, EqualIndicesLeaveTheRestRough) {
  BsdfEvaluator kernel = make_kernel();
  Surface surface = white_surface(0.5f);
  surface.transmission = 0.5f;
  surface.volume = true;
  const Bsdf bsdf = kernel.make_bsdf(surface, -viewer(0.7f), 1.0f);
  EXPECT_NEAR(bsdf.alpha, 0.25f, 1e-6f);
  Dice dice(1);
  double kept = 0.0;
  int straight = 0;
  const int count = 100000;
  for (int i = 0; i < count; i++) {
    const BsdfSample found = kernel.sample_bsdf(bsdf, dice.next(), dice.pair());
    kept += double{found.weight.x};
    if (found.weight.x == 0.0f) continue;  // a facet that reflects into the surface
    if (!found.through) {
      ASSERT_GT(found.pdf, 0.0f);
      continue;
    }
    straight++;
    ASSERT_LT(length(found.direction + viewer(0.7f)), 1e-5f);
  }
  EXPECT_NEAR(kept / count, 1.0, 0.01);
  EXPECT_NEAR(straight, count * double{bsdf.p_glass}, 5.0 * std::sqrt(count));
}

vec3 random_direction(Dice& dice, float lowest, float highest) {
  const float z = dice.between(lowest, highest), turn = dice.between(0.0f, 2.0f * kPi), r = std::sqrt(1.0f - z * z);
  return vec3(r * std::cos(turn), r * std::sin(turn), z);
}

// Swapping light and viewer changes nothing, but for the energy compensation, which depends on the viewer only: it is 1
// for a black metal, and for the Fresnel part of a rough dielectric.
TEST(Reciprocity, Gloss) {
  BsdfEvaluator kernel = make_kernel();
  Dice dice(1);
  for (float roughness : {0.3f, 0.6f, 1.0f}) {
    Surface surface = white_surface(roughness);
    surface.metallic = 1.0f;
    surface.base_color = vec3(0.0f);
    for (int i = 0; i < 1000; i++) {
      const vec3 a = random_direction(dice, 0.05f, 1.0f), b = random_direction(dice, 0.05f, 1.0f);
      const float forward = kernel.bsdf_value(kernel.make_bsdf(surface, -a, 1.5f), b).value.x / b.z;
      const float back = kernel.bsdf_value(kernel.make_bsdf(surface, -b, 1.5f), a).value.x / a.z;
      ASSERT_NEAR(forward, back, 1e-4f * std::max(forward, back) + 1e-9f);
    }
  }
}

// Refraction is reciprocal for radiance over the squared index: f(a, b) from one side is f(b, a) from the other, times
// the squares' ratio, which this kernel leaves out. Each side divides by its own compensation.
TEST(Reciprocity, Refraction) {
  BsdfEvaluator kernel = make_kernel();
  Dice dice(2);
  const float eta = 1.5f;
  int met = 0;
  for (float roughness : {0.3f, 0.6f, 1.0f}) {
    Surface surface = white_surface(roughness);
    surface.transmission = 1.0f;
    surface.volume = true;
    for (int i = 0; i < 3000; i++) {
      const vec3 above = random_direction(dice, 0.05f, 1.0f), below = random_direction(dice, -1.0f, -0.05f);
      const Bsdf in = kernel.make_bsdf(surface, -above, eta);
      Surface flipped = surface;
      flipped.geometric = flipped.normal = vec3(0.0f, 0.0f, -1.0f);
      const Bsdf out = kernel.make_bsdf(flipped, -below, 1.0f / eta);
      const float forward = kernel.bsdf_value(in, below).value.x / in.glass_gain / -below.z;
      const float back = kernel.bsdf_value(out, above).value.x / out.glass_gain / above.z;
      ASSERT_NEAR(forward, back * eta * eta, 2e-3f * forward + 1e-6f);
      met += forward > 1e-3f;
    }
  }
  EXPECT_GT(met, 300);
}

// Whatever the numbers, nothing but finite, not negative weights and unit directions come out.
TEST(Bsdf, NeverBreaks) {
  BsdfEvaluator kernel = make_kernel();
  Dice dice(3);
  const float picks[] = {0.0f, 0.5f, 0.9999999f};
  for (int i = 0; i < 20000; i++) {
    const auto extreme = [&](float low, float high) {
      const float u = dice.next();
      return u < 0.2f ? low : u < 0.4f ? high : dice.between(low, high);
    };
    Surface surface = white_surface(extreme(0.0f, 1.0f));
    if (dice.next() < 0.2f) surface.roughness = dice.between(0.0f, 0.05f);
    surface.metallic = extreme(0.0f, 1.0f);
    surface.transmission = extreme(0.0f, 1.0f);
    surface.volume = dice.next() < 0.5f;
    surface.base_color = vec3(extreme(0.0f, 1.0f), extreme(0.0f, 1.0f), extreme(0.0f, 1.0f));
    if (dice.next() < 0.2f) surface.base_color = vec3(0.0f);
    surface.ior = extreme(1.0f, 3.0f);
    const float z = dice.next() < 0.3f ? std::exp(dice.between(-14.0f, -2.0f)) : extreme(1e-7f, 1.0f);
    const float eta = dice.next() < 0.5f ? surface.ior : 1.0f / surface.ior;
    const Bsdf bsdf = kernel.make_bsdf(surface, -viewer(z), eta);
    for (float pick : picks) {
      const vec2 uv(extreme(0.0f, 0.9999999f), extreme(0.0f, 0.9999999f));
      const BsdfSample found = kernel.sample_bsdf(bsdf, pick, uv);
      for (int c = 0; c < 3; c++) ASSERT_TRUE(found.weight[c] >= 0.0f && found.weight[c] < 1e4f) << found.weight[c];
      ASSERT_TRUE(found.pdf >= 0.0f && std::isfinite(found.pdf));
      ASSERT_TRUE(found.weight == vec3(0.0f) || std::abs(length(found.direction) - 1.0f) < 1e-5f);
      const BsdfValue value = kernel.bsdf_value(bsdf, random_direction(dice, -1.0f, 1.0f));
      ASSERT_TRUE(value.pdf >= 0.0f && std::isfinite(value.pdf));
      for (int c = 0; c < 3; c++) ASSERT_TRUE(value.value[c] >= 0.0f && std::isfinite(value.value[c]));
    }
  }
}

}  // namespace
}  // namespace ods
