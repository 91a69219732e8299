// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/cycles/cycles_part.h"

#include <algorithm>
#include <cmath>

namespace {

// The mean of a part as the sums of one sample.
ods::EyeSamples one_sample(const ods::EyeImage& image, ods::EyeSamples sums, double layer_unit) {
  sums.eye = image.eye;
  std::ranges::fill(sums.count, 1u);
  for (size_t i = 0; i < sums.light.size(); i++) {
    const double light = std::clamp(double{image.radiance.pixels[i]}, 0.0, double{ods::kBrightestSample});
    sums.light[i] = std::llround(light * ods::kLightUnit);
    sums.squares[i] = light * light;
  }
  const auto layer = [&](const ods::Image& from, std::vector<int32_t>& to) {
    for (size_t i = 0; i < from.pixels.size(); i++) {
      to[i] = static_cast<int32_t>(std::lround(std::clamp(double{from.pixels[i]}, -1.0, 1.0) * layer_unit));
    }
  };
  layer(image.normal, sums.normal);
  layer(image.albedo, sums.albedo);
  sums.depth = image.depth.pixels;
  return sums;
}

}  // namespace

ods::RenderOptions options_of_parts(const ods::RenderOptions& picture) {
  ods::RenderOptions options = picture;
  options.samples = picture.part.count;
  options.noise = 0.0f, options.share_paths = options.transparent = false;
  options.layers = options.statistics = true;
  return options;
}

CyclesPart make_part(CyclesSession& session, const CyclesPicture& picture, const ods::RenderOptions& options,
                     const ods::FrameNames& parts, const std::function<void(double)>& report) {
  CyclesRendered rendered = render_eyes(session, picture, parts, report);
  CyclesPart part{no_samples(options), rendered.pose};
  part.samples.done = part.samples.pass_to = samples_of_part(options).end;
  for (size_t i = 0; i < part.samples.eyes.size(); i++) {
    ods::EyeSamples& sums = part.samples.eyes[i];
    sums = one_sample(rendered.picture.eyes[i], std::move(sums), layer_unit(options));
  }
  return part;
}
