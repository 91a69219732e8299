// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/hls.h"

#include <gtest/gtest.h>

namespace ods {
namespace {

TEST(Hls, ALayoutHasItsLine) {
  VideoTrack track;
  track.size = {4096, 4096}, track.fps = 29.97;
  SphericalMetadata metadata;
  EXPECT_FALSE(hls_line(track, metadata)) << "an ordinary video";
  metadata.stereo = VideoStereo::kSideBySide;
  EXPECT_EQ(hls_line(track, metadata).value(),
            "#EXT-X-STREAM-INF:RESOLUTION=4096x4096,FRAME-RATE=29.970,REQ-VIDEO-LAYOUT=\"CH-STEREO/PROJ-RECT\"");
  metadata.projection = VideoProjection::kEquirect;
  EXPECT_TRUE(hls_line(track, metadata).value().ends_with("=\"CH-STEREO/PROJ-EQUI\""));
  metadata.bounds = {0, 0, 1u << 30u, 1u << 30u};
  EXPECT_TRUE(hls_line(track, metadata).value().ends_with("=\"CH-STEREO/PROJ-HEQU\""));
  metadata.stereo = VideoStereo::kOneView;
  EXPECT_TRUE(hls_line(track, metadata).value().ends_with("=\"PROJ-HEQU\""));
  metadata.bounds = {0, 0, 1u << 29u, 1u << 29u};
  EXPECT_FALSE(hls_line(track, metadata)) << "HLS has no name for it";
}

}  // namespace
}  // namespace ods
