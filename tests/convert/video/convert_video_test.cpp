// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos that become other videos.
#include "ods/convert/video/convert_video.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ods/base/error.h"
#include "ods/convert/video/shifted_frame.h"
#include "ods/video/make_video.h"
#include "tests/support/decoded_video.h"
#include "tests/support/made_frames.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// The bytes of a frame's plane, row by row, without padding.
std::string bytes_of_plane(const Planes& planes, Extent size, size_t plane) {
  const Extent block = plane == 0 ? Extent{1, 1} : chroma_block(planes.chroma);
  const size_t row = static_cast<size_t>(size.width / block.width) * (planes.bits > 8 ? 2 : 1);
  std::string bytes;
  for (int y = 0; y < size.height / block.height; y++) {
    bytes.append(reinterpret_cast<const char*>(planes.first[plane] + static_cast<size_t>(y) * planes.stride[plane]),
                 row);
  }
  return bytes;
}

std::string bytes_of(const Planes& planes, Extent size) {
  return bytes_of_plane(planes, size, 0) + bytes_of_plane(planes, size, 1) + bytes_of_plane(planes, size, 2);
}

// Waves of every colour within what sRGB can show, which move.
void write_waves(const std::string& pattern, int frames, Extent eye) {
  for (int frame = 1; frame <= frames; frame++) {
    PictureRows rows;
    rows.eye = eye;
    rows.eyes = {kLeft, kRight};
    rows.layers = {{{"R", "G", "B"}}};
    rows.fill = [=](int index, int y, std::span<float> row) {
      for (int x = 0; x < eye.width; x++) {
        for (int c = 0; c < 3; c++) {
          const float phase =
              0.2f * static_cast<float>(x + 3 * frame + 9 * index) + 0.3f * static_cast<float>(y * (c + 1));
          row[static_cast<size_t>(3 * x + c)] = 0.3f + 0.1f * std::sin(phase);
        }
      }
    };
    SaveOptions options;
    options.tone = ToneCurve::kLinear;
    save_picture(rows, nullptr, options, frame_names(pattern)->path(frame));
  }
}

class ConvertVideo : public ::testing::Test {
 protected:
  std::string make(const std::string& name, const Packing& packing, int frames = 3, Extent eye = {128, 64}) const {
    write_waves(folder.path("a.#.png"), frames, eye);
    folder.write("sound.wav", made::wav(2, 1.0));
    const FrameFiles files = find_frames(folder.path("a.#.png"));
    EncodeOptions options;
    options.packing = packing;
    options.sound = folder.path("sound.wav");
    make_video(files, plan_video(files, {}, {}), {0.0f, ToneCurve::kLinear}, options, folder.path(name));
    for (int frame = 1; frame <= frames; frame++)
      std::filesystem::remove(frame_names(folder.path("a.#.png"))->path(frame));
    return folder.path(name);
  }

  TemporaryFolder folder;
};

const Packing kPacking{VideoCodec::kH264, 8, Chroma::k420, 4};

// The frame that `ods convert` of the one picture gives: its pixels as 16-bit code values, converted by convert().
std::shared_ptr<VideoFrame> by_pictures(const StoredPicture& picture, const ConvertTarget& target,
                                        const FrameFormat& format) {
  const Conversion conversion = convert(picture, target);
  const int eyes = static_cast<int>(target.eyes.size());
  auto frame = std::make_shared<VideoFrame>(packed_size(format.layout, target.eye, eyes), format.packing);
  const size_t channels = count_channels(conversion.rows.layers), width = static_cast<size_t>(target.eye.width);
  for (int i = 0; i < eyes; i++) {
    const EyeCorner corner = eye_corner(format.layout, target.eye, i);
    const auto codes = [&](int y, std::span<float> out) {
      std::vector<float> row(channels * width);
      conversion.rows.fill(i, y, row);
      for (size_t x = 0; x < 3 * width; x++) out[x] = video_code(row[x % width * channels + x / width]);
    };
    put_ycbcr(codes, target.eye, frame->planes().at(corner.x, corner.y), format.color);
  }
  return frame;
}

struct Choice {
  const char* name;
  ConvertTarget target;
  Layout layout;
};

