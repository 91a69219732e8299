// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/plan_conversion.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ods::plan_conversion_test {

StoredPicture stereo_header() {
  StoredPicture header;
  header.size = {64, 32};
  header.eyes.resize(2);
  header.eyes[0].eye = kLeft;
  header.eyes[1].eye = kRight;
  header.layout = Layout::kTopBottom;
  header.has_ipd = true;
  header.is_float = true;
  header.camera.ipd = 0.06f;
  return header;
}

ConversionPlan plan(const StoredPicture& header, std::vector<std::string> words) {
  words.insert(words.begin(), {"in.exr", "-o", "out.exr"});
  Options options("convert", words);
  return plan_conversion(header, parse_convert(options));
}

TEST(PlanConversion, KeepsWhatNoOptionChanges) {
  const ConversionPlan kept = plan(stereo_header(), {});
  EXPECT_EQ(kept.target.eye.width, 64);
  EXPECT_EQ(kept.target.eye.height, 32);
  EXPECT_EQ(kept.target.eyes, (std::vector<int>{kLeft, kRight}));
  EXPECT_EQ(kept.target.camera.ipd, 0.06f);
  EXPECT_EQ(kept.save.layout, Layout::kTopBottom);
  EXPECT_TRUE(kept.notes.empty());
}

// The order of the options on the line does not matter.
TEST(PlanConversion, ChangesTheInputsCamera) {
  for (const auto& words : {std::vector<std::string>{"--to", "perspective", "--fov", "70", "--mono"},
                            std::vector<std::string>{"--mono", "--fov", "70", "--to", "perspective"}}) {
    const ConversionPlan made = plan(stereo_header(), words);
    EXPECT_EQ(made.target.camera.projection.kind, kPerspective);
    EXPECT_EQ(made.target.camera.projection.fov, 70.0f);
    EXPECT_EQ(made.target.eyes, (std::vector<int>{kMono}));
    EXPECT_EQ(made.target.camera.ipd, 0.06f);
  }
}

// A spatial photo needs a distance: that of the input, or the one that is stated, or 65 mm with a note.
TEST(PlanConversion, ASpatialPhotoStatesTheDistanceOfItsCameras) {
  StoredPicture header = stereo_header();
  header.camera.projection = find_projection("perspective")->setting;
  header.is_float = false, header.has_ipd = false, header.camera.ipd = StereoCamera().ipd;
  const auto options_of = [](const std::vector<std::string>& words) {
    Options options("convert", words);
    return parse_convert(options);
  };
  const ConvertOptions plain = options_of({"in_LR.jpg", "-o", "out.heic"});
  ASSERT_EQ(plan_conversion(header, plain).notes.size(), 1u);
  EXPECT_NE(plan_conversion(header, plain).notes[0].find("--ipd"), std::string::npos);
  const ConvertOptions stated = options_of({"in_LR.jpg", "-o", "out.HEIC", "--ipd", "0.0123"});
  StoredPicture taken = header;
  take_stated_distance(stated, taken);
  EXPECT_EQ(taken.camera.ipd, 0.0123f);
  EXPECT_TRUE(taken.has_ipd);
  EXPECT_TRUE(plan_conversion(taken, stated).notes.empty());
  StoredPicture recorded = stereo_header();
  recorded.camera.projection = header.camera.projection;
  take_stated_distance(stated, recorded);
  EXPECT_EQ(recorded.camera.ipd, 0.06f) << "such eyes would be moved";
  StoredPicture other = header;
  take_stated_distance(options_of({"in_LR.jpg", "-o", "out.mpo", "--ipd", "0.0123"}), other);
  EXPECT_FALSE(other.has_ipd);
}

TEST(PlanConversion, SizesNameWidthHeightLayoutAndEyes) {
  const ConversionPlan sized = plan(stereo_header(), {"--size", "tb-minimum-3600", "--width", "128"});
  EXPECT_EQ(sized.target.eye.width, 128);
  EXPECT_EQ(sized.target.eye.height, 64);
  EXPECT_EQ(sized.save.layout, Layout::kTopBottom);
  EXPECT_EQ(plan(stereo_header(), {"--to", "vr180"}).save.layout, Layout::kSideBySide);
  EXPECT_EQ(plan(stereo_header(), {"--to", "vr180", "--to-layout", "bottom-top"}).save.layout, Layout::kBottomTop);
}

TEST(PlanConversion, NotesOptionsWithoutEffect) {
  EXPECT_EQ(plan(stereo_header(), {"--mono", "--ipd", "0.05"}).notes.size(), 1u);
  EXPECT_EQ(plan(stereo_header(), {"--exposure", "1"}).notes.size(), 1u);
}

}  // namespace ods::plan_conversion_test
