// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The other tracks of a video, as FFmpeg writes them and as FFmpeg and ExifTool find them in the new one.
#include "ods/video/tracks/kept_tracks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "ods/video/container/video_file.h"
#include "ods/video/make_video.h"
#include "tests/support/decoded_video.h"
#include "tests/support/made_frames.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

class KeptTracksTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!is_installed("ffmpeg") || !is_installed("ffprobe")) GTEST_SKIP() << "skipped: ffmpeg is not installed";
    made::write_frames(folder.path("a.#.png"), {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    folder.write("stereo.wav", made::wav(2, 1.0));
    folder.write("field.wav", made::wav(4, 1.0));
    folder.write("font.ttf", "no font");
    folder.write("words.srt",
                 "1\n00:00:00,100 --> 00:00:00,400\nHello\n\n2\n00:00:00,500 --> 00:00:00,900\n<i>World</i>\n");
    folder.write("tags.txt",
                 ";FFMETADATA1\ntitle=A title\nartist=Ada\ndirector=Grace\nlocation=+37.1-122.2/\n"
                 "creation_time=2021-02-03T04:05:06Z\n[CHAPTER]\nTIMEBASE=1/1000\nSTART=0\nEND=500\ntitle=First\n"
                 "[CHAPTER]\nTIMEBASE=1/1000\nSTART=500\nEND=1000\ntitle=Second\n");
    run("-f lavfi -i color=red:s=16x16 -frames:v 1 " + folder.path("cover.jpg"));
    run("-f lavfi -i testsrc2=s=128x128:r=10:d=1 -pix_fmt yuv420p " + folder.path("pictures.mp4"));
  }

  void run(const std::string& words) const { output_of("ffmpeg -v error -y " + words + " 2>&1"); }

  // The pictures, the sounds, two subtitles, chapters and tags, with more options.
  std::string source(const std::string& name, const std::string& sounds, const std::string& words) const {
    std::string inputs = "-i " + folder.path("pictures.mp4"), maps = " -map 0:v";
    int last = 1;
    std::istringstream files(sounds + " words.srt words.srt");
    for (std::string each; files >> each; last++) {
      inputs += " -i " + folder.path(each);
      maps += fmt::format(" -map {}", last);
    }
    inputs += " -i " + folder.path("tags.txt");
    run(inputs + maps + fmt::format(" -map_metadata {0} -map_chapters {0} -c:v copy ", last) + words + " " +
        folder.path(name));
    return folder.path(name);
  }

  // A new video of ten other pictures, with all that the old one has.
  std::string keep(const std::string& old, const std::string& name, KeepOptions keep = {}) {
    const FrameFiles files = find_frames(folder.path("a.#.png"));
    EncodeOptions options;
    options.rate = {10, 1};
    keep.path = old;
    keep.track = 1;
    keep.tell = [this](const std::string& words) { told += words + "\n"; };
    options.keep = keep;
    told.clear();
    make_video(files, plan_video(files, {}, {}), {0.0f, ToneCurve::kLinear}, options, folder.path(name));
    return folder.path(name);
  }

  std::string probe(const std::string& video, const std::string& words) const {
    // Side data of streams are lines of their own, without what was asked for.
    return output_of("ffprobe -v error -of compact=p=0:nk=1 " + words + " " + video + " | sed -e 's/|*$//' -e '/^$/d'");
  }
  std::string streams(const std::string& video) const {
    return probe(video, "-show_entries stream=codec_name:stream_tags=language");
  }
  std::string chapters(const std::string& video) const {
    return probe(video, "-show_chapters -show_entries chapter=start_time,end_time:chapter_tags=title");
  }
  std::string packets(const std::string& video, const std::string& stream) const {
    return output_of("ffmpeg -v error -i " + video + " -map " + stream + " -c copy -f framemd5 - | grep -v '^#'");
  }
  std::string text(const std::string& video, int index) const {
    return output_of(fmt::format("ffmpeg -v error -i {} -map 0:s:{} -f srt -", video, index));
  }

  TemporaryFolder folder;
  std::string told;
};

constexpr const char* kLanguages =
    "-metadata:s:a:0 language=eng -metadata:s:a:1 language=jpn -metadata:s:s:0 language=fra -metadata:s:s:1 "
    "language=ita ";

