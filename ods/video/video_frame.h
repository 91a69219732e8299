// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts a stored picture to a video frame: eyes stacked or side by side, the left one first, display-referred.
#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "ods/image/tone.h"
#include "ods/picture/stored_picture.h"
#include "ods/video/video_codec.h"

namespace ods {

// A frame's buffers.
class VideoFrame {
 public:
  // Preconditions: can_have(), and `size` is a multiple of the chroma block.
  VideoFrame(Extent size, const Packing& packing);
  const Planes& planes() const { return planes_; }
  size_t bytes() const { return bytes_; }
  Extent extent() const { return size_; }

 private:
  struct Free {
    void operator()(std::byte* bytes) const;
  };
  Extent size_;
  Planes planes_;
  size_t bytes_ = 0;
  std::unique_ptr<std::byte[], Free> memory_;
};

// A pool of frames of one format that are reused when they are no longer referenced: fresh memory would cost a video as
// much time as its filter, because the kernel clears every page. Frames may outlive the pool.
class FramePool {
 public:
  FramePool(Extent size, const Packing& packing);  // as for VideoFrame
  // Returns a new frame, or a reused one with undefined pixels. May be called concurrently.
  std::shared_ptr<VideoFrame> take() const;

 private:
  struct Shelf;
  std::shared_ptr<Shelf> shelf_;
};

// The conversion of scene-linear light for display. Only float pictures need it; others are already display-referred.
struct DisplayTransform {
  float exposure = 0.0f;  // stops
  ToneCurve tone = ToneCurve::kNeutral;
};

// A fast srgb_encode(), accurate to a millionth. Extended beyond 1, up to 2, and below 0, where it is odd.
float video_code(float linear);
// video_code() for many values.
void video_codes(std::span<const float> light, float* codes);
// The inverse: srgb_decode() of the code rounded to 16 bits, extended in the same way. Codes are -0.5 to 1.5.
float video_light(float code);
// video_light() for a row laid out as in CodeRows. Writes R, G, B and 0 for every pixel.
void video_lights(std::span<const float> row, float* pixels);

// The video layout for a picture: kTopBottom or kSideBySide, squeezed or not.
Layout video_layout(const StoredPicture& picture);

// Converts the picture into `frame`. Precondition: the frame has packed_size() of layout and eyes, whose sides are
// multiples of the chroma block. Alpha is composited over black.
void fill_frame(const StoredPicture& picture, Layout layout, const DisplayTransform& display, VideoFrame& frame);

}  // namespace ods