std::vector<Choice> choices(const StoredPicture& prototype) {
  const auto to = [&](const char* projection, Extent eye) {
    ConvertTarget target = same_format(prototype);
    if (*projection != '\0') target.camera.projection = find_projection(projection)->setting;
    target.eye = eye;
    return target;
  };
  std::vector<Choice> all = {{"turned", to("", {128, 64}), Layout::kTopBottom},
                             {"vr180", to("vr180", {80, 80}), Layout::kSideBySide},
                             {"cubes", to("cube-3x2", {96, 64}), Layout::kTopBottom},
                             {"fisheye", to("fisheye", {64, 64}), Layout::kSideBySide},
                             {"small", to("", {40, 20}), Layout::kTopBottom},
                             {"left", to("vr180", {48, 48}), Layout::kTopBottom},
                             {"window", to("perspective", {64, 48}), Layout::kTopBottom}};
  turn(all[0].target.camera, 33.3f, 0.0f, 0.0f);
  all[5].target.eyes = {kLeft};
  all[6].target.eyes = {kMono};
  all[6].target.camera.projection.fov = 70.0f;
  turn(all[6].target.camera, 20.0f, 30.0f, 10.0f);
  return all;
}

TEST_F(ConvertVideo, FramesAreBitForBitThoseOfPictures) {
  Footage pictures(make("video.mkv", kPacking), {}), frames(folder.path("video.mkv"), {});
  const std::optional<StoredPicture> picture = pictures.picture(0);
  const std::optional<DecodedFrame> decoded = frames.next();
  ASSERT_TRUE(picture && decoded);
  for (const Choice& choice : choices(*picture)) {
    SCOPED_TRACE(choice.name);
    ASSERT_EQ(conversion_fault(*picture, choice.target), "");
    for (const Packing& packing : {kPacking, Packing{VideoCodec::kHevc, 10, Chroma::k444, {}}}) {
      const FrameFormat format{choice.layout, packing, {}};
      const auto expected = by_pictures(*picture, choice.target, format);
      const FrameConverter converter(frames.video(), frames.stream(), choice.target, format, false);
      const auto made = converter.convert(*decoded, {0.0f, 0.0f, 0.0f});
      ASSERT_EQ(made->extent().width, expected->extent().width);
      EXPECT_TRUE(bytes_of(made->planes(), made->extent()) == bytes_of(expected->planes(), expected->extent()));
    }
  }
}

// Row by row, without a converter: columns wrap.
std::string moved_bytes(const Planes& planes, Extent eye, const PixelShift& shift, Extent size) {
  std::string bytes;
  for (size_t plane = 0; plane < 3; plane++) {
    const int block = plane == 0 ? 1 : 2;
    for (int y = 0; y < size.height / block; y++) {
      for (int x = 0; x < size.width / block; x++) {
        const int column = (x + shift.column / block) % (eye.width / block), row = y + shift.row / block;
        bytes += static_cast<char>(
            planes.first[plane][static_cast<size_t>(row) * planes.stride[plane] + static_cast<size_t>(column)]);
      }
    }
  }
  return bytes;
}

TEST_F(ConvertVideo, PixelsThatMerelyMoveAreCopied) {
  Footage pictures(make("video.mkv", kPacking), {}), frames(folder.path("video.mkv"), {});
  const std::optional<StoredPicture> picture = pictures.picture(0);
  const std::optional<DecodedFrame> decoded = frames.next();
  ASSERT_TRUE(picture && decoded);
  const auto converted = [&](const ConvertTarget& target, Layout layout) {
    return FrameConverter(frames.video(), frames.stream(), target, {layout, kPacking, {}}, false)
        .convert(*decoded, {0.0f, 0.0f, 0.0f});
  };
  ConvertTarget half = same_format(*picture), turned = half;
  half.camera.projection = find_projection("vr180")->setting;
  half.eye = {64, 64};
  turn(turned.camera, 360.0f * 70.0f / 128.0f, 0.0f, 0.0f);
  for (const auto& [target, column] : {std::pair(half, 32), std::pair(turned, 70)}) {
    const auto made = converted(target, Layout::kSideBySide);
    const auto expected = by_pictures(*picture, target, {Layout::kSideBySide, kPacking, {}});
    EXPECT_TRUE(bytes_of_plane(made->planes(), made->extent(), 0) ==
                bytes_of_plane(expected->planes(), expected->extent(), 0));
    for (int eye : {0, 1}) {
      const EyeCorner to = eye_corner(Layout::kSideBySide, target.eye, eye);
      EXPECT_TRUE(bytes_of(made->planes().at(to.x, to.y), target.eye) ==
                  moved_bytes(decoded->planes.at(0, 64 * eye), {128, 64}, {eye, column, 0}, target.eye))
          << column << ' ' << eye;
    }
  }
  // By an odd number of pixels chroma would come apart: it is computed.
  turn(turned.camera, 360.0f / 128.0f, 0.0f, 0.0f);
  EXPECT_TRUE(bytes_of(converted(turned, Layout::kTopBottom)->planes(), {128, 128}) ==
              bytes_of(by_pictures(*picture, turned, {Layout::kTopBottom, kPacking, {}})->planes(), {128, 128}));
}

