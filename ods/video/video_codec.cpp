// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/video_codec.h"

#include <algorithm>
#include <filesystem>

#include "ods/base/text.h"

namespace ods {

std::optional<Codec> level_codec(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::kH264:
      return Codec::kH264;
    case VideoCodec::kHevc:
      return Codec::kHevc;
    case VideoCodec::kAv1:
      return Codec::kAv1;
    case VideoCodec::kVp9:
      return Codec::kVp9;
    case VideoCodec::kProRes:
      break;
  }
  return std::nullopt;
}

std::optional<Container> container_of_path(const std::string& path) {
  const std::string extension = small_letters(std::filesystem::path(path).extension().string());
  if (extension == ".m4v") return Container::kMp4;
  return extension.empty() ? std::nullopt : find_in(kContainerTable, std::string_view(extension).substr(1));
}

bool can_hold(Container container, VideoCodec codec) {
  switch (container) {
    case Container::kMp4:
      return codec != VideoCodec::kProRes;
    case Container::kMov:
      return codec == VideoCodec::kH264 || codec == VideoCodec::kHevc || codec == VideoCodec::kProRes;
    case Container::kMatroska:
      return true;
    case Container::kWebm:
      return codec == VideoCodec::kVp9 || codec == VideoCodec::kAv1;
  }
  return false;
}

std::vector<Container> containers_of(VideoCodec codec) {
  std::vector<Container> all;
  for (Container container : kContainers) {
    if (can_hold(container, codec)) all.push_back(container);
  }
  return all;
}

bool can_have(VideoCodec codec, int bits, Chroma chroma) {
  if (bits != 8 && bits != 10) return false;
  if (codec == VideoCodec::kProRes) return bits == 10 && chroma != Chroma::k420;
  return codec != VideoCodec::kAv1 || chroma != Chroma::k422;  // no decoder of today's devices knows its 422
}

Packing packing_for(VideoTarget target, Extent size, double fps) {
  const double kPlayersRate = 4096.0 * 4096.0 * 30.0;  // pixels a second
  const double rate = 1.0 * size.width * size.height * fps;
  const bool players_take_h264 = std::max(size.width, size.height) <= 4096 && rate <= kPlayersRate;
  Packing packing;
  switch (target) {
    case VideoTarget::kVrPlayers:
      packing.codec = players_take_h264 ? VideoCodec::kH264 : VideoCodec::kHevc;
      break;
    case VideoTarget::kQuest:
      packing.codec = VideoCodec::kHevc;
      break;
    case VideoTarget::kYoutube:  // it encodes again: finer than is seen
      packing.codec = smallest_level(Codec::kH264, size, fps).empty() ? VideoCodec::kHevc : VideoCodec::kH264;
      packing.quality = 14;
      break;
    case VideoTarget::kMaster:
      packing = {VideoCodec::kProRes, 10, Chroma::k422, {}};
      break;
  }
  return packing;
}

static constexpr std::string_view kX26Presets =
    "ultrafast superfast veryfast faster fast medium slow slower veryslow placebo";

static constexpr EncoderFacts kEncoders[] = {
    {"libx264", VideoCodec::kH264, false, 51, 18, "preset", "medium", kX26Presets},
    {"libx265", VideoCodec::kHevc, false, 51, 20, "preset", "medium", kX26Presets},
    {"libsvtav1", VideoCodec::kAv1, true, 63, 28, "preset", "8", "12 11 10 9 8 7 6 5 4 3 2 1 0"},
    {"libaom-av1", VideoCodec::kAv1, false, 63, 24, "cpu-used", "6", "8 7 6 5 4 3 2 1 0"},
    {"libvpx-vp9", VideoCodec::kVp9, false, 63, 24, "cpu-used", "4", "8 7 6 5 4 3 2 1 0"},
    {"prores_ks", VideoCodec::kProRes, false, 0, 0, "", "", ""},
};

std::span<const EncoderFacts> known_encoders() {
  return kEncoders;
}

std::optional<Extent> largest_in_levels(Codec codec, Extent size, double fps) {
  const int kStep = 64;
  for (int width = (size.width - 1) / kStep * kStep; width > 0; width -= kStep) {
    const int height = static_cast<int>(int64_t{width} * size.height / size.width) / 2 * 2;
    if (height > 0 && !smallest_level(codec, {width, height}, fps).empty()) return Extent{width, height};
  }
  return std::nullopt;
}

}  // namespace ods
