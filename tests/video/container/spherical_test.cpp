// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The metadata of videos, byte for byte, and their interpretation: forms, V1, V2, names, shapes, players.
#include <gtest/gtest.h>

#include <set>

#include "ods/base/error.h"
#include "ods/lint/players.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/video/container/apple.h"
#include "ods/video/container/complete_metadata.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

SphericalMetadata metadata_of(VideoStereo stereo, VideoProjection projection) {
  SphericalMetadata metadata;
  metadata.stereo = stereo;
  metadata.projection = projection;
  metadata.source = "Omnistereo";
  return metadata;
}

std::string bytes_of(const Box& box) {
  std::string bytes;
  write_box(box, bytes);
  return bytes;
}

std::string from_hex(std::string_view hex) {
  std::string bytes;
  std::string digits;
  for (char c : hex) {
    if (c != ' ') digits += c;
    if (digits.size() == 2) bytes += static_cast<char>(std::stoi(digits, nullptr, 16)), digits.clear();
  }
  return bytes;
}

TEST(VideoStereo, HasTheArrangementsOfLayouts) {
  for (const VideoStereo stereo : kVideoStereos) {
    const EyeArrangement eyes = arrangement_of(stereo);
    EXPECT_EQ(stereo_with(eyes), eyes.how == EyePacking::kMixed ? std::nullopt : std::optional(stereo));
    if (eyes.is_halves()) {
      ASSERT_TRUE(layout_with(eyes));
      EXPECT_EQ(stereo_name(stereo), layout_name(*layout_with(eyes)));
    }
  }
  EXPECT_EQ(stereo_with(arrangement_of(Layout::kTopBottomHalf)), VideoStereo::kTopBottom);
  EXPECT_EQ(stereo_with(arrangement_of(Layout::kRowInterleaved)), VideoStereo::kRows);
  EXPECT_EQ(stereo_with(arrangement_of(Layout::kAnaglyph)), std::nullopt);
}

TEST(Spherical, V2IsTheBytesOfItsSpecification) {
  const SphericalMetadata metadata = metadata_of(VideoStereo::kTopBottom, VideoProjection::kEquirect);
  EXPECT_EQ(bytes_of(st3d_box(metadata)), from_hex("0000000d 73743364 00000000 01"));
  // sv3d { svhd "Omnistereo\0", proj { prhd 0 0 0, equi 0 0 0 0 } }
  EXPECT_EQ(bytes_of(sv3d_box(metadata)),
            from_hex("0000005b 73763364 00000017 73766864 00000000 4f6d6e6973746572656f00 0000003c 70726f6a 00000018 "
                     "70726864 00000000 00000000 00000000 00000000 0000001c 65717569 00000000 00000000 00000000 "
                     "00000000 00000000"));
}

TEST(Spherical, AnglesBoundsAndCubesAreTheBytesOfV2) {
  SphericalMetadata metadata = metadata_of(VideoStereo::kSideBySide, VideoProjection::kEquirect);
  set_projection(metadata, find_projection("vr180")->setting);
  metadata.yaw = 90.0, metadata.pitch = -45.5, metadata.roll = -180.0;
  const std::string bytes = bytes_of(sv3d_box(metadata));
  EXPECT_NE(bytes.find(from_hex("70726864 00000000 005a0000 ffd28000 ff4c0000")), std::string::npos);
  EXPECT_NE(bytes.find(from_hex("65717569 00000000 00000000 00000000 40000000 40000000")), std::string::npos);
  metadata = metadata_of(VideoStereo::kRightLeft, VideoProjection::kCubemap);
  EXPECT_NE(bytes_of(sv3d_box(metadata)).find(from_hex("00000014 63626d70 00000000 00000000 00000000")),
            std::string::npos);
  EXPECT_EQ(bytes_of(st3d_box(metadata)).back(), 4);
}

TEST(Spherical, V1IsTheXmlOfItsSpecification) {
  SphericalMetadata metadata = metadata_of(VideoStereo::kSideBySide, VideoProjection::kEquirect);
  metadata.yaw = 90.0;
  EXPECT_EQ(v1_xml(metadata),
            "<?xml version=\"1.0\"?><rdf:SphericalVideo xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" "
            "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\">"
            "<GSpherical:Spherical>true</GSpherical:Spherical><GSpherical:Stitched>true</GSpherical:Stitched>"
            "<GSpherical:StitchingSoftware>Omnistereo</GSpherical:StitchingSoftware>"
            "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>"
            "<GSpherical:StereoMode>left-right</GSpherical:StereoMode>"
            "<GSpherical:InitialViewHeadingDegrees>90</GSpherical:InitialViewHeadingDegrees></rdf:SphericalVideo>");
}

