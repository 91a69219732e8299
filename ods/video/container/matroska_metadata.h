// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads and writes the stereo and projection elements of a Matroska track. Source: RFC 9559.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "ods/video/container/ebml.h"
#include "ods/video/container/spherical.h"

namespace ods::matroska {

// RFC 9559, section 5.1.
enum Id : uint32_t {
  kEbml = 0x1a45dfa3,
  kDocType = 0x4282,
  kDocTypeVersion = 0x4287,
  kSegment = 0x18538067,
  kSeekHead = 0x114d9b74,
  kSeek = 0x4dbb,
  kSeekPosition = 0x53ac,
  kTracks = 0x1654ae6b,
  kTrackEntry = 0xae,
  kTrackNumber = 0xd7,
  kTrackUid = 0x73c5,
  kTrackType = 0x83,
  kName = 0x536e,
  kCodecId = 0x86,
  kDefaultDuration = 0x23e383,
  kTrackOperation = 0xe2,
  kTrackCombinePlanes = 0xe3,
  kTrackPlane = 0xe4,
  kTrackPlaneUid = 0xe5,
  kTrackPlaneType = 0xe6,
  kVideo = 0xe0,
  kPixelWidth = 0xb0,
  kPixelHeight = 0xba,
  kDisplayWidth = 0x54b0,
  kDisplayHeight = 0x54ba,
  kDisplayUnit = 0x54b2,
  kStereoMode = 0x53b8,
  kProjection = 0x7670,
  kProjectionType = 0x7671,
  kProjectionPrivate = 0x7672,
  kPoseYaw = 0x7673,
  kPosePitch = 0x7674,
  kPoseRoll = 0x7675,
  kTags = 0x1254c367,
  kTag = 0x7373,
  kTargets = 0x63c0,
  kTagTrackUid = 0x63c5,
  kSimpleTag = 0x67c8,
  kTagName = 0x45a3,
  kTagString = 0x4487,
  kCues = 0x1c53bb6b,
  kCuePoint = 0xbb,
  kCueTrackPositions = 0xb7,
  kCueClusterPosition = 0xf1,
  kCueCodecState = 0xea,
  kCluster = 0x1f43b675,
  kClusterPosition = 0xa7,
  kVoid = 0xec,
};

// The number or text of a child; 0 or empty if there is none. Throws MalformedFile.
uint64_t child_number(const Element& element, uint32_t id);
std::string child_text(const Element& element, uint32_t id);

// Parses StereoMode and Projection of an opened Video element. Throws MalformedFile.
std::optional<SphericalMetadata> parse_video(const Element& video);
// Width over height of a pixel, by the display size of an opened Video element; 1 if it has none.
double pixel_aspect_of(const Element& video);
// The private data of a mesh projection, which is the body of an mshp box. Empty if it has another projection.
std::string find_mesh(const Element& video);

// Sets, or removes, both elements. Elements that already match are kept, apart from their angles. The display size
// becomes one eye's. Throws MalformedFile.
void tag_video(Element& video, const std::optional<SphericalMetadata>& metadata);

// Returns whether a SimpleTag contains V1 metadata.
bool is_v1_tag(const Element& tag);

// Updates the angles of all V1 metadata in an opened Tag and removes contradictory ones. Adds none. Throws
// MalformedFile.
void tag_v1(Element& tag, const std::optional<SphericalMetadata>& metadata);

}  // namespace ods::matroska
