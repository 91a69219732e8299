// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/sidecar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "tests/support/statistics.h"
#include "tests/support/temporary_folder.h"

namespace ods::sidecar_test {

std::string error_of(const std::string& text) {
  std::vector<std::string> warnings;
  try {
    read_sidecar(text, "x.camera.json", warnings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

PoleMergeSetting random_merge(Dice& dice) {
  PoleMergeSetting merge;
  merge.mode = kMerges[static_cast<size_t>(dice.next() * static_cast<float>(kMerges.size())) % kMerges.size()];
  merge.start = dice.between(0.0f, 60.0f);
  merge.end = dice.between(60.1f, 90.0f);
  merge.exponent = dice.between(0.01f, 9.0f);
  return merge;
}

std::shared_ptr<const Image> random_map(Dice& dice, int width, int height) {
  auto map = std::make_shared<Image>(width, height, 1);
  for (float& texel : map->pixels) texel = dice.next();
  return map;
}

void expect_same(const std::shared_ptr<const Image>& a, const std::shared_ptr<const Image>& b) {
  ASSERT_EQ(a != nullptr, b != nullptr);
  if (!a) return;
  EXPECT_EQ(a->width, b->width);
  EXPECT_EQ(a->pixels, b->pixels);
}

Sidecar random_file(Dice& dice, size_t i) {
  Sidecar file;
  StereoCamera& camera = file.camera;
  camera.position = vec3(dice.between(-9, 9), dice.between(-9, 9), dice.between(-9, 9));
  camera.yaw = dice.between(-400, 400), camera.pitch = dice.between(-90, 90), camera.roll = dice.between(-180, 180);
  camera.ipd = dice.between(0, 1), camera.neck = dice.between(-1, 1);
  camera.top = random_merge(dice), camera.bottom = random_merge(dice);
  if (camera.top.mode == kMergeMap || camera.bottom.mode == kMergeMap) {
    camera.merge_map = random_map(dice, 3, 2);
  }
  if (i % 2 == 0) camera.head_tilt_map = random_map(dice, 2, 4);
  camera.projection = named_projections()[i % named_projections().size()].setting;
  camera.projection.longitude = vec2(dice.between(-180, 0), dice.between(1, 180));
  camera.projection.latitude = vec2(dice.between(-80, 0), dice.between(1, 80));
  camera.projection.fov = dice.between(1, 170), camera.projection.aspect = dice.between(0.1f, 9);
  camera.projection.pan = dice.between(-180, 180), camera.projection.tilt = dice.between(-90, 90);
  camera.convergence = kConvergences[i % 3], camera.convergence_distance = dice.between(0.1f, 9);
  if (i % 2 == 0) camera.axis = vec3(dice.next(), 1.0f, dice.next());
  camera.lens_radius = dice.next(), camera.focus_distance = dice.between(0.1f, 9);
  camera.mirrored = i % 3 == 0;
  const std::vector<int> eyes[] = {{kLeft, kRight}, {kLeft}, {kRight}, {kMono}};
  file.eyes = eyes[i % 4];
  file.eye = {static_cast<int>(i) + 1, 2 * static_cast<int>(i)};
  file.layout = kLayouts[i % std::size(kLayouts)];
  return file;
}

void expect_same(const PoleMergeSetting& a, const PoleMergeSetting& b) {
  EXPECT_EQ(a.mode, b.mode);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.end, b.end);
  EXPECT_EQ(a.exponent, b.exponent);
}

TEST(Sidecar, ComesBackBitForBit) {
  Dice dice(1);
  for (size_t i = 0; i < 500; i++) {
    const Sidecar file = random_file(dice, i);
    const StereoCamera& camera = file.camera;
    std::vector<std::string> warnings;
    const Sidecar back = read_sidecar(write_sidecar(file), "file", warnings);
    const StereoCamera& same = back.camera;
    EXPECT_TRUE(warnings.empty()) << warnings[0];
    EXPECT_EQ(same.position, camera.position);
    EXPECT_EQ(vec3(same.yaw, same.pitch, same.roll), vec3(camera.yaw, camera.pitch, camera.roll));
    EXPECT_EQ(vec2(same.ipd, same.neck), vec2(camera.ipd, camera.neck));
    expect_same(same.top, camera.top);
    expect_same(same.bottom, camera.bottom);
    expect_same(same.merge_map, camera.merge_map);
    expect_same(same.head_tilt_map, camera.head_tilt_map);
    EXPECT_EQ(same.projection.kind, camera.projection.kind);
    EXPECT_EQ(same.projection.longitude, camera.projection.longitude);
    EXPECT_EQ(same.projection.latitude, camera.projection.latitude);
    EXPECT_EQ(vec2(same.projection.fov, same.projection.aspect), vec2(camera.projection.fov, camera.projection.aspect));
    EXPECT_EQ(vec2(same.projection.pan, same.projection.tilt), vec2(camera.projection.pan, camera.projection.tilt));
    EXPECT_EQ(same.convergence, camera.convergence);
    EXPECT_EQ(same.convergence_distance, camera.convergence_distance);
    EXPECT_EQ(same.axis, camera.axis);
    EXPECT_EQ(vec2(same.lens_radius, same.focus_distance), vec2(camera.lens_radius, camera.focus_distance));
    EXPECT_EQ(same.mirrored, camera.mirrored);
    EXPECT_EQ(back.eyes, file.eyes);
    EXPECT_EQ(back.layout, file.layout);
    EXPECT_EQ(back.eye.width, file.eye.width);
    EXPECT_EQ(back.eye.height, file.eye.height);
  }
}

TEST(Sidecar, NumbersReadAsTheyWereTyped) {
  const std::string text = write_sidecar(Sidecar());
  EXPECT_NE(text.find("\"omnistereo_camera\": 1,"), std::string::npos);
  EXPECT_NE(text.find("\"ipd\": 0.065,"), std::string::npos) << text;
}

TEST(Sidecar, WhatIsMissingStaysAsItWas) {
  std::vector<std::string> warnings;
  const Sidecar file = read_sidecar(R"({"omnistereo_camera": 1, "yaw": 30})", "file", warnings);
  EXPECT_EQ(file.camera.yaw, 30.0f);
  EXPECT_EQ(file.camera.ipd, StereoCamera().ipd);
  EXPECT_TRUE(warnings.empty());
}

TEST(Sidecar, ASidecarFromTheFutureIsRefused) {
  EXPECT_NE(error_of(R"({"omnistereo_camera": 2})").find("written by a newer ods"), std::string::npos);
}

TEST(Sidecar, UnknownKeysAreNamed) {
  std::vector<std::string> warnings;
  read_sidecar(R"({"omnistereo_camera": 1, "nek": 0.07, "lens": {"blades": 5}})", "file", warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("lens.blades"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("did you mean 'neck'?"), std::string::npos) << warnings[1];
}

TEST(Sidecar, NonsenseIsAnErrorOfOneLine) {
  const std::string deep(1000000, '[');
  const char* inside[] = {R"("yaw": "north")",
                          R"("yaw": 1e300)",
                          R"("yaw": 1e999)",
                          R"("ipd": -1)",
                          R"("position": [1, 2])",
                          R"("position": 5)",
                          R"("merge_top": {"mode": "cosy"})",
                          R"("merge_top": {"start": 80, "end": 70})",
                          R"("merge_top": {"mode": "map"})",
                          R"("merge_top": [])",
                          R"("merge_map": {"width": 30000, "height": 30000, "values": []})",
                          R"("merge_map": {"width": 1, "height": 1, "values": [2]})",
                          R"("head_tilt_map": {"width": 1, "height": 1, "values": [-1]})",
                          R"("head_tilt_map": {"width": 2, "height": 1, "values": [0.5]})",
                          R"("projection": {"name": "mercator"})",
                          R"("projection": {"longitude": [10, -10]})",
                          R"("convergence": {"mode": "cross"})",
                          R"("convergence": {"mode": "toe-in", "distance": 0})",
                          R"("axis": [0, 0, 0])",
                          R"("lens": {"focus_distance": 0})",
                          R"("mirrored": 1)",
                          R"("picture": {"eyes": ["right", "left"]})",
                          R"("picture": {"layout": "pile"})",
                          R"("picture": {"eye_width": 1.5})"};
  for (const char* text : inside) {
    EXPECT_NE(error_of(std::string(R"({"omnistereo_camera": 1, )") + text + "}"), "") << text;
  }
  for (const std::string& text : {std::string(), std::string("{"), std::string("[]"), std::string("null"), deep,
                                  std::string("{}"), std::string(R"({"omnistereo_camera": "1"})"),
                                  std::string(R"({"omnistereo_camera": 0})"), std::string("\xff\xfe{")}) {
    EXPECT_NE(error_of(text), "") << text.substr(0, 40);
  }
}

// Every value of a whole file in turn. Only these three keys allow null.
TEST(Sidecar, NullAndWrongTypesAreNoDefaults) {
  Dice dice(4);
  const Json good = Json::parse(write_sidecar(random_file(dice, 0)));
  EXPECT_EQ(error_of(good.dump()), "");
  const Json values = good.flatten();
  EXPECT_GT(values.size(), 40u);
  for (const auto& [path, value] : values.items()) {
    if (path.starts_with("/conventions") || path == "/made_by") continue;
    for (Json::json_pointer at(path); !at.empty(); at = at.parent_pointer()) {
      const std::string key = at.to_string();
      const bool is_optional = key == "/axis" || key == "/merge_map" || key == "/head_tilt_map";
      for (const Json& wrong :
           {Json(nullptr), Json(""), Json("x"), Json(true), Json::array(), Json::object({{"x", 1}})}) {
        if ((wrong.type() == good[at].type() && wrong != "") || (wrong.is_null() && is_optional)) continue;
        Json broken = good;
        broken[at] = wrong;
        EXPECT_NE(error_of(broken.dump()), "") << at.to_string() << " is " << wrong.dump();
      }
    }
  }
  EXPECT_EQ(error_of(R"({"omnistereo_camera": 1, "axis": null, "merge_map": null, "head_tilt_map": null})"), "");
  EXPECT_EQ(error_of(R"({"omnistereo_camera": 1, "ipd": null})"),
            "'x.camera.json' is not a valid camera: ipd must be a number from 0 to 10000, not null");
}

// Bytes changed at random: an error of one line, or a camera whose rays are numbers.
TEST(Sidecar, BrokenBytesAreErrorsOrCameras) {
  Dice dice(3);
  int cameras = 0, errors = 0;
  for (size_t i = 0; i < 4000; i++) {
    std::string text = write_sidecar(random_file(dice, i));
    for (int k = 0; k < 2; k++) {
      const char* bytes = "0123456789-e.,[]{}\"ntf\xff";
      text[static_cast<size_t>(dice.next() * static_cast<float>(text.size() - 1))] =
          bytes[static_cast<size_t>(dice.next() * 24.0f)];
    }
    std::vector<std::string> warnings;
    try {
      const Sidecar file = read_sidecar(text, "file", warnings);
      const Ray ray = camera_ray(make_camera(file.camera), kLeft, vec2(0.4f, 0.3f));
      ASSERT_TRUE(std::isfinite(length(ray.origin)) && std::isfinite(length(ray.direction))) << text;
      cameras++;
    } catch (const Error& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      errors++;
    }
  }
  EXPECT_GT(cameras, 100);
  EXPECT_GT(errors, 100);
}

TEST(Sidecar, StandsBesideItsPicture) {
  EXPECT_EQ(sidecar_path("a/b.png"), "a/b.camera.json");
  EXPECT_EQ(sidecar_path("a.b/c"), "a.b/c.camera.json");
  EXPECT_EQ(sidecar_path("a/eye_%V.png"), "a/eye.camera.json");
  EXPECT_EQ(sidecar_path("%V.png"), "%V.camera.json");
}

TEST(Sidecar, IsSavedWhole) {
  const TemporaryFolder folder;
  Dice dice(2);
  const Sidecar file = random_file(dice, 5);
  save_sidecar(file, folder.path("new/x.camera.json"));
  std::vector<std::string> warnings;
  EXPECT_EQ(write_sidecar(load_sidecar(folder.path("new/x.camera.json"), warnings)), write_sidecar(file));
  EXPECT_THROW(load_sidecar(folder.path("none.json"), warnings), Error);
}

}  // namespace ods::sidecar_test
