// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/complete_metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ods/base/error.h"
#include "ods/image/format/pixel_place.h"
#include "ods/video/container/apple.h"

namespace ods {

VideoStereo video_stereo(Layout layout) {
  const EyeArrangement eyes = arrangement_of(layout);
  if (!eyes.is_halves()) {
    throw Error(ErrorKind::kUsage, fmt::format("360 metadata of videos has no layout {}", layout_name(layout)));
  }
  return *stereo_with(eyes);
}

bool can_say_projection(const ProjectionSetting& projection) {
  if (projection.kind == kPerspective) return true;
  return projection.kind == kLatLong && projection.longitude.x >= -180.0f && projection.longitude.y <= 180.0f;
}

void set_projection(SphericalMetadata& metadata, const ProjectionSetting& projection) {
  metadata.bounds = {};
  if (projection.kind == kPerspective) {
    metadata.projection = VideoProjection::kFlat;
    return;
  }
  if (!can_say_projection(projection)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("360 metadata of videos has no projection {}, only lat-long, parts of it such as vr180, "
                            "cubemap and flat",
                            projection_name(projection)));
  }
  metadata.projection = VideoProjection::kEquirect;
  const auto part = [](float degrees, double whole) {
    return static_cast<uint32_t>(std::llround(static_cast<double>(degrees) / whole * 4294967296.0));
  };
  metadata.bounds = {part(90.0f - projection.latitude.y, 180.0), part(90.0f + projection.latitude.x, 180.0),
                     part(180.0f + projection.longitude.x, 360.0), part(180.0f - projection.longitude.y, 360.0)};
}

static FormatHint as_picture(const SphericalMetadata& known) {
  FormatHint metadata;
  if (known.stereo) {  // kAlone for one eye, or for stereo that pictures do not support
    const EyeArrangement eyes = arrangement_of(*known.stereo);
    metadata.layout = eyes.is_halves() ? layout_with(eyes) : Layout::kSeparate;
  }
  if (known.projection) metadata.projection = ProjectionSetting();  // any value: a known projection is not guessed
  return metadata;
}

std::optional<SphericalMetadata> declared_metadata(const VideoTrack& track) {
  std::optional<SphericalMetadata> said;
  for (const std::optional<SphericalMetadata>* place : {&track.v2, &track.v1, &track.vexu}) {
    if (!*place) continue;
    const SphericalMetadata& metadata = **place;
    if (!said) {
      said = metadata;
    } else {
      if (!said->stereo) said->stereo = metadata.stereo;
      if (!said->projection) {  // then it has no angles and no source, either
        const std::optional<VideoStereo> stereo = said->stereo;
        said = metadata;
        said->stereo = stereo;
      }
    }
  }
  if (!said) return said;
  said->stereo = said->stereo.value_or(VideoStereo::kOneView);
  said->projection = said->projection.value_or(VideoProjection::kFlat);
  said->yaw = std::remainder(said->yaw, 360.0);  // V1 may store a heading of 270
  said->ipd = track.vexu ? track.vexu->ipd : 0.0;
  return said;
}

// Pictures default to lat-long. Videos must not: an ordinary video must not become a sphere.
static void guess_projection(SphericalMetadata& known, const StereoFormat& format, const VideoTrack& track,
                             const std::string& path) {
  const Extent shown{static_cast<int>(std::lround(track.size.width * track.pixel_aspect)), track.size.height};
  const Extent eye = whole_eye(format.layout.layout.value_or(Layout::kSeparate), shown).value_or(shown);
  const bool is_known = format.has_camera || read_name(path).projection != nullptr;
  if (!is_known && !is_told_by_shape(format.camera.projection, eye)) {
    throw Error(ErrorKind::kInput,
                fmt::format("cannot tell what '{}' shows, from its name (_360_TB, _180_LR ...) or its shape "
                            "({}x{}): give `layout` and `projection`",
                            path, track.size.width, track.size.height));
  }
  set_projection(known, format.camera.projection);
}

