// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/lint/video.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "ods/base/error.h"
#include "ods/convert/unwrap.h"
#include "ods/identify/open_media.h"
#include "ods/lint/checks.h"
#include "ods/lint/frame_trace.h"
#include "ods/lint/players.h"
#include "ods/picture/load_eyes.h"
#include "ods/video/video_input.h"

namespace ods {

namespace {

constexpr int kUsualFrames = 24;
constexpr int kSettled = 6;  // frames after a cut: even a late eye has reached it, and the codec has recovered

// Packs the eyes as the video has them.
Image packed_image(Layout layout, const std::vector<Image>& eyes) {
  const Extent eye{eyes[0].width, eyes[0].height};
  const int count = static_cast<int>(eyes.size());
  const Extent size = packed_size(layout, eye, count);
  Image packed(size.width, size.height, 1);
  for (int y = 0; y < size.height; y++) {
    for (const EyeRow& part : packed_row(layout, eye, count, y)) {
      std::copy_n(eyes[static_cast<size_t>(part.index)].at(0, part.y), eye.width, packed.at(part.x, y));
    }
  }
  return packed;
}

// The source of the layout, for findings about it.
LayoutGuess layout_of(const VideoInput& video, const LintOptions& options) {
  LayoutGuess guess;
  if (video.prototype.eyes.size() == 2) guess.layout = video.prototype.layout;
  guess.reason = video.prototype.guesses.empty() ? video.prototype.layout_reason : video.prototype.guesses[0];
  guess.source = options.layout                    ? FormatSource::kOptions
                 : video.prototype.guesses.empty() ? FormatSource::kOwnMetadata
                                                   : FormatSource::kShape;
  return guess;
}

std::optional<double> bits_per_pixel(const std::string& path, const VideoStream& stream) {
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(path, error));
  if (error || stream.count == 0) return {};
  return 8.0 * bytes / stream.count / stream.size.width / stream.size.height;
}

Subject subject_of(const VideoInput& video, const VideoStream& stream, const StoredPicture& picture,
                   const LintOptions& options) {
  Subject subject;
  subject.path = video.path;
  subject.is_video = true;
  subject.bits_per_pixel = bits_per_pixel(video.path, stream);
  subject.info.width = stream.size.width, subject.info.height = stream.size.height;
  subject.format.layout = layout_of(video, options);
  subject.format.camera = video.prototype.camera;
  subject.eyes = grey_eyes(picture);
  subject.small = small_colors(picture, Layout::kSeparate);
  subject.packed = packed_image(picture.layout, subject.eyes);
  return subject;
}

// The findings of the judged frames of a shot.
struct Shot {
  int frames = 0;
  int judged = 0;
  std::map<Fault, std::vector<std::pair<double, Finding>>> found;  // with the times of their frames
};

// A shot's finding is the one of the frame with the median certainty; frames without it count as 0.
std::optional<Finding> verdict(int judged, std::vector<std::pair<double, Finding>> found) {
  if (2 * found.size() <= static_cast<size_t>(judged)) return {};
  std::vector<double> times;
  for (const auto& [time, finding] : found) times.push_back(time);
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.second.certainty > b.second.certainty; });
  Finding finding = found[static_cast<size_t>(judged) / 2].second;
  finding.times = times;
  return finding;
}

class VideoJudge {
 public:
  VideoJudge(const std::string& path, const VideoLintOptions& options)
      : options_(options),
        video_(open_video(path, open_media(path, {.known = hint(options.picture)}).hint)),
        decoder_(path, video_.track, video_.views),
        trace_(decoder_.stream().size, video_.prototype.layout) {
    const int count = decoder_.stream().count;
    every_ = options.every > 0 ? options.every : std::max(1, count / kUsualFrames);
  }

