// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The meaning of the numbers in a picture file: a transfer curve from code values to light, and primaries. Our own
// colour space is sRGB: IEC 61966-2-1 code values in integer files, linear Rec. 709 light in float files.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ods/kernel/math.h"

namespace ods {

struct ColorSpace {
  enum class Curve {
    kDefault,  // unspecified: sRGB for integers, linear for floats
    kSrgb,
    kLinear,
    kOther,
  };
  std::string name;   // for users: "gAMA 0.55556", "ICC profile 'Display P3'"; empty if unspecified
  std::string fault;  // the reason why the file's colour space is ignored; empty if it is used
  Curve curve = Curve::kDefault;
  std::array<std::vector<float>, 3> light;  // for kLinear and kOther: linear light, 0..1, of each 16-bit code value
  bool has_our_primaries = true;
  glm::dmat3 to_rec709{1.0};  // from the file's linear light
};

// Returns whether the file uses our own colour space.
bool is_our_own(const ColorSpace& color, bool is_float);

// Maps a code value to light, both 0..1.
using ColorCurve = std::function<double(double code)>;

// Classifies curves and primaries. Curves within half an 8-bit code value of sRGB's count as sRGB, because profiles
// store rounded tables. Primaries within 0.003 of ours (as entries of to_rec709) count as ours for the same reason.
ColorSpace make_color_space(const std::string& name, const std::array<ColorCurve, 3>& curves,
                            const glm::dmat3& to_rec709);

// CIE 1931 x, y.
struct Chromaticities {
  glm::dvec2 red, green, blue, white;
};
inline constexpr Chromaticities kRec709{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// The matrix from linear light of these primaries to linear Rec. 709; white maps to white (Bradford adaptation).
// Returns nullopt if the primaries do not span a triangle.
std::optional<glm::dmat3> to_rec709(const Chromaticities& from);

// The matrix from CIE XYZ relative to D50, the reference of ICC profiles, to linear Rec. 709.
glm::dmat3 rec709_of_d50_xyz();

// Linear Rec. 709 light from three code values, 0..1, or from three floats, which are light of the file's primaries.
vec3 linear_from_encoded(const ColorSpace& color, vec3 codes);
vec3 light_of_floats(const ColorSpace& color, vec3 light);

// Converts 16-bit code values of a colour space to 16-bit sRGB. Colours outside sRGB are clipped.
class SrgbConverter {
 public:
  explicit SrgbConverter(const ColorSpace& color);
  // Converts pixels with `channels` samples each: R, G, B first; with fewer than three channels, grey first.
  void convert(std::span<uint16_t> pixels, size_t channels) const;

 private:
  ColorSpace color_;
  std::array<std::vector<uint16_t>, 3> codes_;  // per 16-bit code value, if the primaries are ours
};

}  // namespace ods
