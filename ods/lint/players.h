// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The interpretation of a video or a picture by players, and its reasons. Players differ in the metadata that they
// read; they are grouped by that.
// Sources: google/spatial-media (V2 has priority over V1); Meta, "Mobile media overview" (suffixes; square is
// top-bottom); Skybox and DeoVR, their pages on file names. Names of layouts and projections:
// layout_of() and named_projections().
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "ods/picture/metadata/stereo_format.h"
#include "ods/video/container/video_file.h"

namespace ods {

struct PlayerView {
  std::string_view player;   // "reads V2", "reads only V1", "is Apple's", "goes by the name", "goes by the shape"
  std::string takes_it_for;  // "top-bottom, lat-long"
  std::string reason;        // "from st3d and sv3d"
};

std::vector<PlayerView> video_views(const VideoFile& video, const VideoTrack& track, const std::string& path);

// The faults of a video: kinds of players that disagree, V1 metadata that is contradictory or missing, an impossible
// shape, a size that no level of its codec allows.
std::vector<std::string> video_warnings(const VideoFile& video, const VideoTrack& track, const std::string& path);

// Returns whether players that go by the file's name show something else than its metadata declare.
bool name_misleads(const VideoFile& video, const VideoTrack& track, const std::string& path);

// The interpretations of a picture, for which other programs read only GPano; `format` is the result of find_format().
std::vector<PlayerView> picture_views(const FileInfo& info, const StereoFormat& format, bool has_gpano,
                                      const std::string& path);
std::vector<std::string> picture_warnings(const FileInfo& info, const StereoFormat& format, bool has_gpano,
                                          const std::string& path);

}  // namespace ods