// The world of a camera that was turned: what it took is turned back, so that a level camera's picture comes out.
TEST_F(ConvertVideo, TurnedCamerasAreTurnedBack) {
  StereoCamera level, tilted;
  turn(tilted, 20.0f, 5.0f, 12.0f);
  const auto paint = [](vec3 d, int c) {  // smooth, over the whole sphere
    return 0.3f + 0.2f * std::sin(2.0f * d.x + static_cast<float>(c)) * std::cos(1.5f * d.y - d.z);
  };
  PictureRows rows;
  rows.eye = {256, 128};
  rows.eyes = {kLeft, kRight};
  rows.layers = {{{"R", "G", "B"}}};
  const Camera camera = make_camera(tilted);
  rows.fill = [&](int, int y, std::span<float> row) {
    for (int x = 0; x < 256; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / 256.0f, (static_cast<float>(y) + 0.5f) / 128.0f);
      const vec3 d = camera_ray(camera, kMono, uv, uv, vec2(0.0f)).direction;
      for (int c = 0; c < 3; c++) row[static_cast<size_t>(3 * x + c)] = paint(d, c);
    }
  };
  SaveOptions save;
  save.tone = ToneCurve::kLinear;
  save_picture(rows, nullptr, save, folder.path("a_360_TB.png"));
  const StoredPicture picture = open_picture(folder.path("a_360_TB.png"));
  ConvertTarget target = same_format(picture);
  target.turned = {20.0f, 5.0f, 12.0f};
  const Conversion conversion = convert(picture, target);
  const Camera straight = make_camera(level);
  const size_t channels = count_channels(conversion.rows.layers);
  for (int y = 2; y < 126; y += 5) {
    std::vector<float> row(256 * channels);
    conversion.rows.fill(1, y, row);
    for (int x = 0; x < 256; x += 3) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / 256.0f, (static_cast<float>(y) + 0.5f) / 128.0f);
      const vec3 d = camera_ray(straight, kMono, uv, uv, vec2(0.0f)).direction;
      for (int c = 0; c < 3; c++) {
        ASSERT_NEAR(row[static_cast<size_t>(x) * channels + static_cast<size_t>(c)], paint(d, c), 0.006f)
            << x << ' ' << y;
      }
    }
  }
}

// --- the whole video -------------------------------------------------------------------------------------------------

std::string packets_of_sound(const std::string& video) {
  return output_of("ffmpeg -v error -i " + video + " -map 0:a:0 -c copy -f framehash - | grep -v '^#'");
}

// A turn by whole pixels: the fastest conversion.
VideoConversion turned_conversion(const Footage& video) {
  VideoConversion conversion;
  conversion.target = same_format(video.video().prototype);
  turn(conversion.target.camera, 90.0f, 0.0f, 0.0f);
  conversion.layout = video.video().prototype.layout;
  conversion.metadata = video.video().metadata;
  return conversion;
}

// The times of a video's pictures, in milliseconds from the first on. Matroska has no times below 0, which sound may
// begin with, and moves all of them.
std::vector<int> times_of(const std::string& path) {
  VideoDecoder decoder(path, choose_track(read_video_file(path), {}, path).id);
  std::vector<int> times;
  while (const auto frame = decoder.next()) {
    const double seconds = static_cast<double>(frame->time.start) / decoder.stream().clock.value();
    times.push_back(static_cast<int>(std::lround(1000.0 * (seconds - decoder.stream().start))));
  }
  return times;
}

std::string convert_file(const std::string& from, const std::string& to, const TimeSpan& span = {}) {
  Footage video(from, {});
  video.choose(span);
  EncodeOptions options;
  options.packing = packing_like(video.stream(), *container_of_path(to)).value_or(Packing());
  options.keep.path = from;
  options.keep.track = video.video().track;
  options.keep.cut.is_cut = span.is_part();
  convert_video(video, turned_conversion(video), options, to);
  return to;
}

