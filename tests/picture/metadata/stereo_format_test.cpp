// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The sources of a picture's format: attributes, sidecars, GPano, names and shapes; and the guesses that are reported.
#include "ods/picture/metadata/stereo_format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"
#include "tests/support/temporary_folder.h"

namespace ods::stereo_format_test {

PictureRows grey(const std::vector<int>& eyes, Extent eye) {
  PictureRows rows;
  rows.eye = eye;
  rows.eyes = eyes;
  rows.layers = {{{"R", "G", "B"}, LayerRule::kLight, SampleType::kHalf}};
  rows.fill = [](int, int, std::span<float> row) { std::fill(row.begin(), row.end(), 0.5f); };
  return rows;
}

// Numbers that no short decimal is.
StereoCamera strange_rig() {
  StereoCamera stereo;
  stereo.position = vec3(1.0f / 3.0f, -2.0f / 7.0f, 1e-7f);
  stereo.yaw = 100.0f / 3.0f;
  stereo.pitch = -1.0f / 9.0f;
  stereo.roll = 170.0f / 11.0f;
  stereo.ipd = 0.0631f;
  stereo.top = {kMergeCosine, 100.0f / 3.0f, 250.0f / 3.0f, 1.0f / 3.0f};
  stereo.bottom = {kMergePower, 10.0f / 7.0f, 89.9f, 2.1f};
  stereo.convergence = kToeIn;
  stereo.convergence_distance = 10.0f / 3.0f;
  stereo.neck = 0.1f / 3.0f;
  stereo.axis = vec3(0.1f, 1.0f / 3.0f, -0.7f);
  stereo.lens_radius = 0.01f / 3.0f;
  stereo.focus_distance = 7.0f / 3.0f;
  stereo.mirrored = true;
  return stereo;
}

// A sidecar's text has every number, bit for bit.
std::string text_of(const StereoCamera& stereo) {
  return write_sidecar({stereo, {}, Layout::kTopBottom, {kMono}});
}

TEST(Metadata, EveryCameraComesBackBitForBitFromAnExr) {
  for (const NamedProjection& named : named_projections()) {
    for (bool plain : {true, false}) {
      StereoCamera stereo = plain ? StereoCamera() : strange_rig();
      stereo.projection = named.setting;
      if (!plain && has_range(named.setting.kind)) {
        stereo.projection.longitude = vec2(-100.0f / 3.0f, 170.1f);
        stereo.projection.latitude = vec2(-50.0f / 7.0f, 80.3f);
      }
      if (!plain && has_lens(named.setting.kind)) {
        if (has_fov(named.setting.kind)) stereo.projection.fov = 400.0f / 3.0f;
        stereo.projection.pan = 1.0f / 3.0f;
        stereo.projection.tilt = -20.0f / 3.0f;
        if (named.setting.kind == kPerspective) stereo.projection.aspect = 16.0f / 9.0f;
        if (named.setting.kind == kFisheyePolynomial) {
          stereo.projection.sensor = vec2(70.0f / 3.0f, 10.0f);
          stereo.projection.polynomial = {-1e-5f / 3.0f, -0.1f / 3.0f, -1e-4f / 7.0f, -1e-7f / 3.0f, -1e-9f / 3.0f};
        }
      }
      const TemporaryFolder folder;
      save_picture(grey({kLeft, kRight}, {24, 24}), &stereo, {}, folder.path("a.exr"));
      const StoredPicture picture = open_picture(folder.path("a.exr"));
      EXPECT_EQ(text_of(picture.camera), text_of(stereo)) << named.name;
      EXPECT_TRUE(picture.guesses.empty()) << named.name << ::testing::PrintToString(picture.guesses);
    }
  }
}

TEST(Metadata, EveryMergeAndConvergenceComesBack) {
  const TemporaryFolder folder;
  for (int merge : kMerges) {
    StereoCamera stereo;
    stereo.top.mode = merge;
    if (merge == kMergeMap) stereo.merge_map = std::make_shared<Image>(2, 1, 1);
    save_picture(grey({kMono}, {16, 8}), &stereo, {}, folder.path("a.exr"));
    std::vector<std::string> warnings;
    const auto read = camera_of(read_info(folder.path("a.exr")), warnings);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->top.mode, merge);
    EXPECT_TRUE(warnings.empty());
  }
  for (int convergence : kConvergences) {
    StereoCamera stereo;
    stereo.convergence = convergence;
    save_picture(grey({kMono}, {16, 8}), &stereo, {}, folder.path("a.exr"));
    EXPECT_EQ(open_picture(folder.path("a.exr")).camera.convergence, convergence);
  }
}

