// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/identify/thumbnail.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "ods/image/tone.h"
#include "ods/kernel/surface.h"

namespace ods {

namespace {

// Fills a row of the file with luminance, or with `part` of its colours. NaN and negative light count as black.
using Rows = std::function<void(int y, std::vector<float>& row)>;

Rows rows_of(const StoredPicture& whole, const std::function<float(vec3)>& part = luminance) {
  const LayerPixels& layer = whole.eyes[0].layers[0];
  const size_t step = bytes_of(layer.sample);
  const bool is_float = whole.is_float;
  const int largest = layer.sample == SampleType::kUint8 ? 255 : 65535;
  const std::vector<float> light = is_float ? std::vector<float>() : linear_from_encoded(largest);
  return [=, width = whole.size.width](int y, std::vector<float>& row) {
    const std::byte* at = layer.first + y * layer.row_stride;
    row.resize(static_cast<size_t>(width));
    for (float& value : row) {
      vec3 rgb;
      for (int c = 0; c < 3; c++) {
        const float sample = sample_value(layer.sample, at + static_cast<size_t>(c) * step);
        const float code = sample * static_cast<float>(largest) + 0.5f;
        rgb[c] = is_float ? sample : light[static_cast<size_t>(code)];
      }
      value = std::max(0.0f, part(rgb));
      if (!std::isfinite(value)) value = 0.0f;
      at += layer.pixel_stride;
    }
  };
}

// The largest size up to `most` that keeps halves, thirds and sixths of a side on pixel borders.
int reduced(int side, int maximum) {
  constexpr int kParts = 12;
  return side <= maximum ? side : maximum / kParts * kParts;
}

Image reduce(const Rows& rows, Extent file, Extent size) {
  Image small(size.width, size.height, 1);
  std::vector<float> row, sums(static_cast<size_t>(size.width));
  std::vector<int> counts(static_cast<size_t>(size.width));
  int begin = 0;
  for (int y = 0; y < size.height; y++) {
    const int end = static_cast<int>(static_cast<int64_t>(y + 1) * file.height / size.height);
    std::fill(sums.begin(), sums.end(), 0.0f);
    std::fill(counts.begin(), counts.end(), 0);
    for (; begin < end; begin++) {
      rows(begin, row);
      for (int x = 0; x < file.width; x++) {
        const auto to = static_cast<size_t>(static_cast<int64_t>(x) * size.width / file.width);
        sums[to] += row[static_cast<size_t>(x)];
        counts[to]++;
      }
    }
    for (int x = 0; x < size.width; x++) {
      *small.at(x, y) = sums[static_cast<size_t>(x)] / static_cast<float>(counts[static_cast<size_t>(x)]);
    }
  }
  return small;
}

void expose(std::vector<Image*> images) {
  double sum = 0.0, count = 0.0;
  for (const Image* light : images) {
    for (float value : light->pixels) {
      if (value > 0.0f) sum += std::log(static_cast<double>(value)), count += 1.0;
    }
  }
  if (count == 0.0) return;
  const float scale = static_cast<float>(0.25 / std::exp(sum / count));
  for (Image* light : images) {
    for (float& value : light->pixels) value *= scale;
  }
}

// Approximate display curve.
float as_shown(float light) {
  return std::sqrt(std::min(light, 1.0f));
}

float difference(float a, float b) {
  return std::abs(as_shown(a) - as_shown(b));
}

// Compares pixels at some places all over the file, at full resolution.
void compare_neighbours(const Rows& rows, Thumbnail& thumbnail) {
  constexpr int kRows = 96;
  double beside[2] = {}, below[2] = {};  // differences of adjacent pixels, and of every other one
  double along = 0.0, down = 0.0, diagonal = 0.0, blocks = 0.0;
  std::vector<float> here, next, other;
  for (int i = 0; i < kRows; i++) {
    const int y = static_cast<int>(static_cast<int64_t>(thumbnail.file.height - 2) * i / kRows);
    if (y < 0) continue;
    rows(y, here), rows(y + 1, next), rows(std::min(y + 2, thumbnail.file.height - 1), other);
    for (size_t x = 0; x + 2 < here.size(); x++) {
      beside[0] += static_cast<double>(difference(here[x], here[x + 1]));
      beside[1] += static_cast<double>(difference(here[x], here[x + 2]));
      below[0] += static_cast<double>(difference(here[x], next[x]));
      below[1] += static_cast<double>(difference(here[x], other[x]));
      const float a = as_shown(here[x]), b = as_shown(here[x + 1]), c = as_shown(next[x]), d = as_shown(next[x + 1]);
      along += static_cast<double>(std::abs(a - b + c - d)), down += static_cast<double>(std::abs(a + b - c - d));
      diagonal += static_cast<double>(std::abs(a - b - c + d)), blocks++;
    }
  }
  if (beside[1] > 0.0) thumbnail.other_columns = beside[0] / beside[1];
  if (below[1] > 0.0) thumbnail.other_rows = below[0] / below[1];
  if (std::min(along, down) > 0.0) thumbnail.crossed = diagonal / std::min(along, down);
  if (blocks == 0.0) return;
  thumbnail.diagonal = diagonal / blocks, thumbnail.beside = beside[0] / blocks, thumbnail.below = below[0] / blocks;
}

constexpr float kBlack = 0.07f;  // as displayed, including codec artifacts

// Fraction of a row or a column that is not black.
double lit_share(const std::vector<float>& lights) {
  const auto lit = std::count_if(lights.begin(), lights.end(), [](float light) { return as_shown(light) > kBlack; });
  return static_cast<double>(lit) / static_cast<double>(lights.size());
}

// The number of black entries at one end, up to the first one that is mostly not black.
int bar_of(int count, const std::function<double(int)>& lit, bool from_end) {
  constexpr double kNothing = 0.003, kMuch = 0.5;
  constexpr int kBlurred = 4;
  int bar = 0;
  const auto at = [&](int i) { return lit(from_end ? count - 1 - i : i); };
  while (bar < count / 3 && at(bar) <= kNothing) bar++;
  for (int i = bar; i < bar + kBlurred; i++) {
    if (at(i) >= kMuch) return bar;
  }
  return 0;
}

// The width of the bars at both ends, if they are equal; otherwise 0.
int bars_at_ends(int count, const std::function<double(int)>& lit) {
  const int first = bar_of(count, lit, false), last = bar_of(count, lit, true), minimum = std::max(3, count / 100);
  return std::min(first, last) >= minimum && std::abs(first - last) <= std::max(2, count / 200) ? std::min(first, last)
                                                                                                : 0;
}

}  // namespace

bool has_clear_corners(const StoredPicture& whole) {
  const LayerPixels& layer = whole.eyes[0].layers[0];
  constexpr size_t kAlpha = 3;
  if (layer.channels.size() <= kAlpha) return false;
  const auto is_clear = [&](int x, int y) {
    const std::byte* const at = layer.first + y * layer.row_stride + x * layer.pixel_stride;
    return sample_value(layer.sample, at + kAlpha * bytes_of(layer.sample)) == 0.0f;
  };
  const int right = whole.size.width - 1, bottom = whole.size.height - 1;
  return is_clear(0, 0) && is_clear(right, 0) && is_clear(0, bottom) && is_clear(right, bottom);
}

namespace {

// The ground of a drawing: pixels of nearly one colour. Black is judged more strictly, because it also surrounds the
// circles of lenses and fills dark scenes.
struct Ground {
  vec3 color;
  bool is_dark() const { return std::max({color.x, color.y, color.z}) <= 0.08f; }
  bool has(vec3 other) const {
    const vec3 off = abs(other - color);
    return std::max({off.x, off.y, off.z}) <= (is_dark() ? 0.002f : 0.015f);  // JPEG's artifacts
  }
};

}  // namespace

bool has_one_ground(const StoredPicture& whole, double min_black) {
  constexpr int kPlaces = 256;
  constexpr double kEdgeShare = 0.6, kInsideShare = 0.15;
  const LayerPixels& layer = whole.eyes[0].layers[0];
  if (whole.is_float || layer.channels.size() < 3) return false;
  const auto color = [&](double x, double y) {
    const auto column = static_cast<ptrdiff_t>(x * whole.size.width),
               row = static_cast<ptrdiff_t>(y * whole.size.height);
    const std::byte* const at = layer.first + row * layer.row_stride + column * layer.pixel_stride;
    const size_t step = bytes_of(layer.sample);
    return vec3(sample_value(layer.sample, at), sample_value(layer.sample, at + step),
                sample_value(layer.sample, at + 2 * step));
  };
  const auto share = [&](const Ground& ground, const std::function<vec3(int)>& at, int count) {
    int own = 0;
    for (int i = 0; i < count; i++) own += ground.has(at(i)) ? 1 : 0;
    return static_cast<double>(own) / count;
  };
  const auto part = [](int i) { return (i + 0.5) / kPlaces; };
  constexpr double kEnd = 1.0 - 1e-9;
  const std::function<vec3(int)> edges[] = {
      [&](int i) { return color(part(i), 0.0); }, [&](int i) { return color(part(i), kEnd); },
      [&](int i) { return color(0.0, part(i)); }, [&](int i) { return color(kEnd, part(i)); }};
  // If most of an edge has one colour, one of these few pixels has it.
  for (int i = kPlaces / 16; i < kPlaces; i += kPlaces / 8) {
    const Ground ground{edges[0](i)};
    const bool is_around = std::ranges::all_of(
        edges, [&](const std::function<vec3(int)>& edge) { return share(ground, edge, kPlaces) >= kEdgeShare; });
    const auto inside = [&](int k) { return color(part(k % kPlaces), part(k / kPlaces)); };
    if (is_around && share(ground, inside, kPlaces * kPlaces) >= (ground.is_dark() ? min_black : kInsideShare))
      return true;
  }
  return false;
}

Bars bars_of(const StoredPicture& whole) {
  constexpr int kRows = 200;
  const Rows rows = rows_of(whole);
  const Extent size = whole.size;
  std::vector<float> row;
  Bars bars;
  bars.top = bars.bottom = bars_at_ends(size.height, [&](int y) {
    rows(y, row);
    return lit_share(row);
  });
  std::vector<double> lit(static_cast<size_t>(size.width));  // count of lit pixels over some rows
  for (int i = 0; i < kRows; i++) {
    rows(bars.top + static_cast<int>(static_cast<int64_t>(size.height - 2 * bars.top) * i / kRows), row);
    for (size_t x = 0; x < lit.size(); x++) lit[x] += as_shown(row[x]) > kBlack ? 1.0 / kRows : 0.0;
  }
  bars.left = bars.right = bars_at_ends(size.width, [&](int x) { return lit[static_cast<size_t>(x)]; });
  return bars;
}

StoredPicture without_bars(const StoredPicture& whole, const Bars& bars) {
  StoredPicture part = whole;
  part.size = {whole.size.width - bars.left - bars.right, whole.size.height - bars.top - bars.bottom};
  for (LayerPixels& layer : part.eyes[0].layers)
    layer.first += bars.top * layer.row_stride + bars.left * layer.pixel_stride;
  return part;
}

Thumbnail make_thumbnail(const StoredPicture& whole) {
  Thumbnail thumbnail;
  thumbnail.file = whole.size;
  const Rows rows = rows_of(whole);
  thumbnail.light =
      reduce(rows, thumbnail.file,
             {reduced(thumbnail.file.width, kThumbnailSide), reduced(thumbnail.file.height, kThumbnailSide)});
  if (whole.is_float) expose({&thumbnail.light});
  compare_neighbours(rows, thumbnail);
  return thumbnail;
}

std::vector<Image> color_parts(const StoredPicture& whole, Extent size) {
  std::vector<Image> parts;
  for (int c = 0; c < 3; c++)
    parts.push_back(reduce(rows_of(whole, [c](vec3 rgb) { return rgb[c]; }), whole.size, size));
  if (whole.is_float) expose({&parts[0], &parts[1], &parts[2]});
  return parts;
}

std::vector<Image> interleaved_eyes(const StoredPicture& whole, Layout layout) {
  const EyePacking how = arrangement_of(layout).how;
  const int across = how == EyePacking::kRows ? 1 : 2, down = how == EyePacking::kRows ? 2 : 1;
  const Rows rows = rows_of(whole);
  std::vector<Image> eyes;
  for (int eye = 0; eye < 2; eye++) {
    const Extent all{whole.size.width / across, whole.size.height / down};
    const Rows rows_of_eye = [&, row = std::vector<float>()](int y, std::vector<float>& own) mutable {
      const int first = how == EyePacking::kCheckerboard ? (y + eye) % 2 : across == 2 ? eye : 0;
      rows(down * y + (down == 2 ? eye : 0), row);
      own.resize(static_cast<size_t>(all.width));
      for (size_t x = 0; x < own.size(); x++)
        own[x] = row[static_cast<size_t>(across) * x + static_cast<size_t>(first)];
    };
    const int high = how == EyePacking::kCheckerboard ? all.height / 2 : all.height;  // scaled down like its rows
    eyes.push_back(reduce(rows_of_eye, all, {reduced(all.width, kThumbnailSide), reduced(high, kThumbnailSide)}));
  }
  if (whole.is_float) expose({&eyes[0], &eyes[1]});
  return eyes;
}

Image shown(const Image& light) {
  Image result = light;
  for (float& value : result.pixels) value = srgb_encode(std::clamp(value, 0.0f, 1.0f));
  return result;
}

}  // namespace ods
