// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Titles over videos.
#include "ods/compose/over_video.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

#include "ods/base/error.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/video/make_video.h"
#include "tests/support/decoded_video.h"
#include "tests/support/made_frames.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

constexpr Extent kEye{128, 64};

// White, opaque in the middle of the picture and half so around that.
float alpha_at(int x, int y) {
  const int dx = std::abs(2 * x + 1 - kEye.width), dy = std::abs(2 * y + 1 - kEye.height);
  return dx < 32 && dy < 16 ? 1.0f : dx < 64 && dy < 32 ? 0.5f : 0.0f;
}

void write_title(const std::string& path, const StereoCamera& camera = {}) {
  Picture picture;
  for (int eye : {kLeft, kRight}) {
    EyeImage& image = picture.eyes.emplace_back(
        EyeImage{eye, Image(kEye.width, kEye.height, 3), {}, {}, {}, Image(kEye.width, kEye.height, 1)});
    for (int y = 0; y < kEye.height; y++) {
      for (int x = 0; x < kEye.width; x++) {
        *image.alpha.at(x, y) = alpha_at(x, y);
        for (int c = 0; c < 3; c++) image.radiance.at(x, y)[c] = alpha_at(x, y);
      }
    }
  }
  save_picture(picture, camera, SaveOptions(), path);
}

class VideoOver : public ::testing::Test {
 protected:
  // Six frames with sound.
  std::string make_video_file(const std::string& name, const Packing& packing,
                              Layout layout = Layout::kTopBottom) const {
    made::write_frames(folder.path("a.#.png"), {1, 2, 3, 4, 5, 6}, Layout::kTopBottom, kEye);
    folder.write("sound.wav", made::wav(2, 0.2));
    const FrameFiles files = find_frames(folder.path("a.#.png"));
    EncodeOptions options;
    options.packing = packing;
    options.sound = folder.path("sound.wav");
    make_video(files, plan_video(files, {}, layout), {0.0f, ToneCurve::kLinear}, options, folder.path(name));
    return folder.path(name);
  }

  // Lays the title over all of it, encoded as it is.
  std::string lay(const std::string& video, const std::string& front, const std::string& name, int first = 0,
                  int last = INT_MAX) const {
    Footage back(video, {}), before(front, {});
    EncodeOptions options;
    options.packing = *packing_like(back.stream(), *container_of_path(name));
    options.rate = back.stream().rate;
    options.keep.path = video;
    options.keep.track = back.video().track;
    options.keep.cut = {back.stream().start + first / options.rate.value(), INFINITY, first > 0 || last < INT_MAX};
    over_video(back, before, first, last, {}, options, folder.path(name));
    return folder.path(name);
  }

  TemporaryFolder folder;
};

double code_at(const StoredPicture& picture, size_t eye, int x, int y, size_t channel) {
  const LayerPixels& layer = picture.eyes[eye].layers[0];
  const std::byte* at = layer.first + y * layer.row_stride + x * layer.pixel_stride;
  return 255.0 * static_cast<double>(sample_value(layer.sample, at + channel * bytes_of(layer.sample)));
}

// Packet by packet: when it begins, how long it is, what its bytes are.
std::string packets_of_sound(const std::string& video) {
  return output_of("ffmpeg -v error -i " + video + " -map 0:a:0 -c copy -f framehash - | grep -v '^#'");
}

TEST_F(VideoOver, EveryContainerKeepsWhatIsNotCovered) {
  write_title(folder.path("title.exr"));
  const std::pair<const char*, VideoCodec> kVideos[] = {
      {"mp4", VideoCodec::kH264}, {"mov", VideoCodec::kProRes}, {"mkv", VideoCodec::kHevc}, {"webm", VideoCodec::kVp9}};
  for (const auto& [container, codec] : kVideos) {
    SCOPED_TRACE(container);
    Packing packing{codec, 8, Chroma::k420, {}};
    if (codec == VideoCodec::kProRes) packing = {codec, 10, Chroma::k422, {}};
    bool is_there = false;
    for (const EncoderFacts& facts : known_encoders()) is_there |= facts.codec == codec && has_encoder(facts.name);
    if (!is_there) continue;
    const Layout layout = codec == VideoCodec::kHevc ? Layout::kSideBySide : Layout::kTopBottom;
    const std::string video = make_video_file(fmt::format("video.{}", container), packing, layout);
    const std::string titled = lay(video, folder.path("title.exr"), fmt::format("titled.{}", container));

    const VideoFile before = read_video_file(video), after = read_video_file(titled);
    EXPECT_EQ(after.tracks.at(0).v1, before.tracks.at(0).v1);
    EXPECT_EQ(after.tracks.at(0).v2, before.tracks.at(0).v2);
    EXPECT_EQ(after.tracks[0].codec, before.tracks[0].codec);
    ASSERT_EQ(after.sound.size(), 1u);
    EXPECT_EQ(after.sound[0].codec, before.sound.at(0).codec);
    if (is_installed("ffmpeg")) {
      EXPECT_GT(packets_of_sound(video).size(), 200u);
      EXPECT_EQ(packets_of_sound(titled), packets_of_sound(video));
    }

    Footage one(video, {}), other(titled, {});
    EXPECT_EQ(other.stream().rate.count, one.stream().rate.count);
    for (int frame = 0; frame < 6; frame++) {
      const std::optional<StoredPicture> plain = one.picture(frame), covered = other.picture(frame);
      ASSERT_TRUE(plain && covered);
      for (size_t eye : {0u, 1u}) {
        for (int y = 2; y < kEye.height; y += 4) {
          for (int x = 2; x < kEye.width; x += 4) {
            const float alpha = alpha_at(x, y);
            for (size_t c = 0; c < 3; c++) {
              const float back = static_cast<float>(code_at(*plain, eye, x, y, c)) / 255.0f;
              const float light = alpha + srgb_decode(back) * (1.0f - alpha);
              const double expected = 255.0 * static_cast<double>(srgb_encode(light));
              ASSERT_NEAR(code_at(*covered, eye, x, y, c), expected, alpha == 0.0f ? 8.0 : 16.0)
                  << frame << ' ' << eye << ' ' << x << ' ' << y << ' ' << c;
            }
          }
        }
      }
    }
    EXPECT_FALSE(other.picture(6));
  }
}

