// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ods/camera/projection.h"
#include "ods/kernel/camera/camera.h"
#include "ods/picture/anaglyph.h"

namespace ods {
namespace {

bool squeezed(Layout layout) {
  return layout == Layout::kTopBottomHalf || layout == Layout::kSideBySideHalf;
}

TEST(Layout, EveryLayoutHasItsOwnName) {
  std::set<std::string_view> names;
  for (Layout layout : kLayouts) names.insert(layout_name(layout));
  EXPECT_EQ(names.size(), std::size(kLayouts));
  EXPECT_FALSE(names.contains(""));
}

TEST(Layout, NamesAndAliasesLeadBack) {
  for (Layout layout : kLayouts) EXPECT_EQ(layout_of(layout_name(layout)), layout);
  std::set<std::string_view> words;
  for (const LayoutAlias& alias : layout_aliases()) {
    EXPECT_EQ(layout_of(alias.word), alias.layout) << alias.word;
    EXPECT_TRUE(words.insert(alias.word).second) << alias.word;
  }
  EXPECT_EQ(layout_of("Over-Under"), Layout::kTopBottom);
  EXPECT_EQ(layout_of("TB"), Layout::kTopBottom);
  EXPECT_EQ(layout_of("RL"), Layout::kCrossEyed);
  EXPECT_EQ(layout_of("diagonal"), std::nullopt);
  EXPECT_EQ(layout_of(""), std::nullopt);
}

// Every row of the packed image, as eye and row of that eye, from left to right.
std::string rows(Layout layout, int eye_count) {
  const Extent eye{4, 2};
  std::string text;
  for (int y = 0; y < packed_size(layout, eye, eye_count).height; y++) {
    for (const EyeRow& part : packed_row(layout, eye, eye_count, y)) {
      text += std::to_string(part.index) + ":" + std::to_string(part.y) + " ";
    }
    text += "/ ";
  }
  return text;
}

TEST(Layout, EveryEyeIsWhereItsLayoutSays) {
  const auto expected = [](Layout layout) {
    switch (layout) {
      case Layout::kTopBottom:
      case Layout::kTopBottomHalf:
        return "0:0 / 0:1 / 1:0 / 1:1 / ";
      case Layout::kBottomTop:
        return "1:0 / 1:1 / 0:0 / 0:1 / ";
      case Layout::kCrossEyed:
        return "1:0 0:0 / 1:1 0:1 / ";
      case Layout::kRowInterleaved:
        return "0:0 / 1:0 / 0:1 / 1:1 / ";
      case Layout::kColumnInterleaved:
      case Layout::kCheckerboard:
      case Layout::kSideBySide:
      case Layout::kSideBySideHalf:
      case Layout::kAnaglyph:
      case Layout::kAnaglyphHalf:
      case Layout::kAnaglyphDubois:
      case Layout::kSeparate:
      case Layout::kMultiview:
        break;
    }
    return "0:0 1:0 / 0:1 1:1 / ";
  };
  for (Layout layout : kLayouts) {
    EXPECT_EQ(rows(layout, 2), expected(layout)) << layout_name(layout);
    EXPECT_EQ(rows(layout, 1), "0:0 / 0:1 / ") << layout_name(layout);
  }
}

// eye_corner() and packed_row() agree.
TEST(Layout, HalvesBeginWhereTheirRowsDo) {
  const Extent eye{4, 2};
  for (Layout layout : kLayouts) {
    const EyeArrangement eyes = arrangement_of(layout);
    if (!eyes.is_halves()) continue;
    EXPECT_EQ(layout_with(eyes), layout) << layout_name(layout);
    for (int y = 0; y < packed_size(layout, eye, 2).height; y++) {
      int x = 0;
      for (const EyeRow& part : packed_row(layout, eye, 2, y)) {
        const EyeCorner corner = eye_corner(layout, eye, part.index);
        EXPECT_EQ(corner.x, x) << layout_name(layout);
        EXPECT_EQ(part.x, x) << layout_name(layout);
        EXPECT_EQ(corner.y, y - part.y) << layout_name(layout);
        x += eye.width;
      }
    }
  }
  EXPECT_EQ(layout_with({EyePacking::kAlone}), Layout::kSeparate);
  EXPECT_EQ(layout_with({EyePacking::kStacked, true, true}), std::nullopt);
}

TEST(Layout, HalvesHaveTheSizeOfAnEye) {
  for (Layout layout : {Layout::kTopBottomHalf, Layout::kSideBySideHalf}) {
    const Extent squeeze = squeeze_of(layout, 2);
    const Extent size = packed_size(layout, {8 / squeeze.width, 4 / squeeze.height}, 2);
    EXPECT_EQ(size.width, 8);
    EXPECT_EQ(size.height, 4);
    EXPECT_EQ(squeeze.width * squeeze.height, 2);
    EXPECT_EQ(squeeze_of(layout, 1).width * squeeze_of(layout, 1).height, 1) << "one eye has the file for itself";
  }
}

Image eye_image(int eye) {
  Image image(4, 2, 3);
  for (size_t i = 0; i < image.pixels.size(); i++)
    image.pixels[i] = static_cast<float>(100 * eye) + static_cast<float>(i);
  return image;
}

Image pack(Layout layout, const Image (&eyes)[2], int count) {
  const Extent eye{eyes[0].width, eyes[0].height}, size = packed_size(layout, eye, count);
  Image packed(size.width, size.height, 3);
  for (int y = 0; y < size.height; y++) {
    for (const EyeRow& part : packed_row(layout, eye, count, y)) {
      for (int x = part.first, to = part.x; x < eye.width; x += part.every, to += part.step) {
        for (int c = 0; c < 3; c++) packed.at(to, y)[c] = eyes[part.index].at(x, part.y)[c];
      }
    }
  }
  return packed;
}

// Which eye each pixel is of, row by row.
std::string eyes_of(Layout layout, Extent eye) {
  const Image eyes[] = {Image(eye.width, eye.height, 3), [&] {
                          Image right(eye.width, eye.height, 3);
                          for (float& value : right.pixels) value = 1.0f;
                          return right;
                        }()};
  const Image packed = pack(layout, eyes, 2);
  std::string text;
  for (int y = 0; y < packed.height; y++) {
    for (int x = 0; x < packed.width; x++) text += *packed.at(x, y) == 0.0f ? 'L' : 'R';
    text += ' ';
  }
  return text;
}

TEST(Layout, InterleavedEyesAlternate) {
  EXPECT_EQ(eyes_of(Layout::kRowInterleaved, {3, 2}), "LLL RRR LLL RRR ");
  EXPECT_EQ(eyes_of(Layout::kColumnInterleaved, {3, 2}), "LRLRLR LRLRLR ");
  EXPECT_EQ(eyes_of(Layout::kCheckerboard, {3, 3}), "LRL RLR LRL ");
  EXPECT_EQ(eyes_of(Layout::kCheckerboard, {4, 2}), "LRLR RLRL ");
}

// Each keeps what the file has of it; the rest is the mean of the neighbours, so a ramp comes back whole inside.
TEST(Layout, CheckerboardsAreFilledFromNeighbours) {
  Image ramp(5, 4, 3);
  for (int y = 0; y < 4; y++) {
    for (int x = 0; x < 5; x++) std::fill_n(ramp.at(x, y), 3, static_cast<float>(10 * x + y));
  }
  const Image eyes[] = {ramp, ramp};
  const std::vector<Image> unpacked = unpack(Layout::kCheckerboard, pack(Layout::kCheckerboard, eyes, 2));
  ASSERT_EQ(unpacked.size(), 2u);
  for (int i = 0; i < 2; i++) {
    for (int y = 0; y < 4; y++) {
      for (int x = 0; x < 5; x++) {
        const bool is_edge = x == 0 || y == 0 || x == 4 || y == 3;
        if (is_edge && is_left_out(i, x, y)) continue;
        EXPECT_EQ(*unpacked[static_cast<size_t>(i)].at(x, y), *ramp.at(x, y)) << i << ' ' << x << ' ' << y;
      }
    }
  }
  EXPECT_EQ(*unpacked[1].at(0, 0), 5.5f) << "right eye: the mean of 10 and 1";
  EXPECT_EQ(*unpacked[0].at(4, 3), 37.5f) << "left eye: the mean of 42 and 33";
  EXPECT_EQ(unpacked_size(Layout::kCheckerboard, {1, 1}), std::nullopt);
  EXPECT_TRUE(unpacked_size(Layout::kCheckerboard, {2, 1}));
}

TEST(Layout, UnpackUndoesEveryPacking) {
  const Extent eye{4, 2};
  const Image eyes[] = {eye_image(0), eye_image(1)};
  for (Layout layout : kLayouts) {
    if (is_anaglyph(layout) || layout == Layout::kCheckerboard) continue;
    SCOPED_TRACE(layout_name(layout));
    const bool alone = layout == Layout::kSeparate || layout == Layout::kMultiview;
    const int count = alone ? 1 : 2;
    const Extent size = packed_size(layout, eye, count);
    const Image packed = pack(layout, eyes, count);
    EXPECT_EQ(unpacked_size(layout, size)->width, eye.width);
    EXPECT_EQ(unpacked_size(layout, size)->height, eye.height);
    const std::vector<Image> unpacked = unpack(layout, packed);
    ASSERT_EQ(unpacked.size(), static_cast<size_t>(count));
    for (size_t i = 0; i < unpacked.size(); i++) EXPECT_EQ(unpacked[i].pixels, eyes[i].pixels);
  }
}

TEST(Layout, TheWholeEyeIsTheEyeBeforeItWasSqueezed) {
  const Extent eye{4, 2};
  for (Layout layout : kLayouts) {
    if (is_anaglyph(layout)) continue;
    const int count = arrangement_of(layout).how == EyePacking::kAlone ? 1 : 2;
    const std::optional<Extent> whole = whole_eye(layout, packed_size(layout, squeezed_eye(layout, eye, count), count));
    ASSERT_TRUE(whole) << layout_name(layout);
    EXPECT_EQ(whole->width, eye.width) << layout_name(layout);
    EXPECT_EQ(whole->height, eye.height) << layout_name(layout);
  }
  EXPECT_EQ(whole_eye(Layout::kTopBottomHalf, {4, 3}), std::nullopt);
}

TEST(Layout, OddSizesCannotBeUnpacked) {
  EXPECT_FALSE(unpacked_size(Layout::kTopBottom, {4, 3}));
  EXPECT_FALSE(unpacked_size(Layout::kRowInterleaved, {4, 1}));
  EXPECT_FALSE(unpacked_size(Layout::kCrossEyed, {5, 2}));
  EXPECT_FALSE(unpacked_size(Layout::kColumnInterleaved, {5, 2}));
  EXPECT_TRUE(unpacked_size(Layout::kTopBottom, {5, 2}));
}

TEST(Anaglyph, GreyStaysGrey) {
  for (Layout layout : kLayouts) {
    if (!is_anaglyph(layout)) continue;
    for (float grey : {0.0f, 0.25f, 1.0f}) {
      for (int c = 0; c < 3; c++) EXPECT_NEAR(anaglyph_color(layout, vec3(grey), vec3(grey))[c], grey, 0.0011f * grey);
    }
  }
}

TEST(Anaglyph, TheLeftEyeIsRed) {
  const vec3 white(1.0f), black(0.0f);
  EXPECT_EQ(anaglyph_color(Layout::kAnaglyph, white, black), vec3(1.0f, 0.0f, 0.0f));
  EXPECT_EQ(anaglyph_color(Layout::kAnaglyph, black, white), vec3(0.0f, 1.0f, 1.0f));
  EXPECT_EQ(anaglyph_color(Layout::kAnaglyph, vec3(0.2f, 0.3f, 0.4f), vec3(0.5f, 0.6f, 0.7f)), vec3(0.2f, 0.6f, 0.7f));
  // The luminance of pure green, and what the projection makes of pure green: clamped, the published column.
  EXPECT_FLOAT_EQ(anaglyph_color(Layout::kAnaglyphHalf, vec3(0, 1, 0), black).x, 0.7152f);
  EXPECT_EQ(anaglyph_color(Layout::kAnaglyphDubois, vec3(0, 1, 0), black), vec3(0.449f, 0.0f, 0.0f));
  EXPECT_EQ(anaglyph_color(Layout::kAnaglyphDubois, black, vec3(0, 1, 0)), vec3(0.0f, 0.761f, 0.0f));
}

TEST(Layout, OfVr180IsSideBySideAndOfAllElseTopBottom) {
  for (const NamedProjection& named : named_projections()) {
    const Layout expected = named.name == "vr180" ? Layout::kSideBySide : Layout::kTopBottom;
    EXPECT_EQ(default_layout(named.setting), expected) << named.name;
  }
  ProjectionSetting part;
  part.longitude = {-90.0f, 90.0f};
  EXPECT_EQ(default_layout(part), Layout::kSideBySide);  // by its numbers, whatever it was called
  part.latitude.x = -89.0f;
  EXPECT_EQ(default_layout(part), Layout::kTopBottom);
}

TEST(Layout, OfAConvertedPictureFollowsTheProjectionOnlyWhereTheDefaultDoes) {
  const ProjectionSetting whole, half = find_projection("vr180")->setting, cube = find_projection("eac")->setting;
  for (Layout layout : kLayouts) {
    EXPECT_EQ(layout_of_converted(layout, whole, cube), layout);
    EXPECT_EQ(layout_of_converted(layout, half, half), layout);
    const Extent packed = packed_size(layout, {8, 8}, 2);
    const bool stays =
        (packed.width == 8 && packed.height == 8 && !squeezed(layout)) || arrangement_of(layout).is_interleaved();
    EXPECT_EQ(layout_of_converted(layout, whole, half), stays ? layout : Layout::kSideBySide) << layout_name(layout);
    EXPECT_EQ(layout_of_converted(layout, half, whole), stays ? layout : Layout::kTopBottom) << layout_name(layout);
  }
}

TEST(Layout, FileNamesOfEyes) {
  EXPECT_TRUE(names_eye("a.%V.png"));
  EXPECT_TRUE(names_eye("%v/a.png"));
  EXPECT_FALSE(names_eye("100%.png"));
  EXPECT_EQ(path_for_eye("%V/a.%v.%V.exr", kLeft), "left/a.l.left.exr");
  EXPECT_EQ(path_for_eye("%V/a.%v.%V.exr", kRight), "right/a.r.right.exr");
}

}  // namespace
}  // namespace ods
