// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/video/wordless.h"

#include <fmt/format.h>

#include "ods/base/error.h"

using ods::Identity, ods::Reading;

namespace {

std::optional<Wordless> judged(const std::optional<Identity>& identity, bool (*can_express)(const Reading& reading)) {
  if (!identity || identity->readings.empty()) return std::nullopt;
  if (!identity->is_sure()) return Wordless{{}, *identity, "it may be " + doubt_text(*identity)};
  const Reading& best = identity->best();
  const std::string looks =
      fmt::format("it looks like {}: {} ({:.2f})", reading_text(best), identity->reason, best.certainty);
  if (can_express(best)) return Wordless{best, *identity, looks};
  return Wordless{
      {}, *identity, looks + "; if that is right, there is nothing to tag; otherwise give --layout and --projection"};
}

bool video_can_express(const Reading& reading) {
  if (!reading.layout && reading.projection.kind == ods::kPerspective) return false;  // an ordinary video
  try {
    if (reading.layout) ods::video_stereo(*reading.layout);
    ods::SphericalMetadata metadata;
    set_projection(metadata, reading.projection);
  } catch (const ods::Error&) {
    return false;
  }
  return true;
}

// Pixels do not show the field of view of a lens.
bool picture_can_express(const Reading& reading) {
  return !ods::has_fov(reading.projection.kind);
}

}  // namespace

std::optional<Wordless> look_at_frames(const ods::SphericalMetadata& known, const ods::VideoTrack& track,
                                       const std::string& path) {
  if (!is_told_by_shape(known, track, path)) return std::nullopt;
  ods::FormatHint hint;
  if (known.stereo) {
    hint.one_eye = *known.stereo == ods::VideoStereo::kOneView;
    hint.layout = layout_with(arrangement_of(*known.stereo));
  }
  return judged(ods::identify_video(path, track.id, hint), video_can_express);
}

std::optional<Wordless> judged_picture(const std::optional<Identity>& identity) {
  return judged(identity, picture_can_express);
}

std::optional<Wordless> look_at_pixels(const ods::FormatHint& known, const std::string& path) {
  if (ods::names_eye(path)) return std::nullopt;
  const ods::StereoFormat format = find_format(ods::read_info(path), path, known);
  return judged_picture(ods::identify_if_open(path, format, known));
}
