// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that say how a video is packed. Shared by the commands that make one.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/video/make_video.h"

struct VideoWishes {
  std::string output;
  ods::VideoTarget target = ods::VideoTarget::kVrPlayers;
  std::optional<ods::VideoCodec> codec;
  std::optional<int> bits, crf;
  std::optional<ods::Chroma> chroma;
  std::optional<float> bitrate;
  std::string encoder, preset, sound;
  bool copies_sound = false;
  bool for_apple = false;
  ods::SoundCut sound_cut;
  ods::FrameRate rate;
};

// 30, 12.5, 30000/1001; 29.97 and its like mean 30000/1001 and its like, as everybody means. Throws UsageError.
ods::FrameRate parse_rate(const std::string& text);

// -o and what follows, in groups of their own; not the rate.
void add_video_options(Options& options, VideoWishes& wishes);
// The same without -o, in a group that is open already.
void add_packing_options(Options& options, VideoWishes& wishes);

// Of a video's name. Throws UsageError.
ods::Container container_for(const std::string& path);

// How a video of that size is encoded. Throws UsageError where the wishes do not fit together, ods::Error where this
// machine cannot. Nothing is written, but that the file could be is found out.
ods::EncodeOptions encode_options(const VideoWishes& wishes, ods::Extent size, int threads);

// What a video of eyes of this size will be like; warns of what players do not expect. Throws UsageError for a layout
// that videos do not have.
ods::VideoPlan expect_video(ods::Layout layout, size_t eyes, ods::Extent eye, const ods::ProjectionSetting& projection);

// What people should know before a video is made: levels, names; then, of so many frames, its sound.
void say_what_players_need(const VideoWishes& wishes, const ods::VideoPlan& plan, const ods::EncodeOptions& options);
void say_length_of_sound(const ods::EncodeOptions& options, size_t frames);

// "h264 by libx264, 8 bits, 420, level 5.2, 4096x4096, 100 frames at 30 a second".
std::string video_text(const ods::VideoPlan& plan, const ods::EncodeOptions& options, size_t frames);
