// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/hls.h"

#include <fmt/format.h>

namespace ods {

std::optional<std::string> hls_line(const VideoTrack& track, const SphericalMetadata& metadata) {
  const bool is_flat = metadata.projection.value_or(VideoProjection::kFlat) == VideoProjection::kFlat;
  const bool is_mono = metadata.stereo.value_or(VideoStereo::kOneView) == VideoStereo::kOneView;
  if ((is_flat && is_mono) || !(is_flat || fits_vexu(metadata))) return std::nullopt;
  const std::string projection = is_flat ? "PROJ-RECT" : metadata.is_partial() ? "PROJ-HEQU" : "PROJ-EQUI";
  const std::string rate = track.fps > 0.0 ? fmt::format("FRAME-RATE={:.3f},", track.fps) : "";
  return fmt::format("#EXT-X-STREAM-INF:RESOLUTION={}x{},{}REQ-VIDEO-LAYOUT=\"{}{}\"", track.size.width,
                     track.size.height, rate, is_mono ? "" : "CH-STEREO/", projection);
}

}  // namespace ods
