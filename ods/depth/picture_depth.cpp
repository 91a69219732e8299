// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/depth/picture_depth.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "ods/base/error.h"
#include "ods/camera/pixel.h"
#include "ods/depth/floor.h"
#include "ods/depth/nearness.h"
#include "ods/depth/sharpen.h"
#include "ods/files/scratch.h"
#include "ods/kernel/counterpart.h"
#include "ods/picture/load_eyes.h"

namespace ods {

namespace {

const std::vector<std::string> kDepthChannel{"Z"};

// The memory of a picture's pixels and its depth.
struct Kept {
  std::shared_ptr<Scratch> memory;
  std::vector<Image> depth;
};

void set_layer(StoredPicture& picture, const std::vector<Image>& depth) {
  for (size_t i = 0; i < picture.eyes.size(); i++) {
    std::vector<LayerPixels>& layers = picture.eyes[i].layers;
    std::erase_if(layers, [](const LayerPixels& layer) { return layer.channels == kDepthChannel; });
    LayerPixels layer{kDepthChannel, LayerRule::kNearest, SampleType::kFloat, nullptr, sizeof(float), 0};
    layer.row_stride = layer.pixel_stride * picture.size.width;
    if (!depth.empty()) layer.first = reinterpret_cast<const std::byte*>(depth[i].pixels.data());
    layers.push_back(layer);
  }
}

void check_shape(const DepthNumbers& depth, Extent size) {
  constexpr double kTolerance = 0.02;  // estimators round sides to whole blocks
  const double own = 1.0 * depth.numbers.width / depth.numbers.height, wanted = 1.0 * size.width / size.height;
  if (std::abs(own / wanted - 1.0) <= kTolerance) return;
  throw Error(ErrorKind::kInput,
              fmt::format("'{}' has {}x{} pixels, another shape than the picture's {}x{}: is it of this picture?",
                          depth.path, depth.numbers.width, depth.numbers.height, size.width, size.height));
}

GuideImage guide_of(const StoredPicture& picture, size_t eye) {
  GuideImage guide{picture.size.width, picture.size.height, {}};
  guide.pixels.resize(3 * static_cast<size_t>(guide.width) * static_cast<size_t>(guide.height));
  read_colors(picture, eye, [&](int y, const std::vector<float>& row) {
    uint8_t* to = &guide.pixels[3 * static_cast<size_t>(y) * static_cast<size_t>(guide.width)];
    for (const float light : row) *to++ = static_cast<uint8_t>(255.0f * std::sqrt(finite(light, 0.0f, 1.0f)) + 0.5f);
  });
  return guide;
}

// The cosine between a line of sight and the axis along which depth is measured.
float along_axis(const Projection& projection, vec2 uv) {
  const vec3 direction = look_of(projection, uv, uv).direction;
  if (is_cube(projection.kind)) return std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  const vec2 middle(0.5f);
  return dot(direction, look_of(projection, middle, middle).direction);
}

void turn_along_ray(Image& nearness, const StoredPicture& picture, const std::string& path) {
  const Projection projection = make_projection(picture.camera.projection);
  if (!is_cube(projection.kind) && !has_lens(projection.kind)) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}': a {} picture has no axis along which depth could be measured: "
                                               "leave out `depth-along` axis",
                                               path, projection_name(picture.camera.projection)));
  }
  tbb::parallel_for(0, nearness.height, [&](int y) {
    for (int x = 0; x < nearness.width; x++) {
      *nearness.at(x, y) *= std::max(along_axis(projection, pixel_middle(x, y, nearness)), 0.0f);
    }
  });
}

// The options that would read inverted depth correctly.
std::string mend_of(const DepthNumbers& depth, const DepthFormat& format) {
  const DepthKind kind = format.kind.value_or(DepthKind::kMetres);
  if (kind == DepthKind::kInverse || kind == DepthKind::kDisparity) {
    return format.nearest && depth.codes > 0 ? "`depth-kind` relative" : "`depth-kind` metres or relative";
  }
  return "`depth-kind` inverse or disparity";
}

// Converts an eye's depth to metres.
Image metres_of(Image nearness, double scale) {
  const float factor = static_cast<float>(scale);
  tbb::parallel_for(size_t{0}, nearness.pixels.size(), [&](size_t i) {
    float& value = nearness.pixels[i];
    value = value > 1e-9f ? factor / value : kFarDepth;
  });
  return nearness;
}

}  // namespace

void promise_depth(StoredPicture& picture) {
  set_layer(picture, {});
}

std::vector<DepthNumbers> read_depth(const std::string& path, const StoredPicture& picture) {
  if (!names_eye(path)) return depth_of_eyes(read_depth_numbers(path), picture);
  std::vector<DepthNumbers> depth;
  for (const StoredEye& eye : picture.eyes) depth.push_back(read_depth_numbers(path_for_eye(path, eye.eye)));
  return depth;
}

