// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How two eyes share a file. This is the only place that knows; until here every eye is an image of its own.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace ods {

enum class Layout {
  kTopBottom,   // one image, the left eye on top
  kSideBySide,  // one image, the left eye on the left
  kSeparate,    // a file per eye: %V in its name becomes left or right, %v l or r
  kMultiview,   // one EXR of the size of an eye; every eye has its own channels
};

// `top-bottom`, `side-by-side`, `separate`, `multiview`: the words of the command line.
inline constexpr Layout kLayouts[] = {Layout::kTopBottom, Layout::kSideBySide, Layout::kSeparate, Layout::kMultiview};
std::string_view layout_name(Layout layout);

struct Extent {
  int width;
  int height;
};

// The size of the image that packs eyes of one size. A single eye, and every layout but the first two, packs nothing.
Extent packed_size(Layout layout, Extent eye, int eye_count);

// What row y of that image is, from left to right: the row of one eye, or of one after the other.
struct EyeRow {
  int index;  // of the eye in the picture: 0 is the left, or the only one
  int y;
};
std::vector<EyeRow> packed_row(Layout layout, Extent eye, int eye_count, int y);

// kLeft, kRight, kMono -> `left`, `right`, `mono`.
std::string_view eye_name(int eye);

// Whether a file name asks for a file per eye, and its name for one of them (kLeft or kRight).
bool names_eye(const std::string& path);
std::string path_for_eye(const std::string& path, int eye);

}  // namespace ods
