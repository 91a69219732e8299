// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads and tags ISO base media videos: mp4, mov, m4v; whole or fragmented, with the header before or after the
// samples. Sources: ISO/IEC 14496-12; Apple, "QuickTime File Format"; ods/video/container/spherical.h.
//
// Tags in the video track: V2 as st3d and sv3d in every sample entry, after the codec's own boxes and before pasp and
// clap, then vexu and hfov (ods/video/container/apple.h); V1 as the last box of the track, if it can express the
// metadata. Boxes that already have the right values keep their place and bytes.
#pragma once
#include <optional>

#include "ods/image/format/boxes.h"
#include "ods/video/container/video_file.h"

namespace ods {

// The id of a `trak` box. Throws MalformedFile.
uint64_t track_id(const Box& track);

bool is_mp4(std::string_view first_bytes);

// Reads a video. Throws MalformedFile, Error(kInput).
VideoFile read_mp4(const FileInput& file);

// Writes a video with this metadata. The header keeps its place; a `free` box after it is shrunk or grown before any
// data is moved. Throws MalformedFile, Error(kInput), Error(kOutput).
TagResult tag_mp4(const FileInput& file, AtomicFile& to, uint64_t track,
                  const std::optional<SphericalMetadata>& metadata, const OtherTags& other = {});

}  // namespace ods
