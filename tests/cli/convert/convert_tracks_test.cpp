// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Videos whose pictures are two tracks: a track for each eye, and the two rows of faces of a GoPro MAX, made by FFmpeg.
#include <fmt/format.h>

#include <cmath>

#include "ods/base/error.h"
#include "ods/picture/load_eyes.h"
#include "ods/picture/save.h"
#include "ods/video/container/ebml.h"
#include "ods/video/video_input.h"
#include "tests/support/cli_runner.h"
#include "tests/support/made_videos.h"
#include "tests/support/programs.h"
#include "tests/support/worlds.h"

namespace ods::two_tracks_test {

class TwoTracks : public Cli {
 protected:
  void SetUp() override {
    if (const std::string why = missing("ffmpeg with v360", "ffmpeg -v error -h filter=v360 | grep -q eac");
        !why.empty())
      GTEST_SKIP() << why;
  }

  Image world(const char* projection, int eye, Extent size) const {
    StereoCamera camera;
    camera.projection = find_projection(projection)->setting;
    return seen_in(World::kHall, camera, eye, size, eye != kMono);
  }

  void write(const std::string& name, const Image& image) const {
    Picture picture;
    picture.eyes.resize(1);
    picture.eyes[0].eye = kMono, picture.eyes[0].radiance = image;
    SaveOptions options;
    options.layout = Layout::kSeparate, options.tone = ToneCurve::kLinear;
    save_picture(picture, options, folder.path(name));
  }

  void ffmpeg(const std::string& words) const {
    const Ran ran = run_line(fmt::format("cd {} && ffmpeg -v error -y {}", folder.path(""), words));
    ASSERT_EQ(ran.code, 0) << ran.out;
  }

  // The first picture of a video, in display values.
  StoredPicture first_picture(const std::string& name) const {
    const VideoInput video = open_video(folder.path(name));
    VideoDecoder decoder(video.path, video.track, video.views);
    return picture_of(video, decoder.stream(), *decoder.next());
  }

  // Peak signal to noise in dB, of what displays show.
  double match(const Image& grey, const Image& truth) const {
    double sum = 0.0;
    for (int y = 0; y < grey.height; y++) {
      for (int x = 0; x < grey.width; x++) {
        const float* color = truth.at(x, y);
        const float light = 0.2126f * color[0] + 0.7152f * color[1] + 0.0722f * color[2];
        const auto off = static_cast<double>(srgb_encode(light) - srgb_encode(std::max(*grey.at(x, y), 0.0f)));
        sum += off * off;
      }
    }
    return -10.0 * std::log10(sum / (1.0 * grey.width * grey.height));
  }

  // Two eyes as two tracks with these names.
  void make_eyes(const std::string& name, const char* first, const char* second) const {
    write("one.png", world("lat-long", kLeft, {512, 256}));
    write("two.png", world("lat-long", kRight, {512, 256}));
    const char* word = name.ends_with("mkv") ? "title" : "handler_name";
    ffmpeg(
        fmt::format("-loop 1 -i one.png -loop 1 -i two.png -map 0 -map 1 -t 0.12 -c:v libx264 -crf 12 -preset "
                    "ultrafast -pix_fmt yuv420p -metadata:s:v:0 '{0}={1}' -metadata:s:v:1 '{0}={2}' {3}",
                    word, first, second, name));
  }

  // Adds a track that combines the first two to a pair, and drops the index, whose positions no longer apply.
  void add_combined_track(const std::string& name, uint64_t left, uint64_t right) const {
    const FileInput file(folder.path(name));
    const FileElement head = scan_element(file, 0, file.size());
    const FileElement segment = scan_element(file, head.end(), file.size());
    std::string body;
    for (uint64_t at = segment.body(); at < segment.end();) {
      const FileElement part = scan_element(file, at, segment.end());
      at = part.end();
      constexpr uint32_t kSeekHead = 0x114d9b74, kCues = 0x1c53bb6b, kTracks = 0x1654ae6b;
      if (part.id == kSeekHead || part.id == kCues) continue;
      body += part.id == kTracks ? with_combined_track(read_element(file, part), left, right)
                                 : file.read(part.offset, part.size);
    }
    folder.write(name, file.read(0, head.end()) + made::element(0x18538067, body, 8));
  }

