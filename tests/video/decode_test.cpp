// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos that come back as pictures.
#include "ods/video/decode.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ods/base/error.h"
#include "ods/files/read_file.h"
#include "ods/video/footage.h"
#include "ods/video/make_video.h"
#include "tests/support/decoded_video.h"
#include "tests/support/made_frames.h"
#include "tests/support/places.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

bool can_encode(VideoCodec codec, Chroma chroma) {
  for (const EncoderFacts& facts : known_encoders()) {
    if (facts.codec == codec && (chroma == Chroma::k420 || !facts.only_420) && has_encoder(facts.name)) return true;
  }
  return false;
}

Packing usual(VideoCodec codec) {
  if (codec == VideoCodec::kProRes) return {codec, 10, Chroma::k422, {}};
  return {codec, 8, Chroma::k420, {}};
}

// A channel of a pixel, 0 to 255.
double code_at(const StoredPicture& picture, size_t eye, int x, int y, size_t channel) {
  const LayerPixels& layer = picture.eyes[eye].layers[0];
  const std::byte* at = layer.first + y * layer.row_stride + x * layer.pixel_stride;
  return 255.0 * static_cast<double>(sample_value(layer.sample, at + channel * bytes_of(layer.sample)));
}

class Decode : public ::testing::Test {
 protected:
  std::string make(const std::string& name, const Packing& packing, std::optional<Layout> layout = {}) const {
    const FrameFiles files = find_frames(folder.path("a.#.png"));
    EncodeOptions options;
    options.packing = packing;
    make_video(files, plan_video(files, {}, layout), {0.0f, ToneCurve::kLinear}, options, folder.path(name));
    return folder.path(name);
  }