// A merge by depth is a curve, which the file itself keeps; one that varies around needs its sidecar.
TEST(Metadata, AMergeThatIsTheSameAllAroundIsInTheFile) {
  const TemporaryFolder folder;
  StereoCamera stereo;
  auto map = std::make_shared<Image>(4, 3, 1);
  for (size_t i = 0; i < map->pixels.size(); i++)
    map->pixels[i] = i / 4 == 1 ? 1.0f : 0.1f + 0.2f * static_cast<float>(i / 4);
  stereo.merge_map = map;
  stereo.top.mode = stereo.bottom.mode = kMergeMap;
  save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, {}, folder.path("a.exr"));
  const StoredPicture back = open_picture(folder.path("a.exr"));
  EXPECT_EQ(back.camera.top.mode, kMergeMap);
  ASSERT_TRUE(back.camera.merge_map);
  EXPECT_TRUE(same_map(back.camera.merge_map, stereo.merge_map));
  FileInfo info = read_info(folder.path("a.exr"));
  EXPECT_FALSE(lacks_merge_map(info, back.camera));
  for (const char* bad : {"4x3: 0.1 1", "4x3: 0.1 1 2", "4x3: 0.1 1 nan", "4x3: 0.1 1 0.5 ", "0x3: 1 1 1", "4x99999: 1",
                          "4x3:", "", "4x3: 0.1,1,0.5"}) {
    info.text["ods:mergeCurve"] = bad;
    std::vector<std::string> warnings;
    EXPECT_FALSE(camera_of(info, warnings)) << bad;
    ASSERT_EQ(warnings.size(), 1u) << bad;
    EXPECT_NE(warnings[0].find("ods:mergeCurve"), std::string::npos) << warnings[0];
  }

  auto uneven = std::make_shared<Image>(*map);
  uneven->pixels[0] = 0.0f;
  stereo.merge_map = uneven;
  save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, {}, folder.path("b.exr"));
  const StoredPicture without = open_picture(folder.path("b.exr"));
  EXPECT_FALSE(without.camera.merge_map);
  EXPECT_EQ(without.camera.top.mode, kMergeNone);
  EXPECT_TRUE(lacks_merge_map(read_info(folder.path("b.exr")), without.camera));
}

// An EXR names a map; the sidecar has it.
TEST(Metadata, AHeadTiltMapComesBackFromTheSidecar) {
  const TemporaryFolder folder;
  StereoCamera stereo;
  auto map = std::make_shared<Image>(2, 1, 1);
  map->pixels = {0.25f, 0.7f};
  stereo.head_tilt_map = map;
  for (const char* name : {"a.exr", "a.png"}) {
    SaveOptions options;
    options.sidecar = true;
    save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, options, folder.path(name));
    EXPECT_EQ(text_of(open_picture(folder.path(name)).camera), text_of(stereo)) << name;
    std::filesystem::remove(folder.path("a.camera.json"));
    const StoredPicture alone = open_picture(folder.path(name));
    EXPECT_EQ(alone.camera.head_tilt_map, nullptr);
    const bool is_declared = std::any_of(alone.guesses.begin(), alone.guesses.end(), [](const std::string& guess) {
      return guess == "its head-tilt map is in a sidecar that is missing: using a level head";
    });
    EXPECT_EQ(is_declared, name == std::string("a.exr")) << ::testing::PrintToString(alone.guesses);
  }
}

