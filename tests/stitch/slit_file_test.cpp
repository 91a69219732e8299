// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/stitch/slit_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "ods/stitch/rig_mark.h"

namespace ods::slit_file_test {

const std::vector<int> kBoth = {kLeft, kRight};

SlitRig make_rig(int slits, Extent eye) {
  SlitOptions options;
  options.slits = slits;
  return make_slit_rig({}, eye, kBoth, options);
}

SlitRig read(const std::string& text) {
  std::vector<std::string> warnings;
  SlitRig rig = read_slit_rig(text, "rig.json", warnings);
  EXPECT_TRUE(warnings.empty());
  return rig;
}

TEST(SlitFile, ComesBack) {
  StereoCamera camera;
  camera.position = {1.0f, 2.0f, 3.0f};
  camera.yaw = 30.0f, camera.ipd = 0.07f;
  SlitOptions options;
  options.slits = 12, options.pitches = 3, options.caps = true;
  const SlitRig rig = make_slit_rig(camera, {64, 32}, kBoth, options), back = read(write_slit_rig(rig));
  EXPECT_EQ(back.options.slits, 12);
  EXPECT_TRUE(back.options.caps);
  EXPECT_EQ(back.camera.ipd, 0.07f);
  EXPECT_EQ(back.view.height, rig.view.height);
  ASSERT_EQ(back.views.size(), rig.views.size());
  for (size_t i = 0; i < rig.views.size(); i++) {
    const Camera a = make_camera(rig.views[i]), b = make_camera(back.views[i]);
    EXPECT_LT(length(a.back - b.back) + length(a.up - b.up) + length(a.center - b.center), 1e-5f);
    EXPECT_NEAR(a.projection.half_size.x, b.projection.half_size.x, 1e-6f);
    EXPECT_NEAR(a.projection.half_size.y, b.projection.half_size.y, 1e-5f);
  }
}

// --- marks -----------------------------------------------------------------------------------------------------------

SlitRig any_rig(const SlitOptions& options, const StereoCamera& camera) {
  return make_slit_rig(camera, {64, 32}, kBoth, options);
}

StereoCamera turned_camera() {
  StereoCamera camera;
  camera.position = {1.5f, -0.3f, 2.0f};
  camera.yaw = 30.1f, camera.pitch = 7.7f, camera.roll = -3.3f;
  return camera;
}

// Whatever rounding the way through the file brings, also twice.
TEST(RigMark, IsThatOfTheRigsFile) {
  SlitOptions options;
  options.slits = 60;
  const SlitRig rig = any_rig(options, turned_camera());
  const SlitRig once = read(write_slit_rig(rig)), twice = read(write_slit_rig(once));
  EXPECT_EQ(rig_mark(once), rig_mark(rig));
  EXPECT_EQ(rig_mark(twice), rig_mark(rig));
  EXPECT_EQ(once.matrices, twice.matrices);
  EXPECT_EQ(rig_mark(rig).find_first_of("\"\\\n"), std::string::npos);
  const std::string file = mark_file_text(rig_mark(rig));
  EXPECT_EQ(file.find('\n'), 50u);
  EXPECT_EQ(mark_in_file(file), rig_mark(rig));
}

TEST(RigMark, SaysWhichSettingIsAnother) {
  SlitOptions options;
  options.slits = 12;
  const std::string mark = rig_mark(any_rig(options, {}));
  EXPECT_EQ(mark_difference(mark, mark), "");
  const auto difference = [&](const SlitOptions& changed, const StereoCamera& camera = {}) {
    return mark_difference(rig_mark(any_rig(changed, camera)), mark);
  };
  SlitOptions other = options;
  other.padding = 8;
  EXPECT_TRUE(difference(other).starts_with("padding is 8, not 4; view is ")) << difference(other);
  other = options, other.depth = ViewDepth::kPlane;
  EXPECT_EQ(difference(other), "depth is plane, not none");
  other = options, other.slits = 14;
  EXPECT_TRUE(difference(other).starts_with("slits is 14, not 12; ")) << difference(other);
  StereoCamera camera;
  camera.ipd = 0.07f;
  EXPECT_EQ(difference(options, camera), "ipd is 0.07, not 0.065");
  camera = {}, camera.top = {kMergeCosine, 0.0f, 90.0f, 1.0f};
  EXPECT_EQ(difference(options, camera), "merge-top is cosine,0,90,1, not none");
  other = options, other.slits = 14, other.scale = 2.0f;
  EXPECT_TRUE(difference(other, turned_camera()).ends_with("; and 3 more")) << difference(other, turned_camera());
  EXPECT_EQ(mark_difference("nonsense", mark), "the mark is damaged");
  EXPECT_EQ(mark_difference("ods-rig=1 views=00", mark), "the mark was written by another version of ods");
}

// A fade of another width needs no other views, and may be tried with those that are there.
TEST(RigMark, IsTheSameWhereTheViewsAre) {
  Json json = Json::parse(write_slit_rig(make_rig(12, {64, 32})));
  const std::string mark = rig_mark(read(json.dump()));
  json["blend"] = 0.25;
  EXPECT_NE(rig_mark(read(json.dump())), mark);
  EXPECT_EQ(mark_difference(rig_mark(read(json.dump())), mark), "");
  json["views"][3]["matrix"][3] = 0.5;
  EXPECT_EQ(mark_difference(rig_mark(read(json.dump())), mark), "blend is 0.25, not 0.5");
  json["blend"] = 0.5;
  EXPECT_EQ(mark_difference(rig_mark(read(json.dump())), mark), "the views have other positions or directions");
}

// --- bad input -------------------------------------------------------------------------------------------------------

TEST(SlitFile, EditsThatMakeNoRigAreErrors) {
  const std::string good = write_slit_rig(make_rig(12, {64, 32}));
  const auto with = [&](const std::string& from, const std::string& to) {
    const size_t at = good.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return good.substr(0, at) + to + good.substr(at + from.size());
  };
  for (const std::string& bad :
       {std::string("{}"), std::string("nonsense"), std::string(""), good.substr(0, good.size() / 2),
        with("\"slits\": 12", "\"slits\": 0"), with("\"slits\": 12", "\"slits\": 13"),
        with("\"pitches\": 2", "\"pitches\": 1000"), with("\"caps\": false", "\"caps\": true"),
        with("\"caps\": false", "\"caps\": 1"), with("\"omnistereo_slits\": 1", "\"omnistereo_slits\": 99"),
        with("\"matrix\":[", "\"matrix\":[5,"), with("\"matrix\":[", "\"matrix\":[null,"),
        with("\"number\":2", "\"number\":3"), with("\"depth\": \"none\"", "\"depth\": \"deep\""),
        with("\"name\": \"lat-long\"", "\"name\": \"cube-3x2\""), with("\"fov\": [", "\"fov\": [\"x\","),
        with("\"width\"", "\"widht\": 1e9, \"width\": 1e9, \"w\"")}) {
    std::vector<std::string> warnings;
    EXPECT_THROW(read_slit_rig(bad, "rig.json", warnings), Error) << bad.substr(0, 300);
  }
}

TEST(SlitFile, NullAndWrongTypesAreNoDefaults) {
  const Json good = Json::parse(write_slit_rig(make_rig(12, {64, 32})));
  for (const char* path : {"/omnistereo_slits",
                           "/slits",
                           "/pitches",
                           "/caps",
                           "/blend",
                           "/padding",
                           "/scale",
                           "/depth",
                           "/view",
                           "/view/width",
                           "/view/height",
                           "/view/fov",
                           "/view/fov/0",
                           "/camera",
                           "/camera/ipd",
                           "/views",
                           "/views/3",
                           "/views/3/number",
                           "/views/3/matrix",
                           "/views/3/matrix/5"}) {
    const Json::json_pointer at(path);
    for (const Json& wrong : {Json(nullptr), Json(""), Json("x"), Json::array(), Json::object({{"x", 1}})}) {
      Json broken = good;
      broken[at] = wrong;
      try {
        std::vector<std::string> warnings;
        read_slit_rig(broken.dump(), "rig.json", warnings);
        ADD_FAILURE() << path << " is " << wrong.dump();
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::kInput);
        const std::string key = at.back() == "0" || at.back() == "5" ? at.parent_pointer().back() : at.back();
        EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << path << ": " << error.what();
      }
    }
  }
}

}  // namespace ods::slit_file_test
