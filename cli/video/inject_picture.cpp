// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/console/console.h"
#include "cli/video/inject_job.h"
#include "cli/video/wordless.h"
#include "ods/base/error.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/picture/metadata/tag_picture.h"

namespace {

ods::FormatHint known_format(const InjectJob& job) {
  ods::FormatHint known;
  known.one_eye = job.is_mono;
  known.layout = job.layout;
  if (job.projection.empty()) return known;
  const ods::NamedProjection* named = ods::find_projection(job.projection == "flat" ? "perspective" : job.projection);
  if (!named) {
    throw UsageError(fmt::format("--projection: pictures have no projection '{}'{}", job.projection,
                                 ods::did_you_mean(job.projection, ods::names_of(ods::named_projections()))));
  }
  known.projection = named->setting;
  return known;
}

// If only the shape identifies the picture, the pixels must agree.
ods::FormatHint confirmed_by_pixels(const InjectJob& job, ods::FormatHint known) {
  const std::optional<Wordless> seen = wordless_to_tag(ods::open_media(job.file, {.known = known, .color_only = true}));
  if (seen) known.seen = ods::SeenFormat{seen->reading->layout, seen->reading->projection, seen->text};
  return known;
}

// If a picture's name contradicts its metadata, the user must decide.
void settle_name(const InjectJob& job, const ods::PictureTag& tag) {
  const std::string fault = ods::name_fault(job.file, tag.layout, tag.camera.projection);
  if (fault.empty()) return;
  const bool asks = job.is_mono || job.layout || !job.projection.empty() || job.yaw || job.pitch || job.roll;
  if (asks) return warn(fmt::format("'{}': {}", job.file, fault));
  throw ods::Error(ods::ErrorKind::kInput,
                   fmt::format("'{}' contradicts itself: {}. Decide with --layout or --projection", job.file, fault));
}

}  // namespace

void inject_picture(const InjectJob& job) {
  if (job.track || job.ambisonics || job.for_apple)
    throw UsageError(fmt::format("--track, --ambisonics and --apple are for videos, but '{}' is a picture", job.file));
  if (job.remove) return ods::tag_picture(job.file, job.output, std::nullopt);
  std::vector<std::string> guesses;
  ods::PictureTag tag = ods::complete_tag(confirmed_by_pixels(job, known_format(job)), job.file, guesses);
  settle_name(job, tag);
  tag.camera.yaw = job.yaw.value_or(tag.camera.yaw);
  tag.camera.pitch = job.pitch.value_or(tag.camera.pitch);
  tag.camera.roll = job.roll.value_or(tag.camera.roll);
  ods::tag_picture(job.file, job.output, tag);
  for (const std::string& guess : guesses) note(guess);
  note(fmt::format("{}, {}: written", tag.layout ? layout_name(*tag.layout) : ods::eye_name(tag.eye),
                   projection_name(tag.camera.projection)));
}