// A sidecar of an earlier render supplies only the map that the file names.
TEST(Metadata, AnExrComesBeforeItsStaleSidecarWithAMap) {
  const TemporaryFolder folder;
  StereoCamera old, stereo;
  auto map = std::make_shared<Image>(2, 1, 1);
  map->pixels = {0.25f, 0.7f};
  old.merge_map = map, old.ipd = 0.03f;
  old.top.mode = old.bottom.mode = kMergeMap;
  SaveOptions with_sidecar;
  with_sidecar.sidecar = true;
  save_picture(grey({kLeft, kRight}, {16, 8}), &old, with_sidecar, folder.path("a.exr"));
  save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, {}, folder.path("a.exr"));
  const StereoCamera plain = open_picture(folder.path("a.exr")).camera;
  EXPECT_EQ(plain.ipd, stereo.ipd);
  EXPECT_EQ(plain.top.mode, kMergeNone);
  EXPECT_EQ(plain.merge_map, nullptr);
  stereo.merge_map = map, stereo.bottom.mode = kMergeMap;
  save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, {}, folder.path("a.exr"));
  const StereoCamera mapped = open_picture(folder.path("a.exr")).camera;
  EXPECT_EQ(mapped.ipd, stereo.ipd);
  EXPECT_EQ(mapped.top.mode, kMergeNone);
  EXPECT_TRUE(same_map(mapped.merge_map, map));
}

TEST(Metadata, InvalidAttributesAreIgnoredAndReported) {
  FileInfo info;
  info.text["ods:projection"] = "lat-long";
  std::vector<std::string> warnings;
  EXPECT_TRUE(camera_of(info, warnings));
  const std::pair<const char*, std::vector<float>> bad[] = {{"ods:ipd", {-1.0f}},
                                                            {"ods:ipd", {1.0f, 2.0f}},
                                                            {"ods:yaw", {NAN}},
                                                            {"ods:latitude", {-91.0f, 0.0f}},
                                                            {"ods:longitude", {90.0f, 0}},
                                                            {"ods:axis", {0, 0, 0}},
                                                            {"ods:position", {1e30f, 0, 0}},
                                                            {"ods:lens", {0.1f, 0.0f}}};
  for (const auto& [name, values] : bad) {
    FileInfo worse = info;
    worse.numbers[name] = values;
    EXPECT_FALSE(camera_of(worse, warnings)) << name;
  }
  EXPECT_EQ(warnings.size(), std::size(bad));
  EXPECT_EQ(warnings[0], "its ods:ipd is invalid: ignoring its camera metadata");
  FileInfo tilted = info;
  tilted.text["ods:headTilt"] = "steep";
  EXPECT_FALSE(camera_of(tilted, warnings));
  info.text["ods:projection"] = "mercator";
  EXPECT_FALSE(camera_of(info, warnings));
  EXPECT_FALSE(camera_of(FileInfo(), warnings));
}

TEST(Gpano, ComesBackFromEveryFormatThatHasIt) {
  for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
    const TemporaryFolder folder;
    StereoCamera stereo;
    stereo.yaw = 30.0f;
    stereo.pitch = -10.0f;
    stereo.roll = 5.0f;
    save_picture(grey({kMono}, {66, 33}), &stereo, {}, folder.path(name));
    StoredPicture picture = open_picture(folder.path(name));
    EXPECT_TRUE(is_full_lat_long(picture.camera.projection)) << name;
    EXPECT_EQ(picture.camera.yaw, 30.0f);
    EXPECT_EQ(picture.camera.pitch, -10.0f);
    EXPECT_EQ(picture.camera.roll, 5.0f);
    stereo.projection = find_projection("vr180")->setting;
    stereo.projection.latitude = vec2(-45.0f, 90.0f);
    save_picture(grey({kMono}, {64, 48}), &stereo, {}, folder.path(name));
    picture = open_picture(folder.path(name));
    EXPECT_EQ(picture.camera.projection.longitude, vec2(-90.0f, 90.0f)) << name;
    EXPECT_EQ(picture.camera.projection.latitude, vec2(-45.0f, 90.0f)) << name;
  }
  const std::string elements =
      "<rdf:Description><GPano:ProjectionType>equirectangular</GPano:ProjectionType>"
      "<GPano:PoseHeadingDegrees>12.5</GPano:PoseHeadingDegrees></rdf:Description>";
  ASSERT_TRUE(gpano_camera(elements));
  EXPECT_EQ(gpano_camera(elements)->yaw, 12.5f);
  EXPECT_FALSE(gpano_camera("<GPano:ProjectionType>cylindrical</GPano:ProjectionType>"));
  EXPECT_FALSE(gpano_camera(""));
  EXPECT_FALSE(gpano_camera("GPano:ProjectionType=\"equirect"));
  EXPECT_FALSE(
      gpano_camera("GPano:ProjectionType='equirectangular' GPano:FullPanoWidthPixels='10' "
                   "GPano:CroppedAreaLeftPixels='0' GPano:CroppedAreaImageWidthPixels='900'"));
}