  // The error of opening and reading it; empty if there is none.
  std::string error_of(const std::string& path) const {
    try {
      Footage video(path, {});
      for (int i = 0; video.picture(i); i++) {
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder;
};

TEST_F(Decode, EveryContainerCodecAndLayoutComesBack) {
  made::write_frames(folder.path("a.#.png"), {1, 2, 3});
  for (Container container : kContainers) {
    for (VideoCodec codec : kVideoCodecs) {
      if (!can_hold(container, codec) || !can_encode(codec, usual(codec).chroma)) continue;
      for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
        SCOPED_TRACE(fmt::format("{} {} {}", video_codec_name(codec), container_name(container), layout_name(layout)));
        Footage video(make(fmt::format("video.{}", container_name(container)), usual(codec), layout), {});
        ASSERT_EQ(video.kind(), FootageKind::kVideo);
        EXPECT_EQ(video.stream().codec, codec);
        EXPECT_EQ(video.stream().bits, usual(codec).bits);
        EXPECT_EQ(video.stream().chroma, usual(codec).chroma);
        EXPECT_NEAR(video.stream().rate.value(), 30.0, 1e-6);
        EXPECT_EQ(video.frames(), (std::vector<int>{0, 1, 2}));
        EXPECT_EQ(video.video().prototype.layout, layout);
        for (int frame = 0; frame < 3; frame++) {
          const std::optional<StoredPicture> picture = video.picture(frame);
          ASSERT_TRUE(picture);
          ASSERT_EQ(picture->eyes.size(), 2u);
          EXPECT_EQ(picture->size.width, 128);
          for (size_t eye : {0u, 1u}) {
            for (size_t c = 0; c < 3; c++) {
              const double expected = c == 2 * eye ? made::code_of(frame + 1) : 20.0;
              EXPECT_NEAR(code_at(*picture, eye, 64, 32, c), expected, 4.0) << frame << ' ' << eye << ' ' << c;
            }
          }
        }
        EXPECT_FALSE(video.picture(3));
      }
    }
  }
}

// 32 fields of 16x16 pixels, as encode_test writes them.
TEST_F(Decode, ARampComesBack) {
  const auto color = [](int i) { return vec3(i % 4, i / 4 % 4, i / 16 * 2 + 1) * 80.0f; };
  const auto grey = [](int i) { return vec3(std::round(static_cast<float>(i) * 255.0f / 31.0f)); };
  for (const bool colored : {false, true}) {
    Image image(128, 64, 3);
    for (int y = 0; y < 64; y++) {
      for (int x = 0; x < 128; x++) {
        const int field = x / 16 + y / 16 * 8;
        const vec3 codes = (colored ? color(field) : grey(field)) / 255.0f;
        for (int c = 0; c < 3; c++) image.at(x, y)[c] = srgb_decode(codes[c]);
      }
    }
    Picture picture;
    picture.eyes.push_back({kMono, image, {}, {}, {}, {}});
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(picture, save, folder.path("a.1.png"));
    for (int bits : {8, 10}) {
      for (Chroma chroma : kChromas) {
        SCOPED_TRACE(fmt::format("{} bits, {}, {}", bits, chroma_name(chroma), colored ? "colours" : "greys"));
        if (!can_encode(VideoCodec::kH264, chroma)) continue;
        Footage video(make("ramp.mkv", {VideoCodec::kH264, bits, chroma, 4}), {});
        const std::optional<StoredPicture> back = video.picture(0);
        ASSERT_TRUE(back);
        const double maximum = colored && bits == 8 ? 2.5 : 1.5;  // 8 bits of blue are 2.1 codes apart
        for (int field = 0; field < 32; field++) {
          const vec3 expected = colored ? color(field) : grey(field);
          for (size_t c = 0; c < 3; c++) {
            EXPECT_NEAR(code_at(*back, 0, field % 8 * 16 + 8, field / 8 * 16 + 8, c),
                        static_cast<double>(expected[static_cast<int>(c)]), maximum)
                << field << ' ' << c;
          }
        }
      }
    }
  }
}

// --- numbers ---------------------------------------------------------------------------------------------------------

// A smooth picture through put_ycbcr() and back: interpolated colours follow it.
TEST(GetCodes, IsTheWayBackOfPutYcbcr) {
  const Extent size{64, 32};
  const auto value = [](int x, int y, int c) {
    return 0.5f + 0.4f * std::sin(0.07f * static_cast<float>(x + 5 * c)) * std::cos(0.09f * static_cast<float>(y - c));
  };
  for (int bits : {8, 10}) {
    for (Chroma chroma : kChromas) {
      const VideoFrame frame(size, {VideoCodec::kHevc, bits, chroma, {}});
      const auto rows = [&](int y, std::span<float> row) {
        for (int x = 0; x < 64; x++) {
          for (int c = 0; c < 3; c++) row[static_cast<size_t>(64 * c + x)] = value(x, y, c);
        }
      };
      put_ycbcr(rows, size, frame.planes());
      for (int y = 1; y < 31; y++) {  // beyond the edge nothing is known
        std::vector<float> row(3 * 50);
        get_codes(frame.planes(), size, {}, y, 7, row);
        for (int x = 7; x < 57; x++) {
          for (int c = 0; c < 3; c++) {
            ASSERT_NEAR(row[static_cast<size_t>(50 * c + x - 7)], value(x, y, c), bits == 8 ? 1.8f / 255 : 0.7f / 255)
                << bits << ' ' << chroma_name(chroma) << ' ' << x << ' ' << y << ' ' << c;
          }
        }
      }
    }
  }
}

// Numbers by the standards' own formulas, and back.
TEST(GetCodes, KnowsEveryMatrixAndRange) {
  const vec3 colors[] = {vec3(0.0f), vec3(1.0f), vec3(1.0f, 0.0f, 0.0f), vec3(0.2f, 0.9f, 0.4f),
                         vec3(0.1f, 0.3f, 1.0f)};
  const std::pair<YcbcrMatrix, vec2> kMatrices[] = {{YcbcrMatrix::k709, {0.2126f, 0.0722f}},
                                                    {YcbcrMatrix::k601, {0.299f, 0.114f}},
                                                    {YcbcrMatrix::k2020, {0.2627f, 0.0593f}}};
  for (const auto& [matrix, weights] : kMatrices) {
    for (const bool full : {false, true}) {
      for (const vec3& color : colors) {
        const float kr = weights.x, kb = weights.y;
        const float luma = kr * color.x + (1.0f - kr - kb) * color.y + kb * color.z;
        const float cb = (color.z - luma) / (2.0f - 2.0f * kb), cr = (color.x - luma) / (2.0f - 2.0f * kr);
        const float scale = full ? 1023.0f : 876.0f, chroma_scale = full ? 1023.0f : 896.0f;
        uint16_t numbers[3] = {static_cast<uint16_t>(std::lround((full ? 0.0f : 64.0f) + scale * luma)),
                               static_cast<uint16_t>(std::lround(std::min(512.0f + chroma_scale * cb, 1023.0f))),
                               static_cast<uint16_t>(std::lround(std::min(512.0f + chroma_scale * cr, 1023.0f)))};
        uint16_t back[3] = {};
        Planes planes, others;
        planes.bits = others.bits = 10;
        planes.chroma = others.chroma = Chroma::k444;
        for (size_t i = 0; i < 3; i++) {
          planes.first[i] = reinterpret_cast<std::byte*>(&numbers[i]), planes.stride[i] = 2;
          others.first[i] = reinterpret_cast<std::byte*>(&back[i]), others.stride[i] = 2;
        }
        const ColorCode code{matrix, full};
        std::vector<float> row(3);
        get_codes(planes, {1, 1}, code, 0, 0, row);
        for (int c = 0; c < 3; c++) EXPECT_NEAR(row[static_cast<size_t>(c)], color[c], 2.5e-3f) << full << c;
        put_ycbcr([&](int, std::span<float> out) { std::copy_n(&color.x, 3, out.begin()); }, {1, 1}, others, code);
        for (size_t c = 0; c < 3; c++) EXPECT_EQ(back[c], numbers[c]) << full << c;
      }
    }
  }
}

// Sensors see more than white: what the numbers can hold comes back.
TEST(GetCodes, ValuesBeyondBlackAndWhiteComeBack) {
  uint8_t numbers[3] = {245, 128, 128}, back[3] = {};
  Planes planes, others;
  planes.chroma = others.chroma = Chroma::k444;
  for (size_t i = 0; i < 3; i++) {
    planes.first[i] = reinterpret_cast<std::byte*>(&numbers[i]), planes.stride[i] = 1;
    others.first[i] = reinterpret_cast<std::byte*>(&back[i]), others.stride[i] = 1;
  }
  for (const int luma : {4, 245}) {
    numbers[0] = static_cast<uint8_t>(luma);
    const auto rows = [&](int, std::span<float> row) {
      get_codes(planes, {1, 1}, {}, 0, 0, row);
      for (float& code : row) code = video_code(video_light(code));
    };
    put_ycbcr(rows, {1, 1}, others);
    EXPECT_EQ(back[0], luma);
    EXPECT_EQ(back[1], 128);
  }
  put_ycbcr([](int, std::span<float> row) { std::fill(row.begin(), row.end(), 9.0f); }, {1, 1}, others);
  EXPECT_EQ(back[0], 255);
}

// --- what else a video says ------------------------------------------------------------------------------------------

void set_matrix(std::string& bytes, const uint32_t (&matrix)[9]) {
  const size_t at = bytes.find("tkhd") + 44;
  for (size_t i = 0; i < 36; i++) bytes[at + i] = static_cast<char>(matrix[i / 4] >> (24 - 8 * (i % 4)));
}

TEST_F(Decode, PicturesStoredUpsideDownAreTurned) {
  made::write_frames(folder.path("a.#.png"), {1, 2});
  make("video.mp4", {VideoCodec::kH264, 8, Chroma::k420, 4});
  std::string bytes = folder.read("video.mp4");
  set_matrix(bytes, {0xffff0000, 0, 0, 0, 0xffff0000, 0, 0, 0, 0x40000000});
  folder.write("turned.mp4", bytes);
  VideoDecoder plain(folder.path("video.mp4"), 1), turned(folder.path("turned.mp4"), 1);
  EXPECT_FALSE(plain.stream().is_upside_down);
  ASSERT_TRUE(turned.stream().is_upside_down);
  const DecodedFrame a = *plain.next(), b = *turned.next();
  const Extent size = plain.stream().size, block = chroma_block(Chroma::k420);
  for (size_t plane = 0; plane < 3; plane++) {
    const int width = size.width / (plane ? block.width : 1), height = size.height / (plane ? block.height : 1);
    for (int y = 0; y < height; y++) {
      for (int x = 1; x < width; x++) {  // at the edge chroma has one neighbour
        const auto at = [&](const DecodedFrame& frame, int column, int row) {
          const size_t place = static_cast<size_t>(row) * frame.planes.stride[plane] + static_cast<size_t>(column);
          return static_cast<int>(frame.planes.first[plane][place]);
        };
        const int there = at(a, width - 1 - x, height - 1 - y);
        const int expected = plane == 0 ? there : (there + at(a, width - x, height - 1 - y) + 1) / 2;
        ASSERT_EQ(at(b, x, y), expected) << plane << ' ' << x << ' ' << y;
      }
    }
  }
}

// --- eyes that are layers --------------------------------------------------------------------------------------------

// The views of two flat lenses, 63.4 degrees across, three pictures of 256x192: encoded by x265 4.1 (built with
// multiview), in a mov with lhvC, vexu and hfov, as phones write them.
const std::string kLayers = source_folder() + "/tests/video/layers.mov";

std::string bytes_of_layers() {
  const std::vector<uint8_t> bytes = read_file(kLayers, 1 << 20);
  return {bytes.begin(), bytes.end()};
}

int luma_at(const DecodedFrame& frame, int x, int y) {
  return static_cast<int>(
      frame.planes.first[0][static_cast<size_t>(y) * frame.planes.stride[0] + static_cast<size_t>(x)]);
}

TEST_F(Decode, EveryMachineReadsTheFirstLayer) {
  FormatHint alone;
  alone.layout = Layout::kSeparate;
  const VideoInput video = open_video(kLayers, alone);
  EXPECT_EQ(video.prototype.eyes.size(), 1u);
  EXPECT_EQ(video.prototype.size.width, 256);
  EXPECT_EQ(projection_name(video.prototype.camera.projection), "perspective");
  EXPECT_NEAR(video.prototype.camera.projection.fov, 63.4f, 0.001f);
  VideoDecoder decoder(kLayers, video.track, video.views);
  int count = 0;
  for (; const auto frame = decoder.next(); count++) EXPECT_GT(luma_at(*frame, 128, 96), 16);
  EXPECT_EQ(count, 3);
  EXPECT_EQ(decoder.stream().size.width, 256);
}

TEST_F(Decode, LayersBecomeSideBySide) {
  if (!can_decode_both_views()) GTEST_SKIP() << "skipped: this FFmpeg is older than 7.1";
  const VideoInput video = open_video(kLayers);
  EXPECT_EQ(video.prototype.layout, Layout::kSideBySide);
  EXPECT_EQ(video.prototype.size.width, 256);
  EXPECT_NEAR(video.prototype.camera.ipd, 0.01924f, 1e-6f);
  EXPECT_NEAR(video.prototype.camera.projection.fov, 63.4f, 0.001f);
  std::string bytes = bytes_of_layers();
  set_matrix(bytes, {0xffff0000, 0, 0, 0, 0xffff0000, 0, 0, 0, 0x40000000});
  folder.write("turned.mov", bytes);
  VideoDecoder first(kLayers, video.track), both(kLayers, video.track, video.views);
  VideoDecoder turned(folder.path("turned.mov"), video.track, video.views);
  EXPECT_EQ(both.stream().size.width, 512);
  for (int i = 0; i < 3; i++) {
    const std::optional<DecodedFrame> one = first.next(), two = both.next(), upside_down = turned.next();
    ASSERT_TRUE(one && two && upside_down);
    EXPECT_EQ(two->time.start, one->time.start);
    int differing = 0;
    for (int y = 0; y < 192; y++) {
      for (int x = 0; x < 256; x++) {
        ASSERT_EQ(luma_at(*two, x, y), luma_at(*one, x, y));
        ASSERT_EQ(luma_at(*upside_down, x, y), luma_at(*two, 255 - x, 191 - y));
        differing += std::abs(luma_at(*two, 256 + x, y) - luma_at(*two, x, y)) > 8;
      }
    }
    EXPECT_GT(differing, 1000) << "the right eye is another one";
  }
  EXPECT_FALSE(both.next());
  both.skip_to(1.7 / 30.0);
  EXPECT_EQ(both.next()->time.start, 2);
}

// The stream itself assigns the views to the eyes: three-dimensional reference displays (ITU-T H.265, G.14.2.3),
// message 176. If it does not, vexu does.
TEST_F(Decode, TheStreamSaysWhichLayerIsTheLeftEye) {
  if (!can_decode_both_views()) GTEST_SKIP() << "skipped: this FFmpeg is older than 7.1";
  const auto changed = [&](const std::string& name, size_t at, std::string_view to) {
    std::string bytes = bytes_of_layers();
    const size_t message = bytes.find("\x4e\x01\xb0\x04\x04\x0d");
    folder.write(name, bytes.replace(message + at, to.size(), to));
    return folder.path(name);
  };
  const std::string right_first = changed("right.mov", 5, "\x0a\x80"), silent = changed("silent.mov", 2, "\xfe");
  const auto is_swapped = [](const std::string& path, Views views) {
    VideoDecoder plain(kLayers, 1), both(path, 1, views);
    const DecodedFrame one = *plain.next(), two = *both.next();
    const auto has_first = [&](int left) {
      for (int x = 0; x < 256; x++) {
        if (luma_at(two, left + x, 100) != luma_at(one, x, 100)) return false;
      }
      return true;
    };
    EXPECT_NE(has_first(0), has_first(256));
    return has_first(256);
  };
  EXPECT_FALSE(is_swapped(kLayers, Views::kLeftAndRight));
  EXPECT_FALSE(is_swapped(kLayers, Views::kRightAndLeft));
  EXPECT_TRUE(is_swapped(right_first, Views::kLeftAndRight));
  EXPECT_FALSE(is_swapped(silent, Views::kLeftAndRight));
  EXPECT_TRUE(is_swapped(silent, Views::kRightAndLeft));
}

// --- bad input -------------------------------------------------------------------------------------------------------

void expect_refused(const std::string& error, const std::string& words) {
  EXPECT_NE(error.find(words), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

TEST_F(Decode, PicturesTurnedByAQuarterAreRefused) {
  made::write_frames(folder.path("a.#.png"), {1, 2});
  make("video.mp4", usual(VideoCodec::kH264));
  std::string bytes = folder.read("video.mp4");
  set_matrix(bytes, {0, 0x10000, 0, 0xffff0000, 0, 0, 0, 0, 0x40000000});
  folder.write("turned.mp4", bytes);
  expect_refused(error_of(folder.path("turned.mp4")), "stored rotated");
}

TEST_F(Decode, InterlacedPicturesAreRefused) {
  if (const std::string why = missing("ffmpeg", "ffmpeg -version"); !why.empty()) GTEST_SKIP() << why;
  const std::string path = folder.path("fields.mp4");
  ASSERT_EQ(run_line("ffmpeg -v error -f lavfi -i testsrc=s=128x64 -frames:v 4 -c:v libx264 -flags +ildct+ilme "
                     "-x264opts tff=1 -pix_fmt yuv420p " +
                     path)
                .code,
            0);
  expect_refused(error_of(path), "interlaced");
}

TEST_F(Decode, TheStreamsFramePackingIsKnown) {
  if (const std::string why = missing("ffmpeg", "ffmpeg -version"); !why.empty()) GTEST_SKIP() << why;
  const std::pair<int, VideoStereo> kinds[] = {
      {1, VideoStereo::kColumns}, {2, VideoStereo::kRows}, {3, VideoStereo::kSideBySide}, {4, VideoStereo::kTopBottom}};
  for (const auto& [number, stereo] : kinds) {
    const std::string path = folder.path("packed.mp4");
    ASSERT_EQ(run_line(fmt::format("ffmpeg -y -v error -f lavfi -i testsrc=s=128x64 -frames:v 2 -c:v libx264 "
                                   "-x264opts frame-packing={} -pix_fmt yuv420p {}",
                                   number, path))
                  .code,
              0);
    VideoDecoder decoder(path, 1);
    EXPECT_EQ(decoder.next()->packing, stereo) << number;
  }
}

TEST_F(Decode, DamagedVideosAreOneLine) {
  made::write_frames(folder.path("a.#.png"), {1, 2, 3, 4});
  for (const char* name : {"video.mp4", "video.mkv"}) {
    const std::string path = make(name, usual(VideoCodec::kH264));
    const std::string whole = folder.read(name);
    folder.write(name, whole.substr(0, whole.size() / 2));
    expect_refused(error_of(path), name);
    std::string broken = whole;
    const size_t samples = whole.find(std::string_view(name).ends_with("mp4") ? "mdat" : "\x1f\x43\xb6\x75");
    ASSERT_NE(samples, std::string::npos);
    for (size_t i = samples + 40; i < broken.size() && i < samples + 3000; i += 3)
      broken[i] = static_cast<char>(i * 77);
    folder.write(name, broken);
    const std::string error = error_of(path);  // what the decoder mends need not be said
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  folder.write("video.mp4", "no video at all");
  EXPECT_NE(error_of(folder.path("video.mp4")), "");
}

TEST_F(Decode, UnevenTimesAreTheFilesOwn) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  // Four are left out. (Where FFmpeg's setpts moves times, its version 7 writes files without durations, and itself
  // does not show their last picture.)
  made::write_frames(folder.path("a.#.png"), {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  const std::string video = make("video.mp4", usual(VideoCodec::kH264)), uneven = folder.path("uneven_360_TB.mp4");
  const std::string command = "ffmpeg -v error -i " + video +
                              " -vf 'select=not(between(n\\,3\\,6))' -vsync vfr -c:v libx264 " + uneven + " 2>&1";
  if (!output_of(command).empty()) GTEST_SKIP() << "skipped: this ffmpeg makes no uneven video";
  VideoDecoder decoder(uneven, 1);
  const double tick = 1.0 / decoder.stream().clock.value();
  for (int i = 0; i < 6; i++) {
    const std::optional<DecodedFrame> frame = decoder.next();
    ASSERT_TRUE(frame);
    EXPECT_NEAR(static_cast<double>(frame->time.start) * tick, (i + (i >= 3 ? 4 : 0)) / 30.0, 1e-6) << i;
    if (i != 2) {
      EXPECT_NEAR(static_cast<double>(frame->time.duration) * tick, 1.0 / 30.0, 1e-6) << i;
    }
  }
  EXPECT_FALSE(decoder.next());
}

TEST_F(Decode, SkippingEndsAtTheFirstPictureAtOrAfterTheTime) {
  made::write_frames(folder.path("a.#.png"), {1, 2, 3, 4, 5, 6, 7, 8});
  for (const char* name : {"video.mp4", "video.mkv"}) {
    const std::string video = make(name, usual(VideoCodec::kH264));
    for (const int frame : {0, 3, 7}) {
      for (const double later : {0.0, -0.4}) {  // of a frame
        Footage footage(video, {});
        footage.choose({std::max(0.0, (frame + later) / 30.0), {}});
        const std::optional<DecodedFrame> next = footage.next();
        ASSERT_TRUE(next) << frame;
        EXPECT_NEAR(static_cast<double>(next->time.start) / footage.stream().clock.value(), frame / 30.0, 0.001)
            << name;
        EXPECT_EQ(footage.next().has_value(), frame < 7);
      }
    }
    Footage footage(video, {});
    footage.choose({9.0, {}});
    EXPECT_FALSE(footage.next());
  }
}

// Their numbers mean other light than BT.709's: as pictures, or under a title, they would be wrong.
TEST_F(Decode, HdrIsRefused) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  if (!can_encode(VideoCodec::kHevc, Chroma::k420)) GTEST_SKIP() << "skipped: this machine encodes no HEVC";
  made::write_frames(folder.path("a.#.png"), {1, 2});
  const std::string video = make("video.mkv", usual(VideoCodec::kHevc)), hdr = folder.path("hdr.mkv");
  EXPECT_EQ(error_of(video), "");
  const char* const kCurves[][2] = {{"16", "smpte2084"}, {"18", "arib-std-b67"}};  // PQ and HLG
  for (const auto& [number, name] : kCurves) {
    const std::string command =
        "ffmpeg -y -v error -i " + video + " -c copy -bsf:v hevc_metadata=transfer_characteristics=";
    ASSERT_EQ(output_of(command + number + " " + hdr + " 2>&1"), "");
    EXPECT_EQ(error_of(hdr), fmt::format("cannot use '{}': it is HDR; only ods convert, from video to video, supports "
                                         "other colours than BT.709's",
                                         hdr))
        << name;
  }
}

}  // namespace
}  // namespace ods
