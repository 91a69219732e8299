// SPDX-FileCopyrightText: 2026 The Omnistereo authors
#include "ods/stage/exposure.h"
// SPDX-License-Identifier: Apache-2.0
#include "ods/stage/exposure.h"
//
#include "ods/stage/exposure.h"
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
#include "ods/stage/exposure.h"
constexpr const char* kEncodeExamples =
#include "ods/stage/exposure.h"
    "  ods encode 'shot.####.exr' -o shot_360_TB.mp4\n"
#include "ods/stage/exposure.h"
    "  ods encode 'shot_%V.####.png' -o shot_360_TB.mp4 --target quest --fps 60 --audio sound.wav\n"
#include "ods/stage/exposure.h"
    "  ods encode 'shot.####.exr' -o shot.mov --target master --frames 1-250\n"
#include "ods/stage/exposure.h"
    "  ods encode 'shot.%04d.jpg' -o shot_180_LR.webm --projection vr180 --codec av1 --bits 10";
#include "ods/stage/exposure.h"
constexpr const char* kEncodeSummary =
#include "ods/stage/exposure.h"
    "Encodes frames from any renderer as a video that players recognise as stereo 360: both eyes in a frame, the left\n"
#include "ods/stage/exposure.h"
    "one on top; BT.709; Spherical Video V1 and V2. #### in the name (or %04d, $F4) is the frame's number, %V the "
#include "ods/stage/exposure.h"
    "eye.\n"
#include "ods/stage/exposure.h"
    "Projection and layout are detected as in ods convert.";
