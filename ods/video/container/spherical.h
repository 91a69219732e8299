// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The metadata of 360 videos: how the eyes share a frame and which part of the sphere it shows, and their encoding.
// Sources: google/spatial-media, "Spherical Video RFC" (V1) and "Spherical Video V2 RFC"; "Spatial Audio RFC". Angles
// in degrees, as in V2: yaw turns the picture to the left, pitch up, roll clockwise.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "ods/base/names.h"
#include "ods/camera/layout.h"
#include "ods/image/format/boxes.h"

namespace ods {

enum class VideoStereo {
  kOneView,
  kTopBottom,   // the left eye on top
  kSideBySide,  // the left eye on the left
  kCustom,      // as defined by the mesh
  kRightLeft,   // the right eye on the left
  kBottomTop,   // the right eye on top: only Matroska supports it
  // Only Matroska and the streams themselves (frame packing) have these; each with the left eye first, then the right.
  kRows,
  kRowsRightFirst,
  kColumns,
  kColumnsRightFirst,
  kCheckerboard,
  kCheckerboardRightFirst,
  kAnaglyph,
  kLaced,  // the eyes alternate in time
  kOther,
};
struct VideoStereoRow {
  VideoStereo member;
  std::string_view name;  // as in layout.h, if it has one
  EyeArrangement eyes;    // kMixed for an unknown arrangement
};
inline constexpr VideoStereoRow kVideoStereoTable[] = {
    {VideoStereo::kOneView, "mono", {EyePacking::kAlone}},
    {VideoStereo::kTopBottom, "top-bottom", {EyePacking::kStacked}},
    {VideoStereo::kSideBySide, "side-by-side", {EyePacking::kBeside}},
    {VideoStereo::kCustom, "stereo of a mesh", {EyePacking::kMixed}},
    {VideoStereo::kRightLeft, "cross-eyed", {EyePacking::kBeside, true}},
    {VideoStereo::kBottomTop, "bottom-top", {EyePacking::kStacked, true}},
    {VideoStereo::kRows, "row-interleaved", {EyePacking::kRows}},
    {VideoStereo::kRowsRightFirst, "row-interleaved, right eye first", {EyePacking::kRows, true}},
    {VideoStereo::kColumns, "column-interleaved", {EyePacking::kColumns}},
    {VideoStereo::kColumnsRightFirst, "column-interleaved, right eye first", {EyePacking::kColumns, true}},
    {VideoStereo::kCheckerboard, "checkerboard", {EyePacking::kCheckerboard}},
    {VideoStereo::kCheckerboardRightFirst, "checkerboard, right eye first", {EyePacking::kCheckerboard, true}},
    {VideoStereo::kAnaglyph, "an anaglyph", {EyePacking::kMixed}},
    {VideoStereo::kLaced, "eyes that alternate in the stream", {EyePacking::kMixed}},
    {VideoStereo::kOther, "stereo of an unusual kind", {EyePacking::kMixed}},
};
static_assert(has_every_member(kVideoStereoTable));
inline constexpr auto kVideoStereos = members_of(kVideoStereoTable);
constexpr std::string_view stereo_name(VideoStereo stereo) {
  return name_in(kVideoStereoTable, stereo);
}
constexpr EyeArrangement arrangement_of(VideoStereo stereo) {
  return row_in(kVideoStereoTable, stereo).eyes;
}
// Ignores squeezing. Returns nullopt if video metadata cannot express it.
std::optional<VideoStereo> stereo_with(EyeArrangement eyes);

enum class VideoProjection {
  kFlat,
  kEquirect,
  kCubemap,  // right, left, up over down, front, back; the top edge of up is at the front, that of down at the back
  kMesh,     // as defined by the mesh
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
  std::optional<VideoStereo> stereo;          // not set if unspecified
  std::optional<VideoProjection> projection;  // not set if unspecified
  // kEquirect: the fractions of the sphere cropped at top, bottom, left and right, in units of 2^-32.
  std::array<uint32_t, 4> bounds{};
  double yaw = 0.0, pitch = 0.0, roll = 0.0;
  double ipd = 0.0;        // metres between the eyes; 0 if unspecified. Only vexu stores it
  bool for_apple = false;  // also write vexu; see apple.h for the drawback
  std::string source{};    // the program that wrote it

