// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Copies the contents of an old video, except its pictures, to the new video that is made from it.
//
// Packets are copied if the container supports their codec. Other sound is encoded again, as is ambisonic sound that is
// rotated; text is encoded as the container's kind of subtitles. A cover is a picture of its own kind in each
// container. Timecode is a tag of the pictures, from which the container makes its track. Dispositions, languages,
// chapters and tags are copied; those of mp4 and mov, which libavformat supports only in part, are copied box by box
// (container/user_data.h).
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "ods/video/container/spherical.h"
#include "ods/video/container/video_file.h"
#include "ods/video/tracks/keep_options.h"
#include "ods/video/tracks/side_tracks.h"

namespace ods {

// Reports what cannot be kept when its streams are added. Throws Error(kInput).
std::unique_ptr<SideTracks> keep_tracks(const KeepOptions& keep, Container container);

// The ambisonic metadata of an old mp4 or mov for the sound tracks that keep_tracks() adds, in their order; not set for
// tracks without.
std::vector<std::optional<Ambisonics>> kept_ambisonics(const KeepOptions& keep, Container container);

}  // namespace ods