static StereoFormat found_format(const SphericalMetadata& known, const VideoTrack& track, const std::string& path) {
  FileInfo info;
  info.width = track.size.width;
  info.height = track.size.height;
  info.is_float = true;  // skips the search for a picture's XMP
  if (track.pixel_aspect != 1.0) info.numbers[std::string(kPixelAspect)] = {static_cast<float>(track.pixel_aspect)};
  if (info.width == 0 || info.height == 0) {
    throw Error(ErrorKind::kInput, fmt::format("cannot use '{}': it does not give its picture size", path));
  }
  return find_format(info, path, as_picture(known));
}

static void take_metadata(SphericalMetadata& known, const SphericalMetadata& said) {
  if (!known.stereo) known.stereo = said.stereo;
  if (!known.projection) {
    known.projection = said.projection;
    known.bounds = said.bounds;
  }
  if (known.projection != VideoProjection::kFlat) {  // flat has no angles
    known.yaw = said.yaw, known.pitch = said.pitch, known.roll = said.roll;
  }
  known.source = said.source;
}

SphericalMetadata complete_metadata(SphericalMetadata known, const VideoTrack& track, const std::string& path,
                                    std::vector<std::string>& guesses) {
  const std::optional<SphericalMetadata> said = declared_metadata(track);
  const bool is_new = known.stereo || !said;
  if (said) take_metadata(known, *said);
  const StereoFormat format = found_format(known, track, path);
  const Layout layout = format.layout.layout.value_or(Layout::kSeparate);
  if (is_new && !unpacked_size(layout, track.size)) {
    throw Error(ErrorKind::kInput,
                fmt::format("cannot tag '{}': {}x{} pixels are not two eyes, {}: give another `layout`", path,
                            track.size.width, track.size.height, layout_name(layout)));
  }
  if (!known.stereo) known.stereo = layout == Layout::kSeparate ? VideoStereo::kOneView : video_stereo(layout);
  if (!known.projection) guess_projection(known, format, track, path);
  if (known.stereo != VideoStereo::kOneView && known.ipd == 0.0) {
    known.ipd = track.vexu ? track.vexu->ipd : format.has_ipd ? static_cast<double>(format.camera.ipd) : 0.0;
  }
  known.for_apple = known.for_apple || track.vexu.has_value();
  if (!said) known.source = "Omnistereo";
  guesses = format.guesses;
  return known;
}

bool is_told_by_shape(const SphericalMetadata& known, const VideoTrack& track, const std::string& path) {
  return !declared_metadata(track) && found_format(known, track, path).is_open;
}

// --- contradictions --------------------------------------------------------------------------------------------------

// Squeezed eyes are square, or have the width that headsets' decoders prefer. Interleaved eyes have the shape of
// halves.
std::string shape_fault(const SphericalMetadata& metadata, const VideoTrack& track) {
  const Extent size = track.size;
  if (metadata.projection != VideoProjection::kEquirect || metadata.is_partial() || size.height == 0) return {};
  const double aspect = track.pixel_aspect * size.width / size.height;
  const EyeArrangement eyes = arrangement_of(metadata.stereo.value_or(VideoStereo::kOneView));
  const bool is_stacked = eyes.how == EyePacking::kStacked || eyes.how == EyePacking::kRows;
  const bool is_beside = eyes.how == EyePacking::kBeside || eyes.how == EyePacking::kColumns;
  const double whole = is_stacked ? 1.0 : is_beside ? 4.0 : 2.0;
  const auto has_aspect = [&](double of) { return std::abs(aspect / of - 1.0) < 0.02; };
  if (has_aspect(whole) || has_aspect(2.0) || (eyes.is_halves() && has_aspect(16.0 / 9.0))) return {};
  return fmt::format("its metadata specifies {}, which does not fit {}x{} pixels", metadata_text(metadata), size.width,
                     size.height);
}

static std::optional<VideoStereo> stereo_of(std::optional<Layout> layout) {
  if (!layout || *layout == Layout::kSeparate) return VideoStereo::kOneView;
  const EyeArrangement eyes = arrangement_of(*layout);
  return eyes.is_halves() ? stereo_with(eyes) : std::nullopt;
}

