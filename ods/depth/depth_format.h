// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The meaning of the numbers of a depth picture.
#pragma once
#include <optional>
#include <string_view>

#include "ods/base/names.h"

namespace ods {

enum class DepthKind { kMetres, kMillimetres, kInverse, kDisparity, kRelative };

struct DepthKindRow {
  DepthKind member;
  std::string_view name;
  std::string_view meaning;
};
// "0 to 1" is the range of the codes of an integer file. Floats that are not within 0..1 are stretched from their
// minimum and maximum to it.
inline constexpr DepthKindRow kDepthKindTable[] = {
    {DepthKind::kMetres, "metres", "metres"},
    {DepthKind::kMillimetres, "millimetres", "millimetres"},
    {DepthKind::kInverse, "inverse",
     "1 / metres; where the nearest is given, from far (black) to near (white) by 1 / metres"},
    {DepthKind::kDisparity, "disparity",
     "in proportion to 1 / metres: 0 is infinitely far, the largest is the nearest"},
    {DepthKind::kRelative, "relative", "from the nearest (black) to the farthest (white) by metres"},
};
static_assert(has_every_member(kDepthKindTable));

enum class DepthAlong { kRay, kAxis };
inline constexpr NameRow<DepthAlong> kDepthAlongTable[] = {
    {DepthAlong::kRay, "ray"},    // from the eye, along the line of sight
    {DepthAlong::kAxis, "axis"},  // along the axis of the lens, or of the cube's face
};
static_assert(has_every_member(kDepthAlongTable));

// The treatment of edges that are softer than the picture's.
enum class DepthEdges { kSharp, kSoft };
inline constexpr NameRow<DepthEdges> kDepthEdgesTable[] = {
    {DepthEdges::kSharp, "sharp"},  // as sharp as the picture's, see sharpen.h
    {DepthEdges::kSoft, "soft"},    // unchanged
};
static_assert(has_every_member(kDepthEdgesTable));

struct DepthFormat {
  std::optional<DepthKind> kind;  // metres if not set, which is an error for integers
  DepthAlong along = DepthAlong::kRay;
  std::optional<float> nearest, farthest;  // metres
  bool has_scale = true;                   // if false, the numbers are correct except for a factor
};

}  // namespace ods