  static std::string with_combined_track(Element tracks, uint64_t left, uint64_t right) {
    open_element(tracks);
    std::erase_if(tracks.children, [](const Element& child) { return child.id == 0xbf; });  // CRC-32
    std::string body, planes;
    for (Element entry : tracks.children) {
      write_element(entry, body);
      open_element(entry);
      const uint64_t number = number_of(*find_child(entry, 0xd7)), uid = number_of(*find_child(entry, 0x73c5));
      if (number != left && number != right) continue;
      planes += made::element(0xe4, made::element(0xe5, made::number(uid, 8)) +
                                        made::element(0xe6, made::number(number == left ? 0 : 1, 1)));
    }
    body += made::element(0xae, made::element(0xd7, made::number(3, 1)) + made::element(0x73c5, made::number(3, 1)) +
                                    made::element(0x83, made::number(1, 1)) +
                                    made::element(0xe2, made::element(0xe3, planes)));
    return made::element(0x1654ae6b, body, 8);
  }

  // The faces of v360, with what the halves of the outer ones show twice.
  void make_max() const {
    write("world.png", world("lat-long", kMono, {2048, 1024}));
    std::string cuts = "[0]v360=e:eac:w=2208:h=1472:interp=lanczos,split=6[a][b][c][d][e][f]";
    for (const auto& [row, at] : {std::pair{"abc", 0}, {"def", 736}}) {
      const int widths[] = {384, 1504, 384}, begins[] = {0, 352, 1824};
      for (size_t i = 0; i < 3; i++) {
        cuts += fmt::format(";[{0}]crop={1}:736:{2}:{3}[{0}{0}]", row[i], widths[i], begins[i], at);
      }
      cuts += fmt::format(";[{0}{0}][{1}{1}][{2}{2}]hstack=3[row{0}]", row[0], row[1], row[2]);
    }
    ffmpeg(
        fmt::format("-loop 1 -i world.png -filter_complex '{}' -map '[rowa]' -map '[rowd]' -t 0.12 -c:v libx264 "
                    "-crf 8 -preset ultrafast -pix_fmt yuv420p -f mp4 GS010001.360",
                    cuts));
  }
};

TEST_F(TwoTracks, OfAGoProMaxAreOneWorld) {
  make_max();
  const std::string input = folder.path("GS010001.360");
  ASSERT_EQ(run("probe " + input), 0) << err;
  EXPECT_NE(out.find("GoPro's MAX"), std::string::npos) << out;
  ASSERT_EQ(run("convert " + input + " -o " + folder.path("x_360.mp4") + " --width 1024 --crf 8 -q"), 0) << err;
  const StoredPicture made = first_picture("x_360.mp4");
  ASSERT_EQ(made.eyes.size(), 1u);
  const double found = match(grey_eyes(made)[0], world("lat-long", kMono, {1024, 512}));
  RecordProperty("dB", fmt::format("{:.1f}", found));
  EXPECT_GT(found, 30.0);
  EXPECT_EQ(run("inject " + input), 3);
  EXPECT_NE(err.find("two tracks"), std::string::npos) << err;
}

TEST_F(TwoTracks, NamedByTheEyesAreAPair) {
  for (const auto& [name, first, second, is_swapped] :
       {std::tuple{"a.mkv", "Left eye", "Right eye", false}, {"b.mp4", "right", "left", true}}) {
    make_eyes(name, first, second);
    ASSERT_EQ(run("probe " + folder.path(name)), 0) << err;
    EXPECT_NE(out.find("its eyes are two tracks"), std::string::npos) << out;
    const std::string made = folder.path("made_360_TB.mp4");
    std::filesystem::remove(made);
    ASSERT_EQ(run("convert " + folder.path(name) + " -o " + made + " --projection lat-long --crf 12 -q"), 0) << err;
    const std::vector<Image> eyes = grey_eyes(first_picture("made_360_TB.mp4"));
    ASSERT_EQ(eyes.size(), 2u);
    for (const int eye : {kLeft, kRight}) {
      const Image& own = eyes[static_cast<size_t>(eye)];
      const double right = match(own, world("lat-long", is_swapped ? 1 - eye : eye, {512, 256}));
      EXPECT_GT(right, 35.0) << name;
      EXPECT_GT(right, match(own, world("lat-long", is_swapped ? eye : 1 - eye, {512, 256})) + 6.0) << name;
    }
  }
}

TEST_F(TwoTracks, CombinedByTheContainerAreAPair) {
  make_eyes("planes.mkv", "", "");
  add_combined_track("planes.mkv", 2, 1);
  const std::string input = folder.path("planes.mkv"), made = folder.path("made_360_LR.mp4");
  ASSERT_EQ(run("probe " + input), 0) << err;
  EXPECT_NE(out.find("its eyes are two tracks: 2 and 1"), std::string::npos) << out;
  ASSERT_EQ(run("convert " + input + " -o " + made + " --projection lat-long --crf 12 -q"), 0) << err;
  const std::vector<Image> eyes = grey_eyes(first_picture("made_360_LR.mp4"));
  ASSERT_EQ(eyes.size(), 2u);
  EXPECT_GT(match(eyes[kRight], world("lat-long", kLeft, {512, 256})), 35.0);
}

TEST_F(TwoTracks, OfAnInsta360AreItsLenses) {
  for (const auto& [name, yaw] : {std::pair{"one.png", 0.0f}, {"two.png", 180.0f}}) {
    StereoCamera lens;
    lens.projection = find_projection("fisheye")->setting;
    lens.projection.fov = 195.0f, lens.yaw = yaw;
    write(name, seen_in(World::kHall, lens, kMono, {600, 600}));
  }
  ffmpeg(
      "-loop 1 -i one.png -loop 1 -i two.png -map 0 -map 1 -t 0.12 -c:v libx264 -crf 12 -preset ultrafast -pix_fmt "
      "yuv420p -f mp4 VID_1.insv");
  const std::string made = folder.path("world_360.mp4");
  ASSERT_EQ(run("convert " + folder.path("VID_1.insv") + " -o " + made + " --width 512 --crf 12"), 0) << err;
  EXPECT_NE(err.find("two lenses"), std::string::npos) << err;
  EXPECT_GT(match(grey_eyes(first_picture("world_360.mp4"))[0], world("lat-long", kMono, {512, 256})), 25.0);
}

TEST_F(TwoTracks, WithoutNamesAreAQuestion) {
  make_eyes("eyes.mkv", "", "");
  const std::string input = folder.path("eyes.mkv"), made = folder.path("made_360_LR.mp4");
  EXPECT_EQ(run("convert " + input + " -o " + made + " -q"), 3);
  EXPECT_NE(err.find("--layout cross-eyed"), std::string::npos) << err;
  EXPECT_FALSE(std::filesystem::exists(made));
  ASSERT_EQ(run("probe " + input), 0) << err;
  EXPECT_NE(out.find("--layout cross-eyed"), std::string::npos) << out;
  for (const bool is_swapped : {false, true}) {
    const char* layout = is_swapped ? "cross-eyed" : "side-by-side";
    std::filesystem::remove(made);
    ASSERT_EQ(run(fmt::format("convert {} -o {} --layout {} --projection lat-long --crf 12 -q", input, made, layout)),
              0)
        << err;
    const std::vector<Image> eyes = grey_eyes(first_picture("made_360_LR.mp4"));
    ASSERT_EQ(eyes.size(), 2u);
    EXPECT_GT(match(eyes[is_swapped ? 1 : 0], world("lat-long", kLeft, {512, 256})), 35.0) << layout;
  }
}

}  // namespace ods::two_tracks_test
