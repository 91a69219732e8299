// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A stored picture as a frame of a video: its eyes stacked or side by side, the left one first, as a display shows
// them.
#pragma once
#include <cstddef>
#include <memory>

#include "ods/image/tone.h"
#include "ods/picture/stored_picture.h"
#include "ods/video/video_codec.h"

namespace ods {

// A frame to be filled.
class VideoFrame {
 public:
  // Precondition: can_have(), and `size` is of whole blocks.
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

// What becomes of the scene's light, in pictures of floats. Others are what a display shows already.
struct DisplayTransform {
  float exposure = 0.0f;  // EV
  ToneCurve tone = ToneCurve::kNeutral;
};

// srgb_encode() of what is between 0 and 1, fast: exact to a millionth.
float video_code(float linear);

// The layouts that a video can have, by that of its pictures: kTopBottom or kSideBySide, squeezed or not.
Layout video_layout(const StoredPicture& picture);

// Precondition: `frame` is packed_size() of the layout and the picture's eyes, which are of whole blocks. Alpha is
// before black.
void fill_frame(const StoredPicture& picture, Layout layout, const DisplayTransform& development, VideoFrame& frame);

}  // namespace ods
