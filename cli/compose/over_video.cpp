// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/compose/over_video.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "ods/base/error.h"
#include "ods/compose/over_video.h"

using ods::Container, ods::VideoInput, ods::VideoStream, ods::Footage, ods::FootageKind;

namespace {

constexpr int kLast = 1 << 30;

struct Range {
  int first = 0, last = kLast;
};

// Frames must be consecutive because a video's sound is continuous.
Range range_of(const OverJob& job) {
  if (!job.frames) return {};
  check_rising(*job.frames);
  const Range range{job.frames->front(), job.frames->back()};
  if (static_cast<size_t>(range.last - range.first) + 1 == job.frames->size()) return range;
  throw UsageError("--frames of a video that becomes a video must be consecutive, as 30-120, because its sound is");
}

VideoChoices choices_for(const OverJob& job, const VideoInput& video, const VideoStream& stream) {
  VideoChoices choices = job.video;
  choices.output = job.output;
  choices.keep.cut.is_cut = job.frames.has_value();
  return choices_like(choices, video, stream);
}

ods::VideoPlan plan_like(const VideoInput& video, const VideoStream& stream) {
  ods::VideoPlan plan;
  plan.eye = video.prototype.size;
  plan.eyes = video.prototype.eyes.size();
  plan.layout = video.prototype.layout;
  plan.size = stream.size;
  plan.metadata = video.metadata;
  return plan;
}

void check_job(const OverJob& job, const VideoInput& video) {
  if (job.display.tone || job.display.exposure)
    throw UsageError("--exposure and --tone are for scene-linear frames, not for videos");
  if (job.layout && *job.layout != video.prototype.layout) {
    throw UsageError(fmt::format("the video stays {}; --to-layout needs frames as output (-o 'x.####.png')",
                                 layout_name(video.prototype.layout)));
  }
  if (video.metadata.projection == ods::VideoProjection::kOther) {
    throw UsageError(
        fmt::format("'{}': titles over a video need one in lat-long or a part of it; ods convert --to "
                    "lat-long makes one",
                    video.path));
  }
  refuse_overwriting(job.output, job.background);
  refuse_overwriting(job.output, job.foreground);
  const Container container = container_for(job.output);
  if (has_boxes(container) && !ods::fits_v2(video.metadata)) {
    throw UsageError(
        fmt::format("{} cannot express {}; .mkv can", container_name(container), metadata_text(video.metadata)));
  }
}

// The foreground, or its first frame.
ods::StoredPicture first_of(Footage& front) {
  if (front.kind() == FootageKind::kPicture) return *front.picture(0);
  if (front.kind() == FootageKind::kVideo) {
    ods::StoredPicture prototype = front.video().prototype;
    prototype.eyes[0].layers.push_back({{"R", "G", "B"}});
    if (front.stream().has_alpha) prototype.eyes[0].layers[0].channels.emplace_back("A");
    return prototype;
  }
  const std::vector<int> frames = front.frames();
  if (!frames.empty()) return *front.picture(frames.front());
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("there is no frame '{}'", front.path()));
}

}  // namespace

void check_rising(const std::vector<int>& frames) {
  if (std::is_sorted(frames.begin(), frames.end()) && frames.front() >= 0) return;
  throw UsageError("--frames of a video must be ascending, from 0 on: it is read from start to end");
}

void lay_over_video(const OverJob& job, Footage& back, Footage& front, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  const VideoInput& video = back.video();
  note_guesses(back.path(), video.prototype);
  check_job(job, video);
  const ods::StoredPicture first = first_of(front);
  note_guesses(front.path(), first);
  check_over(job, first, video.prototype);
  for (const std::string& warning : over_warnings(first, video.prototype)) warn(warning);
  if (front.kind() == FootageKind::kVideo && front.stream().rate.value() != back.stream().rate.value()) {
    warn(fmt::format("the foreground has {:.4g} frames per second, the background {:.4g}: frames are paired by number",
                     front.stream().rate.value(), back.stream().rate.value()));
  }
  const Range range = range_of(job);
  const VideoChoices choices = choices_for(job, video, back.stream());
  const ods::EncodeOptions options = encode_options(choices, back.stream().size, job.threads);
  const ods::VideoPlan plan = plan_like(video, back.stream());
  note_player_limits(choices, plan, options);
  ods::Progress progress;
  const int last = std::min(range.last, std::max(back.stream().count - 1, range.first));
  const size_t expected = static_cast<size_t>(last - range.first) + 1;
  progress.report = [&](double done) {
    lines.report(done, seconds_since(start), video_step("over", done, expected, job.output));
  };
  const int count = over_video(back, front, range.first, range.last, job.over, options, job.output, progress);
  lines.clear();
  announce_file(job.output);
  note(fmt::format("{}: {}, in {}", job.output, video_text(plan, options, static_cast<size_t>(count)),
                   duration_text(seconds_since(start))));
}
