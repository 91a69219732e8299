// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tagging mkv and webm: whatever had to move, all stored positions stay right.
#include "ods/video/container/matroska_file.h"

#include <gtest/gtest.h>

#include <set>

#include "ods/base/error.h"
#include "ods/kernel/camera/camera.h"
#include "tests/support/made_videos.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

constexpr uint64_t kSegment = 0x18538067, kCluster = 0x1f43b675, kTracks = 0x1654ae6b, kCues = 0x1c53bb6b;

SphericalMetadata stacked() {
  SphericalMetadata metadata;
  metadata.stereo = VideoStereo::kTopBottom;
  metadata.projection = VideoProjection::kEquirect;
  return metadata;
}

class MatroskaVideo : public ::testing::Test {
 protected:
  std::string tag(const std::string& video, const std::optional<SphericalMetadata>& metadata) {
    folder.write("video.mkv", video);
    result = tag_video(folder.path("video.mkv"), folder.path("video.mkv"), 1, metadata);
    return folder.read("video.mkv");
  }

  VideoTrack read(const std::string& video) {
    folder.write("read.mkv", video);
    return read_video_file(folder.path("read.mkv")).tracks.at(0);
  }

  std::string error_of(const std::string& video) {
    folder.write("bad.mkv", video);
    std::string text;
    try {
      tag_video(folder.path("bad.mkv"), folder.path("bad.mkv"), 1, stacked());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
      text = error.what();
      EXPECT_EQ(folder.read("bad.mkv"), video);
    }
    return text;
  }

  // Whatever comes of it; nothing is kept, as flushing to the disk takes its time.
  void try_to_tag(const std::string& video) {
    folder.write("bad.mkv", video);
    const FileInput file(folder.path("bad.mkv"));
    AtomicFile to(folder.path("to.mkv"));
    try {
      tag_matroska(file, to, 1, stacked());
    } catch (const MalformedFile&) {
    }
  }

  TemporaryFolder folder;
  TagResult result;
};

// The data at the places in the video's index: ids, and the texts in the clusters.
void expect_right_places(const std::string& video, bool records_position) {
  const made::Piece segment = made::pieces(video, {kSegment}).at(0);
  const auto number = [&](const made::Piece& piece) {
    return made::value(video, piece.begin, static_cast<int>(piece.end - piece.begin));
  };
  const std::vector<made::Piece> seeks = made::pieces(video, {kSegment, 0x114d9b74, 0x4dbb, 0x53ac});
  ASSERT_EQ(seeks.size(), 2u);
  EXPECT_EQ(made::piece_at(video, segment.begin + number(seeks[0]), video.size()).id, kTracks);
  EXPECT_EQ(made::piece_at(video, segment.begin + number(seeks[1]), video.size()).id, kCues);
  const std::vector<made::Piece> clusters = made::pieces(video, {kSegment, kCluster});
  const std::vector<made::Piece> cues = made::pieces(video, {kSegment, kCues, 0xbb, 0xb7, 0xf1});
  const std::vector<made::Piece> positions = made::pieces(video, {kSegment, kCluster, 0xa7});
  const std::vector<made::Piece> blocks = made::pieces(video, {kSegment, kCluster, 0xa3});
  ASSERT_TRUE(clusters.size() == 2 && cues.size() == 2 && blocks.size() == 2);
  EXPECT_GE(positions.size(), records_position ? 2u : 0u);
  for (size_t i = 0; i < 2; i++) {
    EXPECT_EQ(segment.begin + number(cues[i]), clusters[i].at);
    if (i < positions.size()) {
      EXPECT_EQ(segment.begin + number(positions[i]), clusters[i].at);
    }
    EXPECT_EQ(video.substr(blocks[i].begin + 4, made::kWord), made::word(1, static_cast<int>(i)));
  }
}

// The video with one more part at the end of its segment.
std::string append_part(std::string video, const std::string& part) {
  const made::Piece segment = made::pieces(video, {kSegment}).at(0);
  video += part;
  return video.replace(segment.begin - 8, 8, made::number((uint64_t{1} << 56) | (video.size() - segment.begin), 8));
}

std::vector<made::MatroskaOptions> variants() {
  std::vector<made::MatroskaOptions> all;
  for (size_t room : {size_t{0}, size_t{9}, size_t{200}}) {
    for (bool first : {true, false}) {
      for (bool endless : {true, false}) {
        all.push_back({room, first, false, endless, "", ""});
      }
    }
  }
  return all;
}

