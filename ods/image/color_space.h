// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the numbers of a picture file mean: a transfer curve from code values to light, and primaries. Our own colour
// space is sRGB: code values of IEC 61966-2-1 in files of integers, linear light of Rec. 709 in files of floats.
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
    kDefault,  // the file does not say: sRGB for integers, linear for floats
    kSrgb,
    kLinear,
    kOther,
  };
  std::string name;   // for people: "gAMA 0.55556", "ICC profile 'Display P3'"; empty: the file does not say
  std::string fault;  // why what the file says is ignored; empty: it is not
  Curve curve = Curve::kDefault;
  std::array<std::vector<float>, 3> light;  // of kLinear and kOther: linear light, 0..1, of each 16-bit code value
  bool has_our_primaries = true;
  glm::dmat3 to_rec709{1.0};  // from the file's linear light
};

// Whether the numbers mean what ours mean.
bool is_our_own(const ColorSpace& color, bool is_float);

// Light of a code value, both 0..1.
using ColorCurve = std::function<double(double code)>;

// Finds out which kind the curves are. Curves within half an 8-bit code value of sRGB's are sRGB: profiles hold it
// as tables, rounded. Primaries within 0.003 of ours (as entries of to_rec709) are ours for the same reason.
ColorSpace make_color_space(const std::string& name, const std::array<ColorCurve, 3>& curves,
                            const glm::dmat3& to_rec709);

// CIE 1931 x, y.
struct Chromaticities {
  glm::dvec2 red, green, blue, white;
};
inline constexpr Chromaticities kRec709{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

// From linear light of these primaries to that of Rec. 709; white becomes white (Bradford adaptation). Nothing where
// they span no triangle.
std::optional<glm::dmat3> to_rec709(const Chromaticities& from);

// The same from CIE XYZ relative to D50, which ICC profiles are given in.
glm::dmat3 rec709_of_d50_xyz();

// Linear light of Rec. 709: of three code values, 0..1, and of three floats, which are light of the file's primaries.
vec3 linear_from_encoded(const ColorSpace& color, vec3 codes);
vec3 light_of_floats(const ColorSpace& color, vec3 light);

// Turns 16-bit code values of a colour space into 16-bit code values of sRGB. Colours outside sRGB are clipped.
class SrgbConverter {
 public:
  explicit SrgbConverter(const ColorSpace& color);
  // Pixels of `channels` samples each: R, G, B first, or grey first where there are fewer than three.
  void convert(std::span<uint16_t> pixels, size_t channels) const;

 private:
  ColorSpace color_;
  std::array<std::vector<uint16_t>, 3> codes_;  // of each 16-bit code value, where the primaries are ours
};

}  // namespace ods
