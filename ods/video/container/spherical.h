// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a video says of itself: how its eyes share a frame and what of the sphere a frame shows, and the bytes that say
// so. Sources: google/spatial-media, "Spherical Video RFC" (V1) and "Spherical Video V2 RFC"; "Spatial Audio RFC".
// Degrees; angles as V2 has them: yaw turns the picture to the left, pitch up, roll clockwise.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ods/base/names.h"
#include "ods/camera/layout.h"
#include "ods/video/container/boxes.h"

namespace ods {

enum class VideoStereo {
  kOneView,
  kTopBottom,   // the left eye on top
  kSideBySide,  // the left eye on the left
  kCustom,      // as its mesh has it
  kRightLeft,   // the right eye on the left
  kBottomTop,   // the right eye on top: only Matroska can say so
  kOther,       // what Matroska can say besides: interleaved, anaglyph
};
struct VideoStereoRow {
  VideoStereo member;
  std::string_view name;  // by layout.h, where it has one
  EyeArrangement eyes;    // kMixed: in a way that we do not know
};
inline constexpr VideoStereoRow kVideoStereoTable[] = {
    {VideoStereo::kOneView, "mono", {EyePacking::kAlone}},
    {VideoStereo::kTopBottom, "top-bottom", {EyePacking::kStacked}},
    {VideoStereo::kSideBySide, "side-by-side", {EyePacking::kBeside}},
    {VideoStereo::kCustom, "stereo of a mesh", {EyePacking::kMixed}},
    {VideoStereo::kRightLeft, "cross-eyed", {EyePacking::kBeside, true}},
    {VideoStereo::kBottomTop, "bottom-top", {EyePacking::kStacked, true}},
    {VideoStereo::kOther, "stereo of a rare kind", {EyePacking::kMixed}},
};
static_assert(has_every_member(kVideoStereoTable));
inline constexpr auto kVideoStereos = members_of(kVideoStereoTable);
constexpr std::string_view stereo_name(VideoStereo stereo) {
  return name_in(kVideoStereoTable, stereo);
}
constexpr EyeArrangement arrangement_of(VideoStereo stereo) {
  return row_in(kVideoStereoTable, stereo).eyes;
}
// Of eyes squeezed or not. None: videos have no word for it.
std::optional<VideoStereo> stereo_with(EyeArrangement eyes);

enum class VideoProjection {
  kFlat,
  kEquirect,
  kCubemap,  // right, left, up over down, front, back; up has front at its top, down has back
  kMesh,     // as its own triangles have it
  kOther,
};
inline constexpr NameRow<VideoProjection> kVideoProjectionTable[] = {
    {VideoProjection::kFlat, "flat"},
    {VideoProjection::kEquirect, "lat-long"},
    {VideoProjection::kCubemap, "cubemap"},
    {VideoProjection::kMesh, "mesh"},
    {VideoProjection::kOther, "unknown projection"},
};
static_assert(has_every_member(kVideoProjectionTable));
inline constexpr auto kVideoProjections = members_of(kVideoProjectionTable);
constexpr std::string_view projection_name(VideoProjection projection) {
  return name_in(kVideoProjectionTable, projection);
}

struct SphericalMetadata {
  std::optional<VideoStereo> stereo;          // none: it does not say
  std::optional<VideoProjection> projection;  // likewise
  // kEquirect: what is left out of the sphere at the top, bottom, left and right, in parts of 2^32 of the whole.
  std::array<uint32_t, 4> bounds{};
  double yaw = 0.0, pitch = 0.0, roll = 0.0;
  double ipd = 0.0;        // metres between the eyes; 0: it does not say. Only vexu has a place for it.
  bool for_apple = false;  // vexu is written, too: apple.h has what that costs
  std::string source;      // the program that says so

  bool is_partial() const { return bounds != std::array<uint32_t, 4>{}; }
  bool operator==(const SphericalMetadata&) const = default;
};

// "top-bottom, lat-long", "side-by-side, lat-long 180x180", "mono, flat".
std::string metadata_text(const SphericalMetadata& metadata);

// Whether both show the same part of the sphere, and lay out their eyes likewise. To players no word on the projection
// is flat, and no word on the eyes is mono. Bounds that differ by less than a thousandth of the sphere are the same:
// V1 has them in pixels.
bool same_sphere(const SphericalMetadata& a, const SphericalMetadata& b);
bool same_stereo(const SphericalMetadata& a, const SphericalMetadata& b);

// The id of V1's `uuid` box in moov/trak, in front of its XML.
inline constexpr std::string_view kV1Id = "\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd";

// V1 is written of the whole sphere in lat-long, in mono, top-bottom or side-by-side. It has the angles as whole
// degrees of the initial view, as FFmpeg reads them.
bool fits_v1(const SphericalMetadata& metadata);
std::string v1_xml(const SphericalMetadata& metadata);
// Nothing where the XML is about something else.
std::optional<SphericalMetadata> parse_v1(const std::string& xml);

// Whether a V1 that says `v1` can be changed to say `form`: both show the same part of the sphere, which may be a part
// that fits_v1() knows nothing of, and V1 has a word for the eyes.
bool can_update_v1(const SphericalMetadata& v1, const SphericalMetadata& metadata);
// The XML with only those elements changed that say otherwise than `form`: StereoMode, angles that differ by a degree,
// and the software where `has_new_source`. Nothing where can_update_v1() is false or the XML is not understood.
std::optional<std::string> updated_v1(const std::string& xml, const SphericalMetadata& metadata, bool has_new_source);

// V2 knows no kBottomTop and no kOther; kMesh is not written.
bool fits_v2(const SphericalMetadata& metadata);
// Preconditions: `form` has such eyes; it has such a projection, which is not flat.
Box st3d_box(const SphericalMetadata& metadata);
Box sv3d_box(const SphericalMetadata& metadata);
// Changes the angles and the source of an sv3d box; all else in it stays byte for byte. Throws MalformedFile.
void update_sv3d(Box& sphere, const SphericalMetadata& metadata);
// From the boxes of a sample entry; nothing where it has neither. Throws MalformedFile.
std::optional<SphericalMetadata> parse_v2(const Box& sample_entry);

// The body of an equi or cbmp box, version and flags included, which Matroska has as ProjectionPrivate.
std::string projection_body(const SphericalMetadata& metadata);
// The way back, for the projection that `form` has already.
void parse_projection_body(const std::string& body, SphericalMetadata& metadata);

// An SA3D box: ambisonic sound.
struct Ambisonics {
  uint32_t order = 1;
  uint32_t channels = 4;
  bool has_head_locked = false;  // stereo that does not turn with the head
};
std::optional<Ambisonics> parse_sa3d(const std::string& body);
// Channels in the order of ambisonics (ACN), normalised as SN3D has it.
Box sa3d_box(const Ambisonics& sound);

}  // namespace ods
