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
