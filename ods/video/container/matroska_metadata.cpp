// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/matroska_metadata.h"

#include <algorithm>
#include <cmath>

#include "ods/image/format/pixel_place.h"

namespace ods::matroska {

uint64_t child_number(const Element& element, uint32_t id) {
  const Element* child = find_child(element, id);
  return child == nullptr ? 0 : number_of(*child);
}

std::string child_text(const Element& element, uint32_t id) {
  const Element* child = find_child(element, id);
  return child == nullptr ? "" : text_of(*child);
}

namespace {

struct StereoWord {
  VideoStereo stereo;
  uint64_t mode;
};

}  // namespace
// RFC 9559, "StereoMode". Of two modes for the same (anaglyphs, laced eyes), the first one is written.
constexpr StereoWord kStereoWords[] = {{VideoStereo::kOneView, 0},
                                       {VideoStereo::kSideBySide, 1},
                                       {VideoStereo::kBottomTop, 2},
                                       {VideoStereo::kTopBottom, 3},
                                       {VideoStereo::kCheckerboardRightFirst, 4},
                                       {VideoStereo::kCheckerboard, 5},
                                       {VideoStereo::kRowsRightFirst, 6},
                                       {VideoStereo::kRows, 7},
                                       {VideoStereo::kColumnsRightFirst, 8},
                                       {VideoStereo::kColumns, 9},
                                       {VideoStereo::kAnaglyph, 10},
                                       {VideoStereo::kRightLeft, 11},
                                       {VideoStereo::kAnaglyph, 12},
                                       {VideoStereo::kLaced, 13},
                                       {VideoStereo::kLaced, 14},
                                       {VideoStereo::kCustom, 15}};

static VideoStereo stereo_of(uint64_t mode) {
  for (const StereoWord& word : kStereoWords) {
    if (word.mode == mode) return word.stereo;
  }
  return VideoStereo::kOther;
}

constexpr VideoProjection kTypes[] = {VideoProjection::kFlat, VideoProjection::kEquirect, VideoProjection::kCubemap,
                                      VideoProjection::kMesh};

static void parse_projection(Element projection, SphericalMetadata& metadata) {
  open_element(projection);
  const Element* type = find_child(projection, kProjectionType);
  const uint64_t number = type == nullptr ? 0 : number_of(*type);
  metadata.projection = number < std::size(kTypes) ? kTypes[number] : VideoProjection::kOther;
  if (const Element* data = find_child(projection, kProjectionPrivate)) parse_projection_body(data->body, metadata);
  const auto angle = [&](uint32_t id) {
    const Element* element = find_child(projection, id);
    return element == nullptr ? 0.0 : float_of(*element);
  };
  metadata.yaw = angle(kPoseYaw), metadata.pitch = angle(kPosePitch), metadata.roll = angle(kPoseRoll);
}

std::optional<SphericalMetadata> parse_video(const Element& video) {
  const Element* stereo = find_child(video, kStereoMode);
  const Element* projection = find_child(video, kProjection);
  if (stereo == nullptr && projection == nullptr) return std::nullopt;
  SphericalMetadata metadata;
  if (stereo != nullptr) metadata.stereo = stereo_of(number_of(*stereo));
  if (projection != nullptr) parse_projection(*projection, metadata);
  return metadata;
}

std::string find_mesh(const Element& video) {
  const Element* found = find_child(video, kProjection);
  if (found == nullptr) return {};
  Element projection = *found;
  open_element(projection);
  const Element* type = find_child(projection, kProjectionType);
  const Element* data = find_child(projection, kProjectionPrivate);
  const bool is_mesh = type != nullptr && number_of(*type) == 3;
  return is_mesh && data != nullptr ? data->body : "";
}

static Element projection_element(const SphericalMetadata& metadata) {
  Element projection;
  projection.id = kProjection;
  const auto type = std::find(std::begin(kTypes), std::end(kTypes), *metadata.projection);
  projection.children.push_back(number_element(kProjectionType, static_cast<uint64_t>(type - std::begin(kTypes))));
  projection.children.push_back({kProjectionPrivate, 1, projection_body(metadata), {}});
  if (metadata.yaw != 0.0) projection.children.push_back(float_element(kPoseYaw, metadata.yaw));
  if (metadata.pitch != 0.0) projection.children.push_back(float_element(kPosePitch, metadata.pitch));
  if (metadata.roll != 0.0) projection.children.push_back(float_element(kPoseRoll, metadata.roll));
  return projection;
}

namespace {

struct Share {
  uint64_t across = 1, down = 1;  // number of eyes
};

}  // namespace

static Share share_of(const std::optional<SphericalMetadata>& metadata) {
  const VideoStereo stereo = metadata && metadata->stereo ? *metadata->stereo : VideoStereo::kOneView;
  const EyePacking how = arrangement_of(stereo).how;
  if (how == EyePacking::kStacked) return {1, 2};
  if (how == EyePacking::kBeside) return {2, 1};
  return {};
}

// Some programs store the size of all eyes together, others that of one eye.
double pixel_aspect_of(const Element& video) {
  const auto number = [&](uint32_t id) { return static_cast<double>(child_number(video, id)); };
  const double across = number(kDisplayWidth), down = number(kDisplayHeight);
  const double pixels_across = number(kPixelWidth), pixels_down = number(kPixelHeight);
  if (across * down * pixels_across * pixels_down == 0.0) return 1.0;
  const Share share = share_of(parse_video(video));
  const double together = across / down * pixels_down / pixels_across;
  const double aspect = together * static_cast<double>(share.across) / static_cast<double>(share.down);
  return plausible_aspect(std::abs(std::log(together)) < 0.01 ? 1.0 : aspect);
}

// RFC 9559, "Multi-planar and 3D Videos": the display size of a stereo video is one eye's.
static void fit_display(Element& video, Share before, Share now) {
  const Element* width = find_child(video, kDisplayWidth);
  const Element* height = find_child(video, kDisplayHeight);
  if (child_number(video, kDisplayUnit) != 0) return;  // an aspect ratio, not a size
  const uint64_t pixels_across = child_number(video, kPixelWidth), pixels_down = child_number(video, kPixelHeight);
  const uint64_t across = width == nullptr ? pixels_across : number_of(*width) * before.across;
  const uint64_t down = height == nullptr ? pixels_down : number_of(*height) * before.down;
  std::erase_if(video.children, [](const Element& e) { return e.id == kDisplayWidth || e.id == kDisplayHeight; });
  if (across / now.across == pixels_across && down / now.down == pixels_down) return;
  video.children.push_back(number_element(kDisplayWidth, across / now.across));
  video.children.push_back(number_element(kDisplayHeight, down / now.down));
}

static void set_pose(Element& projection, uint32_t id, double angle) {
  open_element(projection);
  Element* there = find_child(projection, id);
  if ((there == nullptr ? 0.0 : float_of(*there)) == angle) return;
  if (there != nullptr) {
    *there = float_element(id, angle);
  } else {
    projection.children.push_back(float_element(id, angle));
  }
}

void tag_video(Element& video, const std::optional<SphericalMetadata>& metadata) {
  const std::optional<SphericalMetadata> old = parse_video(video);
  Element* projection = find_child(video, kProjection);
  const bool keeps_projection = metadata && projection != nullptr && same_sphere(*old, *metadata);
  if (keeps_projection) {
    set_pose(*projection, kPoseYaw, metadata->yaw);
    set_pose(*projection, kPosePitch, metadata->pitch);
    set_pose(*projection, kPoseRoll, metadata->roll);
  } else {
    std::erase_if(video.children, [](const Element& e) { return e.id == kProjection; });
  }
  if (!metadata || !old || !same_stereo(*old, *metadata)) {
    fit_display(video, share_of(old), share_of(metadata));
    std::erase_if(video.children, [](const Element& e) { return e.id == kStereoMode; });
    for (const StereoWord& word : kStereoWords) {
      if (!metadata || word.stereo != metadata->stereo.value_or(VideoStereo::kOneView)) continue;
      video.children.push_back(number_element(kStereoMode, word.mode));
      break;
    }
  }
  if (metadata && !keeps_projection && metadata->projection && metadata->projection != VideoProjection::kFlat) {
    video.children.push_back(projection_element(*metadata));
  }
}

bool is_v1_tag(const Element& tag) {
  const std::string name = tag.id == kSimpleTag ? child_text(tag, kTagName) : "";
  return name == "SPHERICAL-VIDEO" || name == "spherical-video";
}

void tag_v1(Element& tag, const std::optional<SphericalMetadata>& metadata) {
  std::erase_if(tag.children, [&](Element& each) {
    if (!is_v1_tag(each)) return false;
    const std::string xml = child_text(each, kTagString);
    const std::optional<SphericalMetadata> old = parse_v1(xml);
    const std::optional<std::string> updated =
        metadata && old && same_stereo(*old, *metadata) ? updated_v1(xml, *metadata, false) : std::nullopt;
    if (updated && *updated != xml) find_child(each, kTagString)->body = *updated;
    return !updated;
  });
}

}  // namespace ods::matroska
