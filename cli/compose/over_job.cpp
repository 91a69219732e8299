// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/compose/over_job.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"
#include "ods/files/frames.h"

namespace {

constexpr const char* kOverExamples =
    "  ods over title.exr footage_TB.png -o titled_TB.png\n"
    "  ods over title.exr video_360_TB.mp4 -o titled_360_TB.mp4\n"
    "  ods over robot.exr street.exr -o both.exr --by-depth\n"
    "  ods over 'title.####.exr' 'footage_TB.####.jpg' -o 'titled_TB.####.jpg'";

constexpr const char* kOverSummary =
    "Composites a stereo 360 picture with alpha over another, in linear light: titles and computer graphics over\n"
    "footage. The foreground is converted to the background's projection, layout and size. Both can be pictures, "
    "frames\n"
    "(#### in the name is the number) or videos, whose frames count from 0. Background frames without a foreground "
    "frame\n"
    "stay as they are. A video keeps its codec, frame rate, sound and metadata.";

}  // namespace

OverJob parse_over(Options& options) {
  OverJob job;
  options.describe(kOverSummary, kOverExamples);
  options.argument(ValueKind::input_file("FOREGROUND"), job.foreground,
                   "a picture, frames or a video with alpha, such as those of ods title and ods render --transparent");
  options.argument(ValueKind::input_file("BACKGROUND"), job.background,
                   "a picture, frames or a video; %V in the name: one file per eye");
  options.group("Pictures");
  options.text("-o,--output", ValueKind::output_file(), job.output,
               "output file: .png .jpg .tif .webp .hdr .exr; over a video also .mp4 .mov .mkv .webm; %V in the name "
               "writes one file per eye");
  options.custom(
      "--frames", "RANGE", "", [&](const std::string& text) { job.frames = ods::parse_frames(text); },
      "frames of the background: 1-100, 1-100x2, ...; by default all");
  add_share_options(options, job.share);
  options.custom(
      "--projection", "NAME", "",
      [&](const std::string& name) { job.known.projection = projection_by_name("--projection", name); },
      "the background's projection, if it is not detected");
  add_input_layout_option(options, job.known.layout, "the background's layout, if it is not detected");
  add_layout_option(options, job.layout, "layout of the output; by default from its name (_TB), else the background's",
                    "--to-layout");
  options.flag("--by-depth", job.over.by_depth,
               "hide foreground that is farther away than the background; both need depth");
  options.number("--opacity", job.over.opacity, 0.0f, 1.0f, "opacity of the foreground");
  add_display_options(options, job.display);
  options.group("Video (by default encoded like the background)");
  add_packing_options(options, job.video);
  options.group("Console");
  options.number("--threads", job.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, job.progress);
  options.parse();
  if (job.output.empty()) throw UsageError("no output file: add -o picture.png");
  check_share(job.share, job.background, job.output);
  return job;
}

void check_over(const OverJob& job, const ods::StoredPicture& first, const ods::StoredPicture& background) {
  const std::string fault = over_fault(first, background, job.over);
  if (fault.empty()) return;
  throw UsageError(fmt::format("'{}' over '{}': {}", job.foreground, job.background, fault));
}
