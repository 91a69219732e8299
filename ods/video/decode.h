// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes the pictures of a video in order, with libavcodec and libavformat.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "ods/video/encode.h"
#include "ods/video/video_codec.h"

namespace ods {

// The format of a video's pictures.
struct VideoStream {
  Extent size;
  FrameRate rate;
  std::optional<VideoCodec> codec;  // none: some other codec
  int bits = 8;                     // 8 to 16
  Chroma chroma = Chroma::k420;
  ColorCode color;
  bool has_alpha = false;
  double start = 0.0;  // when the first picture is shown, in seconds
  int count = 0;       // number of pictures, as stated or computed from the duration; 0: unknown
};

// One decoded picture. The planes stay valid while `memory` lives.
struct DecodedFrame {
  Planes planes;                     // read only
  const std::byte* alpha = nullptr;  // if VideoStream has alpha: same bit depth, full range
  size_t alpha_stride = 0;
  std::shared_ptr<const void> memory;
};

class VideoDecoder {
 public:
  // track: as in video_file.h. threads: 0 lets the decoder choose. Throws Error(kInput): a damaged video, no decoder
  // for it, rotated pictures, pixel formats other than planar Y'CbCr, HDR.
  VideoDecoder(const std::string& path, uint64_t track, int threads = 0);
  VideoDecoder(const VideoDecoder&) = delete;
  VideoDecoder& operator=(const VideoDecoder&) = delete;
  ~VideoDecoder();

  const VideoStream& stream() const;

  // The next picture; nothing after the last. Throws Error(kInput): it is damaged, in another format than the first, or
  // not due at its time: videos of uneven frame times would lose sync with their sound.
  std::optional<DecodedFrame> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ods