TEST(Sidecar, SaysWhatTheFileDoesNot) {
  const TemporaryFolder folder;
  SaveOptions options;
  options.sidecar = true;
  for (const char* name : {"a.png", "a_%V.png"}) {
    const StereoCamera stereo = strange_rig();
    options.layout = Layout::kCrossEyed;
    save_picture(grey({kLeft, kRight}, {16, 16}), &stereo, options, folder.path(name));
    const StoredPicture picture = open_picture(folder.path(name));
    EXPECT_EQ(picture.eyes.size(), 2u);
    EXPECT_EQ(picture.layout, names_eye(name) ? Layout::kSeparate : Layout::kCrossEyed) << name;
    EXPECT_EQ(text_of(picture.camera), text_of(stereo));
    EXPECT_TRUE(picture.guesses.empty());
  }
  OpenOptions known;
  known.format.layout = Layout::kSeparate;
  known.format.camera = StereoCamera();
  known.format.projection = find_projection("fisheye")->setting;
  const StoredPicture asked = open_picture(folder.path("a.png"), known);
  EXPECT_EQ(asked.eyes.size(), 1u);
  EXPECT_EQ(asked.camera.yaw, 0.0f);
  EXPECT_EQ(asked.camera.projection.kind, kFisheye);

  const StereoCamera stereo;
  save_picture(grey({kRight}, {16, 8}), &stereo, options, folder.path("one.png"));
  EXPECT_EQ(open_picture(folder.path("one.png")).eyes[0].eye, kRight);
  save_picture(grey({kLeft}, {16, 8}), nullptr, {}, folder.path("two.exr"));
  EXPECT_EQ(open_picture(folder.path("two.exr")).eyes[0].eye, kLeft);
}

TEST(Sidecar, OfAnotherPictureIsLeftOut) {
  const TemporaryFolder folder;
  const StereoCamera stereo = strange_rig();
  SaveOptions options;
  save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, options, folder.path("a.png"));
  options.sidecar = true;
  options.layout = Layout::kMultiview;
  save_picture(grey({kLeft, kRight}, {16, 16}), &stereo, options, folder.path("a.exr"));
  const StoredPicture picture = open_picture(folder.path("a.png"));
  EXPECT_EQ(picture.layout, Layout::kTopBottom);
  EXPECT_EQ(picture.camera.yaw, 0.0f);
  EXPECT_NE(picture.guesses[0].find("belong to another picture"), std::string::npos) << picture.guesses[0];
}

TEST(Sidecar, OfAPictureThatIsGoneIsWrittenAnew) {
  const TemporaryFolder folder;
  StereoCamera stereo;
  SaveOptions options;
  options.sidecar = true;
  save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, options, folder.path("a.png"));
  stereo.yaw = 50.0f;
  options.sidecar = false;
  const auto names = save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, options, folder.path("a.png"));
  EXPECT_EQ(names.size(), 2u);
  EXPECT_EQ(open_picture(folder.path("a.png")).camera.yaw, 50.0f);
}

