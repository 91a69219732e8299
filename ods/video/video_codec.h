// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Encoding settings of videos: codecs, the containers that support them, settings per target.
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

// The codec in codec_level.h. Returns nullopt for codecs without levels there.
std::optional<Codec> level_codec(VideoCodec codec);

// The container by file extension, in upper or lower case.
std::optional<Container> container_of_path(const std::string& path);
bool can_hold(Container container, VideoCodec codec);
std::vector<Container> containers_of(VideoCodec codec);

// Bits are 8 or 10; prores is always 10-bit, 422 or 444.
bool can_have(VideoCodec codec, int bits, Chroma chroma);

// Colour metadata of a video besides ColorCode. The numbers are those of ITU-T H.273: 1 is BT.709.
struct ColorWords {
  int primaries = 1;
  int transfer = 1;
  int matrix = 1;
  int chroma_place = 1;  // H.273's number + 1, as in FFmpeg: 0 is unspecified, 1 is left
  // Metadata of an HDR video about the display on which it was graded and its own brightness, in FFmpeg's records
  // AVMasteringDisplayMetadata and AVContentLightMetadata. Empty if unspecified.
  std::string mastering_display, light_level;

  // PQ or HLG.
  bool is_hdr() const { return transfer == 16 || transfer == 18; }
  bool operator==(const ColorWords&) const = default;
};

// The purpose of the video.
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

// Encoding settings. Sources: DeoVR, its page on formats (H.264 up to 4096x4096 at 30 or 4096x2048 at 60 frames a
// second, HEVC above); Meta, "Browser video" (8K with HEVC). vr-players: H.264 up to those limits, HEVC above; quest:
// HEVC; youtube: higher quality, H.264 if a level allows it, else HEVC; master: ProRes 422 HQ.
struct Packing {
  VideoCodec codec = VideoCodec::kH264;
  int bits = 8;
  Chroma chroma = Chroma::k420;
  std::optional<int> quality;  // on the encoder's scale: lower is better and larger; default if not set
};
Packing packing_for(VideoTarget target, Extent size, double fps);

// An encoder, by its name in libavcodec. For each codec, the best comes first.
struct EncoderFacts {
  std::string_view name;
  VideoCodec codec;
  bool only_420;
  int worst_quality;  // the scale runs from 0 to this; 0 if it has no scale
  int quality;        // default
  std::string_view preset_option;
  std::string_view preset;   // default
  std::string_view presets;  // all presets, separated by spaces, from the fastest to the slowest
};
std::span<const EncoderFacts> known_encoders();

// The largest size of the same aspect, in steps of 64 pixels, that a level allows. Returns nullopt if none does.
std::optional<Extent> largest_in_levels(Codec codec, Extent size, double fps);

}  // namespace ods