// Returns whether a video with this metadata may have this projection in its name: a cubemap or most of a sphere may be
// called 360, a mesh anything.
static bool may_be_called(const SphericalMetadata& metadata, const ProjectionSetting& called) {
  if (metadata.projection == VideoProjection::kMesh || metadata.projection == VideoProjection::kOther) return true;
  const double cut = (1.0 * metadata.bounds[2] + metadata.bounds[3]) / 4294967296.0;
  const bool is_wide = cut < 0.25;
  if (called.kind == kPerspective) return metadata.projection == VideoProjection::kFlat;
  if (metadata.projection == VideoProjection::kFlat) return false;
  const bool is_part = called.kind == kLatLong && called.longitude.y - called.longitude.x < 270.0f;
  if (metadata.projection == VideoProjection::kCubemap)
    return is_cube(called.kind) || (called.kind == kLatLong && !is_part);
  return called.kind == kLatLong && is_wide != is_part;
}

static std::string word_of(const SphericalMetadata& metadata) {
  if (metadata.projection != VideoProjection::kEquirect) return std::string(projection_name(*metadata.projection));
  SphericalMetadata half;
  set_projection(half, find_projection("vr180")->setting);
  return metadata.is_partial() && same_sphere(metadata, half) ? "vr180" : "lat-long";
}

static MetadataConflict layout_conflict(const SphericalMetadata& said, VideoStereo other, const std::string& reason) {
  return {fmt::format("its metadata specifies {}, but {}", stereo_name(*said.stereo), reason),
          fmt::format("`layout` {} or `layout` {}", stereo_name(*said.stereo), stereo_name(other))};
}

static MetadataConflict projection_conflict(const SphericalMetadata& said, const ProjectionSetting& other,
                                            const std::string& reason) {
  SphericalMetadata eye = said;
  eye.stereo.reset();
  eye.yaw = eye.pitch = eye.roll = 0.0;
  std::vector<std::string> options;
  const std::string word = word_of(said);
  if (!said.is_partial() || word == "vr180") options.push_back("`projection` " + word);
  const std::string_view name = projection_name(other);
  if (name == "lat-long" || name == "vr180") options.push_back(fmt::format("`projection` {}", name));
  if (options.size() < 2) options.emplace_back("another name for the file");
  return {fmt::format("its metadata specifies {}, but {}", metadata_text(eye), reason),
          fmt::format("{}", fmt::join(options, " or "))};
}

constexpr const char* kSidecarDisagrees = "its sidecar disagrees";

// Contradictions from a sidecar, and from the name.
static void compare_with_names(const SphericalMetadata& known, const SphericalMetadata& said, const StereoFormat& found,
                               const std::string& path, std::vector<MetadataConflict>& conflicts) {
  const NameWords words = read_name(path);
  const bool has_sidecar = found.layout.source == FormatSource::kSidecar;
  const bool is_custom = said.stereo == VideoStereo::kCustom || said.stereo == VideoStereo::kOther;
  if (!known.stereo && !is_custom && (has_sidecar || found.layout.source == FormatSource::kName)) {
    const std::optional<VideoStereo> other = stereo_of(found.layout.layout);
    if (other && *other != said.stereo)
      conflicts.push_back(
          layout_conflict(said, *other, has_sidecar ? std::string(kSidecarDisagrees) : found.layout.reason));
  }
  if (known.projection) return;
  if (found.has_camera && !may_be_called(said, found.camera.projection)) {
    conflicts.push_back(projection_conflict(said, found.camera.projection, kSidecarDisagrees));
  } else if (!found.has_camera && words.projection != nullptr && !may_be_called(said, words.projection->setting)) {
    const std::string reason = fmt::format(
        "its name ends in {}", words.projection_token.empty() ? words.layout_token : words.projection_token);
    conflicts.push_back(projection_conflict(said, words.projection->setting, reason));
  }
}

std::vector<MetadataConflict> find_conflicts(const SphericalMetadata& known, const VideoTrack& track,
                                             const std::string& path) {
  std::vector<MetadataConflict> conflicts;
  const std::optional<SphericalMetadata> said = declared_metadata(track);
  if (!said) return conflicts;
  try {
    compare_with_names(known, *said, found_format({}, track, path), path, conflicts);
  } catch (const Error&) {
    // An unreadable sidecar has no information.
  }
  const std::string fault = shape_fault(*said, track);
  if (known.stereo || known.projection || !conflicts.empty() || fault.empty()) return conflicts;
  const bool is_square = track.size.width == track.size.height;
  conflicts.push_back({fault, fmt::format("`layout` {} or {}", stereo_name(*said->stereo),
                                          is_square ? "`layout` top-bottom" : "`projection` flat")});
  return conflicts;
}