TEST_F(VideoOver, APartHasItsOwnSound) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  write_title(folder.path("title.exr"));
  const std::string video = make_video_file("video.mkv", {VideoCodec::kH264, 8, Chroma::k420, {}});
  const std::string part = lay(video, folder.path("title.exr"), "part.mkv", 2, 4);
  EXPECT_EQ(Footage(part, {}).frames().size(), 3u);
  const std::string all = packets_of_sound(video), some = packets_of_sound(part);
  const auto hashes = [](const std::string& text) {
    std::vector<std::string> result;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) result.push_back(line.substr(line.rfind(',') + 1));
    return result;
  };
  const std::vector<std::string> whole = hashes(all), cut = hashes(some);
  ASSERT_GE(cut.size(), 4u);  // of 20 ms each, in 100 ms
  ASSERT_LE(cut.size(), 6u);
  const auto found = std::find(whole.begin(), whole.end(), cut[0]);
  ASSERT_LE(static_cast<size_t>(found - whole.begin()) + cut.size(), whole.size());
  EXPECT_TRUE(std::equal(cut.begin(), cut.end(), found));
}

TEST_F(VideoOver, FramesGoOverTheirPicturesAlone) {
  write_title(folder.path("title.0003.exr"));
  const std::string video = make_video_file("video.mp4", {VideoCodec::kH264, 8, Chroma::k420, {}});
  Footage titled(lay(video, folder.path("title.####.exr"), "titled.mp4"), {});
  for (int frame = 0; frame < 6; frame++) {
    const double green = code_at(*titled.picture(frame), 0, 64, 32, 1);
    EXPECT_NEAR(green, frame == 3 ? 255.0 : 20.0, 8.0) << frame;
  }
}

// The metadata of the video's vexu, else of its sidecar.
TEST_F(VideoOver, ATitleForOtherEyesIsReported) {
  const std::string video = make_video_file("video.mp4", {});
  StereoCamera camera;
  camera.ipd = 0.07f;
  write_title(folder.path("title.exr"), camera);
  const StoredPicture title = open_picture(folder.path("title.exr"));
  const auto warning = [&] {
    std::string all;
    for (const std::string& each : over_warnings(title, open_video(video).prototype)) all += each;
    return all;
  };
  Sidecar sidecar;
  sidecar.camera.ipd = 0.05f;
  save_sidecar(sidecar, folder.path("video.camera.json"));
  EXPECT_NE(warning().find("for eyes 70 mm apart, the background for 50: make it with `ipd` 0.05"), std::string::npos)
      << warning();
  SphericalMetadata metadata = open_video(video).metadata;
  metadata.for_apple = true;
  for (const double ipd : {0.06, 0.07}) {
    metadata.ipd = ipd;
    tag_video(video, video, 1, metadata);
    EXPECT_EQ(open_video(video).prototype.has_ipd, true);
    EXPECT_EQ(
        warning().find("for eyes 70 mm apart, the background for 60: make it with `ipd` 0.06") != std::string::npos,
        ipd == 0.06)
        << warning();
    EXPECT_EQ(warning().empty(), ipd == 0.07) << warning();
  }
}

TEST_F(VideoOver, WhatCannotBeCompositedIsReported) {
  StereoCamera other;
  other.ipd = 0.1f;
  write_title(folder.path("title.exr"), other);
  const std::string video = make_video_file("video.mp4", {VideoCodec::kH264, 8, Chroma::k420, {}});
  EXPECT_THROW(lay(video, video, "titled.mp4"), Error);                            // no alpha
  EXPECT_THROW(lay(video, folder.path("title.exr"), "titled.mp4", 9, 12), Error);  // behind its end
  const std::vector<std::string> names = folder.names();
  EXPECT_EQ(std::count(names.begin(), names.end(), "titled.mp4"), 0);
  Footage back(video, {});
  EXPECT_EQ(over_warnings(open_picture(folder.path("title.exr")), back.video().prototype).size(), 0u)
      << "the video does not say what eyes it is for";
}

