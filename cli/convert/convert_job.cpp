// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/convert_job.h"

#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/options/eye_options.h"
#include "cli/options/projection_options.h"
#include "cli/options/time_options.h"
#include "ods/camera/file_names.h"
#include "ods/files/atomic_file.h"
#include "ods/picture/photo_metadata.h"

using ods::StereoCamera, ods::FootageKind;

namespace {

ods::FormatHint hint_of(const ConvertOptions& given) {
  ods::FormatHint known = given.known;
  if (given.input_fov) {
    if (!known.projection) known.projection = ods::find_projection("fisheye")->setting;
    if (!ods::has_fov(known.projection->kind)) {
      throw UsageError(fmt::format("--input-fov is for {}, not for the projection {}", ods::kinds_with(ods::has_fov),
                                   ods::projection_name(*known.projection)));
    }
    known.projection->fov = *given.input_fov;
  }
  finish_lens_options(known);
  if (given.camera.file.empty()) return known;
  const ods::Sidecar file = read_camera_file(given.camera.file);
  known.camera = file.camera;
  if (!known.layout) known.layout = file.eyes.size() == 2 ? file.layout : ods::Layout::kSeparate;
  return known;
}

void open_header(ConvertJob& job) {
  const ConvertOptions& given = job.given;
  const ods::FormatHint known = hint_of(given);
  job.kind = ods::footage_kind(given.input);
  if (job.kind == FootageKind::kFrames) job.files = ods::find_frames(given.input, given.frames);
  job.every_frame = job.files.frames;
  ods::MediaFile media =
      open_input(given.input, {.known = known, .scratch_folder = ods::existing_folder_of(given.output)});
  ods::OpenOptions open;
  open.format = media.hint;
  switch (job.kind) {
    case FootageKind::kPicture:
      job.picture = job.reader.emplace(reader_of(std::move(media))).header();
      break;
    case FootageKind::kFrames:
      job.picture = ods::PictureReader(job.files.path(0), open).header();
      break;
    case FootageKind::kVideo:
      job.picture = job.footage.emplace(given.input, open.format).video().prototype;
      break;
  }
  if (!given.depth.path.empty()) ods::promise_depth(job.picture);
}

// A picture becomes a picture; frames and videos become either.
void check_kinds(const ConvertOptions& given, FootageKind kind) {
  const bool to_video = ods::container_of_path(given.output).has_value();
  const bool to_frames = ods::frame_names(given.output).has_value();
  if (kind == FootageKind::kPicture && (to_video || to_frames)) {
    throw UsageError(fmt::format(
        "'{}' is one picture; a video and frames are made of frames (shot.####.png) or of a video", given.input));
  }
  if (kind != FootageKind::kPicture && !to_video && !to_frames) {
    throw UsageError(
        fmt::format("'{}' has many pictures, '{}' would be one: name frames (-o 'shot.####.png') or a "
                    "video (.mp4 .mov .mkv .webm)",
                    given.input, given.output));
  }
  const bool from_video = kind == FootageKind::kVideo, from_frames = kind == FootageKind::kFrames;
  if (given.trim && !from_video) throw UsageError("--trim is for videos");
  if (!given.turns.empty() && !from_video) throw UsageError("--stabilize is for videos");
  if (given.frames && !from_frames) throw UsageError("--frames is for frames; --trim chooses a part of a video");
  const bool has_times = from_frames && (to_video || given.camera.changes.merge_limit);  // a merge changes over time
  if (given.rate && !has_times) {
    throw UsageError("--fps needs frames that become a video or use --merge auto; a video keeps its own times");
  }
  if (given.restart && !to_video) {
    throw UsageError(from_frames ? "--restart is for videos; frames continue with --skip-existing"
                                 : "--restart is for output that is a video: nothing else resumes");
  }
  if (given.video.specifies_encoding() && !to_video) {
    throw UsageError(
        fmt::format("--codec and similar options need video output, and '{}' is not a video", given.output));
  }
}

// A substitute for the merge that depends on the depth, to check the conversion before the depth is read.
void promise_merge(StereoCamera& camera) {
  auto half = std::make_shared<ods::Image>(1, 1, 1);
  half->pixels[0] = 0.5f;
  camera.merge_map = half;
  camera.top.mode = camera.bottom.mode = ods::kMergeMap;
}

}  // namespace

void refuse_impossible(const ConvertJob& job, const ods::StoredPicture& picture) {
  const std::string fault = ods::conversion_fault(picture, job.target);
  if (!fault.empty()) throw UsageError(fmt::format("'{}': {}", job.given.input, fault));
}

ConvertJob open_conversion(const ConvertOptions& given) {
  ConvertJob job;
  job.given = given;
  open_header(job);
  check_kinds(given, job.kind);
  check_share(given.share, given.input, given.output);
  job.files.frames = own_frames(given.share.only, job.files.frames);
  refuse_overwriting(given.output, given.input);
  take_stated_distance(given, job.picture);
  ConversionPlan plan = plan_conversion(job.picture, given);
  for (const std::string& each : plan.notes) note(each);
  job.target = plan.target, job.save = plan.save;
  read_maps(given.camera.changes, job.target.camera);
  if (given.camera.changes.merge_limit) promise_merge(job.target.camera);
  if (!given.turns.empty()) job.turns = ods::read_turn_keys(given.turns);
  refuse_impossible(job, job.picture);
  if (ods::container_of_path(given.output)) return job;  // convert_to_video() judges the output
  note_misleading_name(given.output, job.save, job.target.eyes.size(), job.target.camera.projection);
  ods::check_output(given.output, job.save, job.target.eyes, job.target.eye, &job.target.camera.projection);
  if (job.kind == FootageKind::kPicture && !ods::names_files(given.input)) {
    const std::string lost = ods::keep_photo_metadata(given.input, given.output, job.save);
    if (!lost.empty()) note(lost);
  }
  return job;
}

void read_pixels(ConvertJob& job) {
  const ConvertOptions& given = job.given;
  job.picture = job.reader->read(ods::existing_folder_of(given.output));
  job.reader.reset();  // it may hold a decoder's memory
  take_stated_distance(given, job.picture);
  note_guesses(given.input, job.picture);
  if (!given.depth.path.empty()) give_depth(given.depth, job.picture);
  refuse_impossible(job, job.picture);
  StereoCamera& camera = job.target.camera;
  const std::optional<float> limit = given.camera.changes.merge_limit;
  if (limit && job.target.eyes[0] != ods::kMono) {
    use_shares(ods::comfortable_shares(ods::seen_by_eyes(job.picture), camera, *limit), camera);
  }
}

std::optional<int> first_of_all(const ConvertJob& job) {
  if (job.kind != FootageKind::kFrames || job.every_frame.empty()) return std::nullopt;
  return job.every_frame.front();
}

void open_depth(ConvertJob& job) {
  const ConvertOptions& given = job.given;
  if (given.depth.path.empty()) return;
  const bool is_part = job.files.frames != job.every_frame || given.share.skip_existing;
  if (is_part && ods::footage_kind(given.depth.path) == FootageKind::kVideo) {
    throw UsageError(fmt::format(
        "--only and --skip-existing need the depth as frames (depth.####.png), which have numbers: '{}' is a video",
        given.depth.path));
  }
  job.depth_frames.emplace(given.depth.path, job.picture, given.depth.options, given.span(), first_of_all(job));
}
