// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/depth/nearness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ods/base/error.h"
#include "ods/files/read_file.h"
#include "ods/picture/picture.h"

namespace ods {

namespace {

// Statistics of a file's numbers.
struct Survey {
  int64_t all = 0, nan = 0, negative = 0, zero = 0, infinite = 0;
  float minimum = std::numeric_limits<float>::infinity(), maximum = -minimum;  // range of the finite ones
};

Survey survey(const Image& numbers) {
  Survey found;
  for (const float value : numbers.pixels) {
    found.all++;
    found.nan += std::isnan(value);
    found.negative += value < 0.0f;
    found.zero += value == 0.0f;
    found.infinite += std::isinf(value);
    if (!std::isfinite(value)) continue;
    found.minimum = std::min(found.minimum, value), found.maximum = std::max(found.maximum, value);
  }
  return found;
}

void refuse_nonsense(const Survey& found, const std::string& path, bool are_distances) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' is not a depth picture: {}", path, what));
  };
  const auto is_most = [&](int64_t count) { return 2 * count > found.all; };
  if (is_most(found.nan)) refuse("most of its numbers are NaN");
  if (found.infinite == found.all) refuse("it is infinite everywhere");
  if (is_most(found.negative)) refuse("most of its numbers are negative");
  if (are_distances && found.zero + found.nan + found.negative < found.all && is_most(found.zero))
    refuse("most of its numbers are 0");
  if (found.minimum >= found.maximum)
    refuse(fmt::format("it is {} everywhere", found.zero == found.all ? 0.0f : found.maximum));
}

Error unclear(const std::string& path, const std::string& what) {
  return Error(ErrorKind::kUsage, fmt::format("'{}': {}", path, what));
}

DepthKind kind_of(const DepthNumbers& depth, const DepthFormat& format) {
  if (!format.kind && depth.codes > 0) {
    throw unclear(depth.path, fmt::format("its integers are ambiguous: set `depth-kind` to one of {}",
                                          fmt::join(names_of(kDepthKindTable), ", ")));
  }
  return format.kind.value_or(DepthKind::kMetres);
}

// Rejects formats that need a scale but lack it, and a near end behind the far one.
void check_range(const DepthNumbers& depth, const DepthFormat& format, DepthKind kind) {
  const bool is_inverse = kind == DepthKind::kInverse && (depth.codes > 0 || format.farthest);
  const std::string_view name = name_in(kDepthKindTable, kind);
  if (format.has_scale && !format.nearest && (kind == DepthKind::kDisparity || is_inverse)) {
    throw unclear(depth.path,
                  fmt::format("`depth-kind` {} needs a scale: `near` METRES, or `eye-height` METRES", name));
  }
  if (kind == DepthKind::kRelative && (!format.nearest || !format.farthest)) {
    throw unclear(depth.path, "`depth-kind` relative needs both ends: `near` METRES `far` METRES");
  }
  if (format.nearest && format.farthest && *format.nearest >= *format.farthest) {
    throw unclear(depth.path, "`near` must be nearer than `far`");
  }
}

// Converts a number of the file to 1 / metres.
class Meaning {
 public:
  Meaning(const DepthNumbers& depth, const DepthFormat& format, DepthKind kind, const Survey& found) : kind_(kind) {
    const bool is_unit = depth.codes > 0 || (found.minimum >= 0.0f && found.maximum <= 1.0f);
    minimum_ = is_unit ? 0.0f : found.minimum;
    range_ = is_unit ? 1.0f : found.maximum - found.minimum;
    if (kind == DepthKind::kDisparity) minimum_ = 0.0f, range_ = found.maximum;
    if (kind == DepthKind::kInverse && !format.nearest && depth.codes == 0) minimum_ = 0.0f, range_ = 1.0f;
    if (kind == DepthKind::kMetres || kind == DepthKind::kMillimetres) {
      minimum_ = 0.0f, range_ = 1.0f / static_cast<float>(std::max(depth.codes, 1));
      if (kind == DepthKind::kMillimetres) range_ *= 1000.0f;
    }
    const float far = format.farthest.value_or(std::numeric_limits<float>::infinity());
    near_end_ = kind == DepthKind::kRelative ? *format.nearest : 1.0f / format.nearest.value_or(1.0f);
    far_end_ = kind == DepthKind::kRelative ? far : kind == DepthKind::kDisparity ? 0.0f : 1.0f / far;
  }

