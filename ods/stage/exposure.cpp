// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ods/kernel/surface.h"

namespace ods {

namespace {

constexpr int kLookWidth = 192, kLookHeight = 96, kLookSamples = 16;
constexpr int kBlock = 4;
constexpr double kSkyShare = 0.5;        // maximum weight of the sky, relative to the weight of surfaces
constexpr double kBlack = 1.0 / 4096.0;  // relative to the highlights: darker light counts as black

struct Patch {
  double luminance;
  double weight;    // relative solid angle
  double surfaces;  // the fraction of it that is not sky
};

// Adds the lit patches of a lat-long picture.
void add_patches(const EyeImage& eye, std::vector<Patch>& patches) {
  const Image& light = eye.radiance;
  for (int y = 0; y + kBlock <= light.height; y += kBlock) {
    const double latitude = std::numbers::pi * (0.5 - (y + 0.5 * kBlock) / light.height);
    for (int x = 0; x + kBlock <= light.width; x += kBlock) {
      double sum = 0.0, covered = 0.0, surfaces = 0.0;
      for (int i = 0; i < kBlock * kBlock; i++) {
        const int px = x + i % kBlock, py = y + i / kBlock;
        const float* pixel = light.at(px, py);
        const double value = static_cast<double>(luminance(vec3(pixel[0], pixel[1], pixel[2])));
        if (std::isfinite(value)) sum += std::max(value, 0.0);
        covered += eye.alpha.pixels.empty() ? 1.0 : static_cast<double>(*eye.alpha.at(px, py));
        surfaces += *eye.depth.at(px, py) < kFarDepth ? 1.0 : 0.0;
      }
      if (sum > 0.0 && covered > 0.0) {
        patches.push_back({sum / covered, std::cos(latitude) * covered, surfaces / (kBlock * kBlock)});
      }
    }
  }
}

// Limits the weight of the sky around an object, because the surfaces are the subject.
void limit_sky(std::vector<Patch>& patches) {
  double surfaces = 0.0, sky = 0.0;
  for (const Patch& patch : patches) {
    surfaces += patch.weight * patch.surfaces;
    sky += patch.weight * (1.0 - patch.surfaces);
  }
  if (surfaces == 0.0) return;
  const double share = std::min(1.0, kSkyShare * surfaces / std::max(sky, 1e-9));
  for (Patch& patch : patches) patch.weight *= patch.surfaces + share * (1.0 - patch.surfaces);
}

// Returns whether the sky is only seen through windows.
bool is_indoors(const std::vector<Patch>& patches) {
  double sky = 0.0, whole = 0.0;
  for (const Patch& patch : patches) sky += patch.weight * (1.0 - patch.surfaces), whole += patch.weight;
  return sky < double{kWindowShare} * whole;
}

// The luminance that only this fraction of the patches exceeds; indoors, of the surfaces.
double brightest(const std::vector<Patch>& sorted, double share, bool indoors) {
  double whole = 0.0, sum = 0.0;
  for (const Patch& patch : sorted) whole += patch.weight;
  for (const Patch& patch : sorted) {
    sum += indoors ? patch.weight * patch.surfaces : patch.weight;
    if (sum >= share * whole) return patch.luminance;
  }
  return sorted.back().luminance;
}

}  // namespace

RenderOptions metering_options(const RenderOptions& options) {
  RenderOptions look;
  look.width = kLookWidth, look.height = kLookHeight;
  look.samples = kLookSamples;
  look.bounces = options.bounces;
  look.clamp = options.clamp;
  look.caustics = options.caustics;
  look.eyes = Eyes::kMonoEye;
  look.filter = PixelFilter::kBox;
  look.layers = true;  // for the depth layer
  look.transparent = options.transparent;
  look.threads = options.threads;
  return look;
}

StereoCamera metering_camera(const StereoCamera& camera) {
  StereoCamera look;
  look.position = camera.position;
  look.yaw = camera.yaw;
  look.ipd = 0.0f;
  return look;
}

std::optional<float> suitable_exposure(std::span<const Picture> looks) {
  std::vector<Patch> patches;
  for (const Picture& look : looks) {
    for (const EyeImage& eye : look.eyes) add_patches(eye, patches);
  }
  if (patches.empty()) return std::nullopt;
  std::stable_sort(patches.begin(), patches.end(),
                   [](const Patch& a, const Patch& b) { return a.luminance > b.luminance; });
  const bool indoors = is_indoors(patches);
  limit_sky(patches);
  const double highlight = brightest(patches, double{kHighlightShare}, indoors);
  double sum = 0.0, weight = 0.0;
  for (const Patch& patch : patches) {
    if (patch.luminance < kBlack * highlight) continue;
    sum += patch.weight * std::log2(patch.luminance);
    weight += patch.weight;
  }
  const double stops =
      std::min(std::log2(double{kExposedMean}) - sum / weight, std::log2(double{kHighlight} / highlight));
  const double limit = double{kMaxStops};
  return static_cast<float>(std::round(10.0 * std::clamp(stops, -limit, limit)) / 10.0) + 0.0f;
}

ToneCurve usual_tone(const Scene& scene) {
  return scene.as_painted ? ToneCurve::kLinear : ToneCurve::kNeutral;
}

float brightened(float exposure, float brighter) {
  const double sum = std::clamp(double{exposure} + double{brighter}, -double{kMaxStops}, double{kMaxStops});
  return static_cast<float>(std::round(1e4 * sum) / 1e4);
}

}  // namespace ods
