// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/joined_tracks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "ods/base/error.h"

namespace ods {
namespace {

// A frame of 4:2:0 whose sample at x, y of a plane is value(plane, x, y). Columns and rows count in luma samples, from
// the middle of a sample.
template <typename T, typename Value>
DecodedFrame made_frame(Extent size, int bits, const Value& value) {
  const auto memory = std::make_shared<std::vector<T>>(static_cast<size_t>(size.width * size.height * 3 / 2));
  DecodedFrame frame;
  frame.planes.bits = bits, frame.planes.chroma = Chroma::k420;
  size_t at = 0;
  for (int i = 0; i < 3; i++) {
    const int share = i == 0 ? 1 : 2;
    frame.planes.first[static_cast<size_t>(i)] = reinterpret_cast<std::byte*>(&(*memory)[at]);
    frame.planes.stride[static_cast<size_t>(i)] = static_cast<size_t>(size.width / share) * sizeof(T);
    for (int y = 0; y < size.height / share; y++) {
      for (int x = 0; x < size.width / share; x++, at++)
        (*memory)[at] = static_cast<T>(std::lround(value(i, (x + 0.5) * share, (y + 0.5) * share)));
    }
  }
  frame.memory = memory;
  return frame;
}

template <typename T>
double sample(const DecodedFrame& frame, size_t plane, int x, int y) {
  const std::byte* row = frame.planes.first[plane] + static_cast<size_t>(y) * frame.planes.stride[plane];
  return reinterpret_cast<const T*>(row)[x];
}

// The place in the row of three faces without overlaps, in faces, of a column of a stored row.
double place_of(double x, const FaceRows& rows) {
  const double face = rows.track.height, side = (rows.track.width - face) / 2, unique = side - rows.overlap;
  if (x >= side && x < side + face) return 1.0 + (x - side) / face;
  const double in_side = x < side ? x : x - side - face;
  return (x < side ? 0.0 : 2.0) + (in_side < side / 2 ? in_side : in_side - rows.overlap) / unique;
}

// A slow wave over the row of faces.
double wave(int plane, int row, double place, double y, double height, double maximum) {
  return maximum * (0.5 + 0.3 * std::sin(5.0 * place + 1.1 * plane + row) + 0.15 * std::cos(6.0 * y / height));
}

template <typename T>
void expect_the_wave(const FaceRows& rows, int bits, double tolerance) {
  const double maximum = (1 << bits) - 1, height = rows.track.height;
  const auto row = [&](int number) {
    return made_frame<T>(rows.track, bits, [&](int plane, double x, double y) {
      return wave(plane, number, place_of(x, rows), y, height, maximum);
    });
  };
  const DecodedFrame whole = join_rows(row(0), row(1), rows);
  double worst = 0.0;
  for (int i = 0; i < 3; i++) {
    const int share = i == 0 ? 1 : 2;
    for (int y = 0; y < 2 * rows.track.height / share; y++) {
      const double at = (y + 0.5) * share, in_row = std::fmod(at, height);
      for (int x = 0; x < 3 * rows.track.height / share; x++) {
        const double expected = wave(i, at < height ? 0 : 1, (x + 0.5) * share / height, in_row, height, maximum);
        worst = std::max(worst, std::abs(sample<T>(whole, static_cast<size_t>(i), x, y) - expected));
      }
    }
  }
  EXPECT_LT(worst, tolerance);
}

TEST(JoinRows, FacesHaveNoOverlapAndAreSquare) {
  expect_the_wave<uint8_t>(*face_rows_of({2272, 736}), 8, 0.51);
  expect_the_wave<uint8_t>(*face_rows_of({4096, 1344}), 8, 1.2);
  expect_the_wave<uint16_t>({{272, 88}, 8}, 10, 1.6);
}

// Without a stretch nothing is interpolated, and where only one half shows a place, it is copied.
TEST(JoinRows, SamplesOfOneHalfAreCopied) {
  const FaceRows rows = *face_rows_of({2272, 736});
  const auto noise = [](int plane, double x, double y) {
    return static_cast<int>(x * 37 + y * 101 + plane * 13 + x * y) % 251;
  };
  const DecodedFrame row = made_frame<uint8_t>(rows.track, 8, noise), whole = join_rows(row, row, rows);
  for (const int x : {0, 1, 351, 400, 735, 736, 1000, 1471, 1472, 1800, 1472 + 384, 2207}) {
    const int stored = x < 368 ? x : x < 1472 + 368 ? x + 32 : x + 64;
    EXPECT_EQ(sample<uint8_t>(whole, 0, x, 5), sample<uint8_t>(row, 0, stored, 5)) << x;
    EXPECT_EQ(sample<uint8_t>(whole, 0, x, 736 + 5), sample<uint8_t>(row, 0, stored, 5)) << x;
  }
}

TEST(JoinRows, OneHalfFadesIntoTheOther) {
  const FaceRows rows = *face_rows_of({2272, 736});
  const DecodedFrame row =
      made_frame<uint8_t>(rows.track, 8, [](int, double x, double) { return x < 384 ? 100.0 : 164.0; });
  const DecodedFrame whole = join_rows(row, row, rows);
  for (int x = 340; x < 400; x++) {
    const double expected = 100.0 + 64.0 * std::clamp((x + 0.5 - 352.0) / 32.0, 0.0, 1.0);
    EXPECT_NEAR(sample<uint8_t>(whole, 0, x, 9), expected, 0.51) << x;
  }
}

TEST(JoinRows, OnlyTheSizesOfTheCameraAreRows) {
  EXPECT_EQ(face_rows_of({4096, 1344})->whole().width, 4032);
  EXPECT_EQ(face_rows_of({2272, 736})->whole().height, 1472);
  for (const Extent size : {Extent{5952, 1920}, {4096, 1340}, {3840, 1920}, {0, 0}}) EXPECT_FALSE(face_rows_of(size));
}

TEST(JoinEyes, TheFirstOneIsOnTheLeft) {
  const Extent eye{16, 8};
  const auto plain = [&](int add) {
    return made_frame<uint8_t>(eye, 8, [=](int plane, double x, double y) { return add + plane + x + 2 * y; });
  };
  const DecodedFrame left = plain(10), right = plain(100), both = join_eyes(left, right, eye);
  for (const size_t plane : {size_t{0}, size_t{1}, size_t{2}}) {
    const int width = plane == 0 ? 16 : 8;
    for (int x = 0; x < 2 * width; x++) {
      EXPECT_EQ(sample<uint8_t>(both, plane, x, 3), sample<uint8_t>(x < width ? left : right, plane, x % width, 3));
    }
  }
}

// --- which tracks belong together ------------------------------------------------------------------------------------

VideoFile two_tracks(const char* first, const char* second, Extent size = {640, 480}) {
  VideoFile video;
  for (const char* name : {first, second}) {
    VideoTrack& track = video.tracks.emplace_back();
    track.id = video.tracks.size(), track.name = name, track.size = size;
  }
  return video;
}

TEST(ChoosePictures, NamesOfTracksTellTheEyes) {
  for (const auto& [first, second, left] : {std::tuple{"left", "right", 1u},
                                            {"Right eye", "Left eye", 2u},
                                            {"view_R", "view_L", 2u},
                                            {"\5links", "\6rechts", 1u}}) {
    const ChosenPictures chosen = choose_pictures(two_tracks(first, second), {}, "eyes.mkv");
    EXPECT_EQ(chosen.views, Views::kTwoTracks);
    EXPECT_EQ(chosen.track.id, left) << first;
    EXPECT_EQ(chosen.track.size.width, 1280);
    EXPECT_EQ(chosen.layout, Layout::kSideBySide);
  }
}

TEST(ChoosePictures, TheContainerTellsTheEyesBeforeNamesAndSizes) {
  VideoFile video = two_tracks("left", "right");
  video.tracks[0].eye = kRight, video.tracks[1].eye = kLeft;
  VideoTrack& larger = video.tracks.emplace_back(video.tracks[0]);
  larger.id = 3, larger.eye.reset(), larger.size = {1920, 1080};
  const ChosenPictures chosen = choose_pictures(video, {}, "eyes.mkv");
  EXPECT_EQ(chosen.views, Views::kTwoTracks);
  EXPECT_EQ(chosen.track.id, 2u);
  EXPECT_EQ(chosen.other, 1u);
}

TEST(ChoosePictures, AsksWhichTrackIsWhichEye) {
  for (const auto& [first, second] :
       {std::pair{"", ""}, {"left", "left"}, {"left and right", "right"}, {"VideoHandler", "VideoHandler"}}) {
    const VideoFile video = two_tracks(first, second);
    try {
      choose_pictures(video, {}, "eyes.mkv");
      ADD_FAILURE() << first;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("cross-eyed"), std::string::npos) << error.what();
    }
    EXPECT_EQ(choose_pictures(video, Layout::kCrossEyed, "eyes.mkv").layout, Layout::kCrossEyed);
    EXPECT_EQ(choose_pictures(video, Layout::kSideBySide, "eyes.mkv").track.id, 1u);
    EXPECT_EQ(choose_pictures(video, Layout::kSeparate, "eyes.mkv").views, Views::kFirst);
    EXPECT_THROW(choose_pictures(video, Layout::kTopBottom, "eyes.mkv"), Error);
  }
}

TEST(ChoosePictures, TheRowsOfACubeNeedNoNames) {
  const ChosenPictures chosen = choose_pictures(two_tracks("GoPro H.265", "GoPro H.265", {4096, 1344}), {}, "x.360");
  EXPECT_EQ(chosen.views, Views::kFaceRows);
  EXPECT_EQ(chosen.track.size.height, 2688);
  EXPECT_EQ(chosen.layout, Layout::kSeparate);
  EXPECT_EQ(chosen.projection, find_projection("eac")->setting);
  EXPECT_EQ(chosen.other, 2u);
  EXPECT_THROW(choose_pictures(two_tracks("", "", {5952, 1920}), {}, "max2.360"), Error);
}

}  // namespace
}  // namespace ods
