// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tagging mp4 and mov: the offsets still point to the samples, whatever had to move.
#include "ods/video/container/mp4_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "ods/base/error.h"
#include "ods/video/container/box_offsets.h"
#include "tests/support/made_videos.h"
#include "tests/support/temporary_folder.h"

namespace ods::mp4_file_test {

SphericalMetadata stacked() {
  SphericalMetadata metadata;
  metadata.stereo = VideoStereo::kTopBottom;
  metadata.projection = VideoProjection::kEquirect;
  metadata.source = "Omnistereo";
  return metadata;
}

class Mp4Video : public ::testing::Test {
 protected:
  // The video with a form in its track.
  std::string tag(const std::string& video, const std::optional<SphericalMetadata>& metadata, uint64_t track = 1) {
    folder.write("video.mp4", video);
    result = tag_video(folder.path("video.mp4"), folder.path("video.mp4"), track, metadata);
    return folder.read("video.mp4");
  }

  VideoTrack read(const std::string& video, size_t track = 0) {
    folder.write("read.mp4", video);
    return read_video_file(folder.path("read.mp4")).tracks.at(track);
  }

  // The error for an invalid video, and that the video did not change.
  std::string error_of(const std::string& video) {
    folder.write("bad.mp4", video);
    std::string text;
    try {
      tag_video(folder.path("bad.mp4"), folder.path("bad.mp4"), 1, stacked());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
      text = error.what();
      EXPECT_EQ(folder.read("bad.mp4"), video);
    }
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text;
  }

  // Whatever comes of it; nothing is kept, as flushing to the disk takes its time.
  void try_to_tag(const std::string& video) {
    folder.write("bad.mp4", video);
    const FileInput file(folder.path("bad.mp4"));
    AtomicFile to(folder.path("to.mp4"));
    try {
      tag_mp4(file, to, 1, stacked());
    } catch (const MalformedFile&) {
    }
  }