TEST_F(KeptTracksTest, BoxesKeepAllThatBoxesHave) {
  for (const char* extension : {"mp4", "mov"}) {
    const std::string old =
        source(fmt::format("old.{}", extension), "stereo.wav field.wav",
               std::string(kLanguages) + "-c:a:0 aac -c:a:1 ac3 -c:s mov_text -timecode 01:00:00:00");
    const std::string made = keep(old, fmt::format("new.{}", extension));
    EXPECT_EQ(told, "");
    EXPECT_EQ(streams(made), streams(old));
    EXPECT_NE(streams(made).find("jpn"), std::string::npos);
    EXPECT_EQ(chapters(made), chapters(old));
    EXPECT_NE(chapters(made).find("Second"), std::string::npos);
    for (const char* stream : {"0:a:0", "0:a:1", "0:s:0", "0:s:1"}) {
      EXPECT_EQ(packets(made, stream), packets(old, stream)) << stream;
      EXPECT_NE(packets(made, stream), "") << stream;
    }
    const std::string tags = "-show_entries format_tags=title,artist,location,creation_time:stream_tags=timecode";
    EXPECT_EQ(probe(made, tags), probe(old, tags));
    EXPECT_NE(probe(made, tags).find("01:00:00:0"), std::string::npos);
    EXPECT_NE(probe(made, tags).find("37.1"), std::string::npos);
    if (!is_installed("exiftool")) continue;
    const std::string ask =
        "exiftool -G1 -a -s -UserData:all -ItemList:all -QuickTime:CreateDate -api largefilesupport=1 ";
    const auto sorted = [](const std::string& command) { return output_of(command + " | sort"); };
    EXPECT_EQ(sorted(ask + made), sorted(ask + old));
  }
}

// Boxes that libavformat does not support, a maker's note, an XMP packet and a cover, are copied box by box.
TEST_F(KeptTracksTest, UnknownBoxesGoOver) {
  if (!is_installed("exiftool")) GTEST_SKIP() << "skipped: exiftool is not installed";
  const std::string old = source("old.mp4", "stereo.wav", "-c:a aac -c:s mov_text");
  output_of("exiftool -q -overwrite_original -Keys:Make=Maker -UserData:Model=Camera -XMP:Rating=4 '-CoverArt<=" +
            folder.path("cover.jpg") + "' " + old + " 2>&1");
  const std::string ask = "exiftool -s3 -Keys:Make -UserData:Model -XMP:Rating ";
  ASSERT_EQ(output_of(ask + old), "Maker\nCamera\n4\n");
  EXPECT_EQ(output_of(ask + keep(old, "new.mp4")), "Maker\nCamera\n4\n");
  EXPECT_EQ(told, "");
  keep(old, "new.mkv");
  EXPECT_NE(told.find("box"), std::string::npos) << told;
}

TEST_F(KeptTracksTest, MatroskaKeepsFontsAndCovers) {
  const std::string old =
      source("old.mkv", "stereo.wav stereo.wav",
             std::string(kLanguages) +
                 "-c:a:0 libopus -c:a:1 flac -c:s:0 srt -c:s:1 ass -metadata:s:a:1 title=Comments "
                 "-attach " +
                 folder.path("font.ttf") + " -metadata:s:t:0 mimetype=application/x-truetype-font -attach " +
                 folder.path("cover.jpg") + " -metadata:s:t:1 mimetype=image/jpeg -metadata:s:t:1 filename=cover.jpg");
  const std::string made = keep(old, "new.mkv");
  EXPECT_EQ(told, "");
  EXPECT_EQ(streams(made), streams(old));
  for (const char* tag : {"format_tags=title", "format_tags=ARTIST", "format_tags=DIRECTOR", "format_tags=LOCATION",
                          "stream_tags=title", "stream_tags=filename"}) {
    const std::string ask = std::string("-show_entries ") + tag;
    EXPECT_EQ(probe(made, ask), probe(old, ask));
    EXPECT_NE(probe(made, ask), "") << tag;
  }
  EXPECT_NE(text(made, 1).find("World"), std::string::npos);

  keep(old, "new.mp4");  // a format without a place for some of it
  for (const char* words : {"font.ttf) is lost", "tag DIRECTOR (Grace)", "title (Comments) of stream 2"}) {
    EXPECT_NE(told.find(words), std::string::npos) << words << " in " << told;
  }
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 3) << told;
  EXPECT_NE(probe(folder.path("new.mp4"), "-show_entries stream=codec_name").find("mjpeg"), std::string::npos);
}

