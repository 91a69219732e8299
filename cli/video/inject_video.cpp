// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/apple_option.h"
#include "cli/video/inject_job.h"
#include "cli/video/wordless.h"
#include "ods/base/error.h"
#include "ods/base/suggest.h"
#include "ods/video/container/apple.h"
#include "ods/video/container/complete_metadata.h"

using ods::SphericalMetadata, ods::VideoProjection;

namespace {

void parse_projection(const std::string& name, SphericalMetadata& metadata) {
  const std::vector<std::string> names = {"lat-long", "vr180", "cubemap", "flat"};
  if (name == "cubemap" || name == "flat") {
    metadata.projection = name == "flat" ? VideoProjection::kFlat : VideoProjection::kCubemap;
  } else if (const ods::NamedProjection* named = ods::find_projection(name); named && name.starts_with("cube-3x2")) {
    throw UsageError(
        "--projection cube-3x2 has another order of faces than the cubemap of videos: right, left, up over down, "
        "front, back");
  } else if (named) {
    set_projection(metadata, named->setting);
  } else {
    throw UsageError(fmt::format("--projection is one of {}, not '{}'{}", fmt::join(names, ", "), name,
                                 ods::did_you_mean(name, names)));
  }
}

void note_written_metadata(const SphericalMetadata& metadata, const ods::TagResult& result, ods::Container container) {
  const char* places = !has_boxes(container) ? "StereoMode and Projection" : result.has_v1 ? "V1 and V2" : "V2";
  note(fmt::format("{}: written as {}{}", metadata_text(metadata), places,
                   result.has_vexu ? ", and for Apple's players" : ""));
}

void set_angles(const InjectJob& job, SphericalMetadata& metadata) {
  const bool is_given = job.yaw || job.pitch || job.roll;
  if (is_given && metadata.projection == VideoProjection::kFlat) {
    throw UsageError(fmt::format("'{}' is flat, so it cannot have --yaw, --pitch or --roll", job.file));
  }
  const auto set = [](const std::optional<float>& choice, double& angle) {
    if (choice) angle = static_cast<double>(*choice);
  };
  set(job.yaw, metadata.yaw), set(job.pitch, metadata.pitch), set(job.roll, metadata.roll);
}

bool has_changes(const InjectJob& job) {
  return job.is_mono || job.layout || !job.projection.empty() || job.yaw || job.pitch || job.roll || job.ambisonics ||
         job.for_apple;
}

// If only the shape identifies the video, the frames must agree.
void take_what_frames_show(const ods::MediaFile& media, SphericalMetadata& known, std::vector<std::string>& guesses) {
  const std::optional<Wordless> seen = wordless_to_tag(media);
  if (!seen) return;
  guesses.push_back(seen->text);
  known.stereo = seen->reading->layout ? ods::video_stereo(*seen->reading->layout) : ods::VideoStereo::kOneView;
  set_projection(known, seen->reading->projection);
}

// If a video's name or shape contradicts its metadata, the user must decide.
void settle_conflicts(const InjectJob& job, const SphericalMetadata& known, const ods::VideoTrack& track,
                      bool matters) {
  std::string texts, options;
  for (const ods::MetadataConflict& conflict : find_conflicts(known, track, job.file)) {
    texts += (texts.empty() ? "" : "; ") + conflict.text;
    options += (options.empty() ? "" : ", and ") + conflict.options;
  }
  if (texts.empty()) return;
  if (!matters) return warn(texts);
  throw ods::Error(ods::ErrorKind::kInput,
                   fmt::format("'{}' contradicts itself: {}. Decide: {}", job.file, texts, options));
}

// Returns the metadata that the video gets; metadata that were not requested stay. Prints what the format cannot
// express.
SphericalMetadata requested_metadata(const InjectJob& job, const ods::MediaFile& media,
                                     std::vector<std::string>& guesses) {
  const ods::VideoTrack& track = media.track;
  const ods::Container container = media.video->container;
  SphericalMetadata known;
  if (job.is_mono) known.stereo = ods::VideoStereo::kOneView;
  if (job.layout) known.stereo = ods::video_stereo(*job.layout);
  if (!job.projection.empty()) parse_projection(job.projection, known);
  known.for_apple = job.for_apple;
  std::vector<std::string> seen;
  take_what_frames_show(media, known, seen);
  SphericalMetadata metadata = complete_metadata(known, track, job.file, guesses);
  guesses.insert(guesses.end(), seen.begin(), seen.end());
  set_angles(job, metadata);
  const ods::TagPlan plan = plan_tag(container, track, metadata);
  settle_conflicts(job, known, track, plan.adds_metadata || !has_changes(job));
  if (job.for_apple && track.layers) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("the eyes of '{}' are layers of its stream, which its vexu describes: --apple would "
                                 "write another",
                                 job.file));
  }
  if (job.for_apple && !fits_vexu(metadata)) {
    throw ods::Error(ods::ErrorKind::kUsage,
                     fmt::format("--apple: vexu cannot express {} ('{}')", metadata_text(metadata), job.file));
  }
  if (!can_express(container, track, metadata)) {
    const auto kind = has_changes(job) ? ods::ErrorKind::kUsage : ods::ErrorKind::kInput;
    throw ods::Error(kind, fmt::format("cannot use '{}': {} cannot express {}", job.file, container_name(container),
                                       metadata_text(metadata)));
  }
  for (const std::string& each : plan.notes) note(each);
  return metadata;
}