  TemporaryFolder folder;
  TagResult result;
};

std::vector<made::Mp4Options> variants() {
  std::vector<made::Mp4Options> all;
  for (bool first : {true, false}) {
    for (bool wide : {true, false}) {
      for (bool large : {true, false}) {
        for (size_t free : {size_t{0}, size_t{8}, size_t{1000}}) {
          made::Mp4Options options;
          options.header_first = first, options.wide_offsets = wide, options.large_data = large, options.free = free;
          all.push_back(options);
        }
      }
    }
  }
  made::Mp4Options options;
  options.endless_data = true;
  all.push_back(options);
  options = {};
  options.widths = {256, 512};
  all.push_back(options);
  options = {};
  options.brand = "qt  ";
  options.entry_boxes = std::string(4, '\0');  // QuickTime ends such lists with it
  return all;
}

TEST_F(Mp4Video, SamplesStayWhereTheOffsetsSay) {
  for (const made::Mp4Options& options : variants()) {
    const std::string video = made::mp4(options);
    const std::string tagged = tag(video, stacked());
    EXPECT_EQ(made::words(tagged), made::words(video));
    EXPECT_EQ(read(tagged).v1, stacked());
    EXPECT_EQ(read(tagged).v2, stacked());
    EXPECT_EQ(tag(tagged, stacked()), tagged) << "twice is once";
    const std::string removed = tag(tagged, std::nullopt);
    EXPECT_EQ(made::words(removed), made::words(video));
    EXPECT_FALSE(read(removed).v1 || read(removed).v2);
    if (options.free == 0) {
      EXPECT_EQ(removed, video);
    }
  }
}

TEST_F(Mp4Video, BoxesStandWhereTheSpecificationsPutThem) {
  SphericalMetadata metadata = stacked();
  metadata.for_apple = true;
  const std::string tagged = tag(made::mp4({}), metadata);
  const std::vector<std::string> entry = {"moov", "trak", "mdia", "minf", "stbl", "stsd", "avc1"};
  std::vector<size_t> places;
  for (const char* type : {"avcC", "st3d", "sv3d", "vexu", "pasp"}) {
    std::vector<std::string> path = entry;
    path.push_back(type);
    ASSERT_EQ(made::find(tagged, path).size(), 1u) << type;
    places.push_back(made::find(tagged, path)[0].box);
  }
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  const made::Found uuid = made::find(tagged, {"moov", "trak", "uuid"}).at(0);
  EXPECT_EQ(tagged.substr(uuid.begin, uuid.end - uuid.begin),
            "\xff\xcc\x82\x63\xf8\x55\x4a\x93\x88\x14\x58\x7a\x02\x52\x1f\xdd" + v1_xml(stacked()));
  EXPECT_EQ(uuid.end, made::find(tagged, {"moov", "trak"}).at(0).end);
}

TEST_F(Mp4Video, AFreeBoxIsUsedUpInsteadOfMoving) {
  made::Mp4Options options;
  options.free = 5000;
  const std::string video = made::mp4(options), tagged = tag(video, stacked());
  EXPECT_FALSE(result.moved);
  EXPECT_EQ(tagged.size(), video.size());
  EXPECT_EQ(tag(tagged, std::nullopt).size(), video.size());
  // One that is used up to its last byte, and one that would leave less than a box.
  const std::string plain = made::mp4({});
  const size_t growth = tag(plain, stacked()).size() - plain.size();
  EXPECT_TRUE(result.moved);
  options.free = growth;
  EXPECT_EQ(made::words(tag(made::mp4(options), stacked())), made::words(plain));
  EXPECT_FALSE(result.moved);
  options.free = growth + 4;
  EXPECT_EQ(made::words(tag(made::mp4(options), stacked())), made::words(plain));
  EXPECT_TRUE(result.moved);
}

TEST_F(Mp4Video, WhatWasThereIsReplaced) {
  SphericalMetadata other = stacked();
  other.stereo = VideoStereo::kSideBySide;
  other.source = "Somebody else";
  made::Mp4Options options;
  write_box(sv3d_box(other), options.entry_boxes);  // in the wrong order
  write_box(st3d_box(other), options.entry_boxes);
  options.track_boxes =
      made::box("uuid", std::string(kV1Id) + v1_xml(other)) + made::box("uuid", "0123456789abcdefkept");
  const std::string video = made::mp4(options), tagged = tag(video, stacked());
  EXPECT_EQ(read(video).v2, other);
  EXPECT_EQ(read(tagged).v1, stacked());
  EXPECT_EQ(read(tagged).v2, stacked());
  EXPECT_EQ(tagged.find("Somebody"), std::string::npos);
  EXPECT_NE(tagged.find("0123456789abcdefkept"), std::string::npos);
}

TEST_F(Mp4Video, VexuIsReplacedAndRemoved) {
  const std::string plain = made::mp4({});
  tag(plain, stacked());
  EXPECT_FALSE(result.has_vexu) << "nobody asked for it";
  SphericalMetadata apples = stacked();
  apples.for_apple = true;
  const std::string tagged = tag(plain, apples);
  EXPECT_TRUE(result.has_vexu);
  EXPECT_EQ(metadata_text(*read(tagged).vexu), metadata_text(stacked()));
  SphericalMetadata beside = apples;
  beside.stereo = VideoStereo::kSideBySide;
  const std::string again = tag(tagged, beside);
  EXPECT_EQ(metadata_text(*read(again).vexu), metadata_text(beside));
  EXPECT_EQ(tag(again, std::nullopt), plain);
  SphericalMetadata turned = apples;
  turned.yaw = 5.0;  // which vexu has no place for: it stays as it is
  EXPECT_EQ(read(tag(tagged, turned)).vexu, read(tagged).vexu);
  SphericalMetadata cube = apples;
  cube.projection = VideoProjection::kCubemap;  // which vexu cannot express
  EXPECT_FALSE(read(tag(tagged, cube)).vexu);
}

// Eyes that are layers of the stream are not ours to describe.
TEST_F(Mp4Video, VexuOfLayersStays) {
  made::Mp4Options options;
  options.entry_boxes = made::box("lhvC", "layers") +
                        made::box("vexu", made::box("eyes", made::box("stri", std::string("\0\0\0\0\3", 5))));
  const std::string video = made::mp4(options), tagged = tag(video, stacked());
  EXPECT_FALSE(result.has_vexu);
  EXPECT_FALSE(read(tagged).vexu);
  EXPECT_NE(tagged.find(options.entry_boxes), std::string::npos);
}

TEST_F(Mp4Video, LayersSayWhatTheirEyesShow) {
  const std::string none(4, '\0');
  const auto layers_of = [&](const std::string& boxes) {
    made::Mp4Options options;
    options.entry_boxes = made::box("lhvC", "layers") + boxes;
    return *read(made::mp4(options)).layers;
  };
  const EyeLayers silent = layers_of("");
  EXPECT_EQ(metadata_text(silent.beside), "side-by-side, flat");
  EXPECT_FALSE(silent.right_first);
  EXPECT_FALSE(silent.fov);
  const std::string eyes = made::box("eyes", made::box("stri", none + made::number(1 + 2 + 8, 1)) +
                                                 made::box("cams", made::box("blin", none + made::number(65000, 4))));
  const EyeLayers half = layers_of(made::box("vexu", eyes + made::box("proj", made::box("prji", none + "hequ"))) +
                                   made::box("hfov", made::number(90500, 4)));
  EXPECT_EQ(metadata_text(half.beside), "side-by-side, lat-long 180x180");
  EXPECT_TRUE(half.right_first);
  EXPECT_EQ(half.fov, 90.5f);
  EXPECT_EQ(half.beside.ipd, 0.065);
  EXPECT_FALSE(layers_of(made::box("hfov", made::number(360000, 4))).fov) << "no window is as wide";
  EXPECT_EQ(metadata_text(layers_of(made::box("vexu", "\xff\xff\xff\xffproj")).beside), "side-by-side, flat");
}

TEST_F(Mp4Video, ADamagedVexuSaysNothing) {
  made::Mp4Options options;
  options.entry_boxes = made::box("vexu", std::string("\xff\xff\xff\xffproj", 8));
  EXPECT_FALSE(read(made::mp4(options)).vexu);
  EXPECT_FALSE(read(tag(made::mp4(options), stacked())).vexu);
}

TEST_F(Mp4Video, FormsThatV1CannotSayHaveNone) {
  SphericalMetadata half = stacked();
  half.bounds = {0, 0, 0x40000000, 0x40000000};
  const std::string tagged = tag(tag(made::mp4({}), stacked()), half);
  EXPECT_FALSE(result.has_v1);
  EXPECT_FALSE(read(tagged).v1);
  EXPECT_EQ(read(tagged).v2, half);
  half.stereo = VideoStereo::kBottomTop;
  EXPECT_THROW(tag(made::mp4({}), half), Error);
}

TEST_F(Mp4Video, TheLargestTrackIsMeant) {
  made::Mp4Options options;
  options.widths = {128, 512, 256};
  const std::string video = made::mp4(options);
  folder.write("video.mp4", video);
  const VideoFile info = read_video_file(folder.path("video.mp4"));
  EXPECT_EQ(choose_track(info, {}, "video.mp4").id, 2u);
  EXPECT_EQ(choose_track(info, 3, "video.mp4").id, 3u);
  EXPECT_THROW(choose_track(info, 4, "video.mp4"), Error);
  const std::string tagged = tag(video, stacked(), 2);
  EXPECT_FALSE(read(tagged, 0).v2);
  EXPECT_TRUE(read(tagged, 1).v2 && read(tagged, 1).v1);
  options.widths = {512, 512};
  folder.write("video.mp4", made::mp4(options));
  EXPECT_THROW(choose_track(read_video_file(folder.path("video.mp4")), {}, "video.mp4"), Error);
}

TEST_F(Mp4Video, FragmentsAndTheirIndicesMove) {
  for (bool absolute : {true, false}) {
    const std::string video = made::fragmented_mp4(absolute), tagged = tag(video, stacked());
    ASSERT_EQ(made::words(video), (std::vector<std::string>{made::word(1, 0), made::word(1, 1)}));
    EXPECT_EQ(made::words(tagged), made::words(video));
    const std::vector<made::Found> fragments = made::find(tagged, {"moof"});
    const made::Found table = made::find(tagged, {"mfra", "tfra"}).at(0);
    const made::Found index = made::find(tagged, {"sidx"}).at(0);
    EXPECT_EQ(made::value(tagged, table.begin + 24, 8), fragments.at(0).box);
    EXPECT_EQ(made::value(tagged, table.begin + 43, 8), fragments.at(1).box);
    EXPECT_EQ(index.end + made::value(tagged, index.begin + 16, 4), fragments.at(0).box);
    EXPECT_EQ(tag(tagged, stacked()), tagged);
    EXPECT_EQ(tag(tagged, std::nullopt), video);
    EXPECT_TRUE(read_video_file(folder.path("video.mp4")).is_fragmented);
  }
}

TEST_F(Mp4Video, ALinkGoesOnLeadingToTheVideoAndModesStay) {
  folder.write("video.mp4", made::mp4({}));
  std::filesystem::permissions(folder.path("video.mp4"), std::filesystem::perms(0640));
  std::filesystem::create_symlink("video.mp4", folder.path("link.mp4"));
  tag_video(folder.path("link.mp4"), folder.path("link.mp4"), 1, stacked());
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.mp4")));
  EXPECT_TRUE(read_video_file(folder.path("video.mp4")).tracks.at(0).v2);
  EXPECT_EQ(std::filesystem::status(folder.path("video.mp4")).permissions(), std::filesystem::perms(0640));
}

// Killed without warning at whatever moment, there is the old video or the new one.
TEST_F(Mp4Video, KilledItLeavesTheOldVideoOrTheNew) {
  made::Mp4Options options;
  options.padding = size_t{1} << 18;
  options.chunks = 32;
  const std::string old = made::mp4(options), tagged = tag(old, stacked());
  for (int i = 0; i < 16; i++) {
    folder.write("video.mp4", old);
    const pid_t child = fork();
    if (child == 0) {
      tag_video(folder.path("video.mp4"), folder.path("video.mp4"), 1, stacked());
      _exit(0);
    }
    usleep(static_cast<useconds_t>(2000 * i));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const std::string now = folder.read("video.mp4");
    EXPECT_TRUE(now == old || now == tagged) << i;
  }
}

// --- offsets ---------------------------------------------------------------------------------------------------------

Box table(BoxType type, const std::string& body) {
  Box box;
  box.type = type;
  box.body = body;
  return box;
}

TEST(BoxOffsets, OffsetsThatNoLongerFitGetMoreBytes) {
  Box samples;
  samples.children = {table(
      box_type("stco"), made::number(0, 4) + made::number(2, 4) + made::number(50, 4) + made::number(0xfffffff0, 4))};
  const Move move{100, 200, 1000, uint64_t{1} << 33};
  EXPECT_TRUE(widen_offsets(samples, move));
  EXPECT_FALSE(widen_offsets(samples, move));
  move_offsets(samples, move);
  EXPECT_EQ(samples.children[0].type, box_type("co64"));
  EXPECT_EQ(samples.children[0].body,
            made::number(0, 4) + made::number(2, 4) + made::number(50, 8) + made::number(0xfffffff0ull + 1000, 8));
}

TEST(BoxOffsets, OffsetsOfOtherThingsMove) {
  const Move move{100, 200, 1000, 100000};
  Box samples;
  samples.children = {
      table(box_type("saio"), made::number(1, 4) + made::number(0, 8) + made::number(1, 4) + made::number(300, 4))};
  move_offsets(samples, move);
  EXPECT_EQ(made::value(samples.children[0].body, 16, 4), 1300u);
  // Two items: offsets of 4 bytes with a base, and one that lies in no file.
  const auto item = [](uint64_t id, uint64_t method, uint64_t base) {
    return made::number(id, 2) + made::number(method, 2) + made::number(0, 2) + made::number(base, 4) +
           made::number(1, 2) + made::number(20, 4) + made::number(5, 4);
  };
  Box meta;
  meta.type = box_type("meta");
  meta.body = made::number(0, 4) + made::box("hdlr", std::string(24, '\0')) +
              made::box("iloc", made::number(0x01000000, 4) + made::number(0x4440, 2) + made::number(2, 2) +
                                    item(1, 0, 400) + item(2, 1, 400));
  move_item_offsets(meta, move);
  const std::string& body = find_child(meta, box_type("iloc"))->body;
  EXPECT_EQ(made::value(body, 14, 4), 1400u);
  EXPECT_EQ(made::value(body, 34, 4), 400u);
}

TEST(BoxOffsets, NothingLiesInTheHeaderOrBehindTheEnd) {
  const Move move{100, 200, 50, 1000};
  EXPECT_EQ(move(99), 99u);
  EXPECT_EQ(move(200), 250u);
  EXPECT_THROW(move(150), MalformedFile);
  EXPECT_THROW(move(1001), MalformedFile);
  EXPECT_THROW(move(uint64_t{1} << 63), MalformedFile);
}

// --- bad input -------------------------------------------------------------------------------------------------------

TEST_F(Mp4Video, CutShortAnywhereIsAnErrorAndNothingElse) {
  for (bool first : {true, false}) {
    made::Mp4Options options;
    options.header_first = first;
    const std::string video = made::mp4(options);
    for (size_t size = 0; size < video.size(); size++) {
      EXPECT_NE(error_of(video.substr(0, size)), "") << size;
    }
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"bad.mp4"});
}

