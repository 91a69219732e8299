// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods inject on videos that already have metadata, by any writer: the requested metadata change, and nothing else does.
#include <cmath>
#include <cstdio>
#include <iterator>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "ods/lint/players.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/video/container/apple.h"
#include "tests/support/cli_runner.h"
#include "tests/support/tagged_videos.h"

namespace ods::inject_test {

using namespace ods::made;
using ods::SphericalMetadata, ods::VideoProjection, ods::VideoStereo;

// --- the table -------------------------------------------------------------------------------------------------------

class InjectCommand : public Cli {
 protected:
  std::vector<Tagged> cases() const {
    std::vector<Tagged> all = videos_of_boxes();
    for (const std::vector<Tagged>& more :
         {videos_of_elements(), videos_of_ours(folder), videos_of_ffmpeg(folder), videos_of_tools(folder)}) {
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }

  static const ods::VideoTrack& largest(const ods::VideoFile& video) { return choose_track(video, {}, "the video"); }

  // In a child of this process: a program takes longer to start than to do this, and here are a thousand.
  int inject_in_child(std::vector<std::string> arguments) {
    const std::string log = folder.path("log.txt");
    const pid_t child = fork();
    if (child == 0) {
      if (!std::freopen("/dev/null", "w", stdout) || !std::freopen(log.c_str(), "w", stderr)) _exit(99);
      const int result = run_command(*find_command("inject"), {arguments.begin() + 1, arguments.end()});
      std::fflush(nullptr);
      _exit(result);
    }
    int status = 0;
    waitpid(child, &status, 0);
    err = folder.read("log.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

  // Tags the video and returns its metadata; returns nullopt, and leaves the video, if that was refused.
  std::optional<ods::VideoFile> inject(const Tagged& video, const std::string& options) {
    folder.write(video.name, video.video);
    std::istringstream words("inject " + folder.path(video.name) + " " + options);
    code = inject_in_child({std::istream_iterator<std::string>(words), {}});
    if (code == 0) return ods::read_video_file(folder.path(video.name));
    EXPECT_EQ(folder.read(video.name), video.video) << "refused is untouched";
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    return std::nullopt;
  }

  int code = 0;
};

// Each place records the form, as far as it can.
void expect_says(const std::optional<SphericalMetadata>& place, const SphericalMetadata& metadata, bool has_angles) {
  if (!place) return;
  EXPECT_TRUE(same_stereo(*place, metadata)) << metadata_text(*place);
  EXPECT_TRUE(same_sphere(*place, metadata)) << metadata_text(*place);
  if (!has_angles) return;
  EXPECT_LT(std::abs(std::remainder(place->yaw - metadata.yaw, 360.0)), 1.0) << metadata_text(*place);
  EXPECT_LT(std::abs(place->pitch - metadata.pitch), 1.0) << metadata_text(*place);
  EXPECT_LT(std::abs(place->roll - metadata.roll), 1.0) << metadata_text(*place);
}

// All places, field by field.
void expect_metadata(const ods::VideoTrack& before, const ods::VideoTrack& after, const SphericalMetadata& metadata) {
  const bool is_ordinary = metadata.stereo == VideoStereo::kOneView && metadata.projection == VideoProjection::kFlat;
  if (is_ordinary && !after.v2 && !after.v1) return;  // an ordinary video does not need metadata
  ASSERT_TRUE(after.v2) << "V1 or vexu alone get V2, too";
  SphericalMetadata said = *declared_metadata(after);
  EXPECT_EQ(said.stereo, metadata.stereo);
  EXPECT_EQ(said.projection, metadata.projection);
  if (before.v2 && same_sphere(*before.v2, metadata)) {
    EXPECT_EQ(said.bounds, metadata.bounds);
  }
  EXPECT_EQ(said.yaw, metadata.yaw);
  EXPECT_EQ(said.pitch, metadata.pitch);
  EXPECT_EQ(said.roll, metadata.roll);
  EXPECT_EQ(said.ipd, metadata.ipd);
  expect_says(after.v2, metadata, true);
  expect_says(after.v1, metadata, true);
  expect_says(after.vexu, metadata, false);
  if (before.v1 && after.v1) {
    EXPECT_EQ(after.v1->source, before.v1->source);
  }
  if (before.v2 && before.v2->projection && same_sphere(*before.v2, metadata)) {
    EXPECT_EQ(after.v2->source, before.v2->source);
  }
}

// Each option, and what it changes.
const std::tuple<const char*, void (*)(SphericalMetadata&)> kInjectOptions[] = {
    {"", [](SphericalMetadata&) {}},
    {"--apple", [](SphericalMetadata&) {}},
    {"--ambisonics", [](SphericalMetadata&) {}},
    {"--track 1", [](SphericalMetadata&) {}},
    {"--yaw 30", [](SphericalMetadata& metadata) { metadata.yaw = 30.0; }},
    {"--pitch -10", [](SphericalMetadata& metadata) { metadata.pitch = -10.0; }},
    {"--roll 4.5", [](SphericalMetadata& metadata) { metadata.roll = 4.5; }},
    {"--yaw 0 --pitch 0 --roll 0",
     [](SphericalMetadata& metadata) { metadata.yaw = metadata.pitch = metadata.roll = 0.0; }},
    {"--layout side-by-side", [](SphericalMetadata& metadata) { metadata.stereo = VideoStereo::kSideBySide; }},
    {"--layout mono", [](SphericalMetadata& metadata) { metadata.stereo = VideoStereo::kOneView, metadata.ipd = 0.0; }},
    {"--layout top-bottom", [](SphericalMetadata& metadata) { metadata.stereo = VideoStereo::kTopBottom; }},
    {"--projection flat",
     [](SphericalMetadata& metadata) {
       metadata.projection = VideoProjection::kFlat, metadata.bounds = {};
       metadata.yaw = metadata.pitch = metadata.roll = 0.0;
     }},
    {"--projection vr180",
     [](SphericalMetadata& metadata) {
       metadata.projection = VideoProjection::kEquirect, metadata.bounds = {0, 0, 0x40000000, 0x40000000};
     }},
    {"--projection cubemap",
     [](SphericalMetadata& metadata) { metadata.projection = VideoProjection::kCubemap, metadata.bounds = {}; }},
    {"--projection lat-long",
     [](SphericalMetadata& metadata) { metadata.projection = VideoProjection::kEquirect, metadata.bounds = {}; }},
};

TEST_F(InjectCommand, WhatIsNotAskedForStays) {
  for (const Tagged& each : cases()) {
    folder.write(each.name, each.video);
    const ods::VideoFile before = ods::read_video_file(folder.path(each.name));
    const SphericalMetadata said = *declared_metadata(largest(before));
    int done = 0;
    for (const auto& [words, ask] : kInjectOptions) {
      SCOPED_TRACE(each.title + " (" + each.name + "): inject " + words);
      const std::optional<ods::VideoFile> after = inject(each, words);
      SphericalMetadata requested = said;
      ask(requested);
      const std::string option = words;
      const bool is_flat_turn = said.projection == VideoProjection::kFlat && option.starts_with("--yaw") |
                                                                                 option.starts_with("--pitch") |
                                                                                 option.starts_with("--roll");
      const bool has_boxes = ods::has_boxes(before.container);
      const bool cannot = (option == "--apple" && (!has_boxes || !ods::fits_vexu(said))) || is_flat_turn ||
                          (option == "--ambisonics" && (before.sound.empty() || !has_boxes));
      EXPECT_EQ(code != 0, cannot) << err;
      if (!after || cannot) continue;
      done++;
      const ods::VideoTrack &old = largest(before), &now = largest(*after);
      if (!now.vexu) requested.ipd = 0.0;  // it has no other place
      expect_metadata(old, now, requested);
      EXPECT_EQ(now.vexu.has_value(), (old.vexu && ods::fits_vexu(requested)) || option == "--apple");
      const bool is_reformed = !same_stereo(requested, said) || !same_sphere(requested, said);
      EXPECT_TRUE(now.v1 || !old.v1 || is_reformed);
      const std::string bytes = folder.read(each.name);
      for (const std::string& kept : each.kept) EXPECT_TRUE(is_reformed || bytes.find(kept) != std::string::npos);
      if (before.sound.size() == 1 && before.sound[0].ambisonics) {
        EXPECT_TRUE(after->sound.at(0).ambisonics);
        EXPECT_EQ(bytes.find(number(3, 4) + number(2, 4) + number(1, 4)) != std::string::npos,
                  option != "--ambisonics");
      }
      if (has_boxes && each.name != "ffmpeg.mp4") {
        EXPECT_EQ(ods::made::words(bytes), ods::made::words(each.video));
      }
    }
    EXPECT_GE(done, 4) << each.title;
  }
}

// The output of our own commands is complete: there is nothing to add.
TEST_F(InjectCommand, AVideoThatSaysAllIsTheSameBytesAfterwards) {
  for (const Tagged& each : videos_of_ours(folder)) {
    ASSERT_TRUE(inject(each, "")) << err;
    EXPECT_TRUE(folder.read(each.name) == each.video) << each.title;
  }
}

TEST_F(InjectCommand, ATrackThatIsNotMeantStays) {
  ods::made::Mp4Options options;
  options.entry_boxes = st3d(2) + sv3d("x", kHalf);
  options.widths = {256, 512};
  const Tagged video{"", "video.mp4", ods::made::mp4(options), {}};
  ASSERT_TRUE(inject(video, "--yaw 5 --layout mono --projection lat-long")) << err;
  const ods::VideoFile after = ods::read_video_file(folder.path("video.mp4"));
  EXPECT_EQ(metadata_text(*after.tracks.at(0).v2), "side-by-side, lat-long 180x180");
  EXPECT_EQ(metadata_text(*after.tracks.at(1).v2), "mono, lat-long, turned by 5,0,0");
}

TEST_F(InjectCommand, VexuKeepsWhatIsNoneOfOurBusiness) {
  const Tagged video = boxes("", 512, 256, st3d(2) + sv3d("x", kHalf) + vexu(3, "hequ", "side"));
  ASSERT_TRUE(inject(video, "--layout cross-eyed")) << err;
  EXPECT_NE(err.find("its vexu metadata, side-by-side"), std::string::npos) << err;
  const std::string bytes = folder.read("video.mp4");
  EXPECT_NE(bytes.find(box("hero", std::string("\0\0\0\0\2", 5))), std::string::npos);
  EXPECT_NE(bytes.find("dadj"), std::string::npos);
  EXPECT_EQ(ods::read_video_file(folder.path("video.mp4")).tracks.at(0).vexu->ipd, 0.0635);
}

TEST_F(InjectCommand, AV1InTheTagsOfMatroskaIsTurnedOrTakenOut) {
  const std::string turned = element(0x53b8, number(3, 1)) + element(0x7670, element(0x7671, number(1, 1)));
  ods::made::MatroskaOptions options;
  options.video = turned;
  const std::string targets = element(0x63c0, element(0x63c5, number(7, 1)));
  const std::string words = element(0x45a3, "SPHERICAL-VIDEO") + element(0x4487, v1("top-bottom"), 2);
  std::string bytes = ods::made::matroska(options);
  const ods::made::Piece segment = ods::made::pieces(bytes, {0x18538067}).at(0);
  bytes += element(0x1254c367, element(0x7373, targets + element(0x67c8, words, 2), 2), 2);
  bytes.replace(segment.begin - 8, 8, number((uint64_t{1} << 56) | (bytes.size() - segment.begin), 8));
  const Tagged video{"", "video.mkv", bytes, {}};
  for (const auto& [option, yaw] : {std::pair<const char*, double>{"", 0.0}, {"--yaw 40", 40.0}}) {
    const std::optional<ods::VideoFile> after = inject(video, option);
    ASSERT_TRUE(after && after->tracks.at(0).v1) << err;
    EXPECT_EQ(after->tracks[0].v1->yaw, yaw);
    EXPECT_EQ(after->tracks[0].v1->source, "Spherical Metadata Tool");
  }
  const std::optional<ods::VideoFile> after = inject(video, "--layout mono");
  ASSERT_TRUE(after);
  EXPECT_FALSE(after->tracks.at(0).v1);
}

// --- contradictions --------------------------------------------------------------------------------------------------

TEST_F(InjectCommand, WhatContradictsTheVideoNeedsAWord) {
  struct Contradiction {
    const char* name;
    int width, height;
    std::string entry, track;
    const char* words;
    const char* options;
  };
  const std::string tb = st3d(1) + sv3d("x", kWhole), half = st3d(2) + sv3d("x", kHalf);
  const Contradiction kCases[] = {
      {"a_360_LR.mp4", 256, 256, tb, "", "its metadata specifies top-bottom, but its name ends in _LR",
       "--layout top-bottom or --layout side-by-side"},
      {"a_180_LR.mp4", 256, 256, st3d(2) + sv3d("x", kWhole), "",
       "its metadata specifies lat-long, but its name ends in _180", "--projection lat-long or --projection vr180"},
      {"a_360_LR.mp4", 512, 256, half, "", "its metadata specifies lat-long 180x180, but its name ends in _360",
       "--projection vr180 or --projection lat-long"},
      {"a_360_TB.mp4", 256, 256, st3d(1), "", "its metadata specifies flat, but its name ends in _360",
       "--projection flat or --projection lat-long"},
      {"a.mp4", 256, 256, "", v1_box("mono"),
       "its metadata specifies mono, lat-long, which does not fit 256x256 pixels",
       "--layout mono or --layout top-bottom"},
  };
  for (const auto& [name, width, height, entry, track, words, options] : kCases) {
    Tagged video = boxes("", width, height, entry, track);
    video.name = name;
    EXPECT_FALSE(inject(video, ""));
    EXPECT_EQ(code, 3);
    EXPECT_NE(err.find(words), std::string::npos) << err;
    EXPECT_NE(err.find(options), std::string::npos) << err;
    const std::string text = options;  // each of them settles it
    const size_t middle = text.find(" or ");
    EXPECT_TRUE(inject(video, text.substr(0, middle))) << err;
    EXPECT_TRUE(inject(video, text.substr(middle + 4))) << err;
    EXPECT_EQ(run("probe " + folder.path(name)), 0);
  }
}

// Decoders like 16:9: many videos have both spheres squeezed into it.
TEST_F(InjectCommand, EyesSqueezedInto16To9DoNotContradictTheVideo) {
  for (const auto& [width, height] : {std::pair{1920, 1080}, std::pair{3840, 2160}}) {
    EXPECT_TRUE(inject(boxes("", width, height, "", v1_box("top-bottom")), "")) << err;
    EXPECT_EQ(err.find("which does not fit"), std::string::npos) << err;
  }
}

// Its sidecar is another witness.
TEST_F(InjectCommand, ASidecarThatContradictsTheVideoNeedsAWord) {
  const Tagged video = boxes("", 256, 256, st3d(1) + sv3d("x", kWhole), v1_box("top-bottom"));
  ods::Sidecar sidecar;
  sidecar.layout = ods::Layout::kSideBySide;
  ods::save_sidecar(sidecar, folder.path("video.camera.json"));
  EXPECT_FALSE(inject(video, ""));
  EXPECT_EQ(code, 3);
  EXPECT_NE(err.find("its metadata specifies top-bottom, but its sidecar disagrees"), std::string::npos) << err;
  EXPECT_TRUE(inject(video, "--yaw 30")) << "which writes no layout anew";
  EXPECT_NE(err.find("warning: its metadata specifies top-bottom"), std::string::npos) << err;
  EXPECT_TRUE(inject(video, "--layout top-bottom")) << err;
}

// All of it goes, and nothing else.
TEST_F(InjectCommand, RemovingTakesAllWordsOut) {
  for (const Tagged& each : cases()) {
    SCOPED_TRACE(each.title + " " + each.name);
    folder.write(each.name, each.video);
    const bool has_layers = largest(ods::read_video_file(folder.path(each.name))).layers.has_value();
    const std::optional<ods::VideoFile> after = inject(each, "--remove");
    ASSERT_TRUE(after) << err;
    const ods::VideoTrack& track = largest(*after);
    EXPECT_FALSE(track.v1 || track.v2);
    EXPECT_EQ(track.vexu.has_value(), has_layers);
    if (ods::has_boxes(after->container) && each.name != "ffmpeg.mp4") {
      EXPECT_EQ(ods::made::words(folder.read(each.name)), ods::made::words(each.video));
    }
  }
}

// The layout is given by options or by the name. The video's own metadata, right or wrong, stay.
TEST_F(InjectCommand, AVideoThatCannotHaveTheLayoutIsRefused) {
  ods::made::Mp4Options options;
  options.widths = {64}, options.height = 33;
  const std::string odd = mp4(options);
  for (const char* words : {"--layout top-bottom", "--layout top-bottom --projection lat-long"}) {
    EXPECT_FALSE(inject({"", "odd.mp4", odd, {}}, words)) << words;
    EXPECT_EQ(code, 3);
    EXPECT_NE(err.find("odd.mp4': 64x33 pixels are not two eyes, top-bottom"), std::string::npos) << err;
  }
  EXPECT_FALSE(inject({"", "odd_360_TB.mp4", odd, {}}, "--yaw 3"));
  EXPECT_NE(err.find("64x33 pixels are not two eyes"), std::string::npos) << err;
  options.entry_boxes = st3d(1) + sv3d("", kHalf);
  EXPECT_TRUE(inject({"", "odd.mp4", mp4(options), {}}, "--yaw 3")) << err;
}

// If the contradiction does not affect the new metadata, there is only a note.
TEST_F(InjectCommand, HarmlessContradictionsAreReported) {
  Tagged video = boxes("", 256, 256, st3d(1) + sv3d("x", kWhole), v1_box("top-bottom"));
  video.name = "a_360_LR.mp4";
  for (const char* option : {"--yaw 30", "--ambisonics"}) {
    EXPECT_TRUE(inject(video, option)) << err;
    EXPECT_NE(err.find("warning: its metadata specifies top-bottom, but its name ends in _LR"), std::string::npos)
        << err;
  }
  EXPECT_FALSE(inject(video, "--apple")) << "which says the layout once more";
}

TEST_F(InjectCommand, WhatAPlaceCannotHoldIsReported) {
  const Tagged video = boxes("", 256, 256, st3d(1) + sv3d("x", kWhole) + vexu(3, "equi", "over"), v1_box("top-bottom"));
  ASSERT_TRUE(inject(video, "--projection cubemap"));
  EXPECT_NE(err.find("its V1 metadata, top-bottom, lat-long, is taken out"), std::string::npos) << err;
  EXPECT_NE(err.find("vexu cannot express top-bottom, cubemap and is taken out"), std::string::npos) << err;
  ASSERT_TRUE(inject(video, "--yaw 10.5"));
  EXPECT_NE(err.find("V1 holds whole degrees"), std::string::npos) << err;
  EXPECT_NE(err.find("vexu has no place for angles"), std::string::npos) << err;
  EXPECT_FALSE(inject(video, "--layout bottom-top"));
  EXPECT_NE(err.find("mp4 cannot express bottom-top"), std::string::npos) << err;
}

// Whatever ods probe advises, ods inject takes, and afterwards there is nothing to advise.
TEST_F(InjectCommand, ProbeAdvisesWhatInjectDoes) {
  int advised = 0;
  for (const char* name : {"video", "video_360_TB", "video_180_LR", "video_fisheye"}) {
    for (Tagged each : cases()) {
      each.name = name + each.name.substr(each.name.find('.'));
      folder.write(each.name, each.video);
      SCOPED_TRACE(each.title + " " + each.name);
      const auto warnings = [&](const ods::VideoFile& video) {
        std::string text;
        for (const std::string& each_one : video_warnings(video, largest(video), folder.path(each.name))) {
          text += each_one + "\n";
        }
        return text;
      };
      const std::string text = with_options(warnings(ods::read_video_file(folder.path(each.name))));
      const size_t advice = text.find("(ods inject ");
      if (advice == std::string::npos) continue;
      advised++;
      std::string options;
      for (const std::string mark : {"true value: ", "and "}) {  // the first choice of each
        const size_t at = text.find(mark + "--", advice);
        if (at != std::string::npos)
          options +=
              " " + text.substr(at + mark.size(), text.find_first_of(",)\n", at + mark.size()) - at - mark.size());
        if (options.find(" or ") != std::string::npos) options.resize(options.find(" or "));
      }
      if (options.empty() && text.find("another name", advice) != std::string::npos) continue;
      const std::optional<ods::VideoFile> after = inject(each, options);
      ASSERT_TRUE(after) << text << err;
      EXPECT_EQ(warnings(*after).find("(ods inject adds"), std::string::npos) << warnings(*after);
    }
  }
  EXPECT_GT(advised, 20);
}

}  // namespace ods::inject_test