// --- without a codec -------------------------------------------------------------------------------------------------

struct Bench {
  VideoInput video;
  VideoStream stream;
  std::shared_ptr<VideoFrame> memory;
  DecodedFrame frame;

  Bench(int bits, Chroma chroma, ColorCode color) {
    video.prototype.size = kEye;
    video.prototype.layout = Layout::kTopBottom;
    video.prototype.eyes.resize(2);
    video.prototype.eyes[0].eye = kLeft, video.prototype.eyes[1].eye = kRight;
    stream.size = {kEye.width, 2 * kEye.height};
    stream.bits = bits, stream.chroma = chroma, stream.color = color;
    memory = std::make_shared<VideoFrame>(stream.size, Packing{VideoCodec::kHevc, bits, chroma, {}});
    frame.planes = memory->planes();
    std::minstd_rand random(7);
    for (size_t i = 0; i < 3; i++) {
      for (int y = 0; y < rows(i); y++) {
        for (int x = 0; x < columns(i); x++) set(i, x, y, (60 + static_cast<int>(random() % 100)) << (bits - 8));
      }
    }
  }

  int columns(size_t i) const { return stream.size.width / (i == 0 ? 1 : chroma_block(stream.chroma).width); }
  int rows(size_t i) const { return stream.size.height / (i == 0 ? 1 : chroma_block(stream.chroma).height); }
  void set(size_t i, int x, int y, int value) {
    std::byte* row = frame.planes.first[i] + static_cast<size_t>(y) * frame.planes.stride[i];
    if (stream.bits == 8) {
      row[x] = static_cast<std::byte>(value);
    } else {
      reinterpret_cast<uint16_t*>(row)[x] = static_cast<uint16_t>(value);
    }
  }
  static int get(const Planes& planes, size_t i, int x, int y) {
    const std::byte* row = planes.first[i] + static_cast<size_t>(y) * planes.stride[i];
    return planes.bits == 8 ? static_cast<int>(row[x]) : reinterpret_cast<const uint16_t*>(row)[x];
  }
};

TEST(LayCover, LeavesNumbersThatItDoesNotCover) {
  const TemporaryFolder folder;
  write_title(folder.path("title.exr"));
  const StoredPicture title = open_picture(folder.path("title.exr"));
  for (int bits : {8, 10}) {
    for (Chroma chroma : kChromas) {
      const Bench bench(bits, chroma, {});
      const Packing packing{VideoCodec::kHevc, bits, chroma, {}};
      const auto to = copied_frame(bench.frame, bench.stream, bench.video, packing);
      lay_cover(make_cover(title, bench.video.prototype, {}), bench.video.prototype, {}, bench.frame.planes,
                to->planes());
      const Extent block = chroma_block(chroma);
      for (size_t i = 0; i < 3; i++) {
        for (int y = 0; y < bench.rows(i); y++) {
          for (int x = 0; x < bench.columns(i); x++) {
            // The alphas of the pixels that count.
            float minimum = 1.0f, maximum = 0.0f;
            const int width = i == 0 ? 1 : block.width, height = i == 0 ? 1 : block.height;
            for (int py = y * height; py < (y + 1) * height; py++) {
              for (int px = std::max(0, x * width - (width == 2)); px < (x + 1) * width; px++) {
                const float alpha = alpha_at(px, py % kEye.height);
                minimum = std::min(minimum, alpha), maximum = std::max(maximum, alpha);
              }
            }
            const int before = Bench::get(bench.frame.planes, i, x, y), after = Bench::get(to->planes(), i, x, y);
            const int white = (i == 0 ? 235 : 128) << (bits - 8);
            if (maximum == 0.0f || minimum == 1.0f) {
              ASSERT_EQ(after, maximum == 0.0f ? before : white)
                  << bits << chroma_name(chroma) << i << ' ' << x << ' ' << y;
            }
          }
        }
      }
    }
  }
}

TEST(LayCover, OtherCodesBecomeBt709) {
  for (const ColorCode color :
       {ColorCode{YcbcrMatrix::k601, false}, ColorCode{YcbcrMatrix::k709, true}, ColorCode{YcbcrMatrix::k601, true}}) {
    Bench bench(8, Chroma::k444, color);
    for (size_t i = 0; i < 3; i++) {
      for (int y = 0; y < bench.rows(i); y++) {
        for (int x = 0; x < bench.columns(i); x++) bench.set(i, x, y, i == 0 ? 110 + x / 4 : 118 + (y + x * 3) % 20);
      }
    }
    const auto to = copied_frame(bench.frame, bench.stream, bench.video, {VideoCodec::kHevc, 10, Chroma::k444, {}});
    for (int y = 0; y < bench.rows(0); y += 5) {
      std::vector<float> before(3 * kEye.width), after(before);
      get_codes(bench.frame.planes, bench.stream.size, color, y, 0, before);
      get_codes(to->planes(), bench.stream.size, {}, y, 0, after);
      for (size_t x = 0; x < before.size(); x++) ASSERT_NEAR(after[x], before[x], 1.0f / 255.0f) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace ods