// Cameras of Insta360 end their files with data that are no box.
TEST_F(Mp4Video, BytesAfterTheLastBoxStay) {
  for (const std::string& trailer : {std::string("\0\1\2\3\4\5\6\7rest", 12), std::string("short"),
                                     std::string("\xff\xff\xff\xff") + "8db42d694ccc418790edff439fe026bf"}) {
    for (const bool first : {true, false}) {
      made::Mp4Options options;
      options.header_first = first;
      const std::string tagged = tag(made::mp4(options) + trailer, stacked());
      EXPECT_TRUE(tagged.ends_with(trailer));
      EXPECT_EQ(read(tagged).v2, stacked());
    }
  }
}

// An error or a video, but no crash and no half a file.
TEST_F(Mp4Video, AnyByteMayBeWrong) {
  const std::string videos[] = {made::mp4({}), made::fragmented_mp4(true)};
  for (const std::string& video : videos) {
    for (size_t at = 0; at < video.size(); at++) {
      for (char value : {'\0', '\xff'}) {
        std::string bad = video;
        bad[at] = value;
        try_to_tag(bad);
      }
    }
  }
}

TEST_F(Mp4Video, RandomBytesAreNoVideo) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; i++) {
    std::string bytes = i % 2 == 0 ? made::number(1000, 4) + "moov" : "";
    while (bytes.size() < 1000) bytes += static_cast<char>(random());
    EXPECT_NE(error_of(bytes), "");
  }
}

