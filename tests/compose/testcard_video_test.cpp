// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The stress video for players.
#include "ods/compose/testcard_video.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "ods/camera/sizes.h"
#include "ods/video/footage.h"
#include "ods/video/tracks/sound.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

const Packing kPlain{VideoCodec::kH264, 8, Chroma::k420, {}};

TestcardVideo make(const StereoCamera& camera, const VideoPlan& plan, double fps = 30.0) {
  const std::vector<int> eyes = plan.eyes == 2 ? std::vector<int>{kLeft, kRight} : std::vector<int>{kMono};
  const FrameRate rate{static_cast<int>(std::lround(fps * 1000)), 1000};
  return make_testcard_video(make_testcard(camera, plan.eye, {"TEST"}), camera, eyes, plan, rate, kPlain);
}

int luma(const Planes& planes, int x, int y) {
  return static_cast<int>(planes.first[0][static_cast<size_t>(y) * planes.stride[0] + static_cast<size_t>(x)]);
}

// The number of differing values in an eye's half of the frame.
int differences(const VideoFrame& a, const VideoFrame& b, Extent from, Extent size) {
  int count = 0;
  for (int y = from.height; y < from.height + size.height; y++) {
    for (int x = from.width; x < from.width + size.width; x++)
      count += luma(a.planes(), x, y) != luma(b.planes(), x, y);
  }
  return count;
}

// Marks drawn over the still card give the same pixels as a card drawn at once.
TEST(TestcardVideo, AFrameIsTheWholeCardOfItsMoment) {
  const std::pair<const char*, Layout> kForms[] = {{"lat-long", Layout::kTopBottom},
                                                   {"vr180", Layout::kSideBySide},
                                                   {"cube-3x2", Layout::kBottomTop},
                                                   {"fisheye", Layout::kCrossEyed}};
  for (const auto& [name, layout] : kForms) {
    SCOPED_TRACE(name);
    StereoCamera camera;
    camera.projection = find_projection(name)->setting;
    const Extent eye{192, static_cast<int>(natural_height(camera.projection, 192)) / 2 * 2};
    const VideoPlan plan = plan_eyes(eye, 2, layout, camera.projection);
    const TestcardVideo video = make(camera, plan);
    for (const int number : {0, 17}) {
      const auto frame = testcard_frame(video, number);
      Testcard whole = video.card;
      for (Card& mark : testcard_marks(camera, eye, number, 30.0)) whole.cards.push_back(std::move(mark));
      int changed = 0;
      for (size_t i = 0; i < 2; i++) {
        const EyeCorner corner = eye_corner(layout, eye, static_cast<int>(i));
        for (int y = 0; y < eye.height; y++) {
          std::vector<float> row(3 * static_cast<size_t>(eye.width));
          fill_testcard_row(whole, video.prototype.eyes[i].eye, y, row);
          for (int x = 0; x < eye.width; x++) {
            const float* c = &row[3 * static_cast<size_t>(x)];
            const float bright = 0.2126f * video_code(c[0]) + 0.7152f * video_code(c[1]) + 0.0722f * video_code(c[2]);
            const int expected = static_cast<int>(16.5f + 219.0f * bright);
            ASSERT_NEAR(luma(frame->planes(), corner.x + x, corner.y + y), expected, 1) << x << ' ' << y;
            changed += luma(video.still->planes(), corner.x + x, corner.y + y) != expected;
          }
        }
      }
      EXPECT_GT(changed, 100);
    }
  }
}

TEST(TestcardVideo, EveryFrameIsAnother) {
  const VideoPlan plan = plan_eyes({512, 256}, 2, Layout::kTopBottom, {});
  const TestcardVideo video = make({}, plan);
  std::shared_ptr<VideoFrame> last = testcard_frame(video, 0);
  for (int number = 1; number < 40; number++) {
    const auto next = testcard_frame(video, number);
    for (const Extent eye : {Extent{0, 0}, Extent{0, 256}}) {
      EXPECT_GT(differences(*last, *next, eye, {512, 256}), 50) << number;
    }
    last = next;
  }
}

