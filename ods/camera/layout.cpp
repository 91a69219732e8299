// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/layout.h"

#include <algorithm>
#include <cassert>

#include "ods/base/text.h"
#include "ods/camera/file_names.h"
#include "ods/camera/projection.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

const std::vector<LayoutAlias>& layout_aliases() {
  static const std::vector<LayoutAlias> aliases = {
      {"over-under", Layout::kTopBottom}, {"ou", Layout::kTopBottom},          {"tb", Layout::kTopBottom},
      {"under-over", Layout::kBottomTop}, {"bt", Layout::kBottomTop},          {"left-right", Layout::kSideBySide},
      {"lr", Layout::kSideBySide},        {"sbs", Layout::kSideBySide},        {"right-left", Layout::kCrossEyed},
      {"rl", Layout::kCrossEyed},         {"hou", Layout::kTopBottomHalf},     {"htb", Layout::kTopBottomHalf},
      {"hsbs", Layout::kSideBySideHalf},  {"dubois", Layout::kAnaglyphDubois},
  };
  return aliases;
}

std::optional<Layout> layout_of(std::string_view word) {
  const std::string small = small_letters(std::string(word));
  if (const std::optional<Layout> layout = find_in(kLayoutTable, small)) return layout;
  for (const LayoutAlias& alias : layout_aliases()) {
    if (small == alias.word) return alias.layout;
  }
  return std::nullopt;
}

// --- positions of the eyes ------------------------------------------------------------------------------------------

std::optional<Layout> layout_with(const EyeArrangement& eyes) {
  for (const LayoutRow& row : kLayoutTable) {
    if (row.eyes == eyes) return row.member;
  }
  return std::nullopt;
}

Layout default_layout(const ProjectionSetting& projection) {
  return is_vr180(projection) ? Layout::kSideBySide : Layout::kTopBottom;
}

Layout layout_of_converted(Layout own, const ProjectionSetting& from, const ProjectionSetting& to) {
  return arrangement_of(own).is_halves() && default_layout(from) != default_layout(to) ? default_layout(to) : own;
}

bool is_anaglyph(Layout layout) {
  return arrangement_of(layout).how == EyePacking::kMixed;
}

Extent squeeze_of(Layout layout, int eye_count) {
  const EyeArrangement eyes = arrangement_of(layout);
  if (!eyes.squeezed || eye_count == 1) return {1, 1};
  return eyes.how == EyePacking::kBeside ? Extent{2, 1} : Extent{1, 2};
}

// The number of columns and rows of eyes that the packed image is cut into.
static Extent cuts_of(EyePacking how, int eye_count) {
  switch (how) {
    case EyePacking::kStacked:
    case EyePacking::kRows:
      return {1, eye_count};
    case EyePacking::kBeside:
    case EyePacking::kColumns:
      return {eye_count, 1};
    case EyePacking::kCheckerboard:
    case EyePacking::kMixed:
    case EyePacking::kAlone:
      break;
  }
  return {1, 1};
}

Extent squeezed_eye(Layout layout, Extent eye, int eye_count) {
  const Extent squeeze = squeeze_of(layout, eye_count);
  return {eye.width / squeeze.width, eye.height / squeeze.height};
}

Extent packed_size(Layout layout, Extent eye, int eye_count) {
  const Extent cuts = cuts_of(arrangement_of(layout).how, eye_count);
  return {eye.width * cuts.width, eye.height * cuts.height};
}

std::vector<EyeRow> packed_row(Layout layout, Extent eye, int eye_count, int y) {
  assert(y >= 0 && y < packed_size(layout, eye, eye_count).height);
  if (eye_count == 1) return {{0, y}};
  const EyeArrangement eyes = arrangement_of(layout);
  const int first = eyes.right_first ? 1 : 0;
  switch (eyes.how) {
    case EyePacking::kStacked:
      return {{y < eye.height ? first : 1 - first, y % eye.height}};
    case EyePacking::kRows:
      return {{y % 2, y / 2}};
    case EyePacking::kBeside:
      return {{first, y}, {1 - first, y, eye.width}};
    case EyePacking::kColumns:
      return {{0, y, 0, 2}, {1, y, 1, 2}};
    case EyePacking::kCheckerboard: {
      const int left = y % 2, right = 1 - left;
      return {{0, y, left, 2, left, 2}, {1, y, right, 2, right, 2}};
    }
    case EyePacking::kMixed:
    case EyePacking::kAlone:
      break;
  }
  return {{0, y}, {1, y}};
}

