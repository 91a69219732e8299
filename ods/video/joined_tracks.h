// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Joins the pictures of two tracks of one video: a track for each eye, or the two rows of a cube's faces, as GoPro's
// MAX stores them.
//
// A row of the MAX has three faces of an equi-angular cube (eac). The middle one is a square as high as the track. Each
// outer one consists of two halves that overlap, because they come from different lenses, and may be narrower than a
// square. Sources: Paul Bourke, "GoPro MAX 360 Action Cam movie layout/format", 2021, and frames of both sizes of the
// camera: there, distant things are `overlap` columns apart in both halves, and the edges of faces continue each other
// in the order of eac.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "ods/camera/projection.h"
#include "ods/video/container/video_file.h"
#include "ods/video/decode.h"

namespace ods {

struct FaceRows {
  Extent track;     // size of a row, pixels
  int overlap = 0;  // of the halves of an outer face

  Extent whole() const { return {3 * track.height, 2 * track.height}; }  // size of the cube
};

// The rows of a track of this size. Returns nullopt for other sizes than those of the camera.
std::optional<FaceRows> face_rows_of(Extent track);

// The cube of two rows, without overlaps: one half fades into the other. Preconditions: both have the same format;
// overlap, and the width that exceeds the middle face, are multiples of 4.
DecodedFrame join_rows(const DecodedFrame& upper, const DecodedFrame& lower, const FaceRows& rows);

// Both eyes side by side. Precondition: both have the same format and size.
DecodedFrame join_eyes(const DecodedFrame& left, const DecodedFrame& right, Extent eye);

// The size of joined pictures of tracks of this size. Preconditions: are_tracks(views); for rows, face_rows_of().
Extent joined_size(Extent track, Views views);

// The track whose pictures belong to those of `track`: the other one of its size. Throws Error(kInput) if there is
// none.
uint64_t other_track(const std::string& path, uint64_t track);

// Joins a picture of a track of this size with the one of the other track at its time, within half a picture; earlier
// ones of the other track are skipped. Returns nullopt after its last one. Throws Error(kInput) if it lacks one, or has
// another format. Precondition: are_tracks(views).
std::optional<DecodedFrame> join_next(const DecodedFrame& picture, const VideoStream& stream, VideoDecoder& other,
                                      Extent track, Views views, const std::string& path);

// The pictures of a video that one chooses by default, and how they are decoded: the largest track, or two joined ones.
struct ChosenPictures {
  VideoTrack track;  // the first one; if it is joined, with the size and the metadata of the joined pictures
  Views views = Views::kFirst;
  std::optional<uint64_t> other{};                // the joined track
  std::optional<Layout> layout{};                 // of joined pictures
  std::optional<ProjectionSetting> projection{};  // of joined pictures, if their format determines it
  std::optional<std::string> note{};              // for users: what was joined, and by which words
};

// `layout` is the caller's. Two tracks of eyes are joined if the container or their names tell the eyes, or `layout` is
// side-by-side (the first one is the left eye) or cross-eyed; two lenses (.insv) are always joined, without a layout.
// Otherwise throws Error like choose_track().
ChosenPictures choose_pictures(const VideoFile& video, std::optional<Layout> layout, const std::string& path);

}  // namespace ods
