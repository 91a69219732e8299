// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos of every kind as other programs see them.
#include "ods/video/encode.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <optional>
#include <random>
#include <set>

#include "ods/video/make_video.h"
#include "tests/support/decoded_video.h"
#include "tests/support/made_frames.h"
#include "tests/support/temporary_folder.h"

namespace ods::encode_test {

std::string usable_encoder(VideoCodec codec, Chroma chroma) {
  for (const EncoderFacts& facts : known_encoders()) {
    const bool fits = facts.codec == codec && (chroma == Chroma::k420 || !facts.only_420);
    if (fits && has_encoder(facts.name)) return std::string(facts.name);
  }
  return "";
}

class Encode : public ::testing::Test {
 protected:
  std::string pattern(const std::string& name = "a.#.png") const { return folder.path(name); }

  // Encodes all frames of the pattern.
  std::string make(const std::string& frames, const std::string& name, const Packing& packing,
                   std::optional<Layout> layout = {}, const EncodeOptions& other = {}) const {
    const FrameFiles files = find_frames(frames);
    EncodeOptions options = other;
    options.packing = packing;
    make_video(files, plan_video(files, {}, layout), {0.0f, ToneCurve::kLinear}, options, folder.path(name));
    return folder.path(name);
  }

  TemporaryFolder folder;
};

// The left eye is red: a decoder finds it in the half that the metadata name.
void expect_left_is_red(const DecodedVideo& video, bool beside, int first_frame) {
  const int width = video.size.width, height = video.size.height;
  for (size_t frame = 0; frame < video.frames(); frame++) {
    const double strong = made::code_of(first_frame + static_cast<int>(frame));
    const auto left = video.codes(frame, width / 4, height / 4);
    const auto right =
        beside ? video.codes(frame, 3 * width / 4, height / 4) : video.codes(frame, width / 4, 3 * height / 4);
    for (size_t c = 0; c < 3; c++) {
      EXPECT_NEAR(left[c], c == 0 ? strong : 20.0, 4.0) << "left " << c << ", frame " << frame;
      EXPECT_NEAR(right[c], c == 2 ? strong : 20.0, 4.0) << "right " << c << ", frame " << frame;
    }
  }
}

Packing usual(VideoCodec codec) {
  if (codec == VideoCodec::kProRes) return {codec, 10, Chroma::k422, {}};
  return {codec, 8, Chroma::k420, {}};
}

TEST_F(Encode, EveryContainerCodecAndLayoutIsWhatItSays) {
  made::write_frames(pattern(), {1, 2, 3});
  const bool decodes = is_installed("ffmpeg") && is_installed("ffprobe");
  for (Container container : kContainers) {
    for (VideoCodec codec : kVideoCodecs) {
      if (!can_hold(container, codec) || usable_encoder(codec, Chroma::k420).empty()) continue;
      for (Layout layout : {Layout::kTopBottom, Layout::kSideBySide}) {
        SCOPED_TRACE(
            fmt::format("{} in {}, {}", video_codec_name(codec), container_name(container), layout_name(layout)));
        const std::string name = fmt::format("video.{}", container_name(container));
        const std::string path = make(pattern(), name, usual(codec), layout);
        const VideoFile video = read_video_file(path);
        EXPECT_EQ(video.container, container);
        ASSERT_EQ(video.tracks.size(), 1u);
        ASSERT_TRUE(video.tracks[0].v2);
        EXPECT_EQ(metadata_text(*video.tracks[0].v2), fmt::format("{}, lat-long", layout_name(layout)));
        const bool has_boxes = container == Container::kMp4 || container == Container::kMov;
        EXPECT_EQ(video.tracks[0].v1.has_value(), has_boxes);
        if (!decodes) continue;
        const DecodedVideo decoded = decode_video(path);
        EXPECT_EQ(decoded.frames(), 3u);
        expect_left_is_red(decoded, layout == Layout::kSideBySide, 1);
      }
    }
  }
  if (!decodes) GTEST_SKIP() << "skipped: what is decoded needs ffmpeg and ffprobe";
}

TEST_F(Encode, FramesOfEveryLayoutBecomeLeftOnTop) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  const std::pair<const char*, Layout> kCases[] = {
      {"bt_BT.#.png", Layout::kBottomTop},  {"rl_RL.#.jpg", Layout::kCrossEyed},
      {"pair_%V.#.tif", Layout::kSeparate}, {"views.#.exr", Layout::kMultiview},
      {"tb.#.exr", Layout::kTopBottom},     {"half_HOU.#.png", Layout::kTopBottomHalf}};
  for (const auto& [name, layout] : kCases) {
    SCOPED_TRACE(name);
    made::write_frames(pattern(name), {4, 5}, layout);
    expect_left_is_red(decode_video(make(pattern(name), "video.mp4", {})), layout == Layout::kCrossEyed, 4);
  }
}

