// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads and tags Matroska videos: mkv and webm. Sources: RFC 9559 (Matroska); ods/video/container/spherical.h.
//
// Tags are StereoMode and Projection in the track's Video element, Matroska's equivalent of V2. Elements that already
// have the right values keep their bytes. V1 metadata in the tags gets new angles, and is removed if it contradicts. If
// the header grows, it uses the space of a Void before the clusters; if that is too small, everything moves, and the
// segment's size, SeekHead, Cues, cluster positions and checksums are updated.
#pragma once
#include <optional>

#include "ods/video/container/ebml.h"
#include "ods/video/container/video_file.h"

namespace ods {

bool is_matroska(std::string_view first_bytes);

// Reads a video. Throws MalformedFile, Error(kInput).
VideoFile read_matroska(const FileInput& file);

// Writes a video with this metadata. Throws MalformedFile, also for live recordings, whose clusters have no size;
// Error(kInput), Error(kOutput).
TagResult tag_matroska(const FileInput& file, AtomicFile& to, uint64_t track,
                       const std::optional<SphericalMetadata>& metadata);

}  // namespace ods
