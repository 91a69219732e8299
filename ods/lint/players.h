// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What players will take a video or a picture for, and why. Players differ in what they look at; these are their kinds.
// Sources: google/spatial-media (V2 goes before V1); Meta, "Mobile media overview" (suffixes; square is top-bottom);
// Skybox and DeoVR, their pages on names of files. Words: layout_of() and named_projections().
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
  std::string reason;        // "st3d and sv3d say so"
};

std::vector<PlayerView> video_views(const VideoFile& video, const VideoTrack& track, const std::string& path);

// What is wrong with it: kinds of players that disagree, a V1 that contradicts or is missing, a shape that cannot be, a
// size that no level of its codec holds.
std::vector<std::string> video_warnings(const VideoFile& video, const VideoTrack& track, const std::string& path);

// A picture, of which GPano is all that others read; `format` is what find_format() says.
std::vector<PlayerView> picture_views(const FileInfo& info, const StereoFormat& format, bool has_gpano,
                                      const std::string& path);
std::vector<std::string> picture_warnings(const FileInfo& info, const StereoFormat& format, bool has_gpano,
                                          const std::string& path);

}  // namespace ods
