// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/video_codec.h"

#include <gtest/gtest.h>

#include <set>

namespace ods {
namespace {

TEST(VideoCodec, EveryMemberHasAName) {
  std::set<std::string_view> names;
  for (VideoCodec codec : kVideoCodecs) names.insert(video_codec_name(codec));
  for (VideoTarget target : kVideoTargets) names.insert(video_target_name(target));
  EXPECT_EQ(names.size(), std::size(kVideoCodecs) + std::size(kVideoTargets));
  EXPECT_FALSE(names.contains(""));
}

TEST(VideoCodec, EveryCodecHasAContainerAnEncoderAndAForm) {
  for (VideoCodec codec : kVideoCodecs) {
    EXPECT_FALSE(containers_of(codec).empty());
    EXPECT_TRUE(can_hold(Container::kMatroska, codec));
    const bool is_master = codec == VideoCodec::kProRes;
    EXPECT_EQ(can_have(codec, 8, Chroma::k420), !is_master);
    EXPECT_EQ(can_have(codec, 10, Chroma::k420), !is_master);
    EXPECT_TRUE(can_have(codec, 10, Chroma::k444));
    EXPECT_FALSE(can_have(codec, 9, Chroma::k420));
    int count = 0;
    for (const EncoderFacts& facts : known_encoders()) {
      if (facts.codec == codec) count++;
      EXPECT_LE(facts.quality, facts.worst_quality);
    }
    EXPECT_GT(count, 0);
  }
  EXPECT_FALSE(can_hold(Container::kMp4, VideoCodec::kProRes));
  EXPECT_FALSE(can_hold(Container::kWebm, VideoCodec::kH264));
}

TEST(VideoCodec, TheExtensionIsTheContainer) {
  EXPECT_EQ(container_of_path("a.mp4"), Container::kMp4);
  EXPECT_EQ(container_of_path("a.M4V"), Container::kMp4);
  EXPECT_EQ(container_of_path("b/a.mov"), Container::kMov);
  EXPECT_EQ(container_of_path("a.mkv"), Container::kMatroska);
  EXPECT_EQ(container_of_path("a.webm"), Container::kWebm);
  for (const char* none : {"a.avi", "a", "mp4", "a.mp4.png", "a.xmp4", ""})
    EXPECT_FALSE(container_of_path(none)) << none;
}

TEST(VideoCodec, TargetsPackAsTheirPlayersLikeIt) {
  EXPECT_EQ(packing_for(VideoTarget::kVrPlayers, {4096, 4096}, 30.0).codec, VideoCodec::kH264);
  EXPECT_EQ(packing_for(VideoTarget::kVrPlayers, {4096, 2048}, 60.0).codec, VideoCodec::kH264);
  EXPECT_EQ(packing_for(VideoTarget::kVrPlayers, {4096, 4096}, 60.0).codec, VideoCodec::kHevc);
  EXPECT_EQ(packing_for(VideoTarget::kVrPlayers, {5760, 5760}, 30.0).codec, VideoCodec::kHevc);
  EXPECT_EQ(packing_for(VideoTarget::kQuest, {1024, 1024}, 30.0).codec, VideoCodec::kHevc);
  EXPECT_EQ(packing_for(VideoTarget::kYoutube, {5760, 5760}, 30.0).codec, VideoCodec::kH264);
  EXPECT_EQ(packing_for(VideoTarget::kYoutube, {8192, 8192}, 30.0).codec, VideoCodec::kHevc);
  for (VideoTarget target : kVideoTargets) {
    const Packing packing = packing_for(target, {4096, 4096}, 30.0);
    EXPECT_TRUE(can_have(packing.codec, packing.bits, packing.chroma)) << video_target_name(target);
  }
}

TEST(VideoCodec, TheLargestOfAShapeIsJustInsideTheLevels) {
  for (Codec codec : kCodecs) {
    for (Extent size : {Extent{8192, 8192}, Extent{16384, 8192}, Extent{8192, 16384}}) {
      const std::optional<Extent> largest = largest_in_levels(codec, size, 30.0);
      ASSERT_TRUE(largest);
      EXPECT_FALSE(smallest_level(codec, *largest, 30.0).empty());
      const Extent next{largest->width + 64, (largest->width + 64) * size.height / size.width};
      EXPECT_TRUE(smallest_level(codec, next, 30.0).empty()) << next.width << "x" << next.height;
      EXPECT_EQ(largest->width * size.height / size.width, largest->height);
    }
  }
  EXPECT_EQ(largest_in_levels(Codec::kHevc, {8192, 8192}, 30.0)->width, 5952);
  EXPECT_FALSE(largest_in_levels(Codec::kHevc, {8192, 8192}, 1e9));
}

}  // namespace
}  // namespace ods