  LintReport run(const Progress& progress) {
    for (int i = 0;; i++) {
      if (progress.cancelled && progress.cancelled()) throw Error(ErrorKind::kCancelled, "interrupted");
      const std::optional<DecodedFrame> frame = decoder_.next();
      if (!frame) break;
      trace_.add(*frame, seconds_of(*frame));
      if (trace_.is_cut()) end_shot();
      if (i % every_ == 0 || (shot_.frames == kSettled && options_.every == 0)) look_at(*frame);
      shot_.frames++;
      const int count = decoder_.stream().count;
      if (progress.report && count > 0) progress.report(std::min(1.0, (i + 1.0) / count));
    }
    end_shot();
    return finish();
  }

 private:
  static FormatHint hint(const LintOptions& options) {
    FormatHint known;
    known.layout = options.layout, known.projection = options.projection, known.lenses = options.lenses;
    return known;
  }

  double seconds_of(const DecodedFrame& frame) const { return decoder_.stream().seconds_at(frame.time); }

  void look_at(const DecodedFrame& frame) {
    const StoredPicture stored = picture_of(video_, decoder_.stream(), frame);
    const StoredPicture picture = stored.maps.empty() ? stored : unwrapped(stored);
    LintReport report = lint_subject(subject_of(video_, decoder_.stream(), picture, options_.picture));
    shot_.judged++, frames_++;
    for (Finding& finding : report.findings) {
      shot_.found[finding.fault].emplace_back(seconds_of(frame), std::move(finding));
    }
    for (const Check check : report.judged) judged_[check]++;
    for (const NotJudged& each : report.not_judged) why_not_[each.check] = each.reason;
    report.findings.clear();
    report_ = report;
  }

  void end_shot() {
    for (auto& [fault, found] : shot_.found) {
      std::optional<Finding> finding = verdict(shot_.judged, std::move(found));
      if (finding) findings_[fault].push_back(std::move(*finding));
    }
    shot_ = {};
  }

  // The report on the whole video: for each fault its most certain finding, with the times of all shots that have it
  // with similar certainty.
  LintReport finish() {
    LintReport report = report_;
    report.frames = trace_.frames(), report.judged_frames = frames_;
    report.judged.clear(), report.not_judged.clear();
    for (const auto& [check, count] : judged_) judge(report, check);
    for (const auto& [check, reason] : why_not_) {
      if (!judged_.contains(check) && !is_of_time(check)) skip(report, check, reason);
    }
    for (auto& [fault, found] : findings_) {
      const auto less = [](const Finding& a, const Finding& b) { return a.certainty < b.certainty; };
      Finding finding = *std::max_element(found.begin(), found.end(), less);
      finding.times.clear();
      for (const Finding& each : found) {
        if (each.certainty < 0.5 && finding.certainty >= 0.5) continue;
        finding.times.insert(finding.times.end(), each.times.begin(), each.times.end());
      }
      report.findings.push_back(std::move(finding));
    }
    trace_.report(report);
    add_container(report);
    sort_report(report);
    return report;
  }

  // Checks the container's metadata against itself, the name and the players.
  void add_container(LintReport& report) const {
    const VideoFile file = read_video_file(video_.path);
    const VideoTrack& track = choose_track(file, static_cast<int>(video_.track), video_.path);
    for (const std::string& warning : video_warnings(file, track, video_.path)) report.notes.push_back(warning);
  }

  VideoLintOptions options_;
  VideoInput video_;
  VideoDecoder decoder_;
  FrameTrace trace_;
  int every_ = 1;
  int frames_ = 0;  // number of judged frames
  Shot shot_;
  std::map<Fault, std::vector<Finding>> findings_;  // per shot
  std::map<Check, int> judged_;
  std::map<Check, std::string> why_not_;
  LintReport report_;  // report of the last judged frame
};

}  // namespace

LintReport lint_video(const std::string& path, const VideoLintOptions& options, const Progress& progress) {
  return VideoJudge(path, options).run(progress);
}

}  // namespace ods