// --- colours ---------------------------------------------------------------------------------------------------------

// 16 fields of 16x16 pixels.
void write_ramp(const std::string& path, const std::function<vec3(int field)>& code) {
  Picture picture;
  Image image(128, 64, 3);
  for (int y = 0; y < 64; y++) {
    for (int x = 0; x < 128; x++) {
      const vec3 codes = code(x / 16 + y / 16 * 8) / 255.0f;
      for (int c = 0; c < 3; c++) image.at(x, y)[c] = srgb_decode(codes[c]);
    }
  }
  picture.eyes.push_back({kMono, image, {}, {}, {}, {}});
  SaveOptions options;
  options.tone = ToneCurve::kLinear;
  save_picture(picture, options, path);
}

// The error of a video of the ramp, of 255.
double worst_of_ramp(const DecodedVideo& video, const std::function<vec3(int field)>& code) {
  double worst = 0.0;
  for (int field = 0; field < 32; field++) {
    const auto codes = video.codes(0, field % 8 * 16 + 8, field / 8 * 16 + 8);
    for (int c = 0; c < 3; c++)
      worst = std::max(worst, std::abs(codes[static_cast<size_t>(c)] - double{code(field)[c]}));
  }
  return worst;
}

TEST_F(Encode, AGreyRampComesBackInEveryCodec) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  const auto grey = [](int field) { return vec3(std::round(static_cast<float>(field) * 255.0f / 31.0f)); };
  write_ramp(pattern("ramp.1.png"), grey);
  for (const EncoderFacts& facts : known_encoders()) {
    for (int bits : {8, 10}) {
      Packing packing = usual(facts.codec);
      if (!has_encoder(facts.name) || (facts.codec == VideoCodec::kProRes && bits == 8)) continue;
      packing.bits = bits;
      EncodeOptions options;
      options.encoder = facts.name;
      const DecodedVideo video = decode_video(make(pattern("ramp.#.png"), "ramp.mkv", packing, {}, options));
      EXPECT_LE(worst_of_ramp(video, grey), 1.5) << facts.name << ", " << bits << " bits";
    }
  }
}

TEST_F(Encode, ColoursComeBackWhereNoneIsShared) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  const auto color = [](int i) { return vec3(i % 4, i / 4 % 4, i / 16 * 2 + 1) * 80.0f; };
  write_ramp(pattern("ramp.1.png"), color);
  for (VideoCodec codec : {VideoCodec::kH264, VideoCodec::kHevc, VideoCodec::kVp9, VideoCodec::kProRes}) {
    if (usable_encoder(codec, Chroma::k444).empty()) continue;
    Packing packing{codec, 10, Chroma::k444, 4};
    if (codec == VideoCodec::kProRes) packing.quality.reset();
    const DecodedVideo video = decode_video(make(pattern("ramp.#.png"), "ramp.mkv", packing));
    EXPECT_LE(worst_of_ramp(video, color), 1.5) << video_codec_name(codec);
  }
}

// --- readers ---------------------------------------------------------------------------------------------------------

TEST_F(Encode, TheVideoSaysThatItIsBt709) {
  if (!is_installed("ffprobe")) GTEST_SKIP() << "skipped: ffprobe is not installed";
  made::write_frames(pattern(), {1});
  for (const char* name : {"video.mp4", "video.mov", "video.mkv"}) {
    const std::string text = output_of("ffprobe -v quiet -show_streams " + make(pattern(), name, {}));
    for (const char* line : {"color_range=tv", "color_space=bt709", "color_transfer=bt709", "color_primaries=bt709",
                             "chroma_location=left", "type=top and bottom", "projection=equirectangular"}) {
      EXPECT_NE(text.find(line), std::string::npos) << name << " " << line;
    }
  }
}

