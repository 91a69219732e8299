// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The layouts in which two eyes share a file. Their geometry is only in this file; elsewhere each eye is its own image.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/base/extent.h"
#include "ods/base/names.h"
#include "ods/image/image.h"

namespace ods {

enum class Layout {
  kTopBottom,       // one image, the left eye on top
  kBottomTop,       // the right eye on top
  kSideBySide,      // the left eye on the left
  kCrossEyed,       // the right eye on the left: viewed by crossing the eyes, without a device
  kTopBottomHalf,   // top-bottom with eyes squeezed to half their height: the file has the size of one eye
  kSideBySideHalf,  // side-by-side with eyes squeezed to half their width
  kRowInterleaved,  // each row of the left eye is followed by the right eye's row; no rows are dropped
  kColumnInterleaved,
  kCheckerboard,  // a file of the eye's size: the left eye's pixels where x + y is even, the right eye's elsewhere
  kAnaglyph,      // for red-cyan glasses, see anaglyph.h
  kAnaglyphHalf,
  kAnaglyphDubois,
  kSeparate,   // a file per eye: %V in its name becomes left or right, %v l or r
  kMultiview,  // one EXR of the size of an eye; each eye has its own channels
};

enum class EyePacking {
  kStacked,  // one above the other
  kBeside,
  kRows,     // every other row
  kColumns,  // every other column
  kCheckerboard,
  kMixed,  // every pixel has both eyes: they cannot be separated again
  kAlone,  // each eye is its own image
};

// The arrangement of the eyes in a layout. Code that needs it calls arrangement_of() instead of listing layouts.
struct EyeArrangement {
  EyePacking how = EyePacking::kAlone;
  bool right_first = false;  // the right eye is on top or on the left
  bool squeezed = false;     // to half the height (stacked) or width (beside)

