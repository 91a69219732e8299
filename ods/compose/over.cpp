// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/compose/over.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "ods/convert/reproject.h"

namespace ods {

// The foreground, with the background's eyes in its metadata.
static StoredPicture with_eyes_of(StoredPicture foreground, const StereoCamera& camera) {
  StereoCamera& own = foreground.camera;
  own.ipd = camera.ipd, own.neck = camera.neck, own.axis = camera.axis, own.mirrored = camera.mirrored;
  own.top = camera.top, own.bottom = camera.bottom, own.merge_map = camera.merge_map;
  own.head_tilt_map = camera.head_tilt_map;
  return foreground;
}

static bool has_alpha(const StoredPicture& picture) {
  return picture.eyes[0].layers[0].channels.back() == "A";
}

std::string over_fault(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options) {
  if (!has_alpha(foreground) && !options.by_depth) {
    return "the foreground has no alpha and would hide the whole background (`by-depth` needs no alpha)";
  }
  if (options.by_depth && (!depth_layer(foreground) || !depth_layer(background))) {
    return "by depth, both need a depth layer, as in an .exr of ods render or ods title";
  }
  if (foreground.eyes.size() != background.eyes.size()) {
    return fmt::format("the foreground has {} and the background {}",
                       foreground.eyes.size() == 2 ? "two eyes" : "one eye",
                       background.eyes.size() == 2 ? "two" : "one");
  }
  return conversion_fault(with_eyes_of(foreground, background.camera), same_format(background));
}

// --- warnings --------------------------------------------------------------------------------------------------------

static void compare_eyes_of(const StereoCamera& front, const StereoCamera& back, std::vector<std::string>& warnings) {
  const float micrometre = 1e-6f;  // finer than videos store it
  if (std::abs(front.ipd - back.ipd) > micrometre) {
    warnings.push_back(
        fmt::format("the foreground was made for eyes {:g} mm apart, the background for {:g}: make it with "
                    "`ipd` {:g}, or it appears at other distances",
                    1000.0f * front.ipd, 1000.0f * back.ipd, back.ipd));
  }
  if (!same_merge(front.top, back.top) || !same_merge(front.bottom, back.bottom) ||
      !same_map(front.merge_map, back.merge_map)) {
    warnings.push_back("the foreground has another pole merge: near the poles it moves away from what it stands on");
  }
  if (!same_map(front.head_tilt_map, back.head_tilt_map)) {
    warnings.push_back("the foreground has another `head-tilt-map`: its eyes differ in height from the background's");
  }
  if (front.neck != back.neck) warnings.push_back("the foreground has another `eye-to-neck`");
}

std::vector<std::string> over_warnings(const StoredPicture& foreground, const StoredPicture& background) {
  std::vector<std::string> warnings;
  // Other programs' footage has no metadata on its eyes.
  if (foreground.has_ipd && background.has_ipd) compare_eyes_of(foreground.camera, background.camera, warnings);
  return warnings;
}

// --- compositing -----------------------------------------------------------------------------------------------------

namespace {

// Rows of a picture in another's format, with the meaning of the channels.
struct Rows {
  PictureRows rows;
  size_t channels = 0;
  int alpha = -1;  // negative if there is none
  int depth = -1;

  Rows(const StoredPicture& picture, const ConvertTarget& target) : rows(convert(picture, target).rows) {
    for (const RowLayer& layer : rows.layers) {
      if (&layer == &rows.layers[0] && layer.channels.back() == "A")
        alpha = static_cast<int>(layer.channels.size()) - 1;
      if (layer.channels == std::vector<std::string>{"Z"}) depth = static_cast<int>(channels);
      channels += layer.channels.size();
    }
  }
  std::vector<float> row(int index, int y) const {
    std::vector<float> values(channels * static_cast<size_t>(rows.eye.width));
    rows.fill(index, y, values);
    return values;
  }
};

// Pixel counts for a row, as in Overlay.
struct Count {
  int covered = 0, behind = 0;
};

}  // namespace

static Count lay_row(const Rows& front, const Rows& back, const OverOptions& options, const std::vector<float>& before,
                     std::span<float> row) {
  Count count;
  for (size_t x = 0; x < row.size() / back.channels; x++) {
    const float* in = &before[x * front.channels];
    float* out = &row[x * back.channels];
    const float own = front.alpha < 0 ? 1.0f : in[front.alpha];
    const bool covers = front.depth >= 0 && back.depth >= 0 && own > 0.5f && !options.by_depth;
    count.covered += covers, count.behind += covers && in[front.depth] > out[back.depth];
    const bool hidden = options.by_depth && !(in[front.depth] < out[back.depth]);
    const float alpha = hidden ? 0.0f : own * options.opacity;
    if (!(alpha > 0.0f)) continue;
    for (int c = 0; c < 3; c++) out[c] = in[c] * options.opacity + out[c] * (1.0f - alpha);
    if (back.alpha >= 0) out[back.alpha] = alpha + out[back.alpha] * (1.0f - alpha);
    if (front.depth >= 0 && back.depth >= 0 && alpha > 0.5f) out[back.depth] = in[front.depth];
  }
  return count;
}

Overlay lay_over(const StoredPicture& foreground, const StoredPicture& background, const OverOptions& options) {
  assert(over_fault(foreground, background, options).empty());
  const ConvertTarget target = same_format(background);
  const auto moved = std::make_shared<const StoredPicture>(with_eyes_of(foreground, background.camera));
  const auto front = std::make_shared<const Rows>(*moved, target);
  const auto back = std::make_shared<const Rows>(background, target);
  Overlay overlay;
  overlay.rows = back->rows;
  overlay.rows.fill = [moved, front, back, options, covered = overlay.covered, behind = overlay.behind](
                          int index, int y, std::span<float> row) {
    back->rows.fill(index, y, row);
    const Count count = lay_row(*front, *back, options, front->row(index, y), row);
    *covered += count.covered, *behind += count.behind;
  };
  return overlay;
}

PictureRows fitted_foreground(const StoredPicture& foreground, const StoredPicture& background,
                              const OverOptions& options) {
  assert(over_fault(foreground, background, options).empty());
  const auto moved = std::make_shared<const StoredPicture>(with_eyes_of(foreground, background.camera));
  const auto front = std::make_shared<const Rows>(*moved, same_format(background));
  PictureRows rows = front->rows;
  rows.layers = {{{"R", "G", "B", "A"}}};
  rows.fill = [moved, front, opacity = options.opacity](int index, int y, std::span<float> row) {
    const std::vector<float> all = front->row(index, y);
    for (size_t x = 0; x < row.size() / 4; x++) {
      const float* in = &all[x * front->channels];
      for (size_t c = 0; c < 3; c++) row[4 * x + c] = in[c] * opacity;
      row[4 * x + 3] = (front->alpha < 0 ? 1.0f : in[front->alpha]) * opacity;
    }
  };
  return rows;
}

std::string behind_warning(const Overlay& overlay) {
  if (*overlay.behind == 0) return {};
  return fmt::format(
      "{:.3g} % of the foreground is farther away than what it covers: bring it nearer, or use `by-depth`",
      100.0 * static_cast<double>(*overlay.behind) / static_cast<double>(*overlay.covered));
}

}  // namespace ods
