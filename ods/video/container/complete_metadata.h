// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Determines a video's format. In order of precedence: what the caller asks for; the video's own metadata (Spherical
// Video V2, then V1, then vexu); its sidecar, name and shape, as stereo_format.h does for pictures.
#pragma once
#include <string>
#include <vector>

#include "ods/picture/metadata/stereo_format.h"
#include "ods/video/container/video_file.h"

namespace ods {

// The video layout for a picture layout; squeezed layouts map to their full ones. Throws Error(kUsage) if videos have
// no such layout.
VideoStereo video_stereo(Layout layout);
// Whether the metadata of videos has a projection: a lat-long that does not cross the seam, and a flat window. (The
// cubemap of videos orders its faces unlike any in projection.h.)
bool can_say_projection(const ProjectionSetting& projection);
// Throws Error(kUsage) unless can_say_projection().
void set_projection(SphericalMetadata& metadata, const ProjectionSetting& projection);

// All of a video's own metadata combined; nothing if there is none. V2 takes precedence over V1, and V1 over vexu; only
// vexu has the eye distance. If only one of stereo and projection is given, the other gets the default that players
// assume: mono, flat.
std::optional<SphericalMetadata> said_metadata(const VideoTrack& track);

// Completes `known`: missing stereo and projection, and everything that the caller cannot set (angles, eye distance,
// source), come from the video's own metadata, else from its sidecar, name and shape. `guesses` lists what was guessed:
// "top-bottom: its name ends in _TB". Throws Error(kInput) if nothing tells, or if a video of this size cannot have the
// stereo that it does not state itself.
SphericalMetadata complete_metadata(SphericalMetadata known, const VideoTrack& track, const std::string& path,
                                    std::vector<std::string>& guesses);

// Whether complete_metadata() would have to go by the shape alone: nobody says the layout and the projection.
bool is_told_by_shape(const SphericalMetadata& known, const VideoTrack& track, const std::string& path);

// A contradiction to the video's own metadata.
struct MetadataConflict {
  std::string text;     // "it says top-bottom, but its name ends in _LR"
  std::string options;  // settings that resolve it: "`layout` top-bottom or `layout` side-by-side"
};
// Contradictions from the sidecar, the name and the shape, except those that `known` resolves.
std::vector<MetadataConflict> find_conflicts(const SphericalMetadata& known, const VideoTrack& track,
                                             const std::string& path);

// Why a whole-sphere video with this metadata cannot have this size, for messages; empty if it can.
std::string shape_fault(const SphericalMetadata& metadata, Extent size);

// Whether V2, or StereoMode and Projection, can express this metadata, or the track has it already.
bool can_say(Container container, const VideoTrack& track, const SphericalMetadata& metadata);

// What tag_video() is going to do to a track.
struct TagPlan {
  bool says_more = false;          // a place gains stereo or projection metadata that it lacked
  std::vector<std::string> notes;  // for people: what a place cannot express, and what is made consistent
};
TagPlan plan_tag(Container container, const VideoTrack& track, const SphericalMetadata& metadata);

}  // namespace ods
