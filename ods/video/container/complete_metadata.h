// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Determines a video's format. In order of precedence: the caller's settings; the video's own metadata (Spherical Video
// V2, then V1, then vexu); its sidecar, name and aspect ratio, as in stereo_format.h for pictures.
#pragma once
#include <string>
#include <vector>

#include "ods/picture/metadata/stereo_format.h"
#include "ods/video/container/video_file.h"

namespace ods {

// The video layout for a picture layout; squeezed layouts map to their full ones. Throws Error(kUsage) if videos have
// no such layout.
VideoStereo video_stereo(Layout layout);
// Returns whether the metadata of videos can express a projection: a lat-long that does not cross the seam, or a flat
// window. (The faces of the cubemap of videos are in another order than any in projection.h.)
bool can_say_projection(const ProjectionSetting& projection);
// Throws Error(kUsage) unless can_say_projection().
void set_projection(SphericalMetadata& metadata, const ProjectionSetting& projection);

// Combines all of a video's own metadata. Returns nullopt if there is none. V2 takes precedence over V1, and V1 over
// vexu; only vexu has the eye distance. If only one of stereo and projection is given, the other gets the default that
// players assume: mono, flat.
std::optional<SphericalMetadata> declared_metadata(const VideoTrack& track);

// Completes `known`: missing stereo and projection, and everything that the caller cannot set (angles, eye distance,
// source), come from the video's own metadata, else from its sidecar, name and aspect ratio. `guesses` receives the
// guesses: "top-bottom: its name ends in _TB". Throws Error(kInput) if nothing determines them, or if the guessed
// stereo is impossible for a video of this size.
SphericalMetadata complete_metadata(SphericalMetadata known, const VideoTrack& track, const std::string& path,
                                    std::vector<std::string>& guesses);

// Returns whether complete_metadata() would have to use the aspect ratio alone, because nothing specifies the layout
// and the projection.
bool is_told_by_shape(const SphericalMetadata& known, const VideoTrack& track, const std::string& path);

// A contradiction of the video's own metadata.
struct MetadataConflict {
  std::string text;     // "its metadata specifies top-bottom, but its name ends in _LR"
  std::string options;  // settings that resolve it: "`layout` top-bottom or `layout` side-by-side"
};
// Contradictions from the sidecar, the name and the aspect ratio, except those that `known` resolves.
std::vector<MetadataConflict> find_conflicts(const SphericalMetadata& known, const VideoTrack& track,
                                             const std::string& path);

// The reason why a whole-sphere video with this metadata cannot have this size, for messages. Empty if it can.
std::string shape_fault(const SphericalMetadata& metadata, const VideoTrack& track);

// Returns whether V2, or StereoMode and Projection, can express this metadata, or the track has it already.
bool can_express(Container container, const VideoTrack& track, const SphericalMetadata& metadata);

// The changes that tag_video() will make to a track.
struct TagPlan {
  bool adds_metadata = false;      // the file gains stereo or projection metadata
  std::vector<std::string> notes;  // for users: metadata that cannot be expressed, and corrections of contradictions
};
TagPlan plan_tag(Container container, const VideoTrack& track, const SphericalMetadata& metadata);

}  // namespace ods
