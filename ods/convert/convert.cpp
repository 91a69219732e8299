// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/convert/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "ods/convert/converter.h"
#include "ods/convert/correct.h"
#include "ods/files/scratch.h"

namespace ods {

// --- possible conversions --------------------------------------------------------------------------------------------

ConvertTarget same_format(const StoredPicture& picture) {
  ConvertTarget format{picture.camera, picture.size, {}};
  for (const StoredEye& eye : picture.eyes) format.eyes.push_back(eye.eye);
  if (picture.front_and_back) format.eyes = {kMono};
  if (!picture.maps.empty()) format.eye = fitting_extent(picture, picture.camera.projection);
  return format;
}

std::vector<RowLayer> row_layers(const StoredPicture& picture) {
  std::vector<RowLayer> layers;
  for (const LayerPixels& layer : picture.eyes[0].layers) {
    const SampleType sample = layer.sample == SampleType::kFloat ? SampleType::kFloat : SampleType::kHalf;
    layers.push_back({layer.channels, layer.rule, sample});
  }
  return layers;
}

static bool is_tilted(const StereoCamera& from, const StereoCamera& to) {
  return length(axis_in_world(make_camera(from)) - axis_in_world(make_camera(to))) > 1e-4f;
}

// Returns whether the target's eyes are at other positions than the picture's. A mono target takes one eye unchanged.
static bool sees_around(const StoredPicture& picture, const ConvertTarget& target) {
  if (target.eyes[0] == kMono) return false;
  return picture.eyes[0].eye == kMono || !same_eyes(picture.camera, target.camera);
}

std::string conversion_fault(const StoredPicture& picture, const ConvertTarget& target) {
  const std::vector<int> eyes = same_format(picture).eyes;
  const bool from_mono = eyes[0] == kMono;
  if (picture.camera.mirrored != target.camera.mirrored) return "a mirrored picture stays mirrored";
  if (target.eyes[0] == kMono) return correction_fault(picture, target);
  for (const int eye : target.eyes) {
    if (!from_mono && std::find(eyes.begin(), eyes.end(), eye) == eyes.end()) {
      return fmt::format("the picture has no {} eye", eye_name(eye));
    }
  }
  if (!from_mono && is_tilted(picture.camera, target.camera)) {
    return "a stereo picture turns about its viewing circle's axis only (yaw): pitched or rolled, its eyes would need "
           "lines of sight that no eye has; a mono one can be tilted";
  }
  if (!sees_around(picture, target) || depth_layer(picture)) return correction_fault(picture, target);
  if (from_mono)
    return "the picture has one eye and no depth from which a second eye could be made: add it with `depth` FILE";
  return "moving the eyes uncovers what was hidden, which needs depth: render to .exr, which keeps it, or add it with "
         "`depth` FILE";
}

bool is_same_picture(const StoredPicture& picture, const ConvertTarget& target) {
  if (!picture.maps.empty()) return false;
  StereoCamera stereo = target.camera;
  stereo.position = picture.camera.position, stereo.lens_radius = picture.camera.lens_radius;
  stereo.focus_distance = picture.camera.focus_distance;
  if (stereo.projection.kind != kPerspective) stereo.projection.aspect = picture.camera.projection.aspect;
  const auto has_eye = [&](int eye) { return picture.eyes[static_cast<size_t>(eye_index(picture, eye))].eye == eye; };
  return stereo == picture.camera && target.right == EyeCorrection() && !has_image_circle(stereo.projection.kind) &&
         target.eye.width == picture.size.width && target.eye.height == picture.size.height && !is_turned(target) &&
         std::all_of(target.eyes.begin(), target.eyes.end(), has_eye);
}

Extent fitting_extent(const StoredPicture& picture, const ProjectionSetting& projection) {
  const ProjectionSetting& own = picture.camera.projection;
  const double natural = natural_height(own, picture.size.width);
  const double stretch = std::max(1.0, picture.size.height / natural);  // for horizontally squeezed eyes
  double density = stretch * pixels_per_radian(own, picture.size.width);
  if (!picture.maps.empty()) {
    const double measured = pixels_per_radian(*picture.maps[0], picture.size, vec3(0.0f, 0.0f, -1.0f));
    if (measured > 0.0) density = measured;
  }
  const double width = density / pixels_per_radian(projection, 1.0);
  const int step = width_step(projection) == 1 ? 4 : 2 * width_step(projection);
  Extent extent;
  extent.width = std::max(1, static_cast<int>(std::lround(std::min(width, double{kMaxSide}) / step))) * step;
  extent.height = natural_height(projection, extent.width);
  extent.height += extent.height % 2;
  return extent;
}

// --- rows ----------------------------------------------------------------------------------------------------------

// Returns whether the target has pixels where the source has none, judged by a grid of samples.
static bool sees_more(const Mapping& mapping) {
  const int kLooks = 128;
  for (int i = 0; i < kLooks * kLooks; i++) {
    const vec2 uv((static_cast<float>(i % kLooks) + 0.5f) / kLooks, (static_cast<float>(i / kLooks) + 0.5f) / kLooks);
    if (look_of(mapping.camera.projection, uv, uv).seen && !mapping.find(0, uv, uv).seen) return true;
  }
  return false;
}

static bool is_whole(const ProjectionSetting& projection) {
  return is_full_lat_long(projection) || is_cube(projection.kind);
}

Conversion convert(const StoredPicture& picture, const ConvertTarget& target) {
  assert(conversion_fault(picture, target).empty());
  Conversion conversion;
  conversion.rows.eye = target.eye;
  conversion.rows.eyes = target.eyes;
  conversion.rows.layers = row_layers(picture);
  std::vector<std::string>& colour = conversion.rows.layers[0].channels;
  conversion.sees_around = sees_around(picture, target);
  const auto plan = std::make_shared<const SourcePlan>(make_plan(picture, target));
  const bool has_holes =
      conversion.sees_around && (target.holes == Holes::kEmpty || !is_whole(picture.camera.projection));
  const bool adds_alpha = colour.back() != "A" && !plan->is_same && (has_holes || sees_more(plan->mapping));
  if (adds_alpha) colour.push_back("A");
  const auto converter =
      std::make_shared<const Converter>(*plan, plan->mapping.source, conversion.sees_around, adds_alpha, target.holes);
  conversion.no_depth = converter->no_depth();
  std::vector<bool> corrected;
  for (int i = 0; i < static_cast<int>(target.eyes.size()); i++)
    corrected.push_back(corrects_colors(picture, target, i));
  conversion.rows.fill = [plan, converter, corrected, right = target.right, empty = conversion.empty,
                          filled = conversion.filled,
                          channels = count_channels(conversion.rows.layers)](int index, int y, std::span<float> row) {
    const RowHoles holes = converter->fill(index, y, row);
    *empty += holes.empty, *filled += holes.filled;
    if (corrected[static_cast<size_t>(index)]) correct_colors(right, channels, row);
  };
  if (picture.memory) conversion.rows.band_done = [memory = picture.memory] { memory->release(); };
  return conversion;
}

}  // namespace ods
