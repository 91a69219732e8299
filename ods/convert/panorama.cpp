// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/panorama.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ods/kernel/camera/line.h"

namespace ods {

static vec2 size_of(const Source& source) {
  return {static_cast<float>(source.picture->size.width), static_cast<float>(source.picture->size.height)};
}

bool is_apart_at_pole(const Camera& camera, bool above) {
  if (camera.axis.y != 1.0f) return false;  // the circle has its own poles
  const float side = above ? 1.0f : -1.0f;
  return merge_at(camera, vec3(0.0f, side, 0.0f), side * 0.5f * kPi) > 0.5f;
}

Source make_source(const StoredPicture& picture) {
  assert(!picture.eyes.empty());
  Source source;
  source.picture = &picture;
  source.camera = make_camera(picture.camera);
  source.camera.center = vec3(0.0f);
  if (picture.eyes.size() == 2 && source.camera.ipd > 0.0f && picture.maps.empty()) {
    source.other_above = is_apart_at_pole(source.camera, true);
    source.other_below = is_apart_at_pole(source.camera, false);
  }
  return source;
}

int eye_index(const StoredPicture& picture, int eye) {
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    if (picture.eyes[i].eye == eye) return static_cast<int>(i);
  }
  return 0;
}

int eye_over_pole(const Source& source, int source_eye, bool above) {
  return (above ? source.other_above : source.other_below) ? 1 - source_eye : source_eye;
}

// A fisheye's edge crosses texels: those whose centre is inside are used up to their corners.
static bool is_seen(const Source& source, const ImagePoint& place) {
  if (place.seen || !has_image_circle(source.camera.projection.kind) || !inside_picture(place.uv)) return place.seen;
  const vec2 middle = (floor(place.uv * size_of(source)) + 0.5f) / size_of(source);
  return look_of(source.camera.projection, middle, middle).seen;
}

static Cell cell_at(int kind, Extent size, int column, int row) {
  const int columns = cube_columns(kind), rows = 6 / columns;
  // A texel belongs to the face that contains its centre.
  const auto edge = [](int i, int count, int whole) { return (2 * i * whole + count - 1) / (2 * count); };
  return {edge(column, columns, size.width), edge(row, rows, size.height), edge(column + 1, columns, size.width),
          edge(row + 1, rows, size.height)};
}

// Moves a position away from its face's border: the adjacent face in the file may be unrelated.
static void keep_in_cell(const Source& source, vec3 direction, Place& place) {
  const int kind = source.camera.projection.kind;
  if (!is_cube(kind)) return;
  const int cell = cube_cell_toward(kind, direction), columns = cube_columns(kind);
  const Cell own = cell_at(kind, source.picture->size, cell % columns, cell / columns);
  const auto keep = [](float x, int low, int high) {
    const float kMargin = 1.0f / 128.0f;
    return std::clamp(x, static_cast<float>(low) + kMargin, static_cast<float>(high) - kMargin);
  };
  place.at = {keep(place.at.x, own.left, own.right), keep(place.at.y, own.top, own.bottom)};
}

// Finds a direction given in the picture's own frame.
static Place find_direction(const Source& source, int source_eye, vec3 d) {
  if (!source.picture->maps.empty()) {
    const ImagePoint shown = source.picture->maps[static_cast<size_t>(source_eye)]->place(d);
    return {source_eye, shown.uv * size_of(source), shown.seen};
  }
  const ImagePoint found = place_of(source.camera.projection, d);
  Place place{source_eye, found.uv * size_of(source), is_seen(source, found)};
  keep_in_cell(source, d, place);
  return place;
}

Place place_of_line(const Source& source, int source_eye, vec3 direction) {
  const Camera& camera = source.camera;
  const int which = source.picture->eyes[static_cast<size_t>(source_eye)].eye;
  direction = normalize(direction);
  const vec3 d(dot(direction, camera.right), dot(direction, camera.up), dot(direction, camera.back));
  const vec3 label = line_label(camera, which, d);
  const bool is_off = which == kRight && source.right;
  return find_direction(source, source_eye, is_off ? stored_direction(*source.right, label) : label);
}

Cell cell_of(const Projection& projection, Extent size, vec2 at) {
  const int kind = projection.kind;
  if (!is_cube(kind)) return {0, 0, size.width, size.height};
  const int columns = cube_columns(kind), rows = 6 / columns;
  int column = columns - 1, row = rows - 1;
  Cell cell = cell_at(kind, size, column, row);
  while (column > 0 && at.x < static_cast<float>(cell.left)) cell = cell_at(kind, size, --column, row);
  while (row > 0 && at.y < static_cast<float>(cell.top)) cell = cell_at(kind, size, column, --row);
  return cell;
}

static vec2 middle_of(const Source& source, int x, int y) {
  return (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / size_of(source);
}

bool has_texel(const Source& source, const Cell& cell, int x, int y) {
  if (x < cell.left || x >= cell.right || y < cell.top || y >= cell.bottom) return false;
  if (!has_image_circle(source.camera.projection.kind)) return true;
  const vec2 p = (2.0f * middle_of(source, x, y) - 1.0f) / source.camera.projection.circle;
  return dot(p, p) <= 1.0f;
}

static Texel nearest_of_edge(const Source& source, int source_eye, const Cell& cell, int x, int y) {
  if (has_image_circle(source.camera.projection.kind)) {
    // Moves inwards until a texel nearby has its centre in the circle.
    const vec2 circle = source.camera.projection.circle, across = circle * size_of(source);
    const vec2 p = (2.0f * middle_of(source, x, y) - 1.0f) / circle;
    const float r = length(p), texel = 2.0f / std::min(across.x, across.y);
    const vec2 at =
        (0.5f + 0.5f * circle * p * std::min(std::max(1.0f - 0.75f * texel, 0.0f) / r, 1.0f)) * size_of(source);
    x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  }
  return {source_eye, std::clamp(x, cell.left, cell.right - 1), std::clamp(y, cell.top, cell.bottom - 1)};
}

Texel texel_of(const Source& source, int source_eye, const Cell& cell, int x, int y) {
  if (has_texel(source, cell, x, y)) return {source_eye, x, y};
  if (!source.picture->maps.empty()) return nearest_of_edge(source, source_eye, cell, x, y);
  const Camera& camera = source.camera;
  const vec2 home =
      0.5f * (middle_of(source, cell.left, cell.top) + middle_of(source, cell.right - 1, cell.bottom - 1));
  const vec2 uv = middle_of(source, x, y);
  const ViewDirection look = look_of(camera.projection, home, uv);
  vec3 direction = look.direction;
  int there = source_eye;
  if (abs(look.elevation) > 0.5f * kPi) {
    const int other = eye_over_pole(source, source_eye, look.elevation > 0.0f);
    if (other != source_eye && camera.convergence == kShift) {  // the other eye is turned in the opposite direction
      const int which = source.picture->eyes[static_cast<size_t>(source_eye)].eye;
      direction = turn_about(direction, camera.axis, 2.0f * shift_angle(camera, which));
    }
    there = other;
  }
  const Place place = find_direction(source, there, direction);
  if (!place.seen) return nearest_of_edge(source, source_eye, cell, x, y);
  const Extent size = source.picture->size;
  return {there, std::clamp(static_cast<int>(place.at.x), 0, size.width - 1),
          std::clamp(static_cast<int>(place.at.y), 0, size.height - 1)};
}

}  // namespace ods
