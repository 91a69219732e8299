// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// HTTP Live Streaming of stereo and spherical video. Source: Apple, "HTTP Live Streaming authoring specification",
// REQ-VIDEO-LAYOUT.
#pragma once
#include <optional>
#include <string>

#include "ods/video/container/video_file.h"

namespace ods {

// The line of a multivariant playlist for a video, without its bandwidth and codecs, which the packager knows. Returns
// nullopt if it needs none: one flat eye; or if HLS has no value for its layout or projection.
std::optional<std::string> hls_line(const VideoTrack& track, const SphericalMetadata& metadata);

}  // namespace ods