TEST(Spherical, EveryFormThatFitsComesBack) {
  for (VideoStereo stereo : kVideoStereos) {
    for (VideoProjection projection : kVideoProjections) {
      SphericalMetadata metadata = metadata_of(stereo, projection);
      if (fits_v1(metadata)) {
        EXPECT_EQ(parse_v1(v1_xml(metadata)), metadata);
      }
      if (!fits_v2(metadata) || projection == VideoProjection::kFlat) continue;
      if (projection == VideoProjection::kEquirect) metadata.bounds = {1, 2, 3, 0xfffffff0};
      metadata.yaw = 1.25, metadata.pitch = -89.5, metadata.roll = 180.0;
      Box entry;
      entry.children = {st3d_box(metadata), sv3d_box(metadata)};
      EXPECT_EQ(parse_v2(entry), metadata) << metadata_text(metadata);
    }
  }
}

TEST(Apple, VexuIsTheBytesOfItsSpecification) {
  SphericalMetadata metadata = metadata_of(VideoStereo::kTopBottom, VideoProjection::kEquirect);
  // vexu { eyes { stri 3, hero 1, cams { blin 65000 } }, proj { prji equi }, pack { pkin over } }
  metadata.ipd = 0.065;
  EXPECT_EQ(bytes_of(vexu_box(metadata)),
            from_hex("00000072 76657875 0000003a 65796573 0000000d 73747269 00000000 03 0000000d 6865726f 00000000 01 "
                     "00000018 63616d73 00000010 626c696e 00000000 0000fde8 00000018 70726f6a 00000010 70726a69 "
                     "00000000 65717569 00000018 7061636b 00000010 706b696e 00000000 6f766572"));
  EXPECT_EQ(bytes_of(hfov_box(metadata)), from_hex("0000000c 68666f76 00057e40"));
  metadata.stereo = VideoStereo::kRightLeft;
  metadata.ipd = 5000.0;  // too many micrometres for 32 bits
  set_projection(metadata, find_projection("vr180")->setting);
  EXPECT_EQ(bytes_of(vexu_box(metadata)),
            from_hex("0000005a 76657875 00000022 65796573 0000000d 73747269 00000000 0b 0000000d 6865726f 00000000 01 "
                     "00000018 70726f6a 00000010 70726a69 00000000 68657175 00000018 7061636b 00000010 706b696e "
                     "00000000 73696465"));
  EXPECT_EQ(bytes_of(hfov_box(metadata)), from_hex("0000000c 68666f76 0002bf20"));
}

TEST(Apple, EveryFormThatFitsComesBack) {
  int count = 0;
  for (VideoStereo stereo : kVideoStereos) {
    for (VideoProjection projection : kVideoProjections) {
      for (const char* part : {"lat-long", "vr180"}) {
        SphericalMetadata metadata = metadata_of(stereo, projection);
        metadata.source = "";
        if (projection == VideoProjection::kEquirect) set_projection(metadata, find_projection(part)->setting);
        if (!fits_vexu(metadata)) continue;
        if (stereo != VideoStereo::kOneView) metadata.ipd = 0.0635;
        Box entry;
        entry.children = {vexu_box(metadata), hfov_box(metadata)};
        EXPECT_EQ(parse_vexu(entry), metadata) << metadata_text(metadata);
        count++;
      }
    }
  }
  EXPECT_EQ(count, 10);  // mono, and left or right first, on top or beside; the whole sphere and half of it
}

// Metadata as cameras of two layers write them, without a packing.
TEST(Apple, LayersAreNoPacking) {
  SphericalMetadata metadata = metadata_of(VideoStereo::kTopBottom, VideoProjection::kEquirect);
  Box entry;
  entry.children = {vexu_box(metadata)};
  entry.children[0].children.pop_back();
  EXPECT_FALSE(parse_vexu(entry));
  EXPECT_FALSE(parse_vexu(Box()));
  entry.children[0].children.clear();
  EXPECT_EQ(metadata_text(*parse_vexu(entry)), "mono, flat");
}

TEST(Spherical, V1OfOthersIsUnderstood) {
  const std::string xml =
      "<rdf:SphericalVideo xmlns:GSpherical='x'>\n  <GSpherical:Spherical> True </GSpherical:Spherical>\n"
      "  <GSpherical:Stitched>true</GSpherical:Stitched>\n"
      "  <GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType>\n"
      "  <GSpherical:CroppedAreaImageWidthPixels>50</GSpherical:CroppedAreaImageWidthPixels>\n"
      "  <GSpherical:FullPanoWidthPixels>100</GSpherical:FullPanoWidthPixels>\n"
      "  <GSpherical:CroppedAreaLeftPixels>25</GSpherical:CroppedAreaLeftPixels>\n</rdf:SphericalVideo>";
  const std::optional<SphericalMetadata> metadata = parse_v1(xml);
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->projection, VideoProjection::kEquirect);
  EXPECT_FALSE(metadata->stereo);
  EXPECT_EQ(metadata->bounds, (std::array<uint32_t, 4>{0, 0, 0x40000000, 0x40000000}));
  EXPECT_EQ(parse_v1("<rdf:RDF>something else</rdf:RDF>"), std::nullopt);
  EXPECT_EQ(parse_v1("GSpherical:Spherical>")->projection, VideoProjection::kOther);
}