TEST_F(ConvertVideo, SoundAndTimesStayInEveryContainer) {
  for (const char* from : {"a.mp4", "a.mkv"}) {
    const std::string video = make(from, kPacking, 8);
    for (const char* to : {"b.mp4", "b.mov", "b.mkv"}) {
      SCOPED_TRACE(std::string(from) + " to " + to);
      if (std::string(from) == "a.mkv" && std::string(to) == "b.mov") continue;  // has no place for Opus
      const std::string made = convert_file(video, folder.path(to));
      EXPECT_EQ(times_of(made), times_of(video));
      EXPECT_NEAR(Footage(made, {}).stream().rate.value(), 30.0, 1e-9);
      const VideoFile file = read_video_file(made);
      EXPECT_EQ(file.tracks.at(0).v2->stereo, VideoStereo::kTopBottom);
      EXPECT_EQ(file.tracks.at(0).v2->projection, VideoProjection::kEquirect);
      ASSERT_EQ(file.sound.size(), 1u);
      if (is_installed("ffmpeg") && std::string(from).substr(2) == std::string(to).substr(2)) {
        EXPECT_GT(packets_of_sound(video).size(), 200u);
        EXPECT_EQ(packets_of_sound(made), packets_of_sound(video));
      }
    }
  }
}

TEST_F(ConvertVideo, UnevenTimesStay) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  const std::string even = make("even.mp4", kPacking, 8), video = folder.path("uneven_360_TB.mp4");
  const std::string command = "ffmpeg -v error -i " + even +
                              " -vf 'setpts=PTS+gte(N\\,3)*4/30/TB+gte(N\\,5)*1/50/TB' -vsync vfr -enc_time_base 1/600 "
                              "-c:v libx264 -c:a copy " +
                              video + " 2>&1";
  if (!output_of(command).empty()) GTEST_SKIP() << "skipped: this ffmpeg makes no uneven video";
  EXPECT_EQ(times_of(video), (std::vector<int>{0, 33, 67, 233, 267, 320, 353, 387}));
  for (const char* to : {"b.mp4", "b.mkv"})
    EXPECT_EQ(times_of(convert_file(video, folder.path(to))), times_of(video)) << to;
}

// Parts that an edit list leaves out stay out, and picture and sound begin as far apart as before.
TEST_F(ConvertVideo, EditListsHold) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  const std::string whole = make("whole.mp4", kPacking, 40), video = folder.path("cut_360_TB.mp4");
  // The copy begins with a key frame, at 0; an edit list shows it from 0.2 s on.
  ASSERT_EQ(output_of("ffmpeg -v error -ss 0.2 -i " + whole + " -c copy " + video + " 2>&1"), "");
  const std::string old =
      output_of("ffmpeg -v error -i " + video + " -map 0:v -f framemd5 - | grep -v '^#' | cut -d, -f3");
  const std::string made = convert_file(video, folder.path("b.mp4"));
  EXPECT_EQ(output_of("ffmpeg -v error -i " + made + " -map 0:v -f framemd5 - | grep -v '^#' | cut -d, -f3"), old);
  EXPECT_EQ(times_of(made).size(), times_of(video).size());
  EXPECT_LT(times_of(made).size(), 40u);
}

TEST_F(ConvertVideo, APartIsExactAtBothEnds) {
  const std::string video = make("a.mp4", kPacking, 40);  // key frames are 30 frames apart
  const auto luma_of = [](const DecodedFrame& frame) { return bytes_of_plane(frame.planes, {128, 128}, 0); };
  for (const auto& [from, to, first, count] :
       {std::tuple(0.5, 1.0, 15, 15), std::tuple(1.1, 9.0, 33, 7), std::tuple(0.0, 0.1, 0, 3)}) {
    const std::string made = convert_file(video, folder.path("b.mkv"), {from, to});
    EXPECT_EQ(static_cast<int>(times_of(made).size()), count) << from;
    EXPECT_EQ(times_of(made).front(), 0);
    Footage old(video, {}), part(made, {});
    const auto before = old.decode(first), after = part.next();
    ASSERT_TRUE(before && after);
    // Turned by a quarter: the moving waves distinguish the frames.
    double off = 0.0, off_by_one = 0.0;
    const auto next = old.next();
    ASSERT_TRUE(next);
    const std::string is = luma_of(*after), was = luma_of(*before), later = luma_of(*next);
    for (size_t y = 0; y < 128; y++) {
      for (size_t x = 0; x < 128; x++) {
        const auto at = [&](const std::string& plane, size_t column) {
          return static_cast<double>(static_cast<unsigned char>(plane[y * 128 + column % 128]));
        };
        off += std::abs(at(is, x) - at(was, x + 32));
        off_by_one += std::abs(at(is, x) - at(later, x + 32));
      }
    }
    EXPECT_LT(4.0 * off, off_by_one) << from;
  }
  Footage none(video, {});
  none.choose({50.0, {}});
  EXPECT_THROW(convert_video(none, turned_conversion(none), {}, folder.path("c.mkv")), Error);
}

