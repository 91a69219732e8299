// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The pictures of a video in their order, by way of libavcodec and libavformat.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "ods/video/encode.h"
#include "ods/video/video_codec.h"

namespace ods {

// What a video's pictures are.
struct VideoStream {
  Extent size;
  FrameRate rate;
  std::optional<VideoCodec> codec;  // none: another one
  int bits = 8;                     // 8 to 16
  Chroma chroma = Chroma::k420;
  ColorCode color;
  bool has_alpha = false;
  double start = 0.0;  // the second at which the first of them is shown
  int count = 0;       // of them, as the video says, or going by its length; 0: it does not say
};

// One of them. The numbers stay where they are as long as `memory` does.
struct DecodedFrame {
  Planes planes;                     // read only
  const std::byte* alpha = nullptr;  // of a VideoStream with alpha: as many bits as the others, of full range
  size_t alpha_stride = 0;
  std::shared_ptr<const void> memory;
};

class VideoDecoder {
 public:
  // track: as video.h has it. threads: 0 for the decoder's own choice. Throws Error(kInput): a video that is damaged or
  // that no decoder here knows; pictures that lie turned, of another form than planes of Y'CbCr, or of HDR.
  VideoDecoder(const std::string& path, uint64_t track, int threads = 0);
  VideoDecoder(const VideoDecoder&) = delete;
  VideoDecoder& operator=(const VideoDecoder&) = delete;
  ~VideoDecoder();

  const VideoStream& stream() const;

  // The next one; nothing behind the last. Throws Error(kInput): it is damaged, unlike the first, or shown at another
  // time than it is due: videos of uneven times would fall out of step with their sound.
  std::optional<DecodedFrame> next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ods
