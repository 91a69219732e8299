// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares the sharpness of the eyes. Tiles that match show the same edges: in each, the energy of second differences
// over two pixels, relative to the tile's contrast, is compared between the eyes. A blurred eye has less nearly
// everywhere; depth of field and motion differ in some places only.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ods/base/median.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr int kStep = 2;             // pixels of the eye: a single resampling removes only finer detail
constexpr int kHalf = 12;            // half size of a patch
constexpr size_t kMaxPatches = 400;  // more do not improve the result
constexpr size_t kEnoughBlocks = 20;
constexpr float kContrast = 1e-3f;  // minimum variance of a patch, of the square root of light

struct Center {
  int x = 0, y = 0;
};

std::optional<Center> center_of(const Projection& projection, const Image& eye, vec3 direction) {
  const ImagePoint place = place_of(projection, direction);
  if (!place.seen) return {};
  const Center center{static_cast<int>(place.uv.x * static_cast<float>(eye.width)),
                      static_cast<int>(place.uv.y * static_cast<float>(eye.height))};
  const int margin = kHalf + kStep;
  const bool fits =
      center.x >= margin && center.y >= margin && center.x + margin < eye.width && center.y + margin < eye.height;
  return fits ? std::optional(center) : std::nullopt;
}

// Energy of second differences over variance. Returns nullopt without contrast.
std::optional<double> fineness_of(const Image& eye, Center center, float unit) {
  const auto shown = [&](int x, int y) { return std::sqrt(std::clamp(*eye.at(x, y) * unit, 0.0f, 1.0f)); };
  double sum = 0.0, square = 0.0, energy = 0.0;
  int count = 0;
  for (int y = center.y - kHalf; y <= center.y + kHalf; y++) {
    for (int x = center.x - kHalf; x <= center.x + kHalf; x++) {
      const float here = shown(x, y);
      const float across = shown(x - kStep, y) - 2.0f * here + shown(x + kStep, y);
      const float along = shown(x, y - kStep) - 2.0f * here + shown(x, y + kStep);
      sum += static_cast<double>(here), square += static_cast<double>(here * here), count++;
      energy += static_cast<double>(across * across + along * along);
    }
  }
  const double variance = square / count - sum * sum / (1.0 * count * count);
  if (!(variance > static_cast<double>(kContrast))) return {};
  return energy / count / variance;
}

// The logarithm of the right eye's fineness over the left one's, for each place where both are known.
std::vector<double> ratios_of(const Subject& subject) {
  const Projection projection = make_projection(subject.projection());
  const std::vector<Match>& found = subject.matches.back().found;
  const size_t step = found.size() / kMaxPatches + 1;
  float unit = 1.0f;
  if (subject.info.is_float) {
    double sum = 0.0;
    for (const float light : subject.eyes[0].pixels) sum += std::isfinite(light) ? static_cast<double>(light) : 0.0;
    unit = static_cast<float>(0.25 * static_cast<double>(subject.eyes[0].pixels.size()) / std::max(sum, 1e-9));
  }
  std::vector<double> ratios;
  for (size_t i = 0; i < found.size(); i += step) {
    const Match& match = found[i];
    const vec3 there = look_at_angles(match.theta - match.around, match.phi - match.down).direction;
    const auto left = center_of(projection, subject.eyes[0], look_at_angles(match.theta, match.phi).direction);
    const auto right = center_of(projection, subject.eyes[1], stored_direction(subject.correction, there));
    if (!left || !right) continue;
    const auto left_fine = fineness_of(subject.eyes[0], *left, unit);
    const auto right_fine = fineness_of(subject.eyes[1], *right, unit);
    if (left_fine && right_fine) ratios.push_back(std::log((*right_fine + 1e-4) / (*left_fine + 1e-4)));
  }
  return ratios;
}

}  // namespace

void check_sharpness(const Subject& subject, LintReport& report) {
  const std::vector<double> ratios = ratios_of(subject);
  if (ratios.size() < kEnoughBlocks) return skip(report, Check::kSharpness, "not enough edges that both eyes show");
  judge(report, Check::kSharpness);
  const double ratio = median(ratios);
  const double same = static_cast<double>(std::count_if(ratios.begin(), ratios.end(),
                                                        [&](double each) { return each * ratio > 0.0; })) /
                      static_cast<double>(ratios.size());
  const double matters = std::clamp((std::abs(ratio) - 0.5) / 0.6, 0.0, 1.0);
  const double certainty = matters * std::clamp((same - 0.6) / 0.25, 0.0, 1.0);
  if (certainty < 0.1) return;
  report.findings.push_back(
      {Fault::kEyeBlurred, certainty,
       fmt::format("the {} eye's picture has {:.0f} % of the other's fine detail, at {:.0f} % of {} places less",
                   ratio < 0.0 ? "right" : "left", 100.0 * std::exp(-std::abs(ratio)), 100.0 * same, ratios.size()),
       "focus, filter and compress both eyes alike; what one eye lost cannot be brought back"});
}

}  // namespace ods
