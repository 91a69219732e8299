// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/video/interleaved.h"

#include <cstring>
#include <vector>

namespace ods {

namespace {

// Samples of 8 bits, or of more in 16.
struct Plane {
  const std::byte* first = nullptr;
  size_t stride = 0, width = 0, height = 0, sample = 1;
};

}  // namespace

// Writes the rows without gaps.
static void divide(const Plane& plane, Views views, std::byte* to) {
  const size_t row_bytes = plane.width * plane.sample;
  for (size_t y = 0; y < plane.height; y++) {
    const std::byte* const row = plane.first + y * plane.stride;
    if (views == Views::kRows) {
      std::memcpy(to + (y / 2 + y % 2 * (plane.height - plane.height / 2)) * row_bytes, row, row_bytes);
      continue;
    }
    for (size_t x = 0; x < plane.width; x++) {
      const size_t column = x / 2 + x % 2 * (plane.width - plane.width / 2);
      std::memcpy(to + y * row_bytes + column * plane.sample, row + x * plane.sample, plane.sample);
    }
  }
}

DecodedFrame take_apart(const DecodedFrame& frame, Extent size, Views views) {
  const Extent block = chroma_block(frame.planes.chroma);
  const auto plane_of = [&](const std::byte* first, size_t stride, Extent share) {
    return Plane{first, stride, static_cast<size_t>(size.width / share.width),
                 static_cast<size_t>(size.height / share.height), frame.planes.bits > 8 ? size_t{2} : size_t{1}};
  };
  std::vector<Plane> planes;
  for (size_t i = 0; i < 3; i++) {
    planes.push_back(plane_of(frame.planes.first[i], frame.planes.stride[i], i == 0 ? Extent{1, 1} : block));
  }
  if (frame.alpha != nullptr) planes.push_back(plane_of(frame.alpha, frame.alpha_stride, {1, 1}));
  size_t bytes = 0;
  for (const Plane& plane : planes) bytes += plane.width * plane.height * plane.sample;
  const auto memory = std::make_shared<std::vector<std::byte>>(bytes);
  DecodedFrame apart = frame;
  std::byte* to = memory->data();
  for (size_t i = 0; i < planes.size(); i++) {
    const size_t stride = planes[i].width * planes[i].sample;
    divide(planes[i], views, to);
    if (i < 3) apart.planes.first[i] = to, apart.planes.stride[i] = stride;
    if (i == 3) apart.alpha = to, apart.alpha_stride = stride;
    to += stride * planes[i].height;
  }
  apart.memory = memory;
  return apart;
}

}  // namespace ods
