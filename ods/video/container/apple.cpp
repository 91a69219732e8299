// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/container/apple.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ods {

constexpr uint32_t kQuarter = 0x40000000;  // a quarter of 2^32
constexpr std::array<uint32_t, 4> kFrontHalf = {0, 0, kQuarter, kQuarter};

namespace {

enum StereoFlag : uint64_t { kHasLeft = 1, kHasRight = 2, kRightFirst = 8 };

}  // namespace

bool fits_vexu(const SphericalMetadata& metadata) {
  const VideoStereo stereo = stereo_of(metadata);
  const bool is_known = stereo == VideoStereo::kOneView || arrangement_of(stereo).is_halves();
  return is_known && metadata.projection == VideoProjection::kEquirect &&
         (!metadata.is_partial() || metadata.bounds == kFrontHalf);
}

// --- writing ---------------------------------------------------------------------------------------------------------

static Box parent(BoxType type, std::vector<Box> children) {
  Box box;
  box.type = type;
  box.children = std::move(children);
  return box;
}

// Version and flags, then a number.
static Box leaf(BoxType type, uint64_t value, size_t bytes) {
  Box box;
  box.type = type;
  append_number(box.body, 0, 4);
  append_number(box.body, value, bytes);
  return box;
}

Box vexu_box(const SphericalMetadata& metadata) {
  assert(fits_vexu(metadata));
  const VideoStereo stereo = stereo_of(metadata);
  Box vexu = parent(box_type("vexu"), {});
  if (stereo != VideoStereo::kOneView) {
    uint64_t flags = kHasLeft | kHasRight;
    if (arrangement_of(stereo).right_first) flags |= kRightFirst;
    Box eyes = parent(box_type("eyes"), {leaf(box_type("stri"), flags, 1), leaf(box_type("hero"), 1, 1)});
    const auto micrometres = static_cast<uint64_t>(std::llround(metadata.ipd * 1e6));
    if (micrometres > 0 && micrometres <= 0xffffffff) {
      eyes.children.push_back(parent(box_type("cams"), {leaf(box_type("blin"), micrometres, 4)}));
    }
    vexu.children.push_back(std::move(eyes));
  }
  const BoxType kind = metadata.is_partial() ? box_type("hequ") : box_type("equi");
  vexu.children.push_back(parent(box_type("proj"), {leaf(box_type("prji"), kind, 4)}));
  if (stereo != VideoStereo::kOneView) {
    const BoxType packing = arrangement_of(stereo).how == EyePacking::kStacked ? box_type("over") : box_type("side");
    vexu.children.push_back(parent(box_type("pack"), {leaf(box_type("pkin"), packing, 4)}));
  }
  return vexu;
}

Box hfov_box(const SphericalMetadata& metadata) {
  assert(fits_vexu(metadata));
  Box box;
  box.type = box_type("hfov");
  append_number(box.body, metadata.is_partial() ? 180000 : 360000, 4);
  return box;
}

// Adds the children of `old` that `box`, which is open, lacks.
static void take_over(Box& box, const Box& old, std::initializer_list<BoxType> but) {
  for (const Box& child : old.children) {
    const bool is_ours = std::find(but.begin(), but.end(), child.type) != but.end();
    if (is_ours) continue;
    if (Box* there = find_child(box, child.type)) {
      *there = child;
    } else {
      box.children.push_back(child);
    }
  }
}

Box updated_vexu(Box old, const SphericalMetadata& metadata) {
  Box vexu = vexu_box(metadata);
  open_box(old, 0);
  take_over(vexu, old, {box_type("eyes"), box_type("proj"), box_type("pack")});
  Box *eyes = find_child(vexu, box_type("eyes")), *old_eyes = find_child(old, box_type("eyes"));
  if (eyes == nullptr || old_eyes == nullptr) return vexu;
  open_box(*old_eyes, 0);
  take_over(*eyes, *old_eyes, {box_type("stri"), box_type("cams")});
  return vexu;
}

// --- reading ---------------------------------------------------------------------------------------------------------

// The number in a nested box. Returns nullopt if it is missing.
static std::optional<uint64_t> find_number(Box& vexu, BoxType outer, BoxType inner, size_t bytes) {
  Box* holder = find_child(vexu, outer);
  if (holder == nullptr) return std::nullopt;
  open_box(*holder, 0);
  const Box* box = find_child(*holder, inner);
  return box == nullptr ? std::nullopt : std::optional(get_number(box->body, 4, bytes));
}

static double find_ipd(Box& vexu) {
  Box* eyes = find_child(vexu, box_type("eyes"));
  if (eyes == nullptr) return 0.0;
  open_box(*eyes, 0);
  return static_cast<double>(find_number(*eyes, box_type("cams"), box_type("blin"), 4).value_or(0)) / 1e6;
}

static void set_projection_of(std::optional<uint64_t> kind, SphericalMetadata& metadata) {
  metadata.projection = !kind || *kind == box_type("rect") ? VideoProjection::kFlat : VideoProjection::kOther;
  if (kind == box_type("equi") || kind == box_type("hequ")) metadata.projection = VideoProjection::kEquirect;
  if (kind == box_type("hequ")) metadata.bounds = kFrontHalf;
}

std::optional<SphericalMetadata> parse_vexu(const Box& sample_entry) {
  const Box* found = find_child(sample_entry, box_type("vexu"));
  if (found == nullptr) return std::nullopt;
  Box vexu = *found;
  open_box(vexu, 0);
  const std::optional<uint64_t> flags = find_number(vexu, box_type("eyes"), box_type("stri"), 1);
  const std::optional<uint64_t> packing = find_number(vexu, box_type("pack"), box_type("pkin"), 4);
  const std::optional<uint64_t> kind = find_number(vexu, box_type("proj"), box_type("prji"), 4);
  SphericalMetadata metadata;
  if (flags && (*flags & kHasLeft) != 0 && (*flags & kHasRight) != 0) {
    if (!packing) return std::nullopt;
    EyeArrangement eyes{EyePacking::kMixed, (*flags & kRightFirst) != 0};
    if (*packing == box_type("over")) eyes.how = EyePacking::kStacked;
    if (*packing == box_type("side")) eyes.how = EyePacking::kBeside;
    metadata.stereo = stereo_with(eyes).value_or(VideoStereo::kOther);
    metadata.ipd = find_ipd(vexu);
  } else {
    metadata.stereo = VideoStereo::kOneView;
  }
  set_projection_of(kind, metadata);
  return metadata;
}

std::optional<EyeLayers> parse_layers(const Box& sample_entry) {
  if (find_child(sample_entry, box_type("lhvC")) == nullptr) return std::nullopt;
  EyeLayers layers;
  if (const Box* wide = find_child(sample_entry, box_type("hfov"))) {
    const float fov = static_cast<float>(get_number(wide->body, 0, 4)) / 1000.0f;
    if (fov > 0.0f && fov < 180.0f) layers.fov = fov;
  }
  const Box* found = find_child(sample_entry, box_type("vexu"));
  if (found == nullptr) return layers;
  Box vexu = *found;
  open_box(vexu, 0);
  layers.right_first = (find_number(vexu, box_type("eyes"), box_type("stri"), 1).value_or(0) & kRightFirst) != 0;
  layers.beside.ipd = find_ipd(vexu);
  set_projection_of(find_number(vexu, box_type("proj"), box_type("prji"), 4), layers.beside);
  return layers;
}

}  // namespace ods
