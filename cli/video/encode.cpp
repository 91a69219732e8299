// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods encode: encodes frames as a video.
#include <fmt/format.h>

#include <chrono>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/options/projection_options.h"
#include "cli/options/video_options.h"
#include "ods/stage/exposure.h"

namespace {

constexpr const char* kEncodeExamples =
    "  ods encode 'shot.####.exr' -o shot_360_TB.mp4\n"
    "  ods encode 'shot_%V.####.png' -o shot_360_TB.mp4 --target quest --fps 60 --audio sound.wav\n"
    "  ods encode 'shot.####.exr' -o shot.mov --target master --frames 1-250\n"
    "  ods encode 'shot.%04d.jpg' -o shot_180_LR.webm --projection vr180 --codec av1 --bits 10";

constexpr const char* kEncodeSummary =
    "Encodes frames from any renderer as a video that players recognise as stereo 360: both eyes in a frame, the left\n"
    "one on top; BT.709; Spherical Video V1 and V2. #### in the name (or %04d, $F4) is the frame's number, %V the "
    "eye.\n"
    "Projection and layout are detected as in ods convert.";

struct EncodeJob {
  std::string pattern;
  std::optional<std::vector<int>> frames;
  ods::FormatHint known;
  ods::DisplayTransform display;
  VideoChoices video;
  std::optional<ods::Layout> layout;
  int threads = 0;
  ProgressMode progress = ProgressMode::kAuto;
};

ods::Layout video_layout(const std::string& word) {
  const ods::Layout layout = layout_by_name("--to-layout", word);
  if (layout == ods::Layout::kTopBottom || layout == ods::Layout::kSideBySide) return layout;
  throw UsageError("--to-layout of a video must be top-bottom or side-by-side");
}

EncodeJob parse_encode(Options& options) {
  EncodeJob job;
  options.describe(kEncodeSummary, kEncodeExamples);
  options.argument(ValueKind::input_file("FRAMES"), job.pattern,
                   "the frames' file names, in quotes: 'shot.####.exr'; any picture format");
  options.group("Frames");
  options.custom(
      "--frames", "RANGE", "", [&](const std::string& text) { job.frames = ods::parse_frames(text); },
      "frames to encode, in this order: 1-100, 1-100x2 or 1,5,10-20; by default all");
  options.custom(
      "--projection", "NAME", "",
      [&](const std::string& name) { job.known.projection = projection_by_name("--projection", name); },
      "the frames' projection, if it is not detected");
  add_input_layout_option(options, job.known.layout, "the frames' layout, if it is not detected");
  options.number("--exposure", job.display.exposure, -ods::kMaxStops, ods::kMaxStops,
                 "exposure in stops, for .hdr and .exr");
  options.choice("--tone", job.display.tone, ods::kToneCurveTable, "tone curve, for .hdr and .exr");
  add_video_options(options, job.video);
  options.custom(
      "--fps", "X|N/M", "30", [&](const std::string& text) { job.video.rate = parse_rate(text); }, "frames per second");
  options.custom(
      "--to-layout", "LAYOUT", "", [&](const std::string& word) { job.layout = video_layout(word); },
      "how both eyes share a frame of the video: top-bottom, or side-by-side (usual for vr180)");
  options.group("Console");
  options.number("--threads", job.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, job.progress);
  options.parse();
  return job;
}

void encode_to_file(const EncodeJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  encode_options(job.video, {256, 256}, job.threads);  // fails early: examining the frames takes time
  const ods::FrameFiles files = ods::find_frames(job.pattern, job.frames);
  const ods::FormatHint seen = open_input(job.pattern, {.known = job.known}).hint;
  const bool needs_convert = !seen.lenses.empty() || seen.bars.any();  // encoding does not convert frames
  const ods::VideoPlan plan = ods::plan_video(files, needs_convert ? job.known : seen, job.layout);
  const ods::EncodeOptions options = encode_options(job.video, plan.size, job.threads);
  ods::check_packing(plan, options.packing);
  for (const std::string& each : plan.notes) note(each);
  note_player_limits(job.video, plan, options);
  note_sound_length(options, files.frames.size());
  ods::Progress progress;
  progress.report = [&](double done) {
    lines.report(done, seconds_since(start), video_step("encode", done, files.frames.size(), job.video.output));
  };
  ods::make_video(files, plan, job.display, options, job.video.output, progress);
  lines.clear();
  announce_file(job.video.output);
  note(fmt::format("{}: {}, in {}", job.video.output, video_text(plan, options, files.frames.size()),
                   duration_text(seconds_since(start))));
}

void encode(const EncodeJob& job) {
  run_long_job(job.progress, job.threads, [&](ProgressLines& lines) { encode_to_file(job, lines); });
}

}  // namespace

extern const Command kEncode = make_command<parse_encode, encode>("encode", "encode frames as a stereo 360 video");
