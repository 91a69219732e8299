// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames and sound into a video file, by way of libavcodec and libavformat. Which encoders
// there are is the machine's affair; SVT-AV1 alone speaks to the console, unless SVT_LOG=0 is in the environment. The
// video says that it is BT.709 of limited range; what it shows of the sphere, it does not say yet (video.h).
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ods/files/atomic_file.h"
#include "ods/video/video_codec.h"
#include "ods/video/video_frame.h"

namespace ods {

// Frames a second, as a fraction: 30/1, 30000/1001.
struct FrameRate {
  int count = 30;
  int seconds = 1;
  double value() const { return static_cast<double>(count) / seconds; }
};

// What of a file's sound is copied.
struct SoundCut {
  double start = 0.0;   // the second of the file with which the video begins
  bool is_cut = false;  // what begins before it, or after the pictures' end, is left out
};

struct EncodeOptions {
  Packing packing;
  std::string encoder;            // one of known_encoders(); empty: the first of them that there is
  std::string preset;             // how hard it tries, in its own words; empty: its usual
  std::optional<double> bitrate;  // million bits a second, in place of packing.quality
  FrameRate rate;
  int threads = 0;            // 0: the encoder's own choice
  std::string sound;          // a file that has sound in it; empty: a silent video
  bool copies_sound = false;  // its packets as they are, in any number of channels; else it is packed anew
  SoundCut sound_cut;
  bool for_apple = false;  // SphericalMetadata
};

bool has_encoder(std::string_view name);

// What the sound of a file is. Throws Error(kInput): there is none, or of other than 1, 2 or 4 channels. Four are
// first-order ambisonics as AmbiX has them (W Y Z X, SN3D).
struct SoundInfo {
  int channels = 0;
  double seconds = 0.0;  // 0: it does not say
};
SoundInfo read_sound_info(const std::string& path);

// Throws Error(kUsage) where this machine cannot encode such pictures or sound: what it lacks, and what it has. Writes
// nothing.
void check_encoder(Container container, const EncodeOptions& options);

// A video file in the making. Its header comes before its pictures, a key frame about every second. The same frames on
// the same machine give the same bytes.
class VideoEncoder {
 public:
  // Throws Error(kUsage), Error(kInput), Error(kOutput). Precondition: can_hold(), can_have(), `size` of whole blocks.
  VideoEncoder(const AtomicFile& file, Container container, Extent size, const EncodeOptions& options);
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;
  ~VideoEncoder();

  // In the order of the video. Throws Error(kOutput), and Error(kInput) where the sound cannot be read on.
  void add(std::shared_ptr<const VideoFrame> frame);

  // The rest. Sound ends with the pictures at the latest. Throws as add().
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace ods