EyeCorner eye_corner(Layout layout, Extent eye, int index) {
  const EyeArrangement eyes = arrangement_of(layout);
  const int place = eyes.right_first ? 1 - index : index;
  switch (eyes.how) {
    case EyePacking::kStacked:
      return {0, place * eye.height};
    case EyePacking::kBeside:
      return {place * eye.width, 0};
    case EyePacking::kRows:
    case EyePacking::kColumns:
    case EyePacking::kCheckerboard:
    case EyePacking::kMixed:
      assert(false);
      break;
    case EyePacking::kAlone:
      break;
  }
  return {};
}

std::optional<Extent> unpacked_size(Layout layout, Extent packed) {
  assert(!is_anaglyph(layout));
  const Extent cuts = cuts_of(arrangement_of(layout).how, 2);
  if (packed.width % cuts.width != 0 || packed.height % cuts.height != 0) return std::nullopt;
  const bool too_small = packed.width == 1 && packed.height == 1;  // the right eye would have no pixel at all
  if (arrangement_of(layout).how == EyePacking::kCheckerboard && too_small) return std::nullopt;
  return Extent{packed.width / cuts.width, packed.height / cuts.height};
}

std::optional<Extent> whole_eye(Layout layout, Extent packed) {
  const std::optional<Extent> eye = unpacked_size(layout, packed);
  if (!eye) return std::nullopt;
  const Extent squeeze = squeeze_of(layout, 2);
  return Extent{eye->width * squeeze.width, eye->height * squeeze.height};
}

Neighbours neighbours_of(int x, int y, Extent eye) {
  Neighbours found;
  const auto add = [&](int nx, int ny) {
    if (nx < 0 || ny < 0 || nx >= eye.width || ny >= eye.height) return;
    found.x[found.count] = nx, found.y[found.count] = ny;
    found.count++;
  };
  add(x, y - 1), add(x - 1, y), add(x + 1, y), add(x, y + 1);
  return found;
}

static void fill_left_out(Image& eye, int index) {
  for (int y = 0; y < eye.height; y++) {
    for (int x = 0; x < eye.width; x++) {
      if (!is_left_out(index, x, y)) continue;
      const Neighbours from = neighbours_of(x, y, {eye.width, eye.height});
      for (int c = 0; c < eye.channels; c++) {
        float sum = 0.0f;
        for (int i = 0; i < from.count; i++) sum += eye.at(from.x[i], from.y[i])[c];
        eye.at(x, y)[c] = sum / static_cast<float>(from.count);
      }
    }
  }
}

std::vector<Image> unpack(Layout layout, const Image& packed) {
  if (arrangement_of(layout).how == EyePacking::kAlone) return {packed};
  const Extent eye = *unpacked_size(layout, {packed.width, packed.height});
  std::vector<Image> eyes(2, Image(eye.width, eye.height, packed.channels));
  for (int y = 0; y < packed.height; y++) {
    for (const EyeRow& part : packed_row(layout, eye, 2, y)) {
      Image& to = eyes[static_cast<size_t>(part.index)];
      int from = part.x;
      for (int x = part.first; x < eye.width; x += part.every, from += part.step) {
        std::copy_n(packed.at(from, y), packed.channels, to.at(x, part.y));
      }
    }
  }
  if (arrangement_of(layout).how == EyePacking::kCheckerboard) fill_left_out(eyes[0], 0), fill_left_out(eyes[1], 1);
  return eyes;
}

// --- the eyes' names -----------------------------------------------------------------------------------------------

std::string_view eye_name(int eye) {
  return eye == kLeft ? "left" : eye == kRight ? "right" : "mono";
}

static const std::string_view kEyePatterns[] = {"%V", "%v"};

bool names_eye(const std::string& path) {
  for (std::string_view pattern : kEyePatterns) {
    if (path.find(pattern) != std::string::npos) return true;
  }
  return words_in_braces(path, 2).has_value();
}

std::string path_for_eye(const std::string& path, int eye) {
  std::string result = path;
  for (std::string_view pattern : kEyePatterns) {
    const std::string_view word = eye_name(eye).substr(0, pattern == "%V" ? std::string_view::npos : 1);
    for (size_t at = result.find(pattern); at != std::string::npos; at = result.find(pattern, at + word.size())) {
      result.replace(at, pattern.size(), word);
    }
  }
  while (const auto found = words_in_braces(result, 2)) {
    result.replace(found->begin, found->end - found->begin, found->words[eye == kRight ? 1 : 0]);
  }
  return result;
}

}  // namespace ods