  bool is_partial() const { return bounds != std::array<uint32_t, 4>{}; }
  bool operator==(const SphericalMetadata&) const = default;
};

// "top-bottom, lat-long", "side-by-side, lat-long 180x180", "mono, flat".
std::string metadata_text(const SphericalMetadata& metadata);

// same_sphere() returns whether both show the same part of the sphere, and arrange the eyes alike. Like in players, a
// missing projection counts as flat, and missing stereo as mono. Bounds that differ by less than a thousandth of the
// sphere count as equal, because V1 stores them in pixels.
VideoStereo stereo_of(const SphericalMetadata& metadata);
bool same_sphere(const SphericalMetadata& a, const SphericalMetadata& b);
bool same_stereo(const SphericalMetadata& a, const SphericalMetadata& b);

// The id of V1's `uuid` box in moov/trak, before its XML.
inline constexpr std::string_view kV1Id = "\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd";

// V1 is written for whole-sphere lat-long in mono, top-bottom or side-by-side. It stores the angles as the initial
// view, in whole degrees, as FFmpeg reads them.
bool fits_v1(const SphericalMetadata& metadata);
std::string v1_xml(const SphericalMetadata& metadata);
// Parses V1 metadata. Returns nullopt if the XML is about something else.
std::optional<SphericalMetadata> parse_v1(const std::string& xml);

// Returns whether `v1` can be updated to `metadata`: both show the same part of the sphere, possibly one that fits_v1()
// rejects, and V1 can express the eyes.
bool can_update_v1(const SphericalMetadata& v1, const SphericalMetadata& metadata);
// The XML with only those elements changed that differ from `metadata`: StereoMode, angles that differ by a degree, and
// the software if `has_new_source`. Returns nullopt if can_update_v1() is false or the XML cannot be parsed.
std::optional<std::string> updated_v1(const std::string& xml, const SphericalMetadata& metadata, bool has_new_source);

// V2 has no kBottomTop and no kOther; kMesh is never written.
bool fits_v2(const SphericalMetadata& metadata);
// Preconditions: V2 can express the stereo of `metadata`, and its projection, which is not flat.
Box st3d_box(const SphericalMetadata& metadata);
Box sv3d_box(const SphericalMetadata& metadata);
// Updates the angles and the source of an sv3d box; all other bytes are unchanged. Throws MalformedFile.
void update_sv3d(Box& sphere, const SphericalMetadata& metadata);
// Parses the boxes of a sample entry. Returns nullopt if it has neither st3d nor sv3d. Throws MalformedFile.
std::optional<SphericalMetadata> parse_v2(const Box& sample_entry);
// The body of a sample entry's mshp box (mesh_box.h). Empty if there is none. Throws MalformedFile.
std::string find_mesh(const Box& sample_entry);

// The body of an equi or cbmp box including version and flags, which is Matroska's ProjectionPrivate.
std::string projection_body(const SphericalMetadata& metadata);
// Parses such a body for the projection that `metadata` already has.
void parse_projection_body(const std::string& body, SphericalMetadata& metadata);

// An SA3D box: ambisonic sound.
struct Ambisonics {
  uint32_t order = 1;
  uint32_t channels = 4;
  bool has_head_locked = false;  // plus stereo that is not rotated with the head
};
std::optional<Ambisonics> parse_sa3d(const std::string& body);
// Channels in ACN order with SN3D normalization.
Box sa3d_box(const Ambisonics& sound);

}  // namespace ods