TEST_F(MatroskaVideo, EverythingThatSaysWhereGoesOnBeingRight) {
  for (const made::MatroskaOptions& options : variants()) {
    const std::string video = made::matroska(options);
    expect_right_places(video, false);
    const std::string tagged = tag(video, stacked());
    EXPECT_EQ(result.moved, options.room < 200);
    expect_right_places(tagged, false);
    EXPECT_EQ(read(tagged).v2, stacked());
    EXPECT_EQ(tag(tagged, stacked()), tagged) << "twice is once";
    const std::string removed = tag(tagged, std::nullopt);
    expect_right_places(removed, false);
    EXPECT_FALSE(read(removed).v2);
  }
}

TEST_F(MatroskaVideo, AVoidIsUsedUpInsteadOfMoving) {
  made::MatroskaOptions options;
  options.room = 500;
  options.records_position = false;
  const std::string video = made::matroska(options), tagged = tag(video, stacked());
  EXPECT_FALSE(result.moved);
  EXPECT_EQ(tagged.size(), video.size());
  expect_right_places(tagged, false);
}

// A position of one byte cannot grow: it is taken out where it is too small.
TEST_F(MatroskaVideo, ClustersThatSayWhereTheyLieSayItAnewOrNoLonger) {
  made::MatroskaOptions options;
  const std::string video = made::matroska(options);
  expect_right_places(video, true);
  const std::string tagged = tag(video, stacked());
  expect_right_places(tagged, false);
  EXPECT_EQ(
      made::pieces(tagged, {kSegment, kCluster, 0xec}).size() + made::pieces(tagged, {kSegment, kCluster, 0xa7}).size(),
      2u);
}

TEST_F(MatroskaVideo, TheElementsAreTheBytesOfTheirSpecification) {
  const std::string tagged = tag(made::matroska({}), stacked());
  const made::Piece video = made::pieces(tagged, {kSegment, kTracks, 0xae, 0xe0}).at(0);
  const std::string expected =
      made::element(0xb0, made::number(256, 2)) + made::element(0xba, made::number(256, 2)) +
      made::element(0x54b0, made::number(256, 2)) + made::element(0x54ba, made::number(128, 1)) +
      made::element(0x53b8, made::number(3, 1)) +
      made::element(0x7670, made::element(0x7671, made::number(1, 1)) + made::element(0x7672, std::string(20, '\0')));
  EXPECT_EQ(tagged.substr(video.begin, video.end - video.begin), expected);
  EXPECT_EQ(made::value(tagged, made::pieces(tagged, {0x1a45dfa3, 0x4287}).at(0).begin, 1), 4u)
      << "Projection is of version 4";
}

TEST_F(MatroskaVideo, EveryFormItKnowsComesBack) {
  for (VideoStereo stereo : kVideoStereos) {
    for (VideoProjection projection : {VideoProjection::kEquirect, VideoProjection::kCubemap}) {
      if (stereo == VideoStereo::kOther) continue;
      SphericalMetadata metadata;
      metadata.stereo = stereo, metadata.projection = projection;
      if (projection == VideoProjection::kEquirect) metadata.bounds = {0, 0, 0x40000000, 0x40000000};
      metadata.yaw = 12.5, metadata.pitch = -3.25, metadata.roll = 170.0;
      EXPECT_EQ(read(tag(made::matroska({}), metadata)).v2, metadata) << metadata_text(metadata);
    }
  }
}

TEST_F(MatroskaVideo, EveryStereoModeHasAMeaning) {
  std::set<VideoStereo> seen;
  for (uint64_t mode = 0; mode <= 15; mode++) {
    made::MatroskaOptions options;
    options.video = made::element(0x53b8, made::number(mode, 1));
    const std::optional<SphericalMetadata> said = read(made::matroska(options)).v2;
    ASSERT_TRUE(said && said->stereo) << mode;
    EXPECT_NE(said->stereo, VideoStereo::kOther) << mode;
    seen.insert(*said->stereo);
  }
  EXPECT_EQ(seen.size(), 14u) << "two modes each for anaglyphs and for laced eyes";
}

TEST_F(MatroskaVideo, AV1InTheTagsIsReadAndTakenOut) {
  SphericalMetadata old = stacked();
  old.stereo = VideoStereo::kOneView;
  old.source = "Somebody";
  const auto name = [](const std::string& text) { return made::element(0x45a3, text); };
  made::MatroskaOptions options;
  options.tags =
      made::element(0x7373,
                    made::element(0x63c0, made::element(0x63c5, made::number(7, 1))) +
                        made::element(0x67c8, name("SPHERICAL-VIDEO") + made::element(0x4487, v1_xml(old), 2), 2) +
                        made::element(0x67c8, name("TITLE") + made::element(0x4487, "kept")),
                    2);
  // The segment's parts are found by their sizes, of which this has two bytes.
  const std::string video = append_part(made::matroska({}), made::element(0x1254c367, options.tags, 2));
  EXPECT_EQ(read(video).v1, old);
  const std::string tagged = tag(video, stacked());
  EXPECT_FALSE(read(tagged).v1);
  EXPECT_NE(tagged.find("kept"), std::string::npos);
  expect_right_places(tagged, false);
}