// Cell by cell, and white where the second begins; also where frames are no whole part of it.
TEST(TestcardVideo, MarksTellTheMoment) {
  for (const double fps : {24.0, 30000.0 / 1001.0, 60.0, 90.0, 12.5}) {
    SCOPED_TRACE(fps);
    const auto card_of = [&](int frame, CardPattern pattern, bool many) {
      for (const Card& card : testcard_marks({}, {512, 256}, frame, fps)) {
        if (card.pattern == pattern && (card.count > 1) == many) return card;
      }
      return Card();
    };
    const int count = card_of(0, CardPattern::kCells, true).count;
    EXPECT_EQ(count, std::min(60, static_cast<int>(std::ceil(fps))));
    for (int second : {0, 1, 2, 1000}) {
      const int first = first_frame_of(second, fps);
      EXPECT_GE(first / fps, second - 1e-6);
      EXPECT_LT((first - 1) / fps, second);
      EXPECT_EQ(card_of(first, CardPattern::kCells, true).lit, 0);
      if (first > 0) {
        EXPECT_GE(card_of(first - 1, CardPattern::kCells, true).lit, count - 2);
      }
      EXPECT_EQ(card_of(first, CardPattern::kCells, false).lit, 0);
      EXPECT_EQ(card_of(first + flash_frames(fps), CardPattern::kCells, false).lit, -1);
      const float phase = card_of(first, CardPattern::kSweep, false).phase;
      EXPECT_LT(std::min(phase, 1.0f - phase), 1.01 / fps);
    }
  }
}

TEST(TestcardVideo, BeepsBeginWithTheFlash) {
  const double fps = 30000.0 / 1001.0;
  const std::string wav = testcard_sound(75, fps);
  ASSERT_GT(wav.size(), 44u);
  std::vector<int16_t> samples((wav.size() - 44) / 2);
  std::memcpy(samples.data(), wav.data() + 44, 2 * samples.size());
  EXPECT_NEAR(static_cast<double>(samples.size()), 75 / fps * 48000, 1.0);
  const auto loudest = [&](double from, double to) {
    int maximum = 0;
    for (auto i = static_cast<size_t>(from * 48000); i < std::min(samples.size(), static_cast<size_t>(to * 48000));
         i++) {
      maximum = std::max(maximum, std::abs(static_cast<int>(samples[i])));
    }
    return maximum;
  };
  for (int second : {0, 1, 2}) {
    const double start = first_frame_of(second, fps) / fps, end = start + flash_frames(fps) / fps;
    EXPECT_GT(loudest(start, start + 0.005), 8000);
    EXPECT_GT(loudest(end - 0.005, end), 8000);
    EXPECT_EQ(loudest(end + 0.001, start + 0.95), 0);
  }
}

TEST(TestcardVideo, IsWhatItSays) {
  const TemporaryFolder folder;
  const VideoPlan plan = plan_eyes({256, 128}, 2, Layout::kTopBottom, {});
  const TestcardVideo video = make({}, plan);
  EncodeOptions options;
  options.packing = kPlain;
  write_testcard_video(video, plan, 36, options, folder.path("card.mp4"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"card.mp4"});  // no sound is left beside it
  const VideoFile info = read_video_file(folder.path("card.mp4"));
  EXPECT_EQ(metadata_text(*info.tracks.at(0).v2), "top-bottom, lat-long");
  ASSERT_EQ(info.sound.size(), 1u);
  EXPECT_NEAR(read_sound_info(folder.path("card.mp4")).seconds, 1.2, 0.05);
  Footage back(folder.path("card.mp4"), {});
  EXPECT_EQ(back.frames().size(), 36u);
  for (const int number : {0, 31}) {
    const auto expected = testcard_frame(video, number);
    const std::optional<DecodedFrame> decoded = back.decode(number);
    ASSERT_TRUE(decoded);
    double sum = 0.0;
    for (int y = 0; y < 256; y++) {
      for (int x = 0; x < 256; x++) sum += std::abs(luma(decoded->planes, x, y) - luma(expected->planes(), x, y));
    }
    EXPECT_LT(sum / (256 * 256), 3.0) << number;
  }
}

TEST(TestcardVideo, EveryNamedSizeIsAVideo) {
  for (const NamedSize& size : named_sizes()) {
    SCOPED_TRACE(size.name);
    const Layout layout = size.layout.value_or(Layout::kTopBottom);
    const size_t eyes = size.layout ? 2 : 1;
    const Extent eye = squeezed_eye(layout, size.eye, static_cast<int>(eyes));
    const VideoPlan plan = plan_eyes(eye, eyes, layout, {});
    EXPECT_NO_THROW(check_packing(plan, kPlain));
  }
}

}  // namespace
}  // namespace ods
