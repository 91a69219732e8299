// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Which form a video has: what the caller asks for, else what the video says of itself (Spherical Video V2, then V1,
// then vexu), else what its sidecar, its name or its shape tells, as picture_form.h has it for pictures.
#pragma once
#include <string>
#include <vector>

#include "ods/picture/metadata/stereo_format.h"
#include "ods/video/container/video_file.h"

namespace ods {

// A layout as videos have it; squeezed eyes are laid out as whole ones. Throws Error(kUsage) for those that videos have
// no word for.
VideoStereo video_stereo(Layout layout);
// A lat-long that does not cross the seam, or a flat window; throws Error(kUsage) for all others. (The cubemap of
// videos has another order of faces than any that projection.h knows.)
void set_projection(SphericalMetadata& metadata, const ProjectionSetting& projection);

// All that a video says of itself, as one form; nothing where it says nothing. V2 goes before V1, and V1 before vexu;
// vexu alone tells the distance of the eyes. A video that says one of stereo and projection says the other too: players
// take no word on stereo for mono, and no word on a projection for flat.
std::optional<SphericalMetadata> said_metadata(const VideoTrack& track);

// What `known` leaves open of stereo and projection, and all that it has no say in (angles, distance of the eyes,
// source): from the video's own words; where it has none, from its sidecar, name and shape. `guesses` gets what was not
// said: "top-bottom: its name ends in _TB". Throws Error(kInput) where nothing tells.
SphericalMetadata complete_metadata(SphericalMetadata known, const VideoTrack& track, const std::string& path,
                                    std::vector<std::string>& guesses);

// Something that says otherwise than the video's own words.
struct FormConflict {
  std::string text;     // "it says top-bottom, but its name ends in _LR"
  std::string options;  // of ods inject, which settle it: "--layout top-bottom or --layout side-by-side"
};
// Of the sidecar, the name and the shape, where `known` leaves open who is right.
std::vector<FormConflict> find_conflicts(const SphericalMetadata& known, const VideoTrack& track,
                                         const std::string& path);

// Why `size` cannot be that of a video of the whole sphere in this form, for people; empty where it can.
std::string shape_fault(const SphericalMetadata& metadata, Extent size);

// Whether V2, or StereoMode and Projection, have words for the form, or say it already.
bool can_say(Container container, const VideoTrack& track, const SphericalMetadata& metadata);

// What tag_video() is going to do to a track.
struct TagPlan {
  bool says_more = false;          // a place will say of stereo or projection what it did not say before
  std::vector<std::string> notes;  // what a place cannot say, and what is made one, for people
};
TagPlan plan_tag(Container container, const VideoTrack& track, const SphericalMetadata& metadata);

}  // namespace ods