// The number alone does not make an entry the track that is tagged.
TEST_F(MatroskaVideo, TagsTheEntryThatIsReadAsTheTrack) {
  constexpr uint64_t kSubtitles = 17;
  const std::string pictures = made::element(0xb0, made::number(256, 2)) + made::element(0xba, made::number(256, 2));
  const std::string subtitles =
      made::element(0xae, made::element(0xd7, made::number(1, 1)) + made::element(0x83, made::number(kSubtitles, 1)) +
                              made::element(0xe0, pictures));
  std::string video = append_part(made::matroska({}), made::element(kTracks, subtitles));
  const std::string tagged = tag(video, stacked());
  EXPECT_EQ(read(tagged).v2, stacked());
  EXPECT_NE(tagged.find(subtitles), std::string::npos) << "changed what is not the video";
  video[made::pieces(video, {kSegment, kTracks, 0xae, 0xe0}).at(0).at] = '\xec';  // the video has no Video any more
  EXPECT_NE(error_of(video).find("no description of its pictures"), std::string::npos);
}

// TrackOperation, RFC 9559, section 5.1.4.1.30.
TEST_F(MatroskaVideo, ACombinedTrackTellsTheEyesOfItsPlanes) {
  constexpr uint64_t kFirstUid = 7;
  const auto track = [](uint64_t number, uint64_t uid, const std::string& more) {
    return made::element(0xae, made::element(0xd7, made::number(number, 1)) +
                                   made::element(0x73c5, made::number(uid, 1)) +
                                   made::element(0x83, made::number(1, 1)) + more);
  };
  const auto plane = [](uint64_t uid, uint64_t type) {
    return made::element(0xe4, made::element(0xe5, made::number(uid, 1)) + made::element(0xe6, made::number(type, 1)));
  };
  const std::string planes = plane(kFirstUid, 1) + plane(8, 0) + plane(9, 2);
  const std::string video = append_part(
      made::matroska({}), made::element(kTracks, track(2, 8, "") + track(3, 9, "") + track(4, 10, "") +
                                                     track(5, 11, made::element(0xe2, made::element(0xe3, planes)))));
  folder.write("planes.mkv", video);
  const VideoFile file = read_video_file(folder.path("planes.mkv"));
  ASSERT_EQ(file.tracks.size(), 4u) << "the combined track has no pictures";
  const std::optional<int> eyes[] = {kRight, kLeft, std::nullopt, std::nullopt};
  for (size_t i = 0; i < 4; i++) {
    EXPECT_EQ(file.tracks[i].id, i + 1);
    EXPECT_EQ(file.tracks[i].eye, eyes[i]) << i;
  }
}

TEST_F(MatroskaVideo, CheckSumsAreMadeTrue) {
  Element element;
  element.id = 0x1654ae6b;
  element.children = {{0xbf, 1, "none", {}}, {0x31, 1, "3456789ab", {}}};
  update_crc(element);
  // The checksum of the bytes 31 89 "3456789ab", by Python's zlib.crc32().
  EXPECT_EQ(element.children[0].body, std::string("\x7b\xf8\x4e\x74", 4));
}

TEST_F(MatroskaVideo, CutShortAnywhereIsAnError) {
  const std::string video = made::matroska({});
  for (size_t size = 0; size < video.size(); size++) EXPECT_NE(error_of(video.substr(0, size)), "") << size;
}

TEST_F(MatroskaVideo, AnyByteMayBeWrong) {
  const std::string video = made::matroska({});
  for (size_t at = 4; at < video.size(); at++) {
    for (char value : {'\0', '\x01', '\x40', '\x7f', '\xff'}) {
      std::string bad = video;
      bad[at] = value;
      try_to_tag(bad);
    }
  }
}

TEST_F(MatroskaVideo, LiveRecordingsSayWhatToUse) {
  std::string video = made::matroska({});
  const made::Piece cluster = made::pieces(video, {kSegment, kCluster}).at(1);
  video[cluster.at + 4] = '\xff';
  EXPECT_NE(error_of(video).find("mkvmerge"), std::string::npos);
}

}  // namespace
}  // namespace ods