TEST_F(ConvertVideo, HdrKeepsItsNumbersAndWords) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  if (!has_encoder("libx265")) GTEST_SKIP() << "skipped: this machine encodes no HEVC";
  const std::string plain = make("plain.mkv", kPacking), hdr = folder.path("hdr_360_TB.mp4");
  const std::string x265 =
      "log-level=none:colorprim=bt2020:transfer=smpte2084:colormatrix=bt2020nc:max-cll=900,400:"
      "master-display=G(13250,34500)B(7500,3000)R(34000,16000)WP(15635,16450)L(10000000,50)";
  output_of("ffmpeg -v error -i " + plain +
            " -vf scale=out_color_matrix=bt2020,format=yuv420p10le -c:v libx265 -crf 4 -x265-params '" + x265 +
            "' -color_primaries bt2020 -color_trc smpte2084 -colorspace bt2020nc -c:a copy " + hdr + " 2>&1");
  Footage video(hdr, {});
  if (!video.stream().words.is_hdr()) GTEST_SKIP() << "skipped: this ffmpeg makes no HDR";
  EXPECT_EQ(video.stream().color.matrix, YcbcrMatrix::k2020);
  EXPECT_FALSE(video.stream().words.mastering_display.empty());
  const std::string made = convert_file(hdr, folder.path("b.mp4"));
  Footage after(made, {});
  EXPECT_EQ(after.stream().color, video.stream().color);
  EXPECT_EQ(after.stream().words, video.stream().words);
  EXPECT_EQ(after.stream().bits, 10);
  // Computed, too, the code values stay where they are: a turn there and back by an odd angle.
  ConvertTarget target = same_format(video.video().prototype);
  target.eye = {64, 32};
  const FrameConverter converter(video.video(), video.stream(), target,
                                 {Layout::kTopBottom, {VideoCodec::kHevc, 10, Chroma::k420, {}}, video.stream().color},
                                 false);
  const std::optional<DecodedFrame> frame = video.next();
  const auto half = converter.convert(*frame, {0.0f, 0.0f, 0.0f});
  double before = 0.0, now = 0.0;
  for (size_t y = 0; y < 128; y++) {
    for (size_t x = 0; x < 128; x++) {
      const auto at = [](const Planes& planes, size_t column, size_t row) {
        uint16_t code;
        std::memcpy(&code, planes.first[0] + row * planes.stride[0] + 2 * column, sizeof code);
        return static_cast<double>(code);
      };
      before += at(frame->planes, x, y) / 16384.0;
      now += at(half->planes(), x / 2, y / 2) / 16384.0;
    }
  }
  EXPECT_NEAR(now, before, 1.0);  // in linear light the mean of waves would become brighter
}

TEST_F(ConvertVideo, FramesBecomeTheSameVideoAsByEncoding) {
  write_waves(folder.path("a_360_TB.#.png"), 3, {128, 64});
  const FrameFiles files = find_frames(folder.path("a_360_TB.#.png"));
  EncodeOptions options;
  options.packing = kPacking;
  const VideoPlan plan = plan_video(files, {}, {});
  make_video(files, plan, {0.0f, ToneCurve::kLinear}, options, folder.path("encoded.mp4"));
  const StoredPicture first = open_picture(files.path(0));
  const FramesConversion conversion{files, first, same_format(first), Layout::kTopBottom, plan.metadata, {}};
  EXPECT_EQ(convert_frames(conversion, options, folder.path("converted.mp4")), 3);
  EXPECT_TRUE(folder.read("converted.mp4") == folder.read("encoded.mp4"));
}

}  // namespace
}  // namespace ods
