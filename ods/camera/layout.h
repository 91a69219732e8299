// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How two eyes share a file. This is the only place that knows; until here every eye is an image of its own.
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
  kCrossEyed,       // the right eye on the left: seen with crossed eyes, without a device
  kTopBottomHalf,   // top-bottom of eyes squeezed to half their height: the file has the size of an eye
  kSideBySideHalf,  // side-by-side of eyes squeezed to half their width
  kRowInterleaved,  // every row of the left eye is followed by the right eye's; none is left out
  kColumnInterleaved,
  kCheckerboard,  // a file of the eye's size, the left eye's pixel where x + y is even: half of each eye's are left out
  kAnaglyph,      // for red-cyan glasses: see anaglyph.h
  kAnaglyphHalf,
  kAnaglyphDubois,
  kSeparate,   // a file per eye: %V in its name becomes left or right, %v l or r
  kMultiview,  // one EXR of the size of an eye; every eye has its own channels
};

enum class EyePacking {
  kStacked,  // one above the other
  kBeside,
  kRows,     // every other row
  kColumns,  // every other column
  kCheckerboard,
  kMixed,  // every pixel has both: nobody can take them apart again
  kAlone,  // each eye is an image of its own
};

// Where a layout puts its eyes. Code that needs to know asks this, instead of listing layouts.
struct EyeArrangement {
  EyePacking how = EyePacking::kAlone;
  bool right_first = false;  // the right eye is on top or on the left
  bool squeezed = false;     // to half the height (stacked) or width (beside)

  // Each eye is one half of the file. This is all that videos and most other programs know.
  constexpr bool is_halves() const { return how == EyePacking::kStacked || how == EyePacking::kBeside; }
  // Neighbouring pixels belong to different eyes, and each pixel to one.
  constexpr bool is_interleaved() const {
    return how == EyePacking::kRows || how == EyePacking::kColumns || how == EyePacking::kCheckerboard;
  }
  bool operator==(const EyeArrangement&) const = default;
};

// The words of the command line, in the order of help texts.
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

// The first layout with this arrangement; kSeparate of eyes that are alone. None: no layout has it, such as squeezed
// with the right eye first.
std::optional<Layout> layout_with(const EyeArrangement& eyes);

struct ProjectionSetting;

// How two eyes share a file where nobody says it, which is what players expect: vr180 side by side, all else
// top-bottom.
Layout default_layout(const ProjectionSetting& projection);

// The layout of a picture that is made of another one, which has the layout `own`, where nobody says it: the same. But
// where the new projection has another default than the old one, eyes that lie above or beside each other follow it.
Layout layout_of_converted(Layout own, const ProjectionSetting& from, const ProjectionSetting& to);

// What others call them, in small letters: over-under, tb, sbs, ...
struct LayoutAlias {
  std::string_view word;
  Layout layout;
};
const std::vector<LayoutAlias>& layout_aliases();

// By name or alias, in capitals or not.
std::optional<Layout> layout_of(std::string_view word);

// Both eyes are in every pixel, as a display shows them.
bool is_anaglyph(Layout layout);

// How many columns and rows of an eye become one of the file: 2x1 and 1x2 for the halves, 1x1 for all others and for a
// single eye. The mean of them does: an area filter, in linear light.
Extent squeeze_of(Layout layout, int eye_count);
Extent squeezed_eye(Layout layout, Extent eye, int eye_count);

// The size of the image that packs eyes which are `eye` large once they are squeezed. A single eye, anaglyphs,
// kSeparate and kMultiview pack nothing.
Extent packed_size(Layout layout, Extent eye, int eye_count);

// What row y of that image is made of, from left to right: the row of one eye, or those of both. Of anaglyphs and
// kMultiview: the row of every eye, in one place.
struct EyeRow {
  int index;  // of the eye in the picture: 0 is the left, or the only one
  int y;
  int x = 0;      // the image's column of the first pixel,
  int step = 1;   // and how many columns on the next one lies
  int first = 0;  // the eye's column of the first pixel,
  int every = 1;  // and of how many of the eye's pixels one is taken
};
std::vector<EyeRow> packed_row(Layout layout, Extent eye, int eye_count, int y);

// The size of either eye in a packed image; nothing when an image of that size cannot be of this layout. Squeezed eyes
// stay as they are stored. Precondition: not an anaglyph.
std::optional<Extent> unpacked_size(Layout layout, Extent packed);

// Where an eye begins in a packed image. `eye` is the size of either, `index` 0 for the left or the only one.
// Precondition: is_halves() or kAlone.
struct EyeCorner {
  int x = 0;
  int y = 0;
};
EyeCorner eye_corner(Layout layout, Extent eye, int index);

// What kCheckerboard leaves out of an eye is filled from the pixels above, below and beside, which it has: those of
// them that lie in the picture. Precondition: the eye has more than one pixel.
struct Neighbours {
  int count = 0;
  int x[4] = {};
  int y[4] = {};
};
Neighbours neighbours_of(int x, int y, Extent eye);
constexpr bool is_left_out(int index, int x, int y) {
  return (x + y) % 2 != index;
}

// The eyes of a packed image, left and right, bit for bit; of kCheckerboard with the mean of the neighbours for what it
// leaves out. kSeparate and kMultiview: the image itself, as it is one
// eye. Precondition: unpacked_size() has a value.
std::vector<Image> unpack(Layout layout, const Image& packed);

// kLeft, kRight, kMono -> `left`, `right`, `mono`.
std::string_view eye_name(int eye);

// Whether a file name asks for a file per eye, and its name for one of them (kLeft or kRight).
bool names_eye(const std::string& path);
std::string path_for_eye(const std::string& path, int eye);

}  // namespace ods
