// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/sequence/render_video.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "ods/base/error.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/sequence/identity.h"
#include "ods/sequence/shared_frames.h"
#include "ods/stage/exposure.h"

namespace ods {
namespace {

// A merge map is the same all around: its size and one column.
std::string map_text(const Image& map) {
  std::vector<float> rows;
  for (int y = 0; y < map.height; y++) rows.push_back(*map.at(0, y));
  return fmt::format("{} {} {}", map.width, map.height, fmt::join(rows, " "));
}

std::optional<Image> parse_map(const std::string& text) {
  std::istringstream numbers(text);
  int width = 0, height = 0;
  numbers >> width >> height;
  if (!numbers || width < 1 || width > 4096 || height < 1 || height > 4096) return std::nullopt;
  Image map(width, height, 1);
  for (int y = 0; y < height; y++) {
    float share = 0.0f;
    if (!(numbers >> share) || share < 0.0f || share > 1.0f) return std::nullopt;
    std::fill_n(map.at(0, y), width, share);
  }
  return map;
}

std::optional<float> parse_stops(const std::string& text) {
  std::istringstream number(text);
  float stops = 0.0f;
  return number >> stops && std::abs(stops) <= kMaxStops ? std::optional(stops) : std::nullopt;
}

template <typename Value>
Value expect(const VideoJournal& journal, const std::optional<Value>& value) {
  if (value) return *value;
  throw Error(ErrorKind::kInput,
              fmt::format("job.txt in '{}' is damaged; `restart` renders the frames again", journal.folder()));
}

// Options with the settings found when the first of the existing frames were made.
SequenceOptions as_recorded(SequenceOptions options, const VideoJournal& journal) {
  if (const auto stops = journal.found(kExposureSetting)) options.exposure = expect(journal, parse_stops(*stops));
  if (const auto map = journal.found(kMergeSetting)) {
    use_merge_map(options.camera.stereo, expect(journal, parse_map(*map)));
    options.merge_limit.reset();
  }
  return options;
}

// Looks first, and then takes what is recorded: another process, on another device, may have found other values first.
FirstLook look_and_record(FrameRenderer& renderer, const std::vector<SequenceFrame>& all, VideoJournal& journal) {
  const FirstLook look = look_first(renderer, all);
  SequenceOptions options = renderer.options();
  journal.record(kExposureSetting, fmt::format("{}", look.chosen));
  if (options.merge_limit) journal.record(kMergeSetting, map_text(*options.camera.stereo.merge_map));
  options.exposure = look.chosen, options.merge_limit.reset();
  renderer.set_options(as_recorded(std::move(options), journal));
  FirstLook recorded = look_first(renderer, all);  // costs nothing: both are given
  recorded.reason = look.reason;
  return recorded;
}

SequenceProgress progress_of_frames(const VideoJournal& journal, const VideoProgress& progress) {
  SequenceProgress frames = progress.frames;
  frames.report = [&journal, &progress](double done, const FrameAtWork& frame) {
    journal.check();
    if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "the video was stopped");
    if (progress.frames.report) progress.frames.report(done, frame);
  };
  return frames;
}

}  // namespace

VideoPlan encode_frames(const VideoJournal& journal, const std::vector<int>& frames, const DisplayTransform& display,
                        const EncodeOptions& encode, bool keep_frames, const Progress& progress) {
  const FrameFiles files = find_frames(journal.pattern(), frames);
  VideoPlan plan = plan_video(files, {}, {});
  make_video(files, plan, display, encode, journal.video(), progress);
  std::error_code ignored;
  for (size_t i = 0; i < frames.size(); i++) std::filesystem::remove(files.path(i) + std::string(kRawEnd), ignored);
  if (!keep_frames) journal.remove();
  return plan;
}

std::optional<VideoPlan> render_video(VideoJournal& journal, Scene& scene, SequenceOptions options,
                                      const VideoOptions& video, const VideoProgress& progress) {
  const std::vector<int>& own = video.only ? *video.only : video.frames;
  journal.plan(video.frames, own);
  const std::vector<SequenceFrame> all = make_frames(options, video.frames, journal.pattern());
  std::vector<SharedFrame> files;
  for (const SequenceFrame& frame : all) files.push_back({frame.number, frame.path});
  wait_for_frames(files, video.wait, progress.late);
  const bool is_found = !options.exposure && journal.found(kExposureSetting);
  FrameRenderer renderer(as_recorded(std::move(options), journal), scene);
  FirstLook look = look_and_record(renderer, all, journal);
  if (is_found) look.reason = ExposureReason::kRecorded;
  const VideoStart start{renderer, all, choose_frames(all, own), look};
  if (progress.start) progress.start(start);
  const Sink sink = video.raw ? Sink::kRaw : video.only ? Sink::kShared : Sink::kFiles;
  render_sequence(renderer, all, start.missing, sink, progress_of_frames(journal, progress));
  if (video.only) return std::nullopt;
  const DisplayTransform display{look.exposure, video.tone.value_or(usual_tone(scene))};
  return encode_frames(journal, video.frames, display, video.encode, video.keep_frames,
                       {progress.encoding, progress.cancelled});
}

VideoPlan render_video(Scene& scene, SequenceOptions options, const VideoOptions& video, const std::string& path,
                       const Progress& progress) {
  options.fps = video.encode.rate.value();
  const JournalUse use = video.only ? JournalUse::kShared : JournalUse::kAlone;
  VideoJournal journal(path, frame_identity(options), video.restart, use);
  VideoProgress of_video;
  of_video.frames.report = [&](double done, const FrameAtWork&) {
    if (progress.report) progress.report(kRenderingShare * done);
  };
  of_video.encoding = [&](double done) {
    if (progress.report) progress.report(kRenderingShare + (1.0 - kRenderingShare) * done);
  };
  of_video.cancelled = progress.cancelled;
  return render_video(journal, scene, std::move(options), video, of_video).value_or(VideoPlan{});
}

}  // namespace ods
