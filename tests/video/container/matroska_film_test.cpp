// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tagging mkv and webm: whatever had to move, everything that says where something lies goes on being right.
#include "ods/video/container/matroska_film.h"

#include <gtest/gtest.h>

#include "ods/base/error.h"
#include "tests/support/made_films.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

constexpr uint64_t kSegment = 0x18538067, kCluster = 0x1f43b675, kTracks = 0x1654ae6b, kCues = 0x1c53bb6b;

FilmForm stacked() {
  FilmForm form;
  form.stereo = FilmStereo::kTopBottom;
  form.projection = FilmProjection::kEquirect;
  return form;
}

class MatroskaFilm : public ::testing::Test {
 protected:
  std::string tag(const std::string& film, const std::optional<FilmForm>& form) {
    folder.write("film.mkv", film);
    result = tag_film(folder.path("film.mkv"), folder.path("film.mkv"), 1, form);
    return folder.read("film.mkv");
  }

  VideoTrack read(const std::string& film) {
    folder.write("read.mkv", film);
    return read_film(folder.path("read.mkv")).video.at(0);
  }

  std::string error_of(const std::string& film) {
    folder.write("bad.mkv", film);
    std::string text;
    try {
      tag_film(folder.path("bad.mkv"), folder.path("bad.mkv"), 1, stacked());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
      text = error.what();
      EXPECT_EQ(folder.read("bad.mkv"), film);
    }
    return text;
  }

  // Whatever comes of it; nothing is kept, as flushing to the disk takes its time.
  void try_to_tag(const std::string& film) {
    folder.write("bad.mkv", film);
    const FileInput file(folder.path("bad.mkv"));
    AtomicFile to(folder.path("to.mkv"));
    try {
      tag_matroska(file, to, 1, stacked());
    } catch (const Broken&) {
    }
  }

  TemporaryFolder folder;
  TagResult result;
};

