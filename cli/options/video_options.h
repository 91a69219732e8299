// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options for packing a video, shared by the commands that make one.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/video/make_video.h"
#include "ods/video/video_input.h"

struct VideoChoices {
  std::string output;
  std::optional<ods::VideoTarget> target;  // by default players of VR videos
  std::optional<ods::VideoCodec> codec;
  std::optional<int> bits, crf;
  std::optional<ods::Chroma> chroma;
  std::optional<float> bitrate;
  std::string encoder, preset, sound;
  bool for_apple = false;
  ods::KeepOptions keep;
  ods::FrameRate rate;

  ods::VideoTarget target_or_usual() const { return target.value_or(ods::VideoTarget::kVrPlayers); }
  bool specifies_encoding() const {
    return target || codec || bits || crf || chroma || bitrate || for_apple || !encoder.empty() || !preset.empty() ||
           !sound.empty();
  }
};

// Parses 30, 12.5, 30000/1001; 29.97 and the like mean 30000/1001 and the like, as usual. Throws UsageError.
ods::FrameRate parse_rate(const std::string& text);

// Adds -o and the packing options, in their own groups, without the rate.
void add_video_options(Options& options, VideoChoices& choices);
// Adds the packing options alone, to the group that is open.
void add_packing_options(Options& options, VideoChoices& choices);

// Copies what the options leave open from the video that is converted: codec, bit depth, chroma, rate, audio and
// metadata. Warns about what cannot be kept.
VideoChoices choices_like(VideoChoices choices, const ods::VideoInput& video, const ods::VideoStream& stream);

// Returns the container that the video's file name selects. Throws UsageError.
ods::Container container_for(const std::string& path);

// Returns the settings to encode a video of that size. Throws UsageError if the options do not fit together, ods::Error
// if this machine cannot encode it. Checks that the file can be written, but writes nothing.
ods::EncodeOptions encode_options(const VideoChoices& choices, ods::Extent size, int threads);

// Describes the video made from eyes of this size; warns about properties that players do not expect. Throws UsageError
// for a layout that videos cannot have.
ods::VideoPlan expect_video(ods::Layout layout, size_t eyes, ods::Extent eye, const ods::ProjectionSetting& projection);

// Notes what users should know before the video is made: levels, names, and its sound for this number of frames.
void note_player_limits(const VideoChoices& choices, const ods::VideoPlan& plan, const ods::EncodeOptions& options);
void note_sound_length(const ods::EncodeOptions& options, size_t frames);

// "h264 by libx264, 8 bits, 420, level 5.2, 4096x4096, 100 frames at 30 a second".
std::string video_text(const ods::VideoPlan& plan, const ods::EncodeOptions& options, size_t frames);