// The settings that make it unnecessary to look at the frames.
ods::FormatHint format_hint_of(const InjectJob& job) {
  ods::FormatHint known;
  known.one_eye = job.is_mono || job.remove;
  known.layout = job.layout;
  if (!job.projection.empty() || job.remove) known.projection = ods::ProjectionSetting();  // any: it is not guessed
  return known;
}

// The sound's new metadata; nothing if it stays as it is.
std::optional<ods::Ambisonics> requested_sound(const InjectJob& job, const ods::VideoFile& video) {
  if (!job.ambisonics) return std::nullopt;
  if (!has_boxes(video.container))
    throw UsageError("--ambisonics is for mp4 and mov; in mkv and webm Opus describes its own channels");
  const bool is_alone = video.sound.size() == 1;
  if (!is_alone)
    throw UsageError(fmt::format("--ambisonics: '{}' has {} sound tracks, not one", job.file, video.sound.size()));
  const int channels = video.sound[0].channels;
  if (channels != 4) {
    const std::string has = channels > 0 ? fmt::format("has {}", channels) : "has an unknown number";
    throw UsageError(fmt::format("--ambisonics needs sound with 4 channels; '{}' {}", job.file, has));
  }
  return ods::Ambisonics();
}

}  // namespace

void inject_video(const InjectJob& job, ProgressLines& lines) {
  const ods::MediaFile media = ods::open_media(job.file, {.known = format_hint_of(job), .track = job.track});
  const ods::VideoFile& video = *media.video;
  if (are_tracks(media.views)) {
    throw ods::Error(ods::ErrorKind::kInput,
                     fmt::format("the pictures of '{}' are two tracks, and players show one: ods convert joins them, "
                                 "and tags the new video; --track {} tags this one of them",
                                 job.file, media.track.id));
  }
  check_apple(job.for_apple, video.container);
  const std::optional<ods::Ambisonics> sound = requested_sound(job, video);
  std::optional<SphericalMetadata> metadata;
  std::vector<std::string> guesses;
  if (!job.remove) metadata = requested_metadata(job, media, guesses);
  const auto start = std::chrono::steady_clock::now();
  const auto progress = [&](double done) {
    const double kSoon = 1.0;  // seconds: shorter jobs do not show progress
    if (const double seconds = seconds_since(start); seconds > kSoon)
      lines.report(done, seconds, {"inject", 0, 0, job.output});
  };
  const ods::TagResult result = tag_video(job.file, job.output, media.track.id, metadata, {{sound}, {}}, progress);
  lines.clear();
  for (const std::string& guess : guesses) note(guess);
  if (metadata) note_written_metadata(*metadata, result, video.container);
  if (job.ambisonics) note("sound: written as first-order ambisonics (SA3D)");
}