  // Each eye is one half of the file. Videos and most other programs support only such layouts.
  constexpr bool is_halves() const { return how == EyePacking::kStacked || how == EyePacking::kBeside; }
  // Neighbouring pixels belong to different eyes, and each pixel to one eye.
  constexpr bool is_interleaved() const {
    return how == EyePacking::kRows || how == EyePacking::kColumns || how == EyePacking::kCheckerboard;
  }
  bool operator==(const EyeArrangement&) const = default;
};

// Names on the command line, in the order of help texts.
struct LayoutRow {
  Layout member;
  std::string_view name;
  EyeArrangement eyes;
};
inline constexpr LayoutRow kLayoutTable[] = {
    {Layout::kTopBottom, "top-bottom", {EyePacking::kStacked}},
    {Layout::kBottomTop, "bottom-top", {EyePacking::kStacked, true}},
    {Layout::kSideBySide, "side-by-side", {EyePacking::kBeside}},
    {Layout::kCrossEyed, "cross-eyed", {EyePacking::kBeside, true}},
    {Layout::kTopBottomHalf, "top-bottom-half", {EyePacking::kStacked, false, true}},
    {Layout::kSideBySideHalf, "side-by-side-half", {EyePacking::kBeside, false, true}},
    {Layout::kSeparate, "separate", {EyePacking::kAlone}},
    {Layout::kMultiview, "multiview", {EyePacking::kAlone}},
    {Layout::kRowInterleaved, "row-interleaved", {EyePacking::kRows}},
    {Layout::kColumnInterleaved, "column-interleaved", {EyePacking::kColumns}},
    {Layout::kCheckerboard, "checkerboard", {EyePacking::kCheckerboard}},
    {Layout::kAnaglyph, "anaglyph", {EyePacking::kMixed}},
    {Layout::kAnaglyphHalf, "anaglyph-half", {EyePacking::kMixed}},
    {Layout::kAnaglyphDubois, "anaglyph-dubois", {EyePacking::kMixed}},
};
static_assert(has_every_member(kLayoutTable));
inline constexpr auto kLayouts = members_of(kLayoutTable);
constexpr std::string_view layout_name(Layout layout) {
  return name_in(kLayoutTable, layout);
}
constexpr EyeArrangement arrangement_of(Layout layout) {
  return row_in(kLayoutTable, layout).eyes;
}

// The first layout with this arrangement; kSeparate for EyePacking::kAlone. Returns nullopt if no layout has it, for
// example squeezed with the right eye first.
std::optional<Layout> layout_with(const EyeArrangement& eyes);

struct ProjectionSetting;

// The layout of two eyes if none is specified, as players expect it: side-by-side for vr180, top-bottom for all others.
Layout default_layout(const ProjectionSetting& projection);

// Default layout of a converted picture: the layout of the original, `own`, unless the two projections have different
// defaults and the eyes are stacked or side by side; then the new projection's default.
Layout layout_of_converted(Layout own, const ProjectionSetting& from, const ProjectionSetting& to);

// Other names for layouts, in lower case: over-under, tb, sbs, ...
struct LayoutAlias {
  std::string_view word;
  Layout layout;
};
const std::vector<LayoutAlias>& layout_aliases();

// The layout with this name or alias, in upper or lower case.
std::optional<Layout> layout_of(std::string_view word);

// Returns whether every pixel has both eyes, as a display shows them.
bool is_anaglyph(Layout layout);

// The number of columns and rows of an eye that become one in the file: 2x1 and 1x2 for the halves, 1x1 for all others
// and for a single eye. They are averaged (area filter, linear light).
Extent squeeze_of(Layout layout, int eye_count);
Extent squeezed_eye(Layout layout, Extent eye, int eye_count);

// The size of the image that contains the eyes, whose size after squeezing is `eye`. A single eye, anaglyphs, kSeparate
// and kMultiview are not packed.
Extent packed_size(Layout layout, Extent eye, int eye_count);

// The parts of row y of the packed image, from left to right: a row of one eye, or rows of both. For anaglyphs and
// kMultiview, the row of every eye, all at the same place.
struct EyeRow {
  int index;  // index of the eye in the picture: 0 is the left or the only one
  int y;
  int x = 0;      // first column in the image
  int step = 1;   // column stride in the image
  int first = 0;  // first column in the eye's row
  int every = 1;  // stride in the eye's row
};
std::vector<EyeRow> packed_row(Layout layout, Extent eye, int eye_count, int y);

// The size of each eye in a packed image. Returns nullopt if an image of that size cannot have this layout. Squeezed
// eyes keep their stored size. Precondition: not an anaglyph.
std::optional<Extent> unpacked_size(Layout layout, Extent packed);

// The size of each eye before it was squeezed. Returns nullopt if unpacked_size() does. Precondition: not an anaglyph.
std::optional<Extent> whole_eye(Layout layout, Extent packed);

// The top left corner of an eye in a packed image. `eye` is the size of each eye, `index` is 0 for the left or the only
// one.
// Precondition: is_halves() or kAlone.
struct EyeCorner {
  int x = 0;
  int y = 0;
};
EyeCorner eye_corner(Layout layout, Extent eye, int index);

// The pixels of an eye that fill one that kCheckerboard dropped: the adjacent pixels above, below, left and right that
// are inside the picture. The file has all of them. Precondition: the eye has more than one pixel.
struct Neighbours {
  int count = 0;
  int x[4] = {};
  int y[4] = {};
};
Neighbours neighbours_of(int x, int y, Extent eye);
constexpr bool is_left_out(int index, int x, int y) {
  return (x + y) % 2 != index;
}

// The eyes of a packed image, left and right, bit for bit; pixels that kCheckerboard dropped are the mean of their
// neighbours. For kSeparate and kMultiview returns the image itself, which is one eye. Precondition: unpacked_size()
// has a value.
std::vector<Image> unpack(Layout layout, const Image& packed);

// kLeft, kRight, kMono -> `left`, `right`, `mono`.
std::string_view eye_name(int eye);

// Returns whether a file name stands for a file per eye, and the name for one of them (kLeft or kRight).
bool names_eye(const std::string& path);
std::string path_for_eye(const std::string& path, int eye);

}  // namespace ods
