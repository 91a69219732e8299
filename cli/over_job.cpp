// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/over_job.h"

#include <fmt/format.h>

#include "cli/console.h"
#include "cli/form_options.h"
#include "cli/long_job.h"
#include "cli/projection_options.h"
#include "ods/base/frames.h"

namespace {

constexpr const char* kExamples =
    "  ods over title.exr footage_TB.png -o titled_TB.png\n"
    "  ods over title.exr film_360_TB.mp4 -o titled_360_TB.mp4\n"
    "  ods over robot.exr street.exr -o both.exr --by-depth\n"
    "  ods over 'title.####.exr' 'footage_TB.####.jpg' -o 'titled_TB.####.jpg'";

constexpr const char* kSummary =
    "Lays a stereo 360 picture with alpha over another, in linear light: titles and computer graphics over footage. "
    "The\n"
    "foreground is brought into the background's projection, layout and size. Both are pictures, frames (#### in the\n"
    "name is the number) or films, whose frames count from 0; where the foreground has no such frame, the background\n"
    "is left as it is. A film stays what it is: codec, frame rate, sound, what it says of itself.";

}  // namespace

bool read_over_job(OverJob& job, int argc, char** argv) {
  Options options("over", kSummary, kExamples);
  options.argument("FOREGROUND", job.foreground,
                   "a picture, frames or a film with alpha, as ods title and ods render --transparent make");
  options.argument("BACKGROUND", job.background, "a picture, frames or a film; %V in its name: a file per eye");
  options.group("Pictures");
  options.text("-o,--output", "FILE", job.output,
               ".png .jpg .tif .webp .hdr .exr; %V in its name: a file per eye; over a film .mp4 .mov .mkv .webm too");
  options.custom(
      "--frames", "RANGE", "", [&](const std::string& text) { job.frames = ods::parse_frames(text); },
      "1-100, 1-100x2, ..: which of the background's frames; else all");
  options.custom(
      "--from", "NAME", "", [&](const std::string& name) { job.known.projection = projection_by_name("--from", name); },
      "projection of the background, where it and its name do not tell");
  add_layout_option(options, job.known.layout, "its layout, likewise", "--from-layout");
  add_layout_option(options, job.layout, "of what is made; else the background's");
  options.flag("--by-depth", job.over.by_depth, "what is farther than the background is behind it; both have depth");
  options.number("--opacity", job.over.opacity, 0.0f, 1.0f, "of the foreground");
  options.number("--exposure", job.save.exposure, -30.0f, 30.0f, "stops; .hdr and .exr keep the light");
  options.choice("--tone", job.save.tone, ods::kToneCurves, ods::tone_curve_name,
                 "tone curve, of .hdr and .exr to the others");
  options.group("A film, which is encoded as the background is, unless these say otherwise");
  add_packing_options(options, job.film);
  options.group("Console");
  options.number("--threads", job.threads, 0, 1024, "0: all processors");
  add_progress_options(options, job.progress);
  if (!options.parse(argc, argv)) return false;
  job.has_tone = options.given("--tone"), job.has_exposure = options.given("--exposure");
  job.has_target = options.given("--target");
  if (job.output.empty()) throw UsageError("no output file: add -o picture.png");
  return true;
}

void check_over(const OverJob& job, const ods::StoredPicture& first, const ods::StoredPicture& background) {
  const std::string fault = over_fault(first, background, job.over);
  if (fault.empty()) return;
  throw UsageError(fmt::format("'{}' over '{}': {}", job.foreground, job.background, fault));
}