// --- the plan --------------------------------------------------------------------------------------------------------

bool can_express(Container container, const VideoTrack& track, const SphericalMetadata& metadata) {
  const SphericalMetadata usual{VideoStereo::kOneView, VideoProjection::kEquirect, {}, 0.0, 0.0, 0.0, 0.0, false, ""};
  SphericalMetadata eyes = usual, sphere = usual;
  eyes.stereo = metadata.stereo;
  sphere.projection = metadata.projection;
  const bool is_mkv_word = !has_boxes(container) && metadata.stereo != VideoStereo::kOther;
  const bool has_eyes = is_mkv_word || fits_v2(eyes) || (track.v2 && same_stereo(*track.v2, metadata));
  return has_eyes && (fits_v2(sphere) || (track.v2 && same_sphere(*track.v2, metadata)));
}

static bool says(const std::optional<SphericalMetadata>& place, const SphericalMetadata& metadata) {
  return place && same_stereo(*place, metadata) && same_sphere(*place, metadata);
}

static std::string turn_of(const SphericalMetadata& metadata) {
  return fmt::format("{:.6g},{:.6g},{:.6g}", metadata.yaw, metadata.pitch, metadata.roll);
}

static bool has_whole_angles(const SphericalMetadata& metadata) {
  return metadata.yaw == std::round(metadata.yaw) && metadata.pitch == std::round(metadata.pitch) &&
         metadata.roll == std::round(metadata.roll);
}

static void plan_v1(const VideoTrack& track, const SphericalMetadata& metadata, bool may_be_new, TagPlan& plan) {
  const bool stays = track.v1 && can_update_v1(*track.v1, metadata) && (may_be_new || same_stereo(*track.v1, metadata));
  const bool will_be = stays || (may_be_new && fits_v1(metadata));
  if (track.v1 && !says(track.v1, metadata)) {
    plan.adds_metadata = true;
    plan.notes.push_back(
        fmt::format("its V1 metadata, {}, is {}", metadata_text(*track.v1), will_be ? "changed" : "taken out"));
  }
  if (will_be && !track.v1) plan.adds_metadata = true;
  if (!will_be && may_be_new && metadata.projection != VideoProjection::kFlat) {
    plan.notes.push_back("V1 cannot express that and is left out: players that read only V1 show a flat video");
  }
  if (will_be && !has_whole_angles(metadata)) {
    plan.notes.push_back("V1 holds whole degrees: only V2 has the exact angles");
  }
}

static void plan_vexu(const VideoTrack& track, const SphericalMetadata& metadata, TagPlan& plan) {
  if (track.layers || !metadata.for_apple) return;
  if (!says(track.vexu, metadata)) plan.adds_metadata = true;
  if (!says(track.vexu, metadata) && !fits_vexu(metadata)) {
    plan.notes.push_back(fmt::format("vexu cannot express {} and {}: Apple's players show a flat video",
                                     metadata_text(metadata), track.vexu ? "is taken out" : "is left out"));
    return;
  }
  if (track.vexu && !says(track.vexu, metadata)) {
    plan.notes.push_back(fmt::format("its vexu metadata, {}, is changed", metadata_text(*track.vexu)));
  }
  if (metadata.yaw != 0.0 || metadata.pitch != 0.0 || metadata.roll != 0.0) {
    plan.notes.push_back(
        fmt::format("vexu has no place for angles: Apple's players do not turn it by {}", turn_of(metadata)));
  }
}

TagPlan plan_tag(Container container, const VideoTrack& track, const SphericalMetadata& metadata) {
  TagPlan plan;
  plan.adds_metadata = !says(track.v2, metadata);
  plan_v1(track, metadata, has_boxes(container), plan);
  if (has_boxes(container)) plan_vexu(track, metadata, plan);
  return plan;
}

}  // namespace ods