std::vector<DepthNumbers> depth_of_eyes(DepthNumbers depth, const StoredPicture& picture) {
  if (picture.eyes.size() == 1) return {std::move(depth)};
  const Extent whole{depth.numbers.width, depth.numbers.height};
  const Layout layout = arrangement_of(picture.layout).is_halves() ? picture.layout : Layout::kTopBottom;
  const std::optional<Extent> size = unpacked_size(layout, whole);
  const double wanted = 1.0 * picture.size.width / picture.size.height;
  if (!size || std::abs(1.0 * size->width / size->height / wanted - 1.0) > 0.02) {
    throw Error(ErrorKind::kInput,
                fmt::format("'{}' has {}x{} pixels: a picture of two eyes needs the depth of both, {} or in two files "
                            "(%V in the name)",
                            depth.path, whole.width, whole.height, layout_name(layout)));
  }
  std::vector<DepthNumbers> eyes;
  for (Image& numbers : unpack(layout, depth.numbers)) eyes.push_back({std::move(numbers), depth.codes, depth.path});
  return eyes;
}

static void note_invalid(int64_t invalid, const std::string& path, DepthReport& report) {
  if (invalid == 0) return;
  report.notes.push_back(fmt::format(
      "'{}': {} of its numbers are not depths (NaN, negative, 0 metres): treated as far away", path, invalid));
}

static void note_sharpened(double share, DepthReport& report) {
  if (share == 0.0) return;
  report.notes.push_back(
      fmt::format("{:.2g} % of the depth was on soft edges, which are as sharp as the picture's now "
                  "(`depth-edges` soft leaves them)",
                  100.0 * share));
}

static double scale_to_floor(const Image& nearness, const StoredPicture& picture, const std::string& path,
                             float height) {
  const std::optional<double> found = floor_below(nearness, make_camera(picture.camera), picture.eyes[0].eye);
  if (found) return double{height} / *found;
  throw Error(
      ErrorKind::kInput,
      fmt::format("'{}' shows no level floor below the viewer, which `eye-height` needs: give `near` instead", path));
}

// Examines the first eye's depth as a whole: whether it is inverted, and its scale.
static void look_at_whole(const Image& nearness, const StoredPicture& picture, const DepthNumbers& depth,
                          const DepthOptions& options, DepthReport& report) {
  const Camera camera = make_camera(picture.camera);
  const int eye = picture.eyes[0].eye;
  if (looks_inverted(nearness, camera, eye)) {
    report.warnings.push_back(
        fmt::format("'{}' looks inverted: near sky, far floor; if so, {}", depth.path, mend_of(depth, options.format)));
  }
  if (!options.eye_height || options.scale) return;
  report.scale = scale_to_floor(nearness, picture, depth.path, *options.eye_height);
  report.notes.push_back(
      fmt::format("'{}' has its floor {:.4g} below: multiplied by {:.4g}, for eyes {:.3g} m above it", depth.path,
                  double{*options.eye_height} / report.scale, report.scale, *options.eye_height));
}

// Half of the width of the widest soft edges, for a map that is smaller than its picture, or blurred by a 200th of the
// picture's width. Limited for small pictures, where everything would be an edge.
static int ramp_of(Extent size, float ratio) {
  return std::max({static_cast<int>(std::ceil(1.5f * ratio - 1.5f)), size.width / 400, std::min(4, size.width / 128)});
}

static Nearness along_rays(const DepthNumbers& depth, const StoredPicture& picture, const DepthOptions& options) {
  check_shape(depth, picture.size);
  DepthFormat format = options.format;
  format.has_scale = !options.eye_height && !options.scale;
  Nearness nearness = nearness_of(depth, format);
  if (format.along == DepthAlong::kAxis) turn_along_ray(nearness.values, picture, depth.path);
  return nearness;
}

double scale_of(const DepthNumbers& depth, const StoredPicture& picture, const DepthOptions& options) {
  return scale_to_floor(along_rays(depth, picture, options).values, picture, depth.path, *options.eye_height);
}

DepthReport add_depth(StoredPicture& picture, const std::vector<DepthNumbers>& depth, const DepthOptions& options) {
  assert(depth.size() == picture.eyes.size());
  if (!picture.maps.empty()) {
    throw Error(ErrorKind::kUsage, "depth needs a picture of a projection, not of a camera's lenses: convert it first");
  }
  DepthReport report;
  report.scale = options.scale.value_or(1.0);
  const bool wraps = wraps_around(make_projection(picture.camera.projection));
  const bool sharpens = options.edges == DepthEdges::kSharp;
  const auto kept = std::make_shared<Kept>(Kept{picture.memory, {}});
  int64_t invalid = 0, sharpened = 0, all = 0;
  for (size_t i = 0; i < depth.size(); i++) {
    const Nearness nearness = along_rays(depth[i], picture, options);
    invalid += nearness.invalid;
    if (i == 0) look_at_whole(nearness.values, picture, depth[0], options, report);
    const float ratio = static_cast<float>(picture.size.width) / static_cast<float>(nearness.values.width);
    Image fitted = resized(nearness.values, picture.size, wraps, !sharpens || ratio < 1.0f);
    const int radius = ramp_of(picture.size, ratio);
    if (sharpens && radius > 0) {
      sharpened += sharpen_edges(fitted, guide_of(picture, i), radius, wraps);
    }
    all += static_cast<int64_t>(fitted.pixels.size());
    kept->depth.push_back(metres_of(std::move(fitted), report.scale));
  }
  note_invalid(invalid, depth[0].path, report);
  note_sharpened(static_cast<double>(sharpened) / static_cast<double>(all), report);
  set_layer(picture, kept->depth);
  picture.memory = std::shared_ptr<Scratch>(kept, kept->memory.get());
  return report;
}

}  // namespace ods
