// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/video/shifted_frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ods {

// The shift of a pixel's position. Returns nullopt if it is between texels.
static std::optional<PixelShift> shift_at(const Mapping& mapping, int index, int x, int y) {
  const float kTolerance = 1.0f / 256.0f;  // as in texel_filter.h
  const vec2 home = mapping.home_of(x, y);
  const Place place = mapping.find(index, home, home);
  const vec2 off = place.at - vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const vec2 whole(std::round(off.x), std::round(off.y));
  if (!place.seen || std::abs(off.x - whole.x) >= kTolerance || std::abs(off.y - whole.y) >= kTolerance) return {};
  const int width = mapping.source.picture->size.width, column = static_cast<int>(whole.x);
  return PixelShift{place.source_eye, (column % width + width) % width, static_cast<int>(whole.y)};
}

// Between two lat-longs with the same axis, positions are linear, so a grid of pixels determines all. For two pictures
// of the same projection, the grid determines whether they are the same.
static std::optional<PixelShift> find_shift(const Mapping& mapping, int index) {
  const int kSteps = 32;
  std::optional<PixelShift> all;
  for (int i = 0; i <= kSteps; i++) {
    for (int j = 0; j <= kSteps; j++) {
      const int x = (mapping.size.width - 1) * i / kSteps, y = (mapping.size.height - 1) * j / kSteps;
      const std::optional<PixelShift> here = shift_at(mapping, index, x, y);
      if (!here) return {};
      if (!all) all = here;
      if (here->source_eye != all->source_eye || here->column != all->column || here->row != all->row) return {};
    }
  }
  return all;
}

std::optional<std::vector<PixelShift>> find_shifts(const Mapping& mapping, Extent block) {
  const ProjectionSetting &made = mapping.stereo.projection, &old = mapping.source.picture->camera.projection;
  const bool may_shift = made.kind == kLatLong && old.kind == kLatLong;
  if (!may_shift && made != old) return {};
  std::vector<PixelShift> shifts;
  for (int index = 0; index < static_cast<int>(mapping.eyes.size()); index++) {
    const std::optional<PixelShift> shift = find_shift(mapping, index);
    if (!shift || shift->column % block.width != 0 || shift->row % block.height != 0) return {};
    if (!may_shift && (shift->column != 0 || shift->row != 0)) return {};
    shifts.push_back(*shift);
  }
  return shifts;
}

void copy_shifted(const Planes& from, Extent from_size, const PixelShift& shift, const Planes& to, Extent to_size) {
  const size_t sample = from.bits > 8 ? 2 : 1;
  for (size_t i = 0; i < 3; i++) {
    const Extent block = i == 0 ? Extent{1, 1} : chroma_block(from.chroma);
    const int all = from_size.width / block.width, width = to_size.width / block.width;
    const int column = shift.column / block.width, before = std::min(width, all - column);
    tbb::parallel_for(tbb::blocked_range<int>(0, to_size.height / block.height, 64), [&](const auto& range) {
      for (int y = range.begin(); y < range.end(); y++) {
        const std::byte* in = from.first[i] + static_cast<size_t>(y + shift.row / block.height) * from.stride[i];
        std::byte* out = to.first[i] + static_cast<size_t>(y) * to.stride[i];
        const size_t first = static_cast<size_t>(before) * sample, rest = static_cast<size_t>(width - before) * sample;
        std::memcpy(out, in + static_cast<size_t>(column) * sample, first);
        std::memcpy(out + first, in, rest);
      }
    });
  }
}

}  // namespace ods
