// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How videos are packed: codecs, which file holds which, what goes with whom it is for.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/codec_level.h"
#include "ods/video/container/video_file.h"
#include "ods/video/ycbcr.h"

namespace ods {

enum class VideoCodec { kH264, kHevc, kAv1, kVp9, kProRes };
inline constexpr NameRow<VideoCodec> kVideoCodecTable[] = {
    {VideoCodec::kH264, "h264"}, {VideoCodec::kHevc, "hevc"},     {VideoCodec::kAv1, "av1"},
    {VideoCodec::kVp9, "vp9"},   {VideoCodec::kProRes, "prores"},
};
static_assert(has_every_member(kVideoCodecTable));
inline constexpr auto kVideoCodecs = members_of(kVideoCodecTable);
constexpr std::string_view video_codec_name(VideoCodec codec) {
  return name_in(kVideoCodecTable, codec);
}

// Of those whose levels video_level.h knows.
std::optional<Codec> level_codec(VideoCodec codec);

// By extension, in capitals or not.
std::optional<Container> container_of_path(const std::string& path);
bool can_hold(Container container, VideoCodec codec);
std::vector<Container> containers_of(VideoCodec codec);

// Bits are 8 or 10; prores has 10, and 422 or 444.
bool can_have(VideoCodec codec, int bits, Chroma chroma);

// Whom a video is for.
enum class VideoTarget { kVrPlayers, kQuest, kYoutube, kMaster };
inline constexpr NameRow<VideoTarget> kVideoTargetTable[] = {
    {VideoTarget::kVrPlayers, "vr-players"},
    {VideoTarget::kQuest, "quest"},
    {VideoTarget::kYoutube, "youtube"},
    {VideoTarget::kMaster, "master"},
};
static_assert(has_every_member(kVideoTargetTable));
inline constexpr auto kVideoTargets = members_of(kVideoTargetTable);
constexpr std::string_view video_target_name(VideoTarget target) {
  return name_in(kVideoTargetTable, target);
}

// What is packed how. Sources: DeoVR, its page on formats (H.264 up to 4096x4096 at 30 or 4096x2048 at 60 frames a
// second, HEVC above); Meta, "Browser video" (8K with HEVC). vr-players: H.264 up to there, HEVC above; quest: HEVC;
// youtube: H.264 where a level holds it, else HEVC, and finer; master: ProRes 422 HQ.
struct Packing {
  VideoCodec codec = VideoCodec::kH264;
  int bits = 8;
  Chroma chroma = Chroma::k420;
  std::optional<int> quality;  // as the encoder counts: less is better and larger; none: its usual
};
Packing packing_for(VideoTarget target, Extent size, double fps);

// Who could pack so, by libavcodec's names; of a codec's the best first.
struct EncoderFacts {
  std::string_view name;
  VideoCodec codec;
  bool only_420;
  int worst_quality;  // it goes from 0 to this; 0: there is no such number
  int quality;        // the usual
  std::string_view preset_option;
  std::string_view preset;   // the usual
  std::string_view presets;  // all, between spaces; from the fastest to the finest
};
std::span<const EncoderFacts> known_encoders();

// The largest of the same shape, in steps of 64 pixels, that a level holds; nothing where none does.
std::optional<Extent> largest_in_levels(Codec codec, Extent size, double fps);

}  // namespace ods
