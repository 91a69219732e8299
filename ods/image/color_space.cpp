// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/color_space.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "ods/image/tone.h"

namespace ods {

constexpr int kLargest = 65535;

bool is_our_own(const ColorSpace& color, bool is_float) {
  using Curve = ColorSpace::Curve;
  const Curve own = is_float ? Curve::kLinear : Curve::kSrgb;
  return color.has_our_primaries && (color.curve == Curve::kDefault || color.curve == own);
}

static bool is_close(const ColorCurve& curve, const std::function<float(float)>& to_code) {
  const double kHalfACode = 0.5 / 255.0;
  for (int code = 0; code <= 255; code++) {
    const double light = curve(code / 255.0);
    if (!(std::abs(static_cast<double>(to_code(static_cast<float>(light))) - code / 255.0) <= kHalfACode)) return false;
  }
  return true;
}

static float linear_code(float light) {
  return light;
}

ColorSpace make_color_space(const std::string& name, const std::array<ColorCurve, 3>& curves,
                            const glm::dmat3& to_rec709) {
  const double kSame = 0.003;
  const auto all = [&](float (*to_code)(float)) {
    return std::all_of(curves.begin(), curves.end(), [&](const ColorCurve& curve) { return is_close(curve, to_code); });
  };
  ColorSpace color;
  color.name = name;
  for (int column = 0; column < 3; column++) {
    for (int row = 0; row < 3; row++) {
      const double own = column == row ? 1.0 : 0.0;
      if (std::abs(to_rec709[column][row] - own) > kSame) color.has_our_primaries = false;
    }
  }
  if (!color.has_our_primaries) color.to_rec709 = to_rec709;
  color.curve = all(srgb_encode)   ? ColorSpace::Curve::kSrgb
                : all(linear_code) ? ColorSpace::Curve::kLinear
                                   : ColorSpace::Curve::kOther;
  if (color.curve == ColorSpace::Curve::kSrgb) return color;
  const auto is_first_again = [&](size_t c) {
    for (int code = 0; code <= 255; code++) {
      if (curves[c](code / 255.0) != curves[0](code / 255.0)) return false;
    }
    return true;
  };
  for (size_t c = 0; c < 3; c++) {
    if (c > 0 && is_first_again(c)) {  // building a table takes as long as decoding a small picture
      color.light[c] = color.light[0];
      continue;
    }
    color.light[c].resize(kLargest + 1);
    for (int code = 0; code <= kLargest; code++) {
      const double light = curves[c](static_cast<double>(code) / kLargest);
      color.light[c][static_cast<size_t>(code)] = light > 0.0 ? static_cast<float>(std::min(light, 1.0)) : 0.0f;
    }
  }
  return color;
}

static glm::dvec3 xyz_of(glm::dvec2 xy) {
  return {xy.x / xy.y, 1.0, (1.0 - xy.x - xy.y) / xy.y};
}

// Adapts XYZ from one white to another (Lindbloom, "Chromatic Adaptation").
static glm::dmat3 bradford(glm::dvec3 from, glm::dvec3 to) {
  const glm::dmat3 cones =
      glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
  const glm::dvec3 scale = (cones * to) / (cones * from);
  const glm::dmat3 scaled(scale.x, 0.0, 0.0, 0.0, scale.y, 0.0, 0.0, 0.0, scale.z);
  return glm::inverse(cones) * scaled * cones;
}

// RGB to XYZ (Lindbloom, "RGB/XYZ Matrices").
static glm::dmat3 xyz_matrix(const Chromaticities& from) {
  const glm::dmat3 primaries(xyz_of(from.red), xyz_of(from.green), xyz_of(from.blue));
  const glm::dvec3 share = glm::inverse(primaries) * xyz_of(from.white);
  return {primaries[0] * share.x, primaries[1] * share.y, primaries[2] * share.z};
}

static bool is_finite(const glm::dmat3& matrix) {
  for (int column = 0; column < 3; column++) {
    for (int row = 0; row < 3; row++) {
      if (!(std::abs(matrix[column][row]) < 1e3)) return false;
    }
  }
  return true;
}

std::optional<glm::dmat3> to_rec709(const Chromaticities& from) {
  const glm::dmat3 to_xyz = xyz_matrix(from);
  const glm::dmat3 matrix =
      glm::inverse(xyz_matrix(kRec709)) * bradford(xyz_of(from.white), xyz_of(kRec709.white)) * to_xyz;
  return is_finite(to_xyz) && is_finite(matrix) ? std::optional(matrix) : std::nullopt;
}

glm::dmat3 rec709_of_d50_xyz() {
  const glm::dvec3 d50(0.9642, 1.0, 0.8249);  // as defined by ICC.1
  return glm::inverse(xyz_matrix(kRec709)) * bradford(d50, xyz_of(kRec709.white));
}

vec3 linear_from_encoded(const ColorSpace& color, vec3 codes) {
  glm::dvec3 light;
  for (int c = 0; c < 3; c++) {
    const std::vector<float>& table = color.light[static_cast<size_t>(c)];
    const float code = std::clamp(codes[c], 0.0f, 1.0f);
    light[c] = static_cast<double>(table.empty() ? srgb_decode(code)
                                                 : table[static_cast<size_t>(std::lround(code * kLargest))]);
  }
  return color.has_our_primaries ? vec3(light) : vec3(color.to_rec709 * light);
}

vec3 light_of_floats(const ColorSpace& color, vec3 light) {
  return color.has_our_primaries ? light : vec3(color.to_rec709 * glm::dvec3(light));
}

static uint16_t srgb_code(float light) {
  return static_cast<uint16_t>(std::lround(srgb_encode(std::clamp(light, 0.0f, 1.0f)) * kLargest));
}

SrgbConverter::SrgbConverter(const ColorSpace& color) : color_(color) {
  for (size_t c = 0; c < 3; c++) {
    if (color_.light[c].empty()) color_.light[c] = linear_from_encoded(kLargest);
    if (c > 0 && color_.light[c] == color_.light[0]) {
      codes_[c] = codes_[0];
      continue;
    }
    for (float light : color_.light[c]) codes_[c].push_back(srgb_code(light));
  }
}

void SrgbConverter::convert(std::span<uint16_t> pixels, size_t channels) const {
  const bool by_channel = color_.has_our_primaries || channels < 3;
  const auto& light = color_.light;
  const auto convert_pixel = [&](uint16_t* pixel) {
    if (by_channel) {
      for (size_t c = 0; c < (channels < 3 ? 1u : 3u); c++) pixel[c] = codes_[c][pixel[c]];
      return;
    }
    const vec3 own(color_.to_rec709 * glm::dvec3(light[0][pixel[0]], light[1][pixel[1]], light[2][pixel[2]]));
    for (int c = 0; c < 3; c++) pixel[c] = srgb_code(own[c]);
  };
  tbb::parallel_for(tbb::blocked_range<size_t>(0, pixels.size() / channels, 4096), [&](const auto& part) {
    for (size_t i = part.begin(); i < part.end(); i++) convert_pixel(&pixels[i * channels]);
  });
}

}  // namespace ods
