// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What an old video has beside its pictures goes into the new one that is made of them.
//
// Packets are copied where the container can hold their codec. Other sound is encoded anew, as is ambisonic sound that
// turns; text is encoded as the container's kind of subtitles. A cover is a picture of its own kind in each container.
// Timecode is a tag of the pictures, from which the container makes its track. Dispositions, languages, chapters and
// tags are copied; those of mp4 and mov, which libavformat knows only in part, box by box (container/user_data.h).
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "ods/video/container/spherical.h"
#include "ods/video/container/video_file.h"
#include "ods/video/tracks/keep_options.h"
#include "ods/video/tracks/side_tracks.h"

namespace ods {

// Tells what cannot be kept when its streams are added. Throws Error(kInput).
std::unique_ptr<SideTracks> keep_tracks(const KeepOptions& keep, Container container);

// Of the sound tracks that keep_tracks() adds, in their order: what an old mp4 or mov says of them; none: nothing.
std::vector<std::optional<Ambisonics>> kept_ambisonics(const KeepOptions& keep, Container container);

}  // namespace ods
