// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods over: a picture with alpha before another.
#include "ods/image/over.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iostream>

#include "cli/console.h"
#include "cli/form_options.h"
#include "cli/long_job.h"
#include "ods/base/error.h"
#include "ods/base/frames.h"

using ods::FrameNames, ods::StoredPicture;

namespace {

constexpr const char* kExamples =
    "  ods over title.exr footage_TB.png -o titled_TB.png\n"
    "  ods over robot.exr street.exr -o both.exr --by-depth\n"
    "  ods over 'title.####.exr' 'footage_TB.####.jpg' -o 'titled_TB.####.jpg'";

constexpr const char* kSummary =
    "Lays a stereo 360 picture with alpha over another, in linear light: titles and computer graphics over footage. "
    "The\n"
    "foreground is brought into the background's projection, layout and size. #### in a name is the number of a "
    "frame;\n"
    "where the foreground has no such frame, the background is left as it is.";

struct OverJob {
  std::string foreground, background, output;
  ods::KnownForm known;  // of the background
  std::optional<std::vector<int>> frames;
  ods::OverOptions over;
  ods::SaveOptions save;
  std::optional<ods::Layout> layout;
  bool has_tone = false;
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

bool read_options(OverJob& job, int argc, char** argv) {
  Options options("over", kSummary, kExamples);
  options.argument("FOREGROUND", job.foreground,
                   "a picture with alpha, as ods title and ods render --transparent make");
  options.argument("BACKGROUND", job.background, "a picture; %V in its name: a file per eye");
  options.group("Pictures");
  options.text("-o,--output", "FILE", job.output, ".png .jpg .tif .webp .hdr .exr; %V in its name: a file per eye");
  options.custom(
      "--frames", "RANGE", "", [&](const std::string& text) { job.frames = ods::parse_frames(text); },
      "1-100, 1-100x2, ..: which of the background's frames; else all");
  add_layout_option(options, job.known.layout, "of the background, where it and its name do not tell", "--from-layout");
  add_layout_option(options, job.layout, "of what is made; else the background's");
  options.flag("--by-depth", job.over.by_depth, "what is farther than the background is behind it; both have depth");
  options.number("--opacity", job.over.opacity, 0.0f, 1.0f, "of the foreground");
  options.number("--exposure", job.save.exposure, -30.0f, 30.0f, "stops; .hdr and .exr keep the light");
  options.choice("--tone", job.save.tone, ods::kToneCurves, ods::tone_curve_name,
                 "tone curve, of .hdr and .exr to the others");
  options.group("Console");
  options.number("--threads", job.threads, 0, 1024, "0: all processors");
  add_progress_options(options, job.progress);
  if (!options.parse(argc, argv)) return false;
  console.json = job.progress == ProgressMode::kJson;
  job.has_tone = options.given("--tone");
  if (job.output.empty()) throw UsageError("where to? -o picture.png");
  return true;
}

StoredPicture open(const std::string& path, const ods::KnownForm& known, bool is_first) {
  ods::OpenOptions options;
  options.form = known;
  StoredPicture picture = ods::open_picture(path, options);
  if (is_first) note_guesses(path, picture);
  return picture;
}

// One frame. Without a foreground the background goes through.
void lay(const OverJob& job, const std::optional<StoredPicture>& front, const std::string& background,
         const std::string& output, bool is_first) {
  for (const std::string& input : {job.foreground, background}) refuse_overwriting(output, input);
  const StoredPicture back = open(background, job.known, is_first);
  ods::SaveOptions save = job.save;
  save_as_it_was(back, output, job.layout, job.has_tone, save);
  ods::Overlay overlay;
  if (front) {
    const std::string fault = over_fault(*front, back, job.over);
    if (!fault.empty()) throw UsageError(fmt::format("'{}' over '{}': {}", job.foreground, background, fault));
    if (is_first) {
      for (const std::string& warning : over_warnings(*front, back)) warn(warning);
    }
    overlay = lay_over(*front, back, job.over);
  } else {
    overlay.rows = convert(back, own_form(back)).rows;
  }
  if (is_first) note_misleading_name(output, save, back.eyes.size(), back.rig.projection);
  for (const std::string& file : save_picture(overlay.rows, &back.rig, save, output)) std::cout << file << std::endl;
  const std::string behind = behind_warning(overlay);
  if (is_first && !behind.empty()) warn(behind);
}

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(ods::names_eye(path) ? ods::path_for_eye(path, ods::kLeft) : path, ignored);
}

void lay_frames(const OverJob& job, const FrameNames& back, ProgressLines& lines) {
  const auto front = ods::frame_names(job.foreground);
  const FrameNames output = film_names(job.output);
  const std::vector<int> frames = job.frames ? *job.frames : ods::frames_on_disk(back);
  if (frames.empty()) throw ods::Error(ods::ErrorKind::kInput, fmt::format("there is no frame '{}'", job.background));
  std::optional<StoredPicture> still;
  if (!front) still = open(job.foreground, {}, true);
  const auto start = std::chrono::steady_clock::now();
  for (size_t i = 0; i < frames.size(); i++) {
    std::optional<StoredPicture> moving;
    const bool has_one = front && exists(front->path(frames[i]));
    if (has_one) moving = open(front->path(frames[i]), {}, i == 0);
    lay(job, front ? moving : still, back.path(frames[i]), output.path(frames[i]), i == 0);
    lines.report(static_cast<double>(i + 1) / static_cast<double>(frames.size()), seconds_since(start));
  }
}

void over(int argc, char** argv) {
  OverJob job;
  if (!read_options(job, argc, argv)) return;
  run_long_job(job.progress, job.threads, [&](ProgressLines& lines) {
    if (const auto back = ods::frame_names(job.background)) return lay_frames(job, *back, lines);
    lay(job, open(job.foreground, {}, true), job.background, job.output, true);
  });
}

}  // namespace

extern "C" int ods_over(int argc, char** argv) {
  return run_command([=] { over(argc, argv); });
}