TEST(Spherical, EveryNameIsAnother) {
  std::set<std::string_view> names;
  for (VideoStereo stereo : kVideoStereos) names.insert(stereo_name(stereo));
  for (VideoProjection projection : kVideoProjections) names.insert(projection_name(projection));
  EXPECT_EQ(names.size(), std::size(kVideoStereos) + std::size(kVideoProjections));
}

TEST(Spherical, AmbisonicsAreRead) {
  const auto sound = parse_sa3d(from_hex("00 80 00000001 00 00 00000006 00000000"));
  ASSERT_TRUE(sound);
  EXPECT_TRUE(sound->has_head_locked);
  EXPECT_EQ(sound->order, 1u);
  EXPECT_EQ(sound->channels, 6u);
  EXPECT_FALSE(parse_sa3d(from_hex("01 00 00000001 00 00 00000004")));
  EXPECT_FALSE(parse_sa3d(""));
}

// --- what nobody said ------------------------------------------------------------------------------------------------

SphericalMetadata guess(const std::string& path, Extent size, const SphericalMetadata& known = {}) {
  VideoTrack track;
  track.size = size;
  std::vector<std::string> guesses;
  return complete_metadata(known, track, path, guesses);
}

TEST(SphericalMetadata, NamesAndShapesTell) {
  struct Case {
    const char* path;
    Extent size;
    const char* metadata;
  };
  const Case kCases[] = {{"a_360_TB.mp4", {512, 512}, "top-bottom, lat-long"},
                         {"a_360_TB.mp4", {1024, 512}, "top-bottom, lat-long"},
                         {"a_180_LR.mov", {512, 256}, "side-by-side, lat-long 180x180"},
                         {"a_360.mkv", {512, 256}, "mono, lat-long"},
                         {"a.mp4", {512, 256}, "mono, lat-long"},
                         {"a.mp4", {512, 512}, "top-bottom, lat-long"},
                         {"a.mp4", {1024, 256}, "side-by-side, lat-long"},
                         {"a_360_mono.mp4", {512, 512}, "mono, lat-long"},
                         {"a_360_BT.mkv", {512, 512}, "bottom-top, lat-long"}};
  for (const Case& c : kCases) EXPECT_EQ(metadata_text(guess(c.path, c.size)), c.metadata) << c.path;
}

TEST(SphericalMetadata, WhatIsKnownGoesFirst) {
  SphericalMetadata known;
  known.stereo = VideoStereo::kOneView;
  EXPECT_EQ(metadata_text(guess("a_360_TB.mp4", {512, 512}, known)), "mono, lat-long");
  known.projection = VideoProjection::kFlat;
  EXPECT_EQ(metadata_text(guess("a_360_TB.mp4", {512, 512}, known)), "mono, flat");
}

TEST(SphericalMetadata, HowFarItsEyesAreApartIsItsOwnWordOrItsSidecars) {
  TemporaryFolder folder;
  VideoTrack track;
  track.size = {512, 512};
  std::vector<std::string> guesses;
  const auto ipd_of = [&](const char* name) { return complete_metadata({}, track, folder.path(name), guesses).ipd; };
  EXPECT_EQ(ipd_of("a_360_TB.mp4"), 0.0);
  track.vexu = metadata_of(VideoStereo::kTopBottom, VideoProjection::kEquirect);
  track.vexu->ipd = 0.06;
  EXPECT_EQ(ipd_of("a_360_TB.mp4"), 0.06);
  Sidecar sidecar;
  sidecar.camera.ipd = 0.05f;
  save_sidecar(sidecar, folder.path("a_360_TB.camera.json"));
  EXPECT_EQ(ipd_of("a_360_TB.mp4"), 0.06);
  track.vexu.reset();
  EXPECT_FLOAT_EQ(static_cast<float>(ipd_of("a_360_TB.mp4")), 0.05f);
  EXPECT_EQ(ipd_of("b_360_mono.mp4"), 0.0) << "one eye";
}

