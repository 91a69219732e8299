// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/compose/testcard_video.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "ods/compose/testcard_video.h"

using ods::Container, ods::Layout;

void add_testcard_video_options(Options& options, TestcardVideoChoices& choices) {
  options.group("Video (-o card.mp4 .mov .mkv .webm)");
  options.flag("--video", choices.is_video,
               "make a video: adds frame numbers for each eye, a cell per frame, a moving bar, and every second a "
               "flash and a beep; implied by a video's file name");
  options.number("--duration", choices.duration, 0.1f, 36000.0f, "length, seconds");
  options.custom(
      "--fps", "X|N/M", "30", [&](const std::string& text) { choices.video.rate = parse_rate(text); },
      "frames per second");
  add_packing_options(options, choices.video);
}

// The eyes as they are placed in the video.
static ods::VideoPlan plan_card(ods::Extent eye, size_t eyes, Layout layout, const ods::ProjectionSetting& projection,
                                Container container) {
  if (eyes == 2 && !ods::arrangement_of(layout).is_halves()) {
    throw UsageError(
        fmt::format("a video's layout must be top-bottom, bottom-top, side-by-side or cross-eyed, possibly -half, "
                    "not {}",
                    layout_name(layout)));
  }
  const ods::VideoPlan plan =
      ods::plan_eyes(ods::squeezed_eye(layout, eye, static_cast<int>(eyes)), eyes, layout, projection);
  if (has_boxes(container) && !ods::fits_v2(plan.metadata)) {
    throw UsageError(
        fmt::format("{} cannot express {}; .mkv can", container_name(container), metadata_text(plan.metadata)));
  }
  return plan;
}

void make_video_of_card(const ods::StereoCamera& camera, ods::Extent eye, const std::vector<int>& eyes, Layout layout,
                        const std::vector<std::string>& lines, const TestcardVideoChoices& choices,
                        ProgressLines& progress_lines) {
  const auto start = std::chrono::steady_clock::now();
  const ods::VideoPlan plan =
      plan_card(eye, eyes.size(), layout, camera.projection, container_for(choices.video.output));
  const ods::EncodeOptions options = encode_options(choices.video, plan.size, choices.threads);
  ods::check_packing(plan, options.packing);
  for (const std::string& each : plan.notes) note(each);
  note_player_limits(choices.video, plan, options);
  const double fps = options.rate.value();
  const int frames = std::max(1, static_cast<int>(std::lround(static_cast<double>(choices.duration) * fps)));
  const ods::Testcard card = make_testcard(camera, plan.eye, lines);
  const ods::TestcardVideo video = make_testcard_video(card, camera, eyes, plan, options.rate, options.packing);
  ods::Progress progress;
  progress.report = [&](double done) {
    progress_lines.report(done, seconds_since(start),
                          video_step("encode", done, static_cast<size_t>(frames), choices.video.output));
  };
  write_testcard_video(video, plan, frames, options, choices.video.output, progress);
  progress_lines.clear();
  announce_file(choices.video.output);
  note(fmt::format("{}: {}, in {}", choices.video.output, video_text(plan, options, static_cast<size_t>(frames)),
                   duration_text(seconds_since(start))));
}
