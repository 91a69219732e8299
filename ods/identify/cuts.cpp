// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/camera/odd_halves.h"
#include "ods/identify/eye_match.h"

namespace ods {

namespace {

// Returns whether both eyes are the same picture: they differ less than its adjacent pixels do.
bool are_equal(const std::vector<Image>& eyes) {
  const Image first = shown(eyes[0]), second = shown(eyes[1]);
  double between = 0.0, beside = 0.0;
  for (int y = 0; y < first.height; y++) {
    for (int x = 0; x + 1 < first.width; x++) {
      between += static_cast<double>(std::abs(*first.at(x, y) - *second.at(x, y)));
      beside += static_cast<double>(std::abs(*first.at(x, y) - *first.at(x + 1, y)));
    }
  }
  return between < 0.2 * beside;
}

void compare_eyes(Cut& cut) {
  cut.pairs = find_pairs(shown(cut.eyes[0]), shown(cut.eyes[1]));
  cut.is_copy = are_equal(cut.eyes);
}

Cut one_eye(const Thumbnail& thumbnail) {
  Cut cut;
  cut.eyes = {thumbnail.light};
  return cut;
}

Cut two_halves(const Thumbnail& thumbnail, EyePacking how) {
  Cut cut;
  cut.how = how;
  const Layout layout = *layout_with({how});
  cut.eyes = unpack(layout, without_middle(layout, thumbnail.light));
  const EyeMatch match = match_eyes(cut.eyes);
  cut.two_eyes = match.mark(), cut.is_still = match.is_still;
  if (cut.two_eyes > 0.0) compare_eyes(cut);
  const char* halves = how == EyePacking::kStacked ? "its upper and lower picture" : "its left and right picture";
  cut.reason = fmt::format("{} match at {:.0f} % of {} places", halves, 100.0 * match.share, match.places);
  return cut;
}

// Returns whether most details move the same way from one eye to the other, as between the eyes of a sphere, where
// everything that moves is near.
bool moves_one_way(const PointPairs& pairs) {
  constexpr float kMoved = 0.3f;  // pixels
  constexpr double kMost = 0.5;
  int right = 0, left = 0;
  for (const PointPair& pair : pairs.found) {
    const float way = pair.right.x - pair.left.x;
    if (std::abs(way) > kMoved) (way > 0.0f ? right : left)++;
  }
  return std::abs(right - left) > kMost * static_cast<double>(pairs.found.size());
}

// Returns whether the halves of a sphere match only because it repeats itself every half turn: the one continues in the
// other, nothing moves or things move either way, and few other details of it are found in the other half.
bool repeats(const Cut& cut, Extent file) {
  constexpr double kFew = 0.35;
  const bool is_sphere = std::abs(file.width - 2 * file.height) <= 2;
  if (cut.how != EyePacking::kBeside || cut.two_eyes <= 0.0 || !is_sphere || cut.broken >= 0.0) return false;
  if (cut.is_still && cut.is_copy) return true;
  const bool has_few = static_cast<double>(cut.pairs.found.size()) < kFew * cut.pairs.places;
  return has_few && (cut.is_still || !moves_one_way(cut.pairs));
}

double between(double value, double no, double yes) {
  return std::clamp(2.0 * (value - no) / (yes - no) - 1.0, -1.0, 1.0);
}

// Evidence that rows or columns alternate between the eyes: then adjacent ones differ more than every other one, and
// more than in the perpendicular direction. Noise differs equally everywhere.
double alternate(double along, double across, double differs) {
  if (along <= 0.0 || across <= 0.0) return -1.0;
  const double seen = between(differs, 0.002, 0.006);  // programs dither gradients in such patterns
  return std::min({between(along, 0.85, 1.0), between(along / across, 1.1, 1.5), seen});
}

// Evidence of a checkerboard: its diagonals differ more than adjacent pixels in a row or a column. In other pictures
// they differ less, and with noise equally.
double alternate_both_ways(const Thumbnail& thumbnail) {
  const auto [less, more] = std::minmax(thumbnail.other_rows, thumbnail.other_columns);
  if (less <= 0.0) return -1.0;
  const double crossed = thumbnail.crossed;
  const double as_much_as_both = std::max(between(crossed / more, 0.8, 0.95), between(crossed, 1.2, 1.6));
  const double seen = between(thumbnail.diagonal, 0.004, 0.012);  // as in alternate()
  return std::min({between(crossed, 0.65, 0.95), as_much_as_both, between(crossed / less, 1.05, 1.3), seen});
}

// Returns whether nothing moves from one eye to the other. Then neighbours of one eye cannot differ from those of the
// other, except by noise or a pattern in it, which a camera or a generated picture may have.
bool lacks_parallax(const PointPairs& pairs) {
  constexpr float kStill = 0.6f;  // pixels; the pixels of interleaved eyes are half a pixel apart
  constexpr double kFew = 0.1;
  const auto moved =
      std::ranges::count_if(pairs.found, [](const PointPair& pair) { return length(pair.right - pair.left) > kStill; });
  return static_cast<double>(moved) < kFew * static_cast<double>(pairs.found.size());
}

Cut interleaved(const StoredPicture& whole, const Thumbnail& thumbnail, EyePacking how) {
  Cut cut;
  cut.how = how;
  const double rows = thumbnail.other_rows, columns = thumbnail.other_columns, both = alternate_both_ways(thumbnail);
  cut.two_eyes = how == EyePacking::kRows      ? alternate(rows, columns, thumbnail.below)
                 : how == EyePacking::kColumns ? alternate(columns, rows, thumbnail.beside)
                                               : both;
  if (how != EyePacking::kCheckerboard && both > 0.0) cut.two_eyes = -1.0;
  cut.reason = "every other pixel is more alike than neighbours";
  if (cut.two_eyes > 0.0) {
    cut.eyes = interleaved_eyes(whole, *layout_with({how}));
    compare_eyes(cut);
    if (lacks_parallax(cut.pairs)) cut.two_eyes = -1.0, cut.is_copy = false;
  }
  if (cut.two_eyes <= 0.0) cut.eyes = {thumbnail.light};
  return cut;
}

}  // namespace

std::vector<Cut> all_cuts(const StoredPicture& whole, const Thumbnail& thumbnail) {
  std::vector<Cut> cuts{one_eye(thumbnail)};
  for (const EyePacking how : {EyePacking::kStacked, EyePacking::kBeside}) {
    const Extent small{thumbnail.light.width, thumbnail.light.height};
    const Layout layout = *layout_with({how});
    if (unpacked_size(layout, without_middle(layout, thumbnail.file)) &&
        unpacked_size(layout, without_middle(layout, small)))
      cuts.push_back(two_halves(thumbnail, how));
  }
  for (const EyePacking how : {EyePacking::kRows, EyePacking::kColumns, EyePacking::kCheckerboard}) {
    if (unpacked_size(*layout_with({how}), thumbnail.file)) cuts.push_back(interleaved(whole, thumbnail, how));
  }
  const double broken = breaks_in_middle(shown(cuts[0].eyes[0]));
  double maximum = 0.0;
  for (Cut& cut : cuts) {
    cut.broken = broken;
    if (repeats(cut, thumbnail.file)) cut.two_eyes = -1.0, cut.pairs = {}, cut.is_copy = false;
    maximum = std::max(maximum, cut.two_eyes);
  }
  cuts[0].two_eyes = -maximum;
  cuts[0].reason = "no two parts of it match";
  for (Cut& cut : cuts) {
    cut.shown = shown(cut.eyes[0]);
    const Image other = cut.eyes.size() == 2 ? shown(cut.eyes[1]) : Image();
    const bool is_pair = cut.two_eyes > 0.0 && cut.eyes.size() == 2;
    cut.marks = marks_of(cut.shown, is_pair ? &other : nullptr);
  }
  return cuts;
}

}  // namespace ods