TEST(SphericalMetadata, AnOrdinaryVideoIsNotTakenForASphere) {
  EXPECT_THROW(guess("holiday.mp4", {1920, 1080}), Error);
  EXPECT_THROW(guess("holiday_TB.mp4", {1920, 1080}), Error);
  EXPECT_THROW(guess("a_cube-3x2.mp4", {300, 200}), Error);  // an order of faces that video metadata cannot express
  EXPECT_THROW(guess("a.mp4", {0, 0}), Error);
}

// --- players ---------------------------------------------------------------------------------------------------------

TEST(Players, EveryKindIsAsked) {
  VideoFile video;
  VideoTrack track;
  track.size = {512, 512};
  track.codec = "avc1";
  track.v2 = metadata_of(VideoStereo::kTopBottom, VideoProjection::kEquirect);
  const std::vector<PlayerView> views = video_views(video, track, "a_180_LR.mp4");
  ASSERT_EQ(views.size(), 5u);
  EXPECT_EQ(views[0].takes_it_for, "top-bottom, lat-long");
  EXPECT_EQ(views[1].takes_it_for, "mono, flat");
  EXPECT_EQ(views[2].takes_it_for, "mono, flat");
  EXPECT_EQ(views[3].takes_it_for, "side-by-side, vr180");
  EXPECT_EQ(views[4].takes_it_for, "top-bottom, lat-long");
  track.vexu = metadata_of(VideoStereo::kSideBySide, VideoProjection::kEquirect);
  EXPECT_EQ(video_views(video, track, "a.mp4")[2].takes_it_for, "side-by-side, lat-long");
  EXPECT_EQ(video_warnings(video, track, "a.mp4").size(), 2u) << "no V1, and a vexu that contradicts V2";
}

TEST(Players, WarningsAreForWhatIsWrongAndForNothingElse) {
  VideoFile video;
  VideoTrack track;
  track.size = {512, 512};
  track.codec = "avc1";
  const SphericalMetadata stacked = metadata_of(VideoStereo::kTopBottom, VideoProjection::kEquirect);
  track.v1 = track.v2 = stacked;
  EXPECT_TRUE(video_warnings(video, track, "a_360_TB.mp4").empty());
  EXPECT_TRUE(video_warnings(video, track, "a_TB.mp4").empty());
  EXPECT_TRUE(video_warnings(video, track, "a.mp4").empty());
  EXPECT_EQ(video_warnings(video, track, "a_360_LR.mp4").size(), 1u);
  track.v1 = metadata_of(VideoStereo::kOneView, VideoProjection::kEquirect);
  EXPECT_EQ(video_warnings(video, track, "a.mp4").size(), 1u);
  track.v1.reset();
  EXPECT_EQ(video_warnings(video, track, "a.mp4").size(), 1u);
  track.v1 = stacked;
  track.size = {8192, 8192};  // in no level of H.264
  EXPECT_EQ(video_warnings(video, track, "a.mp4").size(), 1u);
  track.size = {1920, 1080};  // two spheres squeezed
  EXPECT_TRUE(video_warnings(video, track, "a.mp4").empty());
  track.size = {1920, 1200};  // no shape of two spheres
  EXPECT_EQ(video_warnings(video, track, "a.mp4").size(), 1u);
  track.size = {512, 256};
  track.v1.reset(), track.v2 = metadata_of(VideoStereo::kSideBySide, VideoProjection::kEquirect);
  set_projection(*track.v2, find_projection("vr180")->setting);
  EXPECT_TRUE(video_warnings(video, track, "a_180_LR.mp4").empty());
}

TEST(Players, PicturesAreWarnedOfGPanoInStereo) {
  FileInfo info;
  info.width = info.height = 512;
  StereoFormat format;
  format.layout.layout = Layout::kTopBottom;
  EXPECT_TRUE(picture_warnings(info, format, false, "a_360_TB.png").empty());
  EXPECT_EQ(picture_warnings(info, format, true, "a_360_TB.png").size(), 1u);
  EXPECT_EQ(picture_views(info, format, true, "a.png").at(1).takes_it_for, "mono, lat-long");
}

// "Spatial Audio RFC": version, type, order, ACN, SN3D, the number of channels, which is which.
TEST(Spherical, Sa3dIsAsItsSpecificationHasIt) {
  const Box box = sa3d_box({});
  EXPECT_EQ(type_text(box.type), "SA3D");
  const std::string head("\0\0\0\0\0\1\0\0\0\0\0\4", 12), map("\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\3", 16);
  EXPECT_EQ(box.body, head + map);
  for (const Ambisonics& sound : {Ambisonics{}, Ambisonics{2, 11, true}}) {
    const std::optional<Ambisonics> back = parse_sa3d(sa3d_box(sound).body);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->order, sound.order);
    EXPECT_EQ(back->channels, sound.channels);
    EXPECT_EQ(back->has_head_locked, sound.has_head_locked);
  }
}

}  // namespace
}  // namespace ods
