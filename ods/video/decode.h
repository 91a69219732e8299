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

#include "ods/video/container/spherical.h"
#include "ods/video/encode.h"
#include "ods/video/video_codec.h"

namespace ods {

// The format of a video's pictures.
struct VideoStream {
  Extent size;
  FrameRate rate;
  std::optional<VideoCodec> codec;  // not set for other codecs
  int bits = 8;                     // 8 to 16
  Chroma chroma = Chroma::k420;
  ColorCode color;
  ColorWords words;
  bool has_alpha = false;
  bool is_upside_down = false;  // stored upside down; VideoDecoder turns it upright
  FrameRate clock;              // ticks per second of FrameTime
  double start = 0.0;           // time of the first picture, in seconds
  double file_start = 0.0;      // time of the first picture or sound
  // Data of the first picture, besides its pixels, that no encoder here keeps, as texts for users. Known once it is
  // decoded.
  std::vector<std::string> unkept;
  int count = 0;  // number of pictures, as stored or computed from the duration; 0 if unknown

  // The time in seconds from the first picture on.
  double seconds_at(const FrameTime& time) const { return static_cast<double>(time.start) / clock.value() - start; }
};

// One decoded picture. The planes stay valid as long as `memory`.
struct DecodedFrame {
  FrameTime time;
  Planes planes;                     // read only
  const std::byte* alpha = nullptr;  // if VideoStream has alpha: same bit depth, full range
  size_t alpha_stride = 0;
  std::shared_ptr<const void> memory;
  std::optional<VideoStereo> packing;  // of the eyes, by the frame packing (SEI) of the stream; not set if it has none
};

// The layers to decode of a stream with the eyes as layers (MV-HEVC): only the first layer, as for any other stream, or
// both as one frame, with the left eye on the left. If the stream does not specify the order, the first one is the left
// or the right eye's. Interleaved rows become two halves one above the other, columns two halves side by side. The last
// two join the track with the other one of its size (joined_tracks.h): both eyes, or the faces of a cube.
enum class Views { kFirst, kLeftAndRight, kRightAndLeft, kRows, kColumns, kTwoTracks, kFaceRows };
constexpr bool has_layers(Views views) {
  return views == Views::kLeftAndRight || views == Views::kRightAndLeft;
}
// Returns whether the decoder takes apart the rows or columns of such frames.
constexpr bool are_interleaved(Views views) {
  return views == Views::kRows || views == Views::kColumns;
}

constexpr bool are_tracks(Views views) {
  return views == Views::kTwoTracks || views == Views::kFaceRows;
}

// Returns whether this machine's libavcodec can decode both: FFmpeg 7.1 or later.
bool can_decode_both_views();

class VideoDecoder {
 public:
  // track: as in video_file.h. threads: 0 lets the decoder choose. Throws Error(kInput) for a damaged video, a missing
  // decoder, pictures stored rotated by 90 degrees or interlaced, pixel formats other than planar Y'CbCr, matrices
  // other than ColorCode's. Precondition: !has_layers(views), or can_decode_both_views().
  VideoDecoder(const std::string& path, uint64_t track, Views views = Views::kFirst, int threads = 0);
  VideoDecoder(const VideoDecoder&) = delete;
  VideoDecoder& operator=(const VideoDecoder&) = delete;
  ~VideoDecoder();

  const VideoStream& stream() const;

  // The next picture, or nullopt after the last. Pictures excluded by the file's edit list are skipped. Times ascend.
  // Throws Error(kInput) if it is damaged, in another format than the first, or lacks an eye.
  std::optional<DecodedFrame> next();

  // Makes the first picture at or after this time, in seconds of the file, the next one. Throws the same errors as
  // next().
  void skip_to(double seconds);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Throws Error(kInput) if the colours are not sRGB's: HDR, BT.2020.
void refuse_other_colors(const VideoStream& stream, const std::string& path);

// Encoder settings to match a video. Returns nullopt if that is not possible.
std::optional<Packing> packing_like(const VideoStream& stream, Container container);

}  // namespace ods