TEST_F(Encode, OtherReadersAgree) {
  if (!is_installed("mkvinfo") || !is_installed("mediainfo") || !is_installed("exiftool")) {
    GTEST_SKIP() << "skipped: mkvinfo, mediainfo or exiftool is not installed";
  }
  if (!has_encoder("libx265")) GTEST_SKIP() << "skipped: this machine has no libx265";
  made::write_frames(pattern(), {1, 2});
  const Packing hevc{VideoCodec::kHevc, 8, Chroma::k420, {}};
  const std::string mkv = make(pattern(), "video.mkv", hevc), mp4 = make(pattern(), "video.mp4", hevc);
  const std::string elements = output_of("mkvinfo " + mkv);
  // "Stereo mode", of later ones "Video stereo mode".
  for (const char* line : {"tereo mode: 3", "Projection type: 1", "Color matrix coefficients: 1", "Color range: 1"}) {
    EXPECT_NE(elements.find(line), std::string::npos) << line << "\n" << elements;
  }
  const std::string boxes = output_of("exiftool -s -n " + mp4);
  for (const char* line : {"ColorProfiles                   : nclx", "MatrixCoefficients              : 1",
                           "Stereoscopic3D                  : 1", "StereoMode                      : top-bottom"}) {
    EXPECT_NE(boxes.find(line), std::string::npos) << line << "\n" << boxes;
  }
  const std::string summary = output_of("mediainfo " + mp4);
  for (const char* line : {"hvc1", "Limited", "BT.709", "4:2:0"})
    EXPECT_NE(summary.find(line), std::string::npos) << line;
}

TEST_F(Encode, EverySecondBeginsAnew) {
  if (!is_installed("ffprobe")) GTEST_SKIP() << "skipped: ffprobe is not installed";
  std::vector<int> frames;
  for (int i = 1; i <= 25; i++) frames.push_back(i);
  made::write_frames(pattern(), frames, Layout::kTopBottom, {64, 32});
  EncodeOptions options;
  options.rate = {10, 1};
  for (VideoCodec codec : {VideoCodec::kH264, VideoCodec::kHevc, VideoCodec::kAv1, VideoCodec::kVp9}) {
    if (usable_encoder(codec, Chroma::k420).empty()) continue;
    const std::string video = make(pattern(), "video.mp4", usual(codec), {}, options);
    std::istringstream flags(
        output_of("ffprobe -v error -select_streams v -show_entries packet=flags -of csv=p=0 " + video));
    int frame = 0, key = -10;
    for (std::string each; flags >> each; frame++) {
      if (each.starts_with("K")) key = frame;
      EXPECT_LT(frame - key, 10) << video_codec_name(codec);
    }
    EXPECT_EQ(frame, 25);
  }
}

// --- sound -----------------------------------------------------------------------------------------------------------

TEST_F(Encode, SoundIsMuxed) {
  made::write_frames(pattern(), {1, 2, 3, 4, 5, 6});
  EncodeOptions options;
  options.sound = folder.path("sound.wav");
  for (int channels : {1, 2, 4}) {
    folder.write("sound.wav", made::wav(channels, 0.2));
    for (Container container : {Container::kMp4, Container::kMov, Container::kMatroska}) {
      const std::string video = make(pattern(), fmt::format("video.{}", container_name(container)), {}, {}, options);
      const VideoFile info = read_video_file(video);
      ASSERT_EQ(info.sound.size(), 1u);
      const bool has_boxes = container != Container::kMatroska;
      ASSERT_EQ(info.sound[0].ambisonics.has_value(), channels == 4 && has_boxes) << video;
      if (!is_installed("ffprobe")) continue;
      const std::string text = output_of("ffprobe -v quiet -select_streams a -show_streams " + video);
      EXPECT_NE(text.find(fmt::format("channels={}\n", channels)), std::string::npos) << text;
      const bool says_so = text.find("channel_layout=ambisonic 1") != std::string::npos;
      EXPECT_EQ(says_so, channels == 4 && container != Container::kMp4) << text;
    }
  }
}