#include "ods/stage/exposure.h"
struct EncodeJob {
#include "ods/stage/exposure.h"
  std::string pattern;
#include "ods/stage/exposure.h"
  std::optional<std::vector<int>> frames;
#include "ods/stage/exposure.h"
  ods::FormatHint known;
#include "ods/stage/exposure.h"
  ods::DisplayTransform display;
#include "ods/stage/exposure.h"
  VideoChoices video;
#include "ods/stage/exposure.h"
  std::optional<ods::Layout> layout;
#include "ods/stage/exposure.h"
  int threads = 0;
#include "ods/stage/exposure.h"
  ProgressMode progress = ProgressMode::kAuto;
#include "ods/stage/exposure.h"
};
#include "ods/stage/exposure.h"
ods::Layout video_layout(const std::string& word) {
#include "ods/stage/exposure.h"
  const ods::Layout layout = layout_by_name("--to-layout", word);
#include "ods/stage/exposure.h"
  if (layout == ods::Layout::kTopBottom || layout == ods::Layout::kSideBySide) return layout;
#include "ods/stage/exposure.h"
  throw UsageError("--to-layout of a video must be top-bottom or side-by-side");
#include "ods/stage/exposure.h"
}
#include "ods/stage/exposure.h"
EncodeJob parse_encode(Options& options) {
#include "ods/stage/exposure.h"
  EncodeJob job;
#include "ods/stage/exposure.h"
  options.describe(kEncodeSummary, kEncodeExamples);
#include "ods/stage/exposure.h"
  options.argument(ValueKind::input_file("FRAMES"), job.pattern,
#include "ods/stage/exposure.h"
                   "the frames' file names, in quotes: 'shot.####.exr'; any picture format");
#include "ods/stage/exposure.h"
  options.group("Frames");
#include "ods/stage/exposure.h"
  options.custom(
#include "ods/stage/exposure.h"
      "--frames", "RANGE", "", [&](const std::string& text) { job.frames = ods::parse_frames(text); },
#include "ods/stage/exposure.h"
      "frames to encode, in this order: 1-100, 1-100x2 or 1,5,10-20; by default all");
#include "ods/stage/exposure.h"
  options.custom(
#include "ods/stage/exposure.h"
      "--projection", "NAME", "",
#include "ods/stage/exposure.h"
      [&](const std::string& name) { job.known.projection = projection_by_name("--projection", name); },
#include "ods/stage/exposure.h"
      "the frames' projection, if it is not detected");
#include "ods/stage/exposure.h"
  add_input_layout_option(options, job.known.layout, "the frames' layout, if it is not detected");
#include "ods/stage/exposure.h"
  options.number("--exposure", job.display.exposure, -ods::kMaxStops, ods::kMaxStops,
#include "ods/stage/exposure.h"
                 "exposure in stops, for .hdr and .exr");
#include "ods/stage/exposure.h"
  options.choice("--tone", job.display.tone, ods::kToneCurveTable, "tone curve, for .hdr and .exr");
#include "ods/stage/exposure.h"
  add_video_options(options, job.video);
#include "ods/stage/exposure.h"
  options.custom(
#include "ods/stage/exposure.h"
      "--fps", "X|N/M", "30", [&](const std::string& text) { job.video.rate = parse_rate(text); }, "frames per second");
#include "ods/stage/exposure.h"
  options.custom(
#include "ods/stage/exposure.h"
      "--to-layout", "LAYOUT", "", [&](const std::string& word) { job.layout = video_layout(word); },
#include "ods/stage/exposure.h"
      "how both eyes share a frame of the video: top-bottom, or side-by-side (usual for vr180)");
#include "ods/stage/exposure.h"
  options.group("Console");
#include "ods/stage/exposure.h"
  options.number("--threads", job.threads, 0, 1024, "number of threads; 0: all processors");
#include "ods/stage/exposure.h"
  add_progress_options(options, job.progress);
#include "ods/stage/exposure.h"
  options.parse();
#include "ods/stage/exposure.h"
  return job;
#include "ods/stage/exposure.h"
}
#include "ods/stage/exposure.h"
void encode_to_file(const EncodeJob& job, ProgressLines& lines) {
#include "ods/stage/exposure.h"
  const auto start = std::chrono::steady_clock::now();
#include "ods/stage/exposure.h"
  encode_options(job.video, {256, 256}, job.threads);  // fails early: examining the frames takes time
#include "ods/stage/exposure.h"
  const ods::FrameFiles files = ods::find_frames(job.pattern, job.frames);
#include "ods/stage/exposure.h"
  const ods::FormatHint seen = open_input(job.pattern, {.known = job.known}).hint;
#include "ods/stage/exposure.h"
  const bool needs_convert = !seen.lenses.empty() || seen.bars.any();  // encoding does not convert frames
#include "ods/stage/exposure.h"
  const ods::VideoPlan plan = ods::plan_video(files, needs_convert ? job.known : seen, job.layout);
#include "ods/stage/exposure.h"
  const ods::EncodeOptions options = encode_options(job.video, plan.size, job.threads);
#include "ods/stage/exposure.h"
  ods::check_packing(plan, options.packing);
#include "ods/stage/exposure.h"
  for (const std::string& each : plan.notes) note(each);
#include "ods/stage/exposure.h"
  note_player_limits(job.video, plan, options);
#include "ods/stage/exposure.h"
  note_sound_length(options, files.frames.size());
#include "ods/stage/exposure.h"
  ods::Progress progress;
#include "ods/stage/exposure.h"
  progress.report = [&](double done) {
#include "ods/stage/exposure.h"
    lines.report(done, seconds_since(start), video_step("encode", done, files.frames.size(), job.video.output));
#include "ods/stage/exposure.h"
  };
#include "ods/stage/exposure.h"
  ods::make_video(files, plan, job.display, options, job.video.output, progress);
#include "ods/stage/exposure.h"
  lines.clear();
#include "ods/stage/exposure.h"
  announce_file(job.video.output);
#include "ods/stage/exposure.h"
  note(fmt::format("{}: {}, in {}", job.video.output, video_text(plan, options, files.frames.size()),
#include "ods/stage/exposure.h"
                   duration_text(seconds_since(start))));
#include "ods/stage/exposure.h"
}
#include "ods/stage/exposure.h"
void encode(const EncodeJob& job) {
#include "ods/stage/exposure.h"
  run_long_job(job.progress, job.threads, [&](ProgressLines& lines) { encode_to_file(job, lines); });
#include "ods/stage/exposure.h"
}
#include "ods/stage/exposure.h"
}  // namespace
#include "ods/stage/exposure.h"
extern const Command kEncode = make_command<parse_encode, encode>("encode", "encode frames as a stereo 360 video");
#include "ods/stage/exposure.h"
