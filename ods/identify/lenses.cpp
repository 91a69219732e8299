// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/lenses.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ods/camera/odd_halves.h"
#include "ods/disparity/rim.h"
#include "ods/identify/correlation.h"
#include "ods/identify/lens_detail.h"
#include "ods/identify/pairs.h"
#include "ods/identify/thumbnail.h"
#include "ods/image/block_means.h"
#include "ods/picture/load_eyes.h"

namespace ods {

// --- two circles -----------------------------------------------------------------------------------------------------

constexpr float kMinAlike = 0.5f, kMinSame = 0.5f;

// The correlation of equal positions in both circles, by their detail, if the second picture is shifted by `shift` of
// the radius.
static float sameness(const LensImages& detail, const std::vector<FisheyeLens>& lenses, float shift) {
  constexpr int kSide = 64;
  const vec2 size(static_cast<float>(detail.first.width), static_cast<float>(detail.first.height));
  Correlation both;
  for (int i = 0; i < kSide * kSide; i++) {
    const vec2 off =
        (vec2(static_cast<float>(i % kSide), static_cast<float>(i / kSide)) + 0.5f) / (0.5f * kSide) - 1.0f;
    const vec2 p = (lenses[0].center + lenses[0].radius * off) / size;
    const vec2 q = (lenses[1].center + lenses[1].radius * (off + vec2(shift, 0.0f))) / size;
    if (length(off) > 0.8f || !inside_picture(p) || !inside_picture(q)) continue;
    both.add(sample_at(detail.first, p), sample_at(detail.second, q));
  }
  return both.count() > 0.0 ? both.value() : -1.0f;
}

// Two eyes see nearly the same, perhaps shifted sideways as a whole: in a screenshot of a headset, the lenses' middles are
// not those of the halves.
static float sameness(const LensImages& detail, const std::vector<FisheyeLens>& lenses) {
  float max = -1.0f;
  for (int i = -16; i <= 16; i++) max = std::max(max, sameness(detail, lenses, 0.01f * static_cast<float>(i)));
  return max;
}

std::optional<SeenLenses> find_lenses(const LensImages& images, std::optional<float> fov) {
  const std::optional<Rim> rims[] = {find_rim(images.first), find_rim(images.second)};
  if (!rims[0] || !rims[1]) return std::nullopt;
  if (std::abs(rims[0]->radius / rims[1]->radius - 1.0f) > 0.08f) return std::nullopt;
  SeenLenses seen;
  for (const std::optional<Rim>& rim : rims) {
    FisheyeLens& lens = seen.lenses.emplace_back();
    lens.center = rim->center, lens.radius = rim->radius, lens.fov = fov.value_or(180.0f);
  }
  const Image detail[] = {lens_detail(images.first, seen.lenses[0], kCoarseDetail),
                          lens_detail(images.second, seen.lenses[1], kCoarseDetail)};
  const float same = sameness({detail[0], detail[1]}, seen.lenses);
  const OppositeLenses opposite = align_front_and_back(images, {detail[0], detail[1]}, seen.lenses, fov);
  const PointPairs pairs = find_pairs(images.first, images.second);
  const bool is_stereo = (pairs.places > 0 && static_cast<double>(pairs.found.size()) > 0.3 * pairs.places) ||
                         (same > kMinSame && (opposite.source != FovSource::kOverlap || same > opposite.alike));
  seen.around = std::max(rims[0]->around, rims[1]->around);
  if (is_stereo) return seen;
  const bool is_opposite = opposite.source == FovSource::kOverlap || opposite.alike > kMinAlike;
  if (!is_opposite) return pairs.places > 0 ? std::nullopt : std::optional(seen);
  seen.lenses = opposite.lenses, seen.front_and_back = true;
  seen.alike = opposite.alike, seen.fov_source = opposite.source;
  return seen;
}

// Two fisheyes that look ahead and back and fill their square halves up to the corners, as FFmpeg's v360 writes them.
// The halves' edges are at half the field of view; a larger circle has parts of the corners, too, which overlap.
static std::optional<SeenLenses> find_filled_halves(const LensImages& images, std::optional<float> fov) {
  constexpr float kWider = 1.12f, kSure = 0.6f;
  const int width = images.first.width, height = images.first.height;
  if (100 * std::abs(width - height) > width) return std::nullopt;
  FisheyeLens lens;
  lens.center = 0.5f * vec2(static_cast<float>(width), static_cast<float>(height));
  lens.radius = kWider * 0.5f * static_cast<float>(std::min(width, height));
  const std::optional<float> wider = fov ? std::optional(kWider * *fov) : std::nullopt;
  const Image first = lens_detail(images.first, lens, kCoarseDetail),
              second = lens_detail(images.second, lens, kCoarseDetail);
  const OppositeLenses opposite = align_front_and_back(images, {first, second}, {lens, lens}, wider);
  const bool overlaps = opposite.source == FovSource::kOverlap || (fov && opposite.source == FovSource::kTold);
  if (!overlaps || opposite.alike < kSure || sameness({first, second}, {lens, lens}) > kMinSame) return std::nullopt;
  SeenLenses seen{opposite.lenses, true, opposite.alike, opposite.source};
  for (FisheyeLens& each : seen.lenses) each.radius /= kWider, each.fov /= kWider;
  return seen;
}

// --- files -----------------------------------------------------------------------------------------------------------

// A part of an image; negative light is black.
static Image cut(const Image& image, EyeCorner corner, Extent size) {
  Image part(size.width, size.height, 1);
  for (int y = 0; y < size.height; y++) {
    const float* const row = image.at(corner.x, corner.y + y);
    std::transform(row, row + size.width, part.at(0, y), [](float light) { return std::max(0.0f, light); });
  }
  return part;
}

static bool is_inscribed(const FisheyeLens& lens, Extent eye) {
  const vec2 size(static_cast<float>(eye.width), static_cast<float>(eye.height));
  const float near = 0.008f * std::min(size.x, size.y);
  return length(lens.center - 0.5f * size) < near && std::abs(lens.radius - 0.5f * std::min(size.x, size.y)) < near;
}

// Two lenses have separate circles; a single circle that fills the picture is cut at its middle, and each half has a
// part of its rim.
static bool are_apart(const std::vector<FisheyeLens>& lenses, Layout layout, Extent eye) {
  const EyeCorner first = eye_corner(layout, eye, 0), second = eye_corner(layout, eye, 1);
  const vec2 shift(static_cast<float>(second.x - first.x), static_cast<float>(second.y - first.y));
  return length(lenses[1].center + shift - lenses[0].center) > lenses[0].radius;
}

static std::string lens_text(const FisheyeLens& lens) {
  return fmt::format("{:.1f},{:.1f},{:.1f}", lens.center.x, lens.center.y, lens.radius);
}

static std::optional<ProjectionSetting> known_projection(const FormatHint& known, const std::string& path) {
  if (known.projection) return known.projection;
  const NamedProjection* named = read_name(path).projection;
  return named ? std::optional(named->setting) : std::nullopt;
}

// The field of view that the caller or the name specifies. 180 degrees is also the usual value of a fisheye, so it is
// measured all the same.
static std::optional<float> told_fov(const std::optional<ProjectionSetting>& told) {
  return told && told->fov != 180.0f ? std::optional(told->fov) : std::nullopt;
}

// The lenses for messages, without their circles. The angle is that of the visible circle. A circle that was cut out of
// a larger one has another angle across the whole half, which converters such as FFmpeg's v360 call its field of view.
static std::string opposite_text(const SeenLenses& seen, Extent half) {
  const FisheyeLens& lens = seen.lenses[0];
  const int side = std::min(half.width, half.height);
  const float across = lens.fov * 0.5f * static_cast<float>(side) / lens.radius;
  std::string text = fmt::format("two fisheyes that look ahead and back, {:.1f} degrees each", lens.fov);
  if (seen.fov_source == FovSource::kOverlap && std::abs(across - lens.fov) > 1.0f)
    text += fmt::format(", {:.1f} across {} pixels", across, side);
  return text;
}

// The source of the lenses' angle.
static std::string angle_text(const SeenLenses& seen) {
  switch (seen.fov_source) {
    case FovSource::kTold:
      return "as specified";
    case FovSource::kOverlap:
      return fmt::format("they agree by {:.2f} where both see", seen.alike);
    case FovSource::kRims:
      return fmt::format("nothing is seen by both, and their rims agree by {:.2f}", seen.alike);
    case FovSource::kNothing:
      return "a usual angle, because their pictures are too smooth to show it: specify it with `input-fov`";
  }
  return {};
}

static std::optional<Layout> known_layout(const FormatHint& known, const std::string& path) {
  return known.layout ? known.layout : read_name(path).layout;
}

// The square around an image circle; black outside the image.
static Image around_circle(const Image& image, const FisheyeLens& lens, int side) {
  Image square(side, side, 1);
  const int left = static_cast<int>(std::lround(lens.center.x)) - side / 2,
            top = static_cast<int>(std::lround(lens.center.y)) - side / 2;
  for (int y = std::max(0, -top); y < std::min(side, image.height - top); y++) {
    for (int x = std::max(0, -left); x < std::min(side, image.width - left); x++)
      *square.at(x, y) = *image.at(left + x, top + y);
  }
  return square;
}

// Returns whether the parallax shows that the first half is the right eye's, as Canon's dual fisheye lens stores it.
static bool is_right_first(const LensImages& halves, const std::vector<FisheyeLens>& lenses) {
  constexpr float kSure = 0.5f;
  const int side = 2 * static_cast<int>(lenses[0].radius);
  ProjectionSetting projection = find_projection("fisheye")->setting;
  projection.fov = lenses[0].fov;
  const PointPairs pairs =
      find_pairs(around_circle(halves.first, lenses[0], side), around_circle(halves.second, lenses[1], side));
  return static_cast<float>(parallax_in(pairs, projection).order) < -kSure;
}

// Adds to `notes` and to `all` what was found: `lenses`, their circles, and the evidence.
static void report(const std::string& lenses, const std::string& evidence, const FormatHint& asked, FormatHint& all,
                   std::vector<std::string>& notes) {
  if (!asked.layout) all.seen_lenses = fmt::format("its pixels show {}{}", lenses, evidence);
  notes.push_back(
      fmt::format("{} (`circle` {},{}){}", lenses, lens_text(all.lenses[0]), lens_text(all.lenses[1]), evidence));
}

bool wants_lenses(const FormatHint& known, const std::string& path, bool is_open) {
  const std::optional<ProjectionSetting> told = known_projection(known, path);
  const std::optional<Layout> layout = known_layout(known, path);
  const bool is_done = !known.lenses.empty() || known.camera || known.one_eye || names_eye(path);
  const EyeArrangement eyes = layout ? arrangement_of(*layout) : EyeArrangement();
  if (is_done || (layout && (!eyes.is_halves() || eyes.squeezed))) return false;  // squeezed circles are ellipses
  return told ? is_fisheye(told->kind) : known.front_and_back || is_open;
}

FormatHint with_lenses(const StoredPicture& whole, const std::string& path, const FormatHint& known,
                       std::vector<std::string>& notes) {
  const std::optional<ProjectionSetting> told = known_projection(known, path);
  std::optional<Layout> layout = known_layout(known, path);
  if (whole.size.width < 64 || whole.size.height < 64) return known;
  const bool is_wide = whole.size.width > whole.size.height;
  if (!layout) layout = is_wide ? Layout::kSideBySide : Layout::kTopBottom;
  const std::optional<Extent> eye = unpacked_size(*layout, without_middle(*layout, whole.size));
  if (!eye) return known;
  constexpr float kBlack = 0.05f;  // below it identify() recognises circles, and other projections, by themselves
  constexpr int kLongest = 1100;   // maximum side of a half, pixels
  const int by = 1 + std::max(eye->width, eye->height) / kLongest;
  const Image grey = grey_eyes(whole)[0];
  const auto half = [&](int index) {
    return shown(block_means(cut(grey, eye_corner(*layout, *eye, index), *eye), by));
  };
  const Image first = half(0), second = half(1);
  std::optional<SeenLenses> seen = find_lenses({first, second}, told_fov(told));
  if (!seen) seen = find_filled_halves({first, second}, told_fov(told));
  if (!seen) return known;
  const bool right_first =
      !seen->front_and_back && !known_layout(known, path) && is_right_first({first, second}, seen->lenses);
  if (known.front_and_back && !seen->front_and_back) return known;  // circles that touch the halves' edges
  for (FisheyeLens& lens : seen->lenses) lens.center *= static_cast<float>(by), lens.radius *= static_cast<float>(by);
  if (!are_apart(seen->lenses, *layout, *eye)) return known;
  FormatHint all = known;
  all.layout = layout;
  if (seen->front_and_back) {
    all.front_and_back = true, all.lenses = seen->lenses, all.projection = find_projection("fisheye")->setting;
    report(opposite_text(*seen, *eye), ": " + angle_text(*seen), known, all, notes);
    return all;
  }
  const bool are_inscribed = is_inscribed(seen->lenses[0], *eye) && is_inscribed(seen->lenses[1], *eye);
  if (are_inscribed && seen->around < kBlack) return known;
  all.lenses = seen->lenses, all.projection = told ? *told : find_projection("fisheye")->setting;
  for (FisheyeLens& lens : all.lenses) lens.kind = all.projection->kind;
  if (right_first) {
    std::swap(all.lenses[0], all.lenses[1]);
    all.layout = layout_with({arrangement_of(*layout).how, true});
  }
  const char* const edges = are_inscribed ? "" : " whose circles do not touch the edges";
  report(fmt::format("a pair of fisheyes{}{}", edges, right_first ? ", the right eye first" : ""), "", known, all,
         notes);
  return all;
}

}  // namespace ods