// The sound of the wav, channel by channel and from its first sample, as decoders hear it.
TEST_F(Encode, SoundComesBackInItsChannels) {
  if (!is_installed("ffmpeg")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
  made::write_frames(pattern(), {1, 2, 3, 4, 5, 6});
  folder.write("sound.wav", made::wav(4, 0.25));
  EncodeOptions options;
  options.sound = folder.path("sound.wav");
  for (const char* name : {"video.mp4", "video.mov", "video.mkv"}) {
    const std::string video = make(pattern(), name, {}, {}, options);
    const std::string bytes = output_of("ffmpeg -v error -i " + video + " -map 0:a -f s16le -");
    EXPECT_NEAR(static_cast<double>(bytes.size() / 8), 0.2 * 48000, 1024.0) << name;
    double off[4] = {}, loud[4] = {};
    for (size_t i = 0; i < std::min<size_t>(bytes.size() / 8, 9000); i++) {
      for (size_t c = 0; c < 4; c++) {
        const double gain = static_cast<double>(c + 1);
        const double wanted = 8000.0 * std::sin(0.02 * gain * static_cast<double>(i)) / gain;
        const auto byte = [&](size_t at) { return static_cast<unsigned char>(bytes[8 * i + 2 * c + at]); };
        off[c] += std::pow(static_cast<int16_t>(byte(0) | byte(1) << 8) - wanted, 2.0);
        loud[c] += wanted * wanted;
      }
    }
    for (size_t c = 0; c < 4; c++) EXPECT_LT(std::sqrt(off[c] / loud[c]), 0.1) << name << ", channel " << c;
  }
}

// The bytes of a video whose frames move, under noise that comes and goes.
std::string noisy_video(const TemporaryFolder& folder, int side, int frames, const EncodeOptions& options) {
  AtomicFile file(folder.path("noise.mp4"));
  VideoEncoder encoder(file, Container::kMp4, {side, side}, options);
  std::minstd_rand random(1);
  for (int number = 0; number < frames; number++) {
    auto frame = std::make_shared<VideoFrame>(Extent{side, side}, options.packing);
    const auto noise = static_cast<unsigned>(number / 13 % 3) * 60 + 1;
    for (size_t plane = 0; plane < 3; plane++) {
      const int edge = plane == 0 ? side : side / 2;
      for (int y = 0; y < edge; y++) {
        std::byte* row = frame->planes().first[plane] + static_cast<size_t>(y) * frame->planes().stride[plane];
        for (int x = 0; x < edge; x++) {
          const double wave = std::sin((x + 3 * number) / 9.0) * std::cos((y - 2 * number) / 7.0);
          row[x] = static_cast<std::byte>(static_cast<unsigned>(90.0 + 60.0 * wave) + random() % noise / 2);
        }
      }
    }
    encoder.add(frame, {number, 1});
  }
  encoder.finish();
  file.commit();
  return folder.read("noise.mp4");
}

// 32 and 64: x265 needs frames of several blocks.
// Memory that an encoder never wrote has other contents in every run.
TEST_F(Encode, RunsAreTheSameBytesWhateverThreadsAndMemory) {
  for (const auto& [codec, encoder] : {std::pair{VideoCodec::kH264, "libx264"}, {VideoCodec::kHevc, "libx265"}}) {
    if (!has_encoder(encoder)) GTEST_SKIP() << "skipped: this machine has no " << encoder;
    for (const int side : {32, 256}) {
      for (const std::optional<double> bitrate : {std::optional<double>(), std::optional<double>(1.0)}) {
        EncodeOptions options;
        options.packing.codec = codec;
        options.bitrate = bitrate;
        std::set<std::string> files;
        for (int run = 0; run < 4; run++) {
          mallopt(M_PERTURB, 60 * run);
          options.threads = std::array{0, 1, 2, 5}[static_cast<size_t>(run)];
          files.insert(noisy_video(folder, side, side <= 64 ? 45 : 10, options));
        }
        mallopt(M_PERTURB, 0);
        EXPECT_EQ(files.size(), 1u) << encoder << " " << side << (bitrate ? " with a bit rate" : "");
      }
    }
  }
}

}  // namespace ods::encode_test
