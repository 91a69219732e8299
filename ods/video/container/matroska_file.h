// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos as Matroska files: mkv and webm. Source: RFC 9559 (Matroska); ods/video/container/spherical.h.
//
// What is written into the Video element of the track: StereoMode and Projection, which are the V2 of Matroska. What
// says the form already keeps its bytes. A V1 in the tags gets new angles; one that contradicts is taken out. Where the
// header grows, a Void before the clusters is used up; else all moves, and the segment's size, SeekHead, Cues,
// positions in clusters and check sums are made true again.
#pragma once
#include <optional>

#include "ods/video/container/ebml.h"
#include "ods/video/container/video_file.h"

namespace ods {

bool is_matroska(std::string_view first_bytes);

// Throws MalformedFile, Error(kInput).
VideoFile read_matroska(const FileInput& file);

// Throws MalformedFile, also for a live recording, whose clusters say no size; Error(kInput), Error(kOutput).
TagResult tag_matroska(const FileInput& file, AtomicFile& to, uint64_t track,
                       const std::optional<SphericalMetadata>& metadata);

}  // namespace ods
