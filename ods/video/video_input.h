// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A video to be read picture by picture: what it says of itself as pictures say it.
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
  SphericalMetadata metadata;  // complete
  bool has_sound = false;
  std::optional<Ambisonics> ambisonics;  // what its sound says
  StoredPicture like;                    // every picture but for its pixels: eyes without layers
};

// What the video does not say is found as inject finds it; `known` goes before all. Its eyes' distance is what
// it says itself (vexu), else what its sidecar says, which tells the rest of its camera, too. Throws Error(kInput): a
// video that is damaged, that is flat or of another projection than lat-long and parts of it, or whose form nothing
// tells.
VideoInput open_video(const std::string& path, const FormatHint& known = {});

// Its colours as code values of 16 bits, whatever the video's are.
StoredPicture picture_of(const VideoInput& video, const VideoStream& stream, const DecodedFrame& frame);

}  // namespace ods