TEST_F(Mp4Video, SizesAreNotBelieved) {
  const std::string video = made::mp4({});
  for (uint64_t size : {uint64_t{1} << 63, ~uint64_t{0}, uint64_t{1} << 40, uint64_t{15}, uint64_t{0}}) {
    EXPECT_NE(error_of(video + made::number(1, 4) + "free" + made::number(size, 8)), "") << size;
    EXPECT_NE(error_of(made::box("ftyp", "isom") + made::number(1, 4) + "moov" + made::number(size, 8)), "") << size;
  }
  for (const char* type : {"stco", "co64"}) {
    made::Mp4Options options;
    options.wide_offsets = std::string(type) == "co64";
    std::string bad = made::mp4(options);
    const size_t count = bad.find(type) + 8;
    bad.replace(count, 4, made::number(0xffffffff, 4));
    EXPECT_NE(error_of(bad), "");
  }
}

TEST_F(Mp4Video, DepthAndWidthAreNotBelieved) {
  std::string deep;
  for (int i = 0; i < 10000; i++) deep = made::number(deep.size() + 8, 4) + "trak" + deep;
  EXPECT_NE(error_of(made::box("ftyp", "isom") + made::box("moov", deep)), "");
  std::string wide;
  for (int i = 0; i < 1000001; i++)
    wide += std::string(
        "\0\0\0\x08"
        "free",
        8);
  EXPECT_NE(error_of(wide), "");
  EXPECT_NE(error_of(made::box("moov", wide)), "");
}

TEST_F(Mp4Video, WhatIsNotAVideoSaysSo) {
  EXPECT_NE(error_of("").find("not a supported video"), std::string::npos);
  EXPECT_NE(error_of("plain text that is long enough").find("not a supported video"), std::string::npos);
  EXPECT_NE(error_of(made::box("ftyp", "isom") + made::box("mdat", "x")).find("no header"), std::string::npos);
  EXPECT_NE(error_of(made::mp4({}) + made::box("moov", "")).find("two headers"), std::string::npos);
  EXPECT_NE(error_of(made::box("moov", made::box("cmov", ""))).find("compressed"), std::string::npos);
  EXPECT_THROW(read_video_file(folder.path("absent.mp4")), Error);
  EXPECT_THROW(read_video_file(folder.path("")), Error);
}

TEST_F(Mp4Video, SamplesInOtherFilesAreRefused) {
  std::string video = made::mp4({});
  video[video.find("url ") + 7] = '\0';
  EXPECT_NE(error_of(video).find("other files"), std::string::npos);
}

}  // namespace ods::mp4_file_test
