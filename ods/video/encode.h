// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Encodes frames and sound into a video file, with libavcodec and libavformat. The available encoders depend on the
// machine; SVT-AV1 prints to the console unless the environment has SVT_LOG=0. tag_video() (video_file.h) adds the
// spherical metadata.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/files/atomic_file.h"
#include "ods/video/tracks/keep_options.h"
#include "ods/video/video_codec.h"
#include "ods/video/video_frame.h"

namespace ods {

// The frame rate as a fraction: 30/1, 30000/1001.
struct FrameRate {
  int count = 30;
  int seconds = 1;
  double value() const { return static_cast<double>(count) / seconds; }
};

// The time and duration of a picture, in ticks of a clock.
struct FrameTime {
  int64_t start = 0;
  int64_t duration = 1;
};

struct EncodeOptions {
  Packing packing;
  std::string encoder;             // one of known_encoders(); if empty, the first available
  std::string preset;              // the encoder's own preset name; if empty, its default
  std::optional<double> bitrate;   // Mbit/s, replaces packing.quality
  FrameRate rate;                  // pictures per second, on average
  std::optional<FrameRate> clock;  // ticks per second of FrameTime; if not set, a tick per picture
  ColorCode color;                 // colours of the frames
  ColorWords words;
  int threads = 0;    // 0 lets the encoder choose
  std::string sound;  // a file with sound to encode; if empty, only kept sound
  KeepOptions keep;
  bool for_apple = false;  // as in SphericalMetadata
};

// A picture as encoded; times in ticks of the encoder's clock.
struct EncodedPicture {
  int64_t shown = 0;
  int64_t decoded = 0;  // decode time; pictures come in this order
  int64_t duration = 1;
  int flags = 0;  // libavcodec's: a key frame, a disposable frame
  std::string_view bytes;
};

// Maximum number of pictures between key frames.
int key_interval(const FrameRate& rate);

bool has_encoder(std::string_view name);

// Throws Error(kUsage) if this machine cannot encode such pictures or sound; the message names the missing and the
// available encoders. Writes nothing.
void check_encoder(Container container, const EncodeOptions& options);

// Writes a video file: the header before the pictures, a key frame about every second. The same frames on the same
// machine, with the same ends of parts, give the same bytes.
class VideoEncoder {
 public:
  // Throws Error(kUsage), Error(kInput), Error(kOutput). Preconditions: can_hold(), can_have(), `size` is a multiple of
  // the chroma block.
  VideoEncoder(const AtomicFile& file, Container container, Extent size, const EncodeOptions& options);
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;
  ~VideoEncoder();

  // Adds the next frame, shown later than the last one. Throws Error(kOutput), and Error(kInput) if the sound cannot be
  // read.
  void add(std::shared_ptr<const VideoFrame> frame, const FrameTime& time);

  // Calls `take` with every picture encoded from now on.
  void keep(std::function<void(const EncodedPicture&)> take);
  // Ends a part: all frames so far are encoded, and the next one is encoded as if it were the first. Throws the same
  // errors as add().
  void end_part();
  // Adds a picture that another encoder with the same options kept; all of its parts come before the first frame.
  void add(const EncodedPicture& picture);
  // The parameters of the encoding that the file stores once for all pictures.
  std::string header() const;

  // Writes the rest. Sound ends with the pictures at the latest. Throws the same errors as add().
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ods
