// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods inject and pictures that already have metadata: each form with each option, and only the requested fields change.
#include <gtest/gtest.h>

#include <cstdlib>

#include "ods/image/format/xmp_file.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/metadata/stereo_format.h"
#include "ods/picture/save.h"
#include "tests/support/cli_runner.h"

namespace ods::inject_picture_test {

using ods::StereoCamera;

struct Form {
  std::string name;   // of the file
  std::string title;  // the writer of its metadata
};

class InjectPicture : public Cli {
 protected:
  // One eye with a neutral name.
  void write(const std::string& name, ods::Extent size) const {
    ods::Picture picture;
    ods::EyeImage eye;
    eye.radiance = ods::Image(size.width, size.height, 3);
    for (size_t i = 0; i < eye.radiance.pixels.size(); i++) {
      eye.radiance.pixels[i] = static_cast<float>(i * 7919 % 251) / 250.0f;
    }
    picture.eyes.push_back(std::move(eye));
    save_picture(picture, {}, folder.path(name));
  }

  std::vector<Form> forms() {
    std::vector<Form> all;
    const bool has_exiftool = std::system("exiftool -ver >/dev/null 2>&1") == 0;
    for (const std::string kind : {"jpg", "png", "tif"}) {
      write("whole." + kind, {256, 128});
      EXPECT_EQ(run("inject " + folder.path("whole." + kind) +
                    " --layout mono --projection lat-long --yaw 20 --pitch 5 --roll -3"),
                0)
          << err;
      all.push_back({"whole." + kind, "ours: the whole sphere"});
      write("half." + kind, {128, 128});
      EXPECT_EQ(run("inject " + folder.path("half." + kind) + " --layout mono --projection vr180 --yaw -15"), 0) << err;
      all.push_back({"half." + kind, "ours: its front half"});
      if (!has_exiftool) continue;
      write("other." + kind, {256, 128});
      const std::string words =
          "exiftool -overwrite_original -XMP-GPano:ProjectionType=equirectangular -XMP-GPano:PoseHeadingDegrees=90 "
          "-XMP-GPano:CroppedAreaImageWidthPixels=256 -XMP-GPano:CroppedAreaImageHeightPixels=128 "
          "-XMP-GPano:FullPanoWidthPixels=256 -XMP-GPano:FullPanoHeightPixels=128 "
          "-XMP-GPano:CroppedAreaLeftPixels=0 -XMP-GPano:CroppedAreaTopPixels=0 -XMP-dc:Creator=Somebody ";
      EXPECT_EQ(std::system((words + folder.path("other." + kind) + " >/dev/null 2>&1").c_str()), 0);
      all.push_back({"other." + kind, "exiftool"});
    }
    return all;
  }
};

// Each option, and what it changes.
const std::pair<const char*, void (*)(StereoCamera&)> kOptions[] = {
    {"", [](StereoCamera&) {}},
    {"--yaw 30", [](StereoCamera& camera) { camera.yaw = 30.0f; }},
    {"--pitch -10", [](StereoCamera& camera) { camera.pitch = -10.0f; }},
    {"--roll 4.5", [](StereoCamera& camera) { camera.roll = 4.5f; }},
    {"--yaw 0 --pitch 0 --roll 0", [](StereoCamera& camera) { camera.yaw = camera.pitch = camera.roll = 0.0f; }},
};

TEST_F(InjectPicture, WhatIsNotAskedForStays) {
  for (const Form& form : forms()) {
    const std::string path = folder.path(form.name), to = folder.path("to_" + form.name);
    const std::optional<StereoCamera> said = ods::gpano_camera(ods::read_xmp(path));
    ASSERT_TRUE(said) << form.name << " " << form.title;
    for (const auto& [words, ask] : kOptions) {
      SCOPED_TRACE(form.title + " (" + form.name + "): inject " + words);
      ASSERT_EQ(run("inject " + path + " -o " + to + " " + words), 0) << err;
      const std::string xmp = ods::read_xmp(to);
      const std::optional<StereoCamera> now = ods::gpano_camera(xmp);
      ASSERT_TRUE(now);
      StereoCamera requested = *said;
      ask(requested);
      EXPECT_NEAR(std::remainder(now->yaw - requested.yaw, 360.0f), 0.0f, 1e-3f);
      EXPECT_NEAR(now->pitch, requested.pitch, 1e-3f);
      EXPECT_NEAR(now->roll, requested.roll, 1e-3f);
      EXPECT_EQ(now->projection, requested.projection);
      if (form.title != "exiftool") continue;
      EXPECT_NE(xmp.find("Somebody"), std::string::npos) << "others' words stay";
    }
  }
}

// The projection that is asked for, and only that.
TEST_F(InjectPicture, AProjectionThatIsAskedForKeepsTheOrientation) {
  for (const Form& form : forms()) {
    if (form.name.starts_with("half")) continue;
    SCOPED_TRACE(form.title + " " + form.name);
    const std::string path = folder.path(form.name);
    const std::optional<StereoCamera> said = ods::gpano_camera(ods::read_xmp(path));
    ASSERT_TRUE(said);
    ASSERT_EQ(run("inject " + path + " --projection vr180"), 0) << err;
    const std::optional<StereoCamera> now = ods::gpano_camera(ods::read_xmp(path));
    ASSERT_TRUE(now);
    EXPECT_TRUE(ods::is_vr180(now->projection));
    EXPECT_NEAR(std::remainder(now->yaw - said->yaw, 360.0f), 0.0f, 1e-3f);
    EXPECT_NEAR(now->pitch, said->pitch, 1e-3f);
    EXPECT_NEAR(now->roll, said->roll, 1e-3f);
  }
}

// Commands believe the sidecar before GPano.
TEST_F(InjectPicture, TheSidecarSaysTheSame) {
  const std::string path = folder.path("seen_360.png"), beside = "seen_360.camera.json";
  ASSERT_EQ(run("render axis --eyes mono --width 32 --samples 1 --quiet --sidecar -o " + path), 0) << err;
  ASSERT_EQ(run("inject " + path + " --yaw 30 --pitch -10"), 0) << err;
  std::vector<std::string> warnings;
  const StereoCamera now = ods::open_camera(path, warnings).camera;
  EXPECT_EQ(now.yaw, 30.0f);
  EXPECT_EQ(now.pitch, -10.0f);
  // The sidecar of another picture of the same name stays.
  const std::string other = folder.read(beside);
  ASSERT_EQ(run("render axis --eyes mono --width 64 --samples 1 --quiet -o " + folder.path("seen_360.tif")), 0) << err;
  folder.write(beside, other);
  ASSERT_EQ(run("inject " + folder.path("seen_360.tif") + " --yaw 60"), 0) << err;
  EXPECT_EQ(folder.read(beside), other);
}

}  // namespace ods::inject_picture_test
