// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/layout.h"

#include <algorithm>
#include <cassert>

#include "ods/base/text.h"
#include "ods/camera/projection.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

std::string_view layout_name(Layout layout) {
  switch (layout) {
    case Layout::kTopBottom:
      return "top-bottom";
    case Layout::kBottomTop:
      return "bottom-top";
    case Layout::kSideBySide:
      return "side-by-side";
    case Layout::kCrossEyed:
      return "cross-eyed";
    case Layout::kTopBottomHalf:
      return "top-bottom-half";
    case Layout::kSideBySideHalf:
      return "side-by-side-half";
    case Layout::kRowInterleaved:
      return "row-interleaved";
    case Layout::kAnaglyph:
      return "anaglyph";
    case Layout::kAnaglyphHalf:
      return "anaglyph-half";
    case Layout::kAnaglyphDubois:
      return "anaglyph-dubois";
    case Layout::kSeparate:
      return "separate";
    case Layout::kMultiview:
      return "multiview";
  }
  return {};
}

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
  for (Layout layout : kLayouts) {
    if (small == layout_name(layout)) return layout;
  }
  for (const LayoutAlias& alias : layout_aliases()) {
    if (small == alias.word) return alias.layout;
  }
  return std::nullopt;
}

// --- where the eyes lie --------------------------------------------------------------------------------------------

namespace {

// What the layouts are made of.
enum class Arrangement { kStacked, kBeside, kInterleaved, kAlone };

struct Form {
  Arrangement arrangement;
  bool right_first = false;
  bool squeezed = false;
};

}  // namespace

static Form form_of(Layout layout) {
  switch (layout) {
    case Layout::kTopBottom:
      return {Arrangement::kStacked};
    case Layout::kBottomTop:
      return {Arrangement::kStacked, true};
    case Layout::kSideBySide:
      return {Arrangement::kBeside};
    case Layout::kCrossEyed:
      return {Arrangement::kBeside, true};
    case Layout::kTopBottomHalf:
      return {Arrangement::kStacked, false, true};
    case Layout::kSideBySideHalf:
      return {Arrangement::kBeside, false, true};
    case Layout::kRowInterleaved:
      return {Arrangement::kInterleaved};
    case Layout::kAnaglyph:
    case Layout::kAnaglyphHalf:
    case Layout::kAnaglyphDubois:
    case Layout::kSeparate:
    case Layout::kMultiview:
      break;
  }
  return {Arrangement::kAlone};
}

Layout default_layout(const ProjectionSetting& projection) {
  return is_vr180(projection) ? Layout::kSideBySide : Layout::kTopBottom;
}

Layout layout_of_converted(Layout own, const ProjectionSetting& from, const ProjectionSetting& to) {
  const Arrangement arrangement = form_of(own).arrangement;
  const bool packed = arrangement == Arrangement::kStacked || arrangement == Arrangement::kBeside;
  return packed && default_layout(from) != default_layout(to) ? default_layout(to) : own;
}

bool is_anaglyph(Layout layout) {
  return layout == Layout::kAnaglyph || layout == Layout::kAnaglyphHalf || layout == Layout::kAnaglyphDubois;
}

Extent squeeze_of(Layout layout, int eye_count) {
  const Form form = form_of(layout);
  if (!form.squeezed || eye_count == 1) return {1, 1};
  return form.arrangement == Arrangement::kBeside ? Extent{2, 1} : Extent{1, 2};
}

// In how many eyes the packed image is cut.
static Extent cuts_of(Arrangement arrangement, int eye_count) {
  if (arrangement == Arrangement::kAlone) return {1, 1};
  return arrangement == Arrangement::kBeside ? Extent{eye_count, 1} : Extent{1, eye_count};
}

Extent squeezed_eye(Layout layout, Extent eye, int eye_count) {
  const Extent squeeze = squeeze_of(layout, eye_count);
  return {eye.width / squeeze.width, eye.height / squeeze.height};
}

Extent packed_size(Layout layout, Extent eye, int eye_count) {
  const Extent cuts = cuts_of(form_of(layout).arrangement, eye_count);
  return {eye.width * cuts.width, eye.height * cuts.height};
}

std::vector<EyeRow> packed_row(Layout layout, Extent eye, int eye_count, int y) {
  assert(y >= 0 && y < packed_size(layout, eye, eye_count).height);
  if (eye_count == 1) return {{0, y}};
  const Form form = form_of(layout);
  const int first = form.right_first ? 1 : 0;
  switch (form.arrangement) {
    case Arrangement::kStacked:
      return {{y < eye.height ? first : 1 - first, y % eye.height}};
    case Arrangement::kInterleaved:
      return {{y % 2, y / 2}};
    case Arrangement::kBeside:
    case Arrangement::kAlone:
      break;
  }
  return {{first, y}, {1 - first, y}};
}

std::optional<Extent> unpacked_size(Layout layout, Extent packed) {
  assert(!is_anaglyph(layout));
  const Extent cuts = cuts_of(form_of(layout).arrangement, 2);
  if (packed.width % cuts.width != 0 || packed.height % cuts.height != 0) return std::nullopt;
  return Extent{packed.width / cuts.width, packed.height / cuts.height};
}

std::vector<Image> unpack(Layout layout, const Image& packed) {
  if (form_of(layout).arrangement == Arrangement::kAlone) return {packed};
  const Extent eye = *unpacked_size(layout, {packed.width, packed.height});
  std::vector<Image> eyes(2, Image(eye.width, eye.height, packed.channels));
  for (int y = 0; y < packed.height; y++) {
    int x = 0;
    for (const EyeRow& part : packed_row(layout, eye, 2, y)) {
      const float* in = packed.at(x, y);
      std::copy(in, in + eye.width * packed.channels, eyes[static_cast<size_t>(part.index)].at(0, part.y));
      x += eye.width;
    }
  }
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
  return false;
}

std::string path_for_eye(const std::string& path, int eye) {
  std::string result = path;
  for (std::string_view pattern : kEyePatterns) {
    const std::string_view word = eye_name(eye).substr(0, pattern == "%V" ? std::string_view::npos : 1);
    for (size_t at = result.find(pattern); at != std::string::npos; at = result.find(pattern, at + word.size())) {
      result.replace(at, pattern.size(), word);
    }
  }
  return result;
}

}  // namespace ods
