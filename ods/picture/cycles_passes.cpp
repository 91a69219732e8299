// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/cycles_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "ods/base/error.h"
#include "ods/camera/pixel.h"
#include "ods/image/image_file.h"

namespace ods {
namespace {

// The channels of a pass, in the order of the letters: ViewLayer.Combined.R, or ViewLayer.Combined.left.R in a file that
// names its one view. Empty if the file does not have all of them.
std::vector<std::string> channels_of(const FileInfo& info, const std::string& pass, std::string_view letters) {
  std::vector<std::string> found;
  for (const char letter : letters) {
    for (const std::string& channel : info.channels) {
      const size_t end = channel.rfind('.');
      std::string layer = end == std::string::npos ? "" : channel.substr(0, end);
      for (const char* view : {".left", ".right"}) {
        if (layer.ends_with(view)) layer.resize(layer.rfind('.'));
      }
      if (layer.ends_with("." + pass) && channel.substr(end + 1) == std::string(1, letter)) found.push_back(channel);
    }
  }
  if (found.size() != letters.size()) found.clear();
  return found;
}

void add(Image& sum, const Image& other) {
  for (size_t i = 0; i < sum.pixels.size(); i++) sum.pixels[i] += other.pixels[i];
}

void scale(Image& image, float factor) {
  for (float& value : image.pixels) value *= factor;
}

// Blender's z is our y, its y is our -z.
void turn_upright(Image& normals) {
  for (size_t i = 0; i + 2 < normals.pixels.size(); i += 3) {
    const float y = normals.pixels[i + 1];
    normals.pixels[i + 1] = normals.pixels[i + 2];
    normals.pixels[i + 2] = -y;
  }
}

void measure_along_rays(Image& depth, const CyclesPasses& passes) {
  const Camera camera = make_camera(passes.camera);
  for (int y = 0; y < depth.height; y++) {
    for (int x = 0; x < depth.width; x++) {
      float& value = *depth.at(x, y);
      if (!is_surface(value)) {
        value = kFarDepth;
      } else {
        value =
            along_ray(passes.camera, camera_ray(camera, passes.eye, pixel_middle(x, y, depth)), value * passes.unit);
      }
    }
  }
}

EyeImage read_part(const std::string& file, const CyclesPasses& passes) {
  const FileInfo info = read_info(file);
  const auto read = [&](const std::string& pass, std::string_view letters) {
    const std::vector<std::string> channels = channels_of(info, pass, letters);
    return channels.empty() ? Image() : read_channels(file, channels);
  };
  EyeImage image;
  image.eye = passes.eye;
  image.radiance = read("Combined", "RGB");
  if (passes.has_alpha) image.alpha = read("Combined", "A");
  image.depth = read("Depth", "Z");
  if (image.depth.pixels.empty()) image.depth = read("Depth", "V");  // as Blender 5 calls it
  image.normal = read("Normal", "XYZ");
  image.albedo = read("Denoising Albedo", "RGB");
  if (image.radiance.pixels.empty() || image.depth.pixels.empty()) {
    throw Error(ErrorKind::kInput, fmt::format("'{}' has no colour or no depth of Cycles", file));
  }
  return image;
}

// The most samples that a pixel of the file got: Blender records it as cycles.LAYER.samples.
float most_samples(const FileInfo& info) {
  for (const auto& [name, value] : info.text) {
    if (name.starts_with("cycles.") && name.ends_with(".samples")) return static_cast<float>(std::atof(value.c_str()));
  }
  return 0.0f;
}

}  // namespace

Image read_cycles_counts(std::span<const std::string> files) {
  Image sum;
  for (const std::string& file : files) {
    const FileInfo info = read_info(file);
    const std::vector<std::string> channels = channels_of(info, "Debug Sample Count", "X");
    if (channels.empty()) return Image();
    Image counts = read_channels(file, channels);
    scale(counts, most_samples(info));  // the pass is 1 where a pixel got all
    if (sum.pixels.empty()) {
      sum = std::move(counts);
    } else if (sum.pixels.size() == counts.pixels.size()) {
      add(sum, counts);
    }
  }
  return sum;
}

float along_ray(const StereoCamera& camera, const Ray& ray, float from_center) {
  const vec3 eye = ray.origin - camera.position;
  const float ahead = dot(eye, ray.direction);
  const float square = ahead * ahead + from_center * from_center - dot(eye, eye);
  return square > 0.0f ? std::max(0.0f, std::sqrt(square) - ahead) : 0.0f;
}

EyeImage read_cycles(std::span<const std::string> files, const CyclesPasses& passes) {
  EyeImage sum = read_part(files.front(), passes);
  Image squares = sum.radiance;
  for (float& value : squares.pixels) value *= value;
  for (const std::string& file : files.subspan(1)) {
    const EyeImage part = read_part(file, passes);
    if (part.radiance.pixels.size() != sum.radiance.pixels.size() ||
        part.albedo.pixels.size() != sum.albedo.pixels.size()) {
      throw Error(ErrorKind::kInput, fmt::format("'{}' is not a part of the picture of '{}'", file, files.front()));
    }
    for (size_t i = 0; i < squares.pixels.size(); i++)
      squares.pixels[i] += part.radiance.pixels[i] * part.radiance.pixels[i];
    add(sum.radiance, part.radiance), add(sum.albedo, part.albedo), add(sum.normal, part.normal);
    add(sum.alpha, part.alpha);
  }
  const auto count = static_cast<float>(files.size());
  for (Image* image : {&sum.radiance, &sum.albedo, &sum.normal, &sum.alpha}) scale(*image, 1.0f / count);
  turn_upright(sum.normal);
  measure_along_rays(sum.depth, passes);
  if (files.size() < 2) return sum;
  sum.variance = std::move(squares);
  for (size_t i = 0; i < sum.variance.pixels.size(); i++) {
    const float mean = sum.radiance.pixels[i];
    const float spread = std::max(0.0f, sum.variance.pixels[i] / count - mean * mean);
    sum.variance.pixels[i] = spread / (count - 1.0f);
  }
  sum.samples = Image(sum.radiance.width, sum.radiance.height, 1);
  std::fill(sum.samples.pixels.begin(), sum.samples.pixels.end(), count);
  return sum;
}

}  // namespace ods
