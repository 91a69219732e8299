// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos as ISO base media files: mp4, mov, m4v; whole or in fragments, header before or behind the samples. Sources:
// ISO/IEC 14496-12; Apple, "QuickTime File Format"; ods/video/container/spherical.h.
//
// What is written into the video track: V2 as st3d and sv3d in every sample entry, behind the codec's own boxes and
// before pasp and clap, and vexu and hfov (ods/video/container/apple.h) behind them; V1 as the last box of the track,
// where it can say the form. Boxes that say the form already keep their place and their bytes.
#pragma once
#include <optional>

#include "ods/video/container/boxes.h"
#include "ods/video/container/video_file.h"

namespace ods {

bool is_mp4(std::string_view first_bytes);

// Throws MalformedFile, Error(kInput).
VideoFile read_mp4(const FileInput& file);

// Throws MalformedFile, Error(kInput), Error(kOutput). The header keeps its place; a `free` box behind it is used up,
// or grown, before anything is moved.
TagResult tag_mp4(const FileInput& file, AtomicFile& to, uint64_t track,
                  const std::optional<SphericalMetadata>& metadata, const std::optional<Ambisonics>& sound = {});

}  // namespace ods
