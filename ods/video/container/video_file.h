// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A video in any container: its tracks, its metadata, and how to tag it.
// The containers are mp4_file.h and matroska_file.h.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/layout.h"
#include "ods/video/container/apple.h"
#include "ods/video/container/user_data.h"

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
  std::string name;                       // as its author or a program named it
  std::string codec;                      // avc1, hvc1, V_VP9: as the container names it
  Extent size;                            // size of a frame
  std::optional<int> eye;                 // the eye that it shows, if the container combines tracks to a stereo pair
  double pixel_aspect = 1.0;              // width over height of a pixel
  double fps = 0.0;                       // 0 if unknown
  std::optional<SphericalMetadata> v1;    // Spherical Video V1
  std::optional<SphericalMetadata> v2;    // Spherical Video V2, in Matroska StereoMode and Projection
  std::optional<SphericalMetadata> vexu;  // the vexu for Apple's players
  std::string mesh;                       // the body of the mshp box of v2 (mesh_box.h); empty if it has none
  std::optional<EyeLayers> layers;        // set if the eyes are layers of the stream (MV-HEVC), which vexu describes
};

struct SoundTrack {
  uint64_t id = 0;
  std::string codec;
  int channels = 0;  // 0 if unknown, as in mkv and webm
  std::optional<Ambisonics> ambisonics;
};

struct VideoFile {
  Container container = Container::kMp4;
  bool is_fragmented = false;
  std::vector<VideoTrack> tracks;
  std::vector<SoundTrack> sound;
};

// Returns whether a file is a video by its first bytes, regardless of its name: mp4, mov, mkv, webm.
bool is_video(const std::string& path);

// Reads a file's tracks and metadata. Throws Error(kInput) for other kinds of files, and truncated or damaged ones.
VideoFile read_video_file(const std::string& path);

// The track with this id; without one, the track with the largest pictures. Throws Error(kUsage) if there is no such
// id; Error(kInput) if there is no track at all, or two are the largest.
const VideoTrack& choose_track(const VideoFile& video, std::optional<int> id, const std::string& path);

struct TagResult {
  bool has_v1 = false;  // with the same metadata
  bool has_v2 = false;
  bool has_vexu = false;
  bool moved = false;  // everything after the header was moved and its offsets updated
};

// Other data that tag_video() writes into an mp4 or mov. In Matroska, Opus describes its own channels, and libavformat
// writes all tags.
struct OtherTags {
  std::vector<std::optional<Ambisonics>> sound;  // for the sound tracks, in order; not set for unchanged ones
  UserData user;                                 // added to the file's own
};

// Writes the video with this metadata to `to`, which may be `path` itself: the complete new file then replaces it.
// Without metadata, removes it. Boxes that already match stay byte-identical, even of kinds that we never write (a
// mesh, a padded cubemap); with the result of complete_metadata(), only the requested properties change. Samples stay
// bit-identical. Throws Error(kInput), also if the container cannot express the metadata; Error(kOutput). `progress`
// reports the fraction copied.
TagResult tag_video(const std::string& path, const std::string& to, uint64_t track,
                    const std::optional<SphericalMetadata>& metadata, const OtherTags& other = {},
                    const std::function<void(double done)>& progress = {});

}  // namespace ods
