// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/page_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/kernel/camera/angles.h"

namespace ods {

namespace {

constexpr int kMaxPage = 2048;
constexpr float kQuarter = std::numbers::pi_v<float> / 4.0f;
constexpr int kFacePlanes = 6;

struct FaceAxes {
  vec3 right, down, ahead;
};

constexpr FaceAxes kAxes[kFaces] = {
    {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}},  {{0, 0, 1}, {0, -1, 0}, {1, 0, 0}}, {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
    {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
};

// The edge after the first pages of a face, -1..1 by angle.
float edge_at(const PageGrid& grid, int pages) {
  return 2.0f * static_cast<float>(pages) / static_cast<float>(grid.across()) - 1.0f;
}

// The position of a direction in a face: 0 .. across, divided evenly by angle.
vec2 in_face(const PageGrid& grid, int face, vec3 direction) {
  const FaceAxes& axes = kAxes[face];
  const float ahead = dot(direction, axes.ahead);
  const vec2 at(atan_of(dot(direction, axes.right), ahead), atan_of(dot(direction, axes.down), ahead));
  return 0.5f * (at / kQuarter + 1.0f) * static_cast<float>(grid.across());
}

// Texels, from a position in a page, 0..1 without the gutters.
vec2 in_texels(const PageGrid& grid, vec2 inner) {
  return static_cast<float>(PageGrid::kGutter) + inner * static_cast<float>(grid.inner());
}

// The slope of the rays at a position in a page, along one axis of its face.
float slope_at(const PageGrid& grid, int cell, float texel) {
  const float inner = (texel - static_cast<float>(PageGrid::kGutter)) / static_cast<float>(grid.inner());
  const float at = 2.0f * (inner + static_cast<float>(cell)) / static_cast<float>(grid.across()) - 1.0f;
  return std::tan(at * kQuarter);
}

vec3 ray_at(int face, float right, float down) {
  return normalize(kAxes[face].ahead + kAxes[face].right * right + kAxes[face].down * down);
}

}  // namespace

PageGrid::PageGrid(int size, int across) : size_(size), across_(across) {
  for (int cell = 0; cell < across; cell++) {
    for (int texel = 0; texel < size; texel++)
      slopes_.push_back(slope_at(*this, cell, static_cast<float>(texel) + 0.5f));
  }
}

float PageGrid::pixel() const {
  return 2.0f * kQuarter / static_cast<float>(inner() * across_);
}

vec3 PageGrid::texel_ray(int page, int x, int y) const {
  const int per_face = across_ * across_;
  return ray_at(page / per_face, slopes_[static_cast<size_t>(page % across_ * size_ + x)],
                slopes_[static_cast<size_t>(page % per_face / across_ * size_ + y)]);
}

PageGrid page_grid(int width) {
  const int face = std::max((width + 3) / 4, 4);
  const int across = (face + kMaxPage - 1) / kMaxPage;
  const int page = (face + across - 1) / across;
  return {std::min((page + 2 * PageGrid::kGutter + 3) / 4 * 4, kMaxPage), across};
}

int face_of(vec3 direction) {
  int found = 0;
  for (int face = 1; face < kFaces; face++) {
    if (dot(direction, kAxes[face].ahead) > dot(direction, kAxes[found].ahead)) found = face;
  }
  return found;
}

PagePlace place_in_pages(const PageGrid& grid, vec3 direction) {
  const int face = face_of(direction);
  const vec2 at = in_face(grid, face, direction);
  const auto cell = [&](float whole) { return std::clamp(static_cast<int>(whole), 0, grid.across() - 1); };
  const int column = cell(at.x), row = cell(at.y);
  const vec2 cells(static_cast<float>(column), static_cast<float>(row));
  return {(face * grid.across() + row) * grid.across() + column, in_texels(grid, at - cells)};
}

vec2 to_page(const PageGrid& grid, int page, vec3 direction) {
  const int per_face = grid.across() * grid.across();
  const vec2 cells(static_cast<float>(page % grid.across()), static_cast<float>(page % per_face / grid.across()));
  return in_texels(grid, in_face(grid, page / per_face, direction) - cells);
}

vec3 from_page(const PageGrid& grid, int page, vec2 position) {
  const int per_face = grid.across() * grid.across();
  return ray_at(page / per_face, slope_at(grid, page % grid.across(), position.x),
                slope_at(grid, page % per_face / grid.across(), position.y));
}

int page_plane_count(const PageGrid& grid) {
  return kFacePlanes + kFaces * 2 * (grid.across() - 1);
}

PagePlane page_plane(const PageGrid& grid, int index) {
  if (index < kFacePlanes) {
    const int axis = index / 2;
    vec3 normal(0.0f);
    normal[axis] = 1.0f;
    normal[(axis + 1) % 3] = index % 2 == 0 ? 1.0f : -1.0f;
    return {normalize(normal), -1};
  }
  const int divider = (index - kFacePlanes) / 2;
  const int face = divider / (grid.across() - 1);
  const FaceAxes& axes = kAxes[face];
  const float slope = std::tan(edge_at(grid, 1 + divider % (grid.across() - 1)) * kQuarter);
  const vec3 across = (index - kFacePlanes) % 2 == 0 ? axes.right : axes.down;
  return {normalize(across - axes.ahead * slope), face};
}

}  // namespace ods
