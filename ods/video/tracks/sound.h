// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sound of a new video that is encoded again, and rotated if it is ambisonic.
#pragma once
#include <functional>
#include <glm/mat3x3.hpp>
#include <memory>
#include <string>

#include "ods/video/container/video_file.h"
#include "ods/video/tracks/keep_options.h"
#include "ods/video/tracks/side_tracks.h"

namespace ods {

// The sound of a file. Throws Error(kInput) if there is none, or it has other than 1, 2 or 4 channels. Four channels
// are first-order ambisonics in AmbiX (W Y Z X, SN3D).
struct SoundInfo {
  int channels = 0;
  double seconds = 0.0;  // 0 if unknown
};
SoundInfo read_sound_info(const std::string& path);

struct SoundSource {
  std::string path;
  int stream = -1;            // index in the file; -1 for the best one with sound
  bool any_channels = false;  // else 1, 2 or 4
  bool keeps_codec = false;   // if there is an encoder for the codec, else uses the container's usual one
  TimeCut cut = {};           // the file's time at which the video begins
  int head_locked = 0;        // number of channels, at the end, that are not rotated
  bool is_ambisonic = false;  // the channels before those are ambisonic
  SoundTurn turn = {};        // null for no rotation
};

// Throws Error(kInput) if there is no sound, or it cannot be read; Error(kUsage) if there is no encoder for it.
std::unique_ptr<SideTracks> pack_sound(const SoundSource& source, Container container);

// libavformat's name of the container.
const char* format_name(Container container);

// Returns whether players of the container support a track with this AVCodecID. Not PCM in mp4, although FFmpeg writes
// it since 6.1.
bool can_hold(Container container, int codec);

}  // namespace ods