TEST_F(KeptTracksTest, OtherContainersHaveOtherKinds) {
  const std::string old = source("old.mov", "stereo.wav",
                                 "-metadata:s:a:0 language=eng -c:a pcm_s16le -c:s mov_text -timecode 01:00:00:00");
  const std::string made = keep(old, "new.mp4");
  EXPECT_NE(told.find("sound (stream 1, pcm_s16le, eng) is encoded again"), std::string::npos) << told;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  EXPECT_NE(streams(made).find("aac|eng"), std::string::npos) << streams(made);

  const std::string other = keep(old, "new.mkv");
  EXPECT_NE(streams(other).find("subrip"), std::string::npos) << streams(other);
  EXPECT_EQ(text(other, 0), text(old, 0));
  EXPECT_NE(text(other, 0).find("World"), std::string::npos);
  EXPECT_NE(probe(other, "-show_entries stream_tags=TIMECODE").find("01:00:00:0"), std::string::npos);
}

TEST_F(KeptTracksTest, APartHasItsOwnTimes) {
  const std::string old = source("old.mp4", "stereo.wav", "-c:a aac -c:s mov_text -timecode 01:00:00:00");
  KeepOptions half;
  half.cut = {0.3, 0.5, true};
  const std::string made = keep(old, "new.mp4", half);
  EXPECT_EQ(chapters(made), "0.000000|0.200000|First\n0.200000|0.500000|Second\n");
  const std::string words = text(made, 0);
  EXPECT_NE(words.find("00:00:00,000 --> 00:00:00,100\nHello"), std::string::npos) << words;
  EXPECT_NE(words.find("00:00:00,200 --> 00:00:00,500\n<i>World"), std::string::npos) << words;
  EXPECT_NE(probe(made, "-show_entries stream_tags=timecode").find("01:00:00:3"), std::string::npos);
}

// The share of the first channel in each channel.
std::vector<double> levels(const std::string& video) {
  const std::string bytes = output_of("ffmpeg -v error -i " + video + " -map 0:a:0 -f f32le -");
  std::vector<double> sums(4, 0.0);
  std::vector<float> samples(bytes.size() / 4);
  std::memcpy(samples.data(), bytes.data(), 4 * samples.size());
  for (size_t i = 9600; i + 9604 < samples.size(); i += 4) {
    for (size_t c = 0; c < 4; c++) sums[c] += static_cast<double>(samples[i]) * static_cast<double>(samples[i + c]);
  }
  for (size_t c = 4; c-- > 0;) sums[c] /= sums[0];
  return sums;
}

// A source 30 degrees to the left; the view turns by 60 degrees to the right.
TEST_F(KeptTracksTest, AmbisonicsTurnWithTheView) {
  run("-f lavfi -i 'aevalsrc=0.4*sin(2764*t)|0.2*sin(2764*t)|0|0.3464*sin(2764*t):d=1:s=48000:c=4.0' -c:a pcm_s24le " +
      folder.path("field.wav"));
  KeepOptions turned;
  turned.turn = [](double) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), glm::radians(60.0), glm::dvec3(0.0, 1.0, 0.0)));
  };
  const std::string opus = source("old.mkv", "field.wav", "-c:a libopus -mapping_family 2 -b:a 512k -c:s srt");
  source("plain.mp4", "field.wav", "-c:a aac -b:a 512k -c:s mov_text");
  OtherTags tags;
  tags.sound = {Ambisonics()};
  tag_video(folder.path("plain.mp4"), folder.path("old.mp4"), 1, SphericalMetadata(), tags);
  for (const std::string name : {"mp4", "mkv"}) {
    const std::string old = folder.path("old." + name), made = keep(old, "new." + name, turned);
    EXPECT_NE(told.find("turns with the picture"), std::string::npos) << told;
    const std::vector<double> before = levels(old), after = levels(made);
    EXPECT_NEAR(before[1], 0.5, 0.01) << name;
    EXPECT_NEAR(before[3], 0.866, 0.01) << name;
    EXPECT_NEAR(after[1], 1.0, 0.01) << name;
    EXPECT_NEAR(after[3], 0.0, 0.01) << name;
    EXPECT_EQ(read_video_file(made).sound.at(0).ambisonics.has_value(), name == "mp4");
  }
  keep(folder.path("plain.mp4"), "new.mp4", turned);
  EXPECT_NE(told.find("is not rotated with the picture"), std::string::npos) << told;
}

}  // namespace
}  // namespace ods
