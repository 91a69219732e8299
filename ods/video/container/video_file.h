// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A video of whatever container: what is in it, what it says of itself, and how to make it say something else.
// mp4_video.h and matroska_video.h are the containers.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/layout.h"
#include "ods/video/container/spherical.h"

namespace ods {

enum class Container { kMp4, kMov, kMatroska, kWebm };
inline constexpr NameRow<Container> kContainerTable[] = {
    {Container::kMp4, "mp4"},
    {Container::kMov, "mov"},
    {Container::kMatroska, "mkv"},
    {Container::kWebm, "webm"},
};
static_assert(has_every_member(kContainerTable));
inline constexpr auto kContainers = members_of(kContainerTable);
constexpr std::string_view container_name(Container container) {
  return name_in(kContainerTable, container);
}
inline bool has_boxes(Container container) {
  return container == Container::kMp4 || container == Container::kMov;
}

struct VideoTrack {
  uint64_t id = 0;
  std::string codec;                      // avc1, hvc1, V_VP9: as the container has it
  Extent size;                            // of a frame
  double fps = 0.0;                       // 0: unknown
  std::optional<SphericalMetadata> v1;    // what its Spherical Video V1 says
  std::optional<SphericalMetadata> v2;    // its V2, which Matroska has as StereoMode and Projection
  std::optional<SphericalMetadata> vexu;  // what stands there for Apple's players
  bool has_layers = false;                // its eyes are layers of the stream (MV-HEVC), and its vexu is about those
};

struct SoundTrack {
  uint64_t id = 0;
  std::string codec;
  int channels = 0;  // 0: it cannot be told, as in mkv and webm
  std::optional<Ambisonics> ambisonics;
};

struct VideoFile {
  Container container = Container::kMp4;
  bool is_fragmented = false;
  std::vector<VideoTrack> tracks;
  std::vector<SoundTrack> sound;
};

// By its first bytes, whatever the name says: mp4, mov, mkv, webm.
bool is_video(const std::string& path);

// Throws Error(kInput): not such a file, cut short, damaged.
VideoFile read_video_file(const std::string& path);

// The track of that id; without one, that with the largest pictures. Throws Error(kUsage): there is none of
// that id; Error(kInput): there is none at all, or two are largest.
const VideoTrack& choose_track(const VideoFile& video, std::optional<int> id, const std::string& path);

struct TagResult {
  bool has_v1 = false;  // of that form
  bool has_v2 = false;
  bool has_vexu = false;
  bool moved = false;  // what lies behind the header was moved, and every offset with it
};

// Writes the video with another form into `to`, which may be `path` itself: a complete new file takes its place. No
// form: one that says nothing. What says the form already stays byte for byte, also where it is of a kind that is not
// written anew (a mesh, a padded cubemap); with what complete_metadata() returns, only what was asked for changes.
// Every sample stays bit for bit what it was. Throws Error(kInput), also where the container cannot say such a form;
// Error(kOutput). With `sound`, the sound of an mp4 or mov says so, too; in Matroska Opus says by itself what its
// channels are. `progress` is told now and then which share is copied.
TagResult tag_video(const std::string& path, const std::string& to, uint64_t track,
                    const std::optional<SphericalMetadata>& metadata, const std::optional<Ambisonics>& sound = {},
                    const std::function<void(double done)>& progress = {});

}  // namespace ods