  bool are_distances() const { return kind_ == DepthKind::kMetres || kind_ == DepthKind::kMillimetres; }

  // Returns a negative number if the number is not a depth.
  float operator()(float number) const {
    if (std::isnan(number)) return -1.0f;
    if (std::isinf(number)) return are_distances() && number > 0.0f ? 0.0f : -1.0f;
    const float value = (number - minimum_) / range_;
    if (are_distances()) return value > 0.0f ? nearness(value) : -1.0f;
    if (number < 0.0f && minimum_ == 0.0f) return -1.0f;
    if (kind_ == DepthKind::kRelative) return nearness(mix(near_end_, far_end_, value));
    return mix(far_end_, near_end_, value);
  }

 private:
  static float nearness(float metres) { return is_surface(metres) ? 1.0f / std::max(metres, 1e-4f) : 0.0f; }
  static float mix(float a, float b, float t) { return a + (b - a) * t; }

  DepthKind kind_;
  float minimum_ = 0.0f, range_ = 1.0f, near_end_ = 1.0f, far_end_ = 0.0f;
};

}  // namespace

Nearness nearness_of(const DepthNumbers& depth, const DepthFormat& format) {
  const DepthKind kind = kind_of(depth, format);
  check_range(depth, format, kind);
  const Survey found = survey(depth.numbers);
  const Meaning meaning(depth, format, kind, found);
  refuse_nonsense(found, depth.path, meaning.are_distances());
  Nearness nearness{depth.numbers, 0};
  for (float& value : nearness.values.pixels) {
    value = meaning(value);
    if (value >= 0.0f) continue;
    value = 0.0f;
    nearness.invalid++;
  }
  return nearness;
}

// --- another size ----------------------------------------------------------------------------------------------------

namespace {

// The two pixels on either side of a new one.
struct Between {
  int first, second;
  float share;  // weight of the second one
};

std::vector<Between> between(int from, int to, bool wraps) {
  std::vector<Between> all;
  for (int i = 0; i < to; i++) {
    const float at = (static_cast<float>(i) + 0.5f) * static_cast<float>(from) / static_cast<float>(to) - 0.5f;
    const int first = static_cast<int>(std::floor(at));
    const auto inside = [&](int k) { return wraps ? (k + from) % from : std::clamp(k, 0, from - 1); };
    all.push_back({inside(first), inside(first + 1), at - static_cast<float>(first)});
  }
  return all;
}

}  // namespace

Image resized(const Image& nearness, Extent size, bool wraps, bool crisp) {
  if (nearness.width == size.width && nearness.height == size.height) return nearness;
  const std::vector<Between> columns = between(nearness.width, size.width, wraps);
  const std::vector<Between> rows = between(nearness.height, size.height, false);
  Image result(size.width, size.height, 1);
  tbb::parallel_for(0, size.height, [&](int y) {
    const Between& row = rows[static_cast<size_t>(y)];
    for (int x = 0; x < size.width; x++) {
      const Between& column = columns[static_cast<size_t>(x)];
      const float corners[4] = {*nearness.at(column.first, row.first), *nearness.at(column.second, row.first),
                                *nearness.at(column.first, row.second), *nearness.at(column.second, row.second)};
      const float own = corners[(column.share < 0.5f ? 0 : 1) + (row.share < 0.5f ? 0 : 2)];
      const bool is_one = std::all_of(corners, corners + 4, [&](float corner) { return is_one_surface(corner, own); });
      const float top = corners[0] + (corners[1] - corners[0]) * column.share;
      const float bottom = corners[2] + (corners[3] - corners[2]) * column.share;
      *result.at(x, y) = crisp && !is_one ? own : top + (bottom - top) * row.share;
    }
  });
  return result;
}

}  // namespace ods