// Another picture of the same name and size may have written it.
TEST(Sidecar, GoesBehindTheFilesOwnCamera) {
  const TemporaryFolder folder;
  StereoCamera stereo;
  stereo.yaw = 50.0f;
  save_picture(grey({kLeft, kRight}, {16, 8}), &stereo, {}, folder.path("a.exr"));
  save_sidecar({StereoCamera(), {16, 8}, Layout::kTopBottom, {kLeft, kRight}}, folder.path("a.camera.json"));
  EXPECT_EQ(open_picture(folder.path("a.exr")).camera.yaw, 50.0f);
}

TEST(Sidecar, DamagedIsAnErrorWithARemedy) {
  const TemporaryFolder folder;
  save_picture(grey({kLeft, kRight}, {16, 8}), nullptr, {}, folder.path("a.png"));
  folder.write("a.camera.json", "{");
  try {
    open_picture(folder.path("a.png"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("fix or remove it"), std::string::npos) << error.what();
  }
  OpenOptions known;
  known.format.layout = Layout::kTopBottom;
  const StoredPicture picture = open_picture(folder.path("a.png"), known);
  EXPECT_EQ(picture.eyes.size(), 2u);
  EXPECT_NE(picture.guesses[0].find("ignored"), std::string::npos) << picture.guesses[0];
}

TEST(GuessLayout, WhatIsNoLayoutIsLeftAside) {
  FileInfo info;
  info.width = info.height = 64;
  info.is_float = true;
  info.text["ods:layout"] = "up-down";
  const StereoFormat format = find_format(info, "a_LR.png", {});
  EXPECT_EQ(format.layout.layout, Layout::kSideBySide);
  EXPECT_EQ(format.layout.source, FormatSource::kName);
  EXPECT_TRUE(is_guess(format.layout));
  EXPECT_NE(format.guesses[0].find("ods:layout is invalid"), std::string::npos) << format.guesses[0];
}

TEST(NameEnd, IsReadAsWhatThePictureShows) {
  for (const NamedProjection& named : named_projections()) {
    for (const Layout layout : kLayouts) {
      if (layout == Layout::kSeparate) continue;  // two names
      const std::string end = name_end(named.setting, layout);
      const NameWords words = read_name("a" + end);
      EXPECT_TRUE(words.layout_token.empty() || words.layout == layout) << end;
      const bool is_half = is_vr180(named.setting);
      EXPECT_EQ(words.projection_token, is_half                                                   ? "_180"
                                        : named.name == "lat-long" || is_cube(named.setting.kind) ? "_360"
                                                                                                  : "");
    }
  }
  EXPECT_EQ(name_end(find_projection("vr180")->setting, Layout::kSideBySide), "_180_LR.png");
  EXPECT_EQ(name_end(find_projection("cylinder")->setting, Layout::kMultiview), ".exr");
  EXPECT_EQ(name_end({}, Layout::kSeparate), "_360_%V.png");
  ProjectionSetting band;
  band.latitude = vec2(-45.0f, 45.0f);
  EXPECT_EQ(name_end(band, Layout::kCrossEyed), "_RL.png");
}

TEST(NameFault, IsWhatReadersWouldGetWrong) {
  const ProjectionSetting sphere, half = find_projection("vr180")->setting;
  EXPECT_NE(name_fault("y_LR.png", Layout::kTopBottom, sphere).find("_LR"), std::string::npos);
  EXPECT_NE(name_fault("y_LR.png", {}, sphere).find("one eye"), std::string::npos);
  EXPECT_NE(name_fault("y_mono.png", Layout::kTopBottom, sphere), "");
  EXPECT_NE(name_fault("y_180_TB.png", Layout::kTopBottom, find_projection("cube-3x2")->setting), "");
  for (const char* fine : {"y.png", "y_TB.png", "y_OU_360.png", "y.0180.png"}) {
    EXPECT_EQ(name_fault(fine, Layout::kTopBottom, sphere), "") << fine;
  }
  EXPECT_EQ(name_fault("y_180.png", {}, half), "");
  EXPECT_EQ(name_fault("y_LR.exr", Layout::kMultiview, sphere), "");  // its metadata record it
}

struct Guess {
  const char* name;
  Extent file;
  std::optional<Layout> layout;
  const char* projection;
  std::vector<std::string> said;
};

constexpr Layout kTb = Layout::kTopBottom, kLr = Layout::kSideBySide;
constexpr const char* kSphere = "lat-long: nothing tells what it shows, and the file has a sphere's shape";
constexpr const char* kFlat = "perspective: nothing tells what it shows, and its shape is not a sphere's";
const Guess kGuesses[] = {
    {"a.png",
     {64, 64},
     kTb,
     "lat-long",
     {"top-bottom: it has the shape of two eyes, lat-long", "lat-long: an eye has that shape"}},
    {"a.png",
     {64, 32},
     {},
     "lat-long",
     {"one eye: it has the shape of one eye, lat-long", "lat-long: an eye has that shape"}},
    {"a.png",
     {64, 29},
     {},
     "lat-long",
     {"one eye: nothing tells of two eyes",
      "lat-long: nothing tells what it shows, and its shape is nearly a sphere's"}},
    {"a.png", {64, 50}, {}, "perspective", {"one eye: nothing tells of two eyes", kFlat}},
    {"a.png", {128, 32}, kLr, "lat-long", {}},
    {"photo.png", {96, 64}, {}, "perspective", {"one eye: nothing tells of two eyes", kFlat}},
    {"photo.png", {96, 128}, {}, "perspective", {}},
    {"a.png", {96, 16}, {}, "cube-6x1", {}},
    {"a.png", {192, 16}, kLr, "cube-6x1", {}},
    {"a.png", {16, 96}, {}, "cube-1x6", {}},
    {"a.png", {16, 192}, kTb, "cube-1x6", {}},
    {"a_LR.png", {64, 32}, kLr, "lat-long", {"side-by-side: its name ends in _LR", kSphere}},
    {"a_LR.png", {64, 24}, kLr, "perspective", {"side-by-side: its name ends in _LR", kFlat}},
    {"a_180_LR.png", {64, 32}, kLr, "vr180", {"side-by-side: its name ends in _LR", "vr180: its name ends in _180"}},
    {"a_vr180.png",
     {64, 32},
     kLr,
     "vr180",
     {"side-by-side: it has the shape of two eyes, vr180", "vr180: its name ends in _vr180"}},
    {"a_180.png", {64, 64}, {}, "vr180", {}},
    {"a_180.png", {32, 64}, kTb, "vr180", {}},
    {"a_mono.png", {64, 64}, {}, "lat-long", {"one eye: its name ends in _mono", kSphere}},
    {"a_TB_360.png",
     {64, 48},
     kTb,
     "lat-long",
     {"top-bottom: its name ends in _TB", "lat-long: its name ends in _360"}},
    {"a_tb_eac.png", {96, 128}, kTb, "eac", {}},
    {"a.0180.png", {64, 32}, {}, "lat-long", {}},
    {"a.180.png", {64, 32}, {}, "lat-long", {}},
    {"a_hsbs.png",
     {64, 32},
     Layout::kSideBySideHalf,
     "lat-long",
     {"side-by-side-half: its name ends in _hsbs", "lat-long: an eye has that shape"}},
};

TEST(Guesses, AreMadeByNameThenByShapeAndReported) {
  for (const Guess& guess : kGuesses) {
    const TemporaryFolder folder;
    SCOPED_TRACE(std::string(guess.name) + " " + std::to_string(guess.file.width));
    save_picture(grey({kMono}, guess.file), nullptr, {}, folder.path(guess.name));
    const StoredPicture picture = open_picture(folder.path(guess.name));
    EXPECT_EQ(picture.eyes.size(), guess.layout ? 2u : 1u);
    EXPECT_EQ(picture.layout, guess.layout.value_or(Layout::kSeparate));
    EXPECT_EQ(projection_name(picture.camera.projection), guess.projection);
    EXPECT_TRUE(guess.said.empty() || picture.guesses == guess.said) << ::testing::PrintToString(picture.guesses);
  }
}

}  // namespace ods::stereo_format_test