// What stands at the places that the film's index names: ids, and the words in the clusters.
void expect_right_places(const std::string& film, bool says_position) {
  const made::Piece segment = made::pieces(film, {kSegment}).at(0);
  const auto number = [&](const made::Piece& piece) {
    return made::value(film, piece.begin, static_cast<int>(piece.end - piece.begin));
  };
  const std::vector<made::Piece> seeks = made::pieces(film, {kSegment, 0x114d9b74, 0x4dbb, 0x53ac});
  ASSERT_EQ(seeks.size(), 2u);
  EXPECT_EQ(made::piece_at(film, segment.begin + number(seeks[0]), film.size()).id, kTracks);
  EXPECT_EQ(made::piece_at(film, segment.begin + number(seeks[1]), film.size()).id, kCues);
  const std::vector<made::Piece> clusters = made::pieces(film, {kSegment, kCluster});
  const std::vector<made::Piece> cues = made::pieces(film, {kSegment, kCues, 0xbb, 0xb7, 0xf1});
  const std::vector<made::Piece> positions = made::pieces(film, {kSegment, kCluster, 0xa7});
  const std::vector<made::Piece> blocks = made::pieces(film, {kSegment, kCluster, 0xa3});
  ASSERT_TRUE(clusters.size() == 2 && cues.size() == 2 && blocks.size() == 2);
  EXPECT_GE(positions.size(), says_position ? 2u : 0u);
  for (size_t i = 0; i < 2; i++) {
    EXPECT_EQ(segment.begin + number(cues[i]), clusters[i].at);
    if (i < positions.size()) {
      EXPECT_EQ(segment.begin + number(positions[i]), clusters[i].at);
    }
    EXPECT_EQ(film.substr(blocks[i].begin + 4, made::kWord), made::word(1, static_cast<int>(i)));
  }
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

TEST_F(MatroskaFilm, EverythingThatSaysWhereGoesOnBeingRight) {
  for (const made::MatroskaOptions& options : variants()) {
    const std::string film = made::matroska(options);
    expect_right_places(film, false);
    const std::string tagged = tag(film, stacked());
    EXPECT_EQ(result.moved, options.room < 200);
    expect_right_places(tagged, false);
    EXPECT_EQ(read(tagged).v2, stacked());
    EXPECT_EQ(tag(tagged, stacked()), tagged) << "twice is once";
    const std::string removed = tag(tagged, std::nullopt);
    expect_right_places(removed, false);
    EXPECT_FALSE(read(removed).v2);
  }
}

TEST_F(MatroskaFilm, AVoidIsUsedUpInsteadOfMoving) {
  made::MatroskaOptions options;
  options.room = 500;
  options.says_position = false;
  const std::string film = made::matroska(options), tagged = tag(film, stacked());
  EXPECT_FALSE(result.moved);
  EXPECT_EQ(tagged.size(), film.size());
  expect_right_places(tagged, false);
}

// A position of one byte cannot grow: it is taken out where it is too small.
TEST_F(MatroskaFilm, ClustersThatSayWhereTheyLieSayItAnewOrNoLonger) {
  made::MatroskaOptions options;
  const std::string film = made::matroska(options);
  expect_right_places(film, true);
  const std::string tagged = tag(film, stacked());
  expect_right_places(tagged, false);
  EXPECT_EQ(
      made::pieces(tagged, {kSegment, kCluster, 0xec}).size() + made::pieces(tagged, {kSegment, kCluster, 0xa7}).size(),
      2u);
}

TEST_F(MatroskaFilm, TheElementsAreTheBytesOfTheirSpecification) {
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

TEST_F(MatroskaFilm, EveryFormItKnowsComesBack) {
  for (FilmStereo stereo : kFilmStereos) {
    for (FilmProjection projection : {FilmProjection::kEquirect, FilmProjection::kCubemap}) {
      if (stereo == FilmStereo::kOther) continue;
      FilmForm form;
      form.stereo = stereo, form.projection = projection;
      if (projection == FilmProjection::kEquirect) form.bounds = {0, 0, 0x40000000, 0x40000000};
      form.yaw = 12.5, form.pitch = -3.25, form.roll = 170.0;
      EXPECT_EQ(read(tag(made::matroska({}), form)).v2, form) << form_text(form);
    }
  }
}

TEST_F(MatroskaFilm, AV1InTheTagsIsReadAndTakenOut) {
  FilmForm old = stacked();
  old.stereo = FilmStereo::kOneView;
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
  std::string film = made::matroska({});
  const made::Piece segment = made::pieces(film, {kSegment}).at(0);
  film += made::element(0x1254c367, options.tags, 2);
  film.replace(segment.begin - 8, 8, made::number((uint64_t{1} << 56) | (film.size() - segment.begin), 8));
  EXPECT_EQ(read(film).v1, old);
  const std::string tagged = tag(film, stacked());
  EXPECT_FALSE(read(tagged).v1);
  EXPECT_NE(tagged.find("kept"), std::string::npos);
  expect_right_places(tagged, false);
}

TEST_F(MatroskaFilm, CheckSumsAreMadeTrue) {
  Element element;
  element.id = 0x1654ae6b;
  element.children = {{0xbf, 1, "none", {}}, {0x31, 1, "3456789ab", {}}};
  update_crc(element);
  // Of the bytes 31 89 "3456789ab", by Python's zlib.crc32().
  EXPECT_EQ(element.children[0].body, std::string("\x7b\xf8\x4e\x74", 4));
}

TEST_F(MatroskaFilm, CutShortAnywhereIsAnError) {
  const std::string film = made::matroska({});
  for (size_t size = 0; size < film.size(); size++) EXPECT_NE(error_of(film.substr(0, size)), "") << size;
}

TEST_F(MatroskaFilm, AnyByteMayBeWrong) {
  const std::string film = made::matroska({});
  for (size_t at = 4; at < film.size(); at++) {
    for (char value : {'\0', '\x01', '\x40', '\x7f', '\xff'}) {
      std::string bad = film;
      bad[at] = value;
      try_to_tag(bad);
    }
  }
}

TEST_F(MatroskaFilm, LiveRecordingsSayWhatToUse) {
  std::string film = made::matroska({});
  const made::Piece cluster = made::pieces(film, {kSegment, kCluster}).at(1);
  film[cluster.at + 4] = '\xff';
  EXPECT_NE(error_of(film).find("mkvmerge"), std::string::npos);
}

}  // namespace
}  // namespace ods
