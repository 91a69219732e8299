// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/light/push.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace ods {
namespace {

struct PushedTexture {
  Image& image;
  std::vector<int> owners;  // of the texels with a colour, -1 for others

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x);
  }
};

// Sets the texel to the mean of the colours of `owner` around it. Returns false if there are none.
bool take_mean(PushedTexture& texture, int x, int y, int owner) {
  Image& image = texture.image;
  float* const to = image.at(x, y);
  int count = 0;
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, image.height - 1); row++) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, image.width - 1); column++) {
      if (texture.owners[texture.index(column, row)] != owner) continue;
      const float* from = image.at(column, row);
      for (int c = 0; c < image.channels; c++) to[c] = (count == 0 ? 0.0f : to[c]) + from[c];
      count++;
    }
  }
  for (int c = 0; c < image.channels && count > 0; c++) to[c] /= static_cast<float>(count);
  return count > 0;
}

// Returns false if no texel was filled. Texels that are filled have no owner before the ring is complete.
bool push_ring(PushedTexture& texture, const std::vector<int>& claims) {
  std::vector<std::vector<int>> filled(static_cast<size_t>(texture.image.height));  // columns, by row
  tbb::parallel_for(0, texture.image.height, [&](int y) {
    for (int x = 0; x < texture.image.width; x++) {
      const size_t i = texture.index(x, y);
      if (texture.owners[i] >= 0 || claims[i] < 0) continue;
      if (take_mean(texture, x, y, claims[i])) filled[static_cast<size_t>(y)].push_back(x);
    }
  });
  bool any = false;
  for (int y = 0; y < texture.image.height; y++) {
    for (const int x : filled[static_cast<size_t>(y)]) {
      any = true;
      texture.owners[texture.index(x, y)] = claims[texture.index(x, y)];
    }
  }
  return any;
}

// --- the nearest texel with a colour ---------------------------------------------------------------------------------
// By the lower envelope of parabolas: Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions", 2012.

constexpr int kNone = -1;

// The row of the nearest colour in the same column, for each texel; the upper one of two. kNone for an empty column.
std::vector<int> nearest_rows(const PushedTexture& texture) {
  const int width = texture.image.width, height = texture.image.height;
  std::vector<int> rows(texture.owners.size(), kNone);
  tbb::parallel_for(0, width, [&](int x) {
    int above = kNone;
    for (int y = 0; y < height; y++) {
      if (texture.owners[texture.index(x, y)] >= 0) above = y;
      rows[texture.index(x, y)] = above;
    }
    int below = kNone;
    for (int y = height - 1; y >= 0; y--) {
      int& row = rows[texture.index(x, y)];
      if (row == y) below = y;
      if (below != kNone && (row == kNone || below - y < y - row)) row = below;
    }
  });
  return rows;
}

int64_t square(int64_t v) {
  return v * v;
}

// The column of the nearest colour for each texel of a row, whose colours are in other rows.
std::vector<int> nearest_columns(const PushedTexture& texture, const std::vector<int>& rows, int y) {
  struct Parabola {
    int column;
    double from;  // it is the lowest from here on
  };
  const auto height_at = [&](int column) { return square(rows[texture.index(column, y)] - y); };
  std::vector<Parabola> envelope;
  for (int x = 0; x < texture.image.width; x++) {
    if (rows[texture.index(x, y)] == kNone) continue;
    double from = -1.0;
    while (!envelope.empty()) {
      const int other = envelope.back().column;
      from = static_cast<double>(height_at(x) + square(x) - height_at(other) - square(other)) / (2.0 * (x - other));
      if (from > envelope.back().from) break;
      envelope.pop_back();
      from = -1.0;
    }
    envelope.push_back({x, from});
  }
  std::vector<int> columns(static_cast<size_t>(texture.image.width), kNone);
  size_t at = 0;
  for (int x = 0; x < texture.image.width && !envelope.empty(); x++) {
    while (at + 1 < envelope.size() && envelope[at + 1].from < x) at++;
    columns[static_cast<size_t>(x)] = envelope[at].column;
  }
  return columns;
}

void fill_rest(PushedTexture& texture) {
  const std::vector<int> rows = nearest_rows(texture);
  Image& image = texture.image;
  tbb::parallel_for(0, image.height, [&](int y) {
    const std::vector<int> columns = nearest_columns(texture, rows, y);
    for (int x = 0; x < image.width; x++) {
      const int column = columns[static_cast<size_t>(x)];
      if (texture.owners[texture.index(x, y)] >= 0 || column == kNone) continue;
      std::copy_n(image.at(column, rows[texture.index(column, y)]), image.channels, image.at(x, y));
    }
  });
}

}  // namespace

void push_outwards(Image& image, const std::vector<int>& owners, const std::vector<int>& claims, int rings) {
  assert(owners.size() * static_cast<size_t>(image.channels) == image.pixels.size() && claims.size() == owners.size());
  PushedTexture texture{image, owners};
  for (int ring = 0; ring < rings && push_ring(texture, claims); ring++) {
  }
  fill_rest(texture);
}

}  // namespace ods
