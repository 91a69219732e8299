// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cli/console/console.h"
#include "cli/options/picture_options.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/stage/exposure.h"

namespace {

constexpr size_t kLooks = 5;  // at a video, spread evenly

std::optional<float> parse_exposure(const std::string& word) {
  if (word == "auto") return std::nullopt;
  const std::vector<float> numbers = parse_numbers(word);
  if (numbers.size() == 1 && numbers[0] >= -ods::kMostStops && numbers[0] <= ods::kMostStops) return numbers[0];
  throw UsageError(fmt::format("--exposure is auto or a number of stops from -30 to 30, not '{}'", word));
}

bool is_looked_at(const RenderJob& job) {
  return job.time.is_video || job.part || !keeps_light(job.output);
}

bool is_made_for_it(const RenderJob& job) {
  return ods::find_builtin(job.scene.name) && job.scene.light.environment.empty();
}

}  // namespace

void add_exposure_option(Options& options, RenderJob& job) {
  options.custom(
      "--exposure", "auto|STOPS", "auto", [&](const std::string& word) { job.exposure = parse_exposure(word); },
      "exposure in stops. auto: what suits the light, found by a first look, the same for both eyes and all frames; "
      ".hdr and .exr stay scene-linear and ignore it");
}

float find_exposure(const RenderJob& job, FrameRenderer& renderer, const std::vector<Frame>& frames) {
  if (job.exposure || !is_looked_at(job) || is_made_for_it(job) || frames.empty()) return job.exposure.value_or(0.0f);
  std::set<size_t> chosen;
  for (size_t i = 0; i < kLooks; i++) chosen.insert((2 * i + 1) * frames.size() / (2 * kLooks));
  std::vector<ods::Picture> looks;
  for (const size_t i : chosen) looks.push_back(renderer.first_look(frames[i]));
  const std::optional<float> stops = ods::suitable_exposure(looks);
  if (!stops) {
    warn("there is nothing to see: no light reaches the camera (--env 1 lights the scene, --position X,Y,Z moves it)");
    return 0.0f;
  }
  note(fmt::format("exposure {:+.1f} stops, from a first look at the light (--exposure {:.1f})", *stops, *stops));
  return *stops;
}
