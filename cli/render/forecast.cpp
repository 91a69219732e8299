// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console/console.h"
#include "cli/options/disk_room.h"
#include "ods/files/private_folder.h"
#include "ods/sequence/looks.h"

namespace {

constexpr double kShort = 10.0;   // seconds below which there is no forecast
constexpr double kLong = 3600.0;  // seconds from which faster settings are suggested

// On the average. Small pictures are less smooth than large ones, so their files are larger for their size.
ods::SmallFrame look_at(const RenderJob& job, ods::FrameRenderer& renderer,
                        const std::vector<ods::SequenceFrame>& frames) {
  const size_t looks = frames.size() < 16 ? 1 : 3;
  const ods::PrivateFolder folder((std::filesystem::path(job.output).parent_path() / ".look-").native());
  ods::SmallFrame mean;
  for (size_t i = 0; i < looks; i++) {
    const ods::SequenceFrame& frame = frames[(2 * i + 1) * frames.size() / (2 * looks)];
    const ods::SmallFrame small = ods::try_small(renderer, frame, fmt::format("{}/{}.exr", folder.path(), i));
    mean.seconds += small.seconds / static_cast<double>(looks);
    mean.bytes += small.bytes / static_cast<double>(looks);
  }
  mean.bytes = std::min(mean.bytes, largest_frame(job.output, job.render, job.save));
  return mean;
}

void suggest_faster(const RenderJob& job, double seconds_per_frame) {
  const int half = job.render.width / 2;
  const std::string limit = job.render.time_limit > 0.0 ? ""
                                                        : fmt::format(", --time-limit {:.3g}s for half of it (noisier)",
                                                                      0.5 * seconds_per_frame);
  note(fmt::format("faster: --width {} for a quarter of the time{}, or several machines: ods submit", half, limit));
}

}  // namespace

void report_forecast(const RenderJob& job, ods::FrameRenderer& renderer,
                     const std::vector<ods::SequenceFrame>& frames) {
  const ods::SmallFrame frame = look_at(job, renderer, frames);
  const double seconds = frame.seconds * static_cast<double>(frames.size());
  if (seconds >= kShort) {
    note(fmt::format("rendering takes about {}, {} for each frame, by a first look", duration_text(seconds),
                     duration_text(frame.seconds)));
  }
  if (seconds >= kLong) suggest_faster(job, frame.seconds);
  check_disk_room(job.output, frames.size(), frame.bytes, job.force);
}
