// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens a video for reading as a sequence of pictures.
#pragma once
#include <optional>
#include <string>

#include "ods/picture/stored_picture.h"
#include "ods/video/container/video_file.h"
#include "ods/video/decode.h"

namespace ods {

struct VideoInput {
  std::string path;
  uint64_t track = 0;
  Views views = Views::kFirst;  // for VideoDecoder
  double fps = 0.0;             // 0: unknown
  SphericalMetadata metadata;   // complete
  StoredPicture prototype;      // every picture except its pixels: eyes without layers
};

// Missing metadata is completed as ods inject does; `known` takes precedence, and may have any projection. The eye
// distance comes from the video (vexu), else from its sidecar, which also gives the rest of the camera. A mesh becomes
// StoredPicture::maps; one that cannot be read gives way to V1. Eyes that are layers of the stream (MV-HEVC) become
// side by side, flat ones too, unless `known` asks for the first alone (Layout::kSeparate). Throws Error(kInput): a
// damaged video, any other flat one, a projection other than a mesh, lat-long or a part of it, metadata that nothing
// determines, or layers that this machine cannot decode.
VideoInput open_video(const std::string& path, const FormatHint& known = {});

// Its colours as 16-bit code values, whatever the video's bit depth.
StoredPicture picture_of(const VideoInput& video, const VideoStream& stream, const DecodedFrame& frame);

}  // namespace ods
