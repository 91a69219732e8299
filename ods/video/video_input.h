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
  Views views = Views::kFirst;          // for VideoDecoder
  std::optional<uint64_t> other_track;  // if two are joined
  double fps = 0.0;                     // 0 if unknown
  SphericalMetadata metadata;           // complete
  StoredPicture prototype;              // all properties of the pictures except their pixels: eyes without layers
};

// Opens a video. Missing metadata is completed as by ods inject; `known` takes precedence, and may have any projection.
// The eye distance comes from the video (vexu), else from its sidecar, which also specifies the rest of the camera. A
// mesh becomes StoredPicture::maps; if it cannot be read, V1 is used. Eyes that are layers of the stream (MV-HEVC) are
// placed side by side, flat ones too, unless `known` requests only the first one (Layout::kSeparate); interleaved rows
// and columns become halves. Throws
// Error(kInput) for a damaged video, any other flat one, a projection other than a mesh, lat-long or a part of it,
// undetermined metadata, or layers that this machine cannot decode.
VideoInput open_video(const std::string& path, const FormatHint& known = {});

// The colours of a frame as 16-bit code values, for any bit depth of the video.
StoredPicture picture_of(const VideoInput& video, const VideoStream& stream, const DecodedFrame& frame);

}  // namespace ods
