// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/convert/convert_frames.h"
#include "cli/convert/resume_settings.h"
#include "cli/options/picture_options.h"
#include "ods/base/error.h"
#include "ods/video/container/apple.h"

using ods::Container, ods::FootageKind, ods::SphericalMetadata, ods::VideoStream;

namespace {

// The layout of the new frames. Videos have both eyes in halves; another layout becomes the usual one, unless it was
// requested.
ods::Layout layout_for(const ConvertJob& job) {
  const ods::Layout layout = job.save.layout;
  if (job.target.eyes.size() == 1 || ods::arrangement_of(layout).is_halves()) return layout;
  if (!job.given.form.given_layout()) return ods::default_layout(job.target.camera.projection);
  throw UsageError(
      fmt::format("a video's layout is top-bottom, bottom-top, side-by-side or cross-eyed, perhaps -half, "
                  "not {}",
                  layout_name(layout)));
}

// The old video's metadata stay: its angles, its eye distance, and whether it is for Apple's players.
void keep_metadata(const ConvertJob& job, ods::VideoPlan& plan) {
  SphericalMetadata& metadata = plan.metadata;
  if (job.target.eyes.size() == 2 && job.picture.has_ipd) {
    metadata.ipd = static_cast<double>(job.target.camera.ipd);
  }
  if (!job.footage) return;
  const SphericalMetadata& old = job.footage->video().metadata;
  if (metadata.projection && metadata.projection != ods::VideoProjection::kFlat) {
    metadata.yaw = old.yaw, metadata.pitch = old.pitch, metadata.roll = old.roll;
  }
  metadata.for_apple = old.for_apple && fits_vexu(metadata);
  if (old.for_apple && !metadata.for_apple) {
    plan.notes.push_back(
        fmt::format("vexu cannot express {}: Apple's players show a flat video", metadata_text(metadata)));
  }
}

ods::VideoPlan plan_for(ConvertJob& job) {
  const int eyes = static_cast<int>(job.target.eyes.size());
  const ods::Layout layout = layout_for(job);
  job.target.eye = ods::squeezed_eye(layout, job.target.eye, eyes);
  ods::VideoPlan plan = ods::plan_eyes(job.target.eye, job.target.eyes.size(), layout, job.target.camera.projection);
  keep_metadata(job, plan);
  const Container container = container_for(job.given.output);
  if (plan.metadata.projection && has_boxes(container) && !fits_v2(plan.metadata)) {
    throw UsageError(
        fmt::format("{} cannot express {}; .mkv can", container_name(container), metadata_text(plan.metadata)));
  }
  return plan;
}

// Encoding costs quality and time: changes of metadata alone are for other commands.
void refuse_copy(const ConvertJob& job, const ods::VideoPlan& plan) {
  const auto is_rearranged = [](const ods::Footage& footage) {
    const ods::Views views = footage.video().views;
    return footage.stream().is_upside_down || views != ods::Views::kFirst;
  };
  const bool has_layout = plan.layout == job.picture.layout || job.picture.eyes.size() == 1;
  const bool is_same = has_layout && !(job.footage && is_rearranged(*job.footage));
  if (job.given.span().is_part() || !job.turns.empty() || job.given.video.specifies_encoding() || !is_same ||
      !is_same_picture(job.picture, job.target))
    return;
  throw UsageError(
      fmt::format("no pixel of '{}' would change, and encoding it again would cost quality: ods inject "
                  "changes its metadata; --codec or --crf encode it again anyway",
                  job.given.input));
}

VideoChoices choices_for(const ConvertJob& job) {
  VideoChoices choices = job.given.video;
  choices.output = job.given.output;
  if (!job.footage) return choices;
  const VideoStream& stream = job.footage->stream();
  choices.keep.cut.is_cut = job.given.span().is_part();
  if (job.given.span().to) choices.keep.cut.length = *job.given.span().to - job.given.span().from;
  choices = choices_like(choices, job.footage->video(), stream);
  if (!stream.words.is_hdr()) return choices;
  if (job.given.video.bits == 8)
    throw UsageError(fmt::format("'{}' is HDR, which needs 10 bits: leave out --bits 8", job.given.input));
  choices.bits = 10;
  return choices;
}

void check_job(const ConvertJob& job) {
  if (!job.footage) return;
  if (job.given.display.exposure || job.given.display.tone) {
    throw UsageError("--exposure and --tone are for scene-linear frames: a video's curve stays as it is");
  }
  if (job.footage->stream().words.is_hdr() && changes_colors(job.target.right)) {
    throw UsageError(fmt::format(
        "'{}' is HDR, whose code values are kept: --right-gain and --right-gamma are for others", job.given.input));
  }
  if (job.footage->stream().has_alpha) {
    throw UsageError(
        fmt::format("'{}' has alpha, which the encoders here cannot keep: convert it to frames (-o "
                    "'x.####.png')",
                    job.given.input));
  }
}

int convert_footage(ConvertJob& job, const ods::VideoPlan& plan, const ods::EncodeOptions& options,
                    const ods::Progress& progress) {
  const ods::Resume resume{resume_settings(job), [](const std::string& words) { note(words); }, job.given.restart};
  ods::DepthFootage* depth = job.depth_frames ? &*job.depth_frames : nullptr;
  ods::MergeOfPicture merge;
  if (job.merges) merge = [&job](int picture) { return job.merges->at(picture); };
  if (!job.footage) {
    const ods::DisplayTransform display{job.save.exposure, job.save.tone};
    return ods::convert_frames(
        {job.files, job.picture, job.target, plan.layout, plan.metadata, display, resume, depth, note_depth, merge},
        options, job.given.output, progress);
  }
  return ods::convert_video(*job.footage,
                            {job.target, plan.layout, plan.metadata, job.turns, resume, depth, note_depth, merge},
                            options, job.given.output, progress);
}

}  // namespace

void convert_to_video(ConvertJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  note_guesses(job.footage ? job.given.input : job.files.path(0), job.picture);
  check_job(job);
  open_depth(job);
  find_merges(job);
  if (job.footage) job.footage->choose(job.given.span());
  const ods::VideoPlan plan = plan_for(job);
  refuse_copy(job, plan);
  for (const std::string& each : plan.notes) note(each);
  const VideoChoices choices = choices_for(job);
  const ods::EncodeOptions options = encode_options(choices, plan.size, job.given.threads);
  ods::check_packing(plan, options.packing);
  note_player_limits(choices, plan, options);
  const size_t expected = job.footage ? static_cast<size_t>(job.footage->expected_count()) : job.files.frames.size();
  note_sound_length(options, expected);
  if (options.bitrate && expected > ods::kPartFrames) {
    note("--bitrate is an average over the whole video: if interrupted, it starts over");
  }
  ods::Progress progress;
  progress.report = [&](double done) {
    lines.report(done, seconds_since(start), video_step("convert", done, expected, job.given.output));
  };
  const int count = convert_footage(job, plan, options, progress);
  lines.clear();
  announce_file(job.given.output);
  note(fmt::format("{}: {}, in {}", job.given.output, video_text(plan, options, static_cast<size_t>(count)),
                   duration_text(seconds_since(start))));
}
