// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes the pictures of a video in order, with libavcodec and libavformat.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
  ColorWords words;
  bool has_alpha = false;
  bool is_turned = false;   // stored upside down: VideoDecoder turns it upright
  FrameRate clock;          // ticks per second of FrameTime
  double start = 0.0;       // when the first picture is shown, in seconds
  double file_start = 0.0;  // when the first picture or sound begins
  // What the first picture carries beside its pixels and no encoder here keeps, for people. Known once it is decoded.
  std::vector<std::string> unkept;
  int count = 0;  // number of pictures, as stated or computed from the duration; 0: unknown

  // From the first picture on.
  double seconds_at(const FrameTime& time) const { return static_cast<double>(time.start) / clock.value() - start; }
};

// One decoded picture. The planes stay valid while `memory` lives.
struct DecodedFrame {
  FrameTime time;
  Planes planes;                     // read only
  const std::byte* alpha = nullptr;  // if VideoStream has alpha: same bit depth, full range
  size_t alpha_stride = 0;
  std::shared_ptr<const void> memory;
};

// What to decode of a stream that has the eyes as layers (MV-HEVC): the first layer, as of any other stream, or both as
// one frame, the left eye's at the left. Where the stream does not say which is which, the first one is the left or the
// right eye's.
enum class Views { kFirst, kLeftAndRight, kRightAndLeft };

// Whether this machine's libavcodec can decode both: since FFmpeg 7.1.
bool can_decode_both_views();

class VideoDecoder {
 public:
  // track: as in video_file.h. threads: 0 lets the decoder choose. Throws Error(kInput): a damaged video, no decoder
  // for it, pictures stored rotated by 90 degrees, pixel formats other than planar Y'CbCr, matrices other than
  // ColorCode's. Precondition: views is kFirst, or can_decode_both_views().
  VideoDecoder(const std::string& path, uint64_t track, Views views = Views::kFirst, int threads = 0);
  VideoDecoder(const VideoDecoder&) = delete;
  VideoDecoder& operator=(const VideoDecoder&) = delete;
  ~VideoDecoder();

  const VideoStream& stream() const;

  // The next picture; nothing after the last. Pictures that the file's edit list leaves out are skipped. Times ascend.
  // Throws Error(kInput): it is damaged, in another format than the first, or lacks an eye.
  std::optional<DecodedFrame> next();

  // Makes the first picture at or after this time, in seconds of the file, the next one. Throws as next().
  void skip_to(double seconds);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Throws Error(kInput) if the pictures' numbers mean other light than sRGB's: HDR, BT.2020.
void refuse_other_colors(const VideoStream& stream, const std::string& path);

// Encoder settings to match a video; nothing if that is not possible.
std::optional<Packing> packing_like(const VideoStream& stream, Container container);

}  // namespace ods
