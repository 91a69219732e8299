// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// FLIP: the difference that people perceive between two alternating pictures (P. Andersson, J. Nilsson, T.
// Akenine-Moller, M. Oskarsson, K. Astrom, M. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", 2020).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "ods/image/image.h"
#include "ods/kernel/math.h"

namespace ods {

inline constexpr float kFlipPixelsPerDegree = 67.0f;  // a monitor of 3840 pixels, 0.7 m wide, seen from 0.7 m

namespace flip {

using Weight = std::function<float(float away)>;  // weight of a pixel at this distance

// 2 radius + 1 weights. Those above 0 add up to 1, those below to -1.
inline std::vector<float> kernel_of(int radius, const Weight& weight) {
  std::vector<float> kernel;
  float above = 0.0f, below = 0.0f;
  for (int i = -radius; i <= radius; i++) {
    const float value = weight(static_cast<float>(i));
    kernel.push_back(value);
    (value > 0.0f ? above : below) += std::abs(value);
  }
  for (float& value : kernel) value /= value > 0.0f ? above : below > 0.0f ? below : 1.0f;
  return kernel;
}

// Beyond its edges, the picture is continued by its last pixels.
inline std::vector<float> blurred(const std::vector<float>& plane, int width, const std::vector<float>& kernel,
                                  bool down) {
  const int height = static_cast<int>(plane.size()) / width, radius = static_cast<int>(kernel.size() / 2);
  std::vector<float> result(plane.size());
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      float sum = 0.0f;
      for (int i = -radius; i <= radius; i++) {
        const int px = down ? x : std::clamp(x + i, 0, width - 1), py = down ? std::clamp(y + i, 0, height - 1) : y;
        sum += kernel[static_cast<size_t>(i + radius)] * plane[static_cast<size_t>(py * width + px)];
      }
      result[static_cast<size_t>(y * width + x)] = sum;
    }
  }
  return result;
}

inline constexpr std::array<float, 3> kWhite = {0.950428545f, 1.0f, 1.088900371f};

inline vec3 xyz_of(vec3 c) {  // from linear sRGB, white is 1
  return vec3((0.4124564f * c.x + 0.3575761f * c.y + 0.1804375f * c.z) / kWhite[0],
              (0.2126729f * c.x + 0.7151522f * c.y + 0.0721750f * c.z) / kWhite[1],
              (0.0193339f * c.x + 0.1191920f * c.y + 0.9503041f * c.z) / kWhite[2]);
}

inline vec3 rgb_of(vec3 v) {
  const float x = v.x * kWhite[0], y = v.y * kWhite[1], z = v.z * kWhite[2];
  return vec3(3.2404542f * x - 1.5371385f * y - 0.4985314f * z, -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
              0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

inline vec3 opponents_of(vec3 rgb) {  // YyCxCz
  const vec3 v = xyz_of(rgb);
  return vec3(116.0f * v.y - 16.0f, 500.0f * (v.x - v.y), 200.0f * (v.y - v.z));
}

inline vec3 rgb_of_opponents(vec3 v) {
  const float y = (v.x + 16.0f) / 116.0f;
  return rgb_of(vec3(y + v.y / 500.0f, y, y - v.z / 200.0f));
}

// L*a*b*, with paler colours in dark areas (Hunt's effect).
inline vec3 perceived(vec3 rgb) {
  const auto root = [](float t) {
    constexpr float kDelta = 6.0f / 29.0f;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
  };
  const vec3 v = xyz_of(rgb);
  const float y = root(v.y), lightness = 116.0f * y - 16.0f;
  return vec3(lightness, 0.01f * lightness * 500.0f * (root(v.x) - y), 0.01f * lightness * 200.0f * (y - root(v.z)));
}

inline float distance_of(vec3 a, vec3 b) {  // HyAB
  const vec3 d = a - b;
  return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

// Converts a distance of colours to 0..1.
inline float colour_error(float distance) {
  constexpr float kPower = 0.7f, kLow = 0.4f, kLowShare = 0.95f;
  const float maximum =
      std::pow(distance_of(perceived(vec3(0.0f, 1.0f, 0.0f)), perceived(vec3(0.0f, 0.0f, 1.0f))), kPower);
  const float error = std::pow(distance, kPower), low = kLow * maximum;
  return error < low ? kLowShare / low * error
                     : std::min(kLowShare + (error - low) / (maximum - low) * (1.0f - kLowShare), 1.0f);
}

struct Seen {
  std::vector<vec3> colours;  // without imperceptible detail
  std::vector<float> edges, points;
};

inline Seen seen(const Image& linear, float pixels_per_degree) {
  constexpr float kPi2 = 9.8696044f;
  constexpr struct {
    float a1, b1, a2, b2;
  } kContrast[] = {{1.0f, 0.0047f, 0.0f, 1e-5f}, {1.0f, 0.0053f, 0.0f, 1e-5f}, {34.1f, 0.04f, 13.5f, 0.025f}};
  const size_t count = linear.pixels.size() / 3;
  std::vector<float> planes[3], grey(count);
  for (std::vector<float>& plane : planes) plane.resize(count);
  for (size_t i = 0; i < count; i++) {
    const float* p = &linear.pixels[3 * i];
    const vec3 colour = opponents_of(clamp(vec3(p[0], p[1], p[2]), 0.0f, 1.0f));
    for (size_t c = 0; c < 3; c++) planes[c][i] = colour[static_cast<int>(c)];
    grey[i] = (colour.x + 16.0f) / 116.0f;
  }
  const int reach = static_cast<int>(std::ceil(3.0f * std::sqrt(0.04f / (2.0f * kPi2)) * pixels_per_degree));
  Seen result;
  result.colours.resize(count);
  for (size_t c = 0; c < 3; c++) {
    // A sum of two Gaussian curves is not a product of a horizontal and a vertical curve, but each of the two is.
    const auto [a1, b1, a2, b2] = kContrast[c];
    const auto part = [&](float b) {
      const auto kernel = kernel_of(reach, [&](float away) {
        const float degrees = away / pixels_per_degree;
        return std::exp(-kPi2 * degrees * degrees / b);
      });
      return blurred(blurred(planes[c], linear.width, kernel, false), linear.width, kernel, true);
    };
    const std::vector<float> one = part(b1), two = a2 > 0.0f ? part(b2) : one;
    // The integral over the plane of sqrt(pi / b) exp(-pi^2 r^2 / b) is sqrt(b / pi).
    const float w1 = a1 * std::sqrt(b1), w2 = a2 * std::sqrt(b2);
    for (size_t i = 0; i < count; i++) result.colours[i][static_cast<int>(c)] = (w1 * one[i] + w2 * two[i]) / (w1 + w2);
  }
  for (vec3& colour : result.colours) colour = perceived(clamp(rgb_of_opponents(colour), 0.0f, 1.0f));
  const float deviation = 0.5f * 0.082f * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0f * deviation));
  const auto bell = [&](float t) { return std::exp(-t * t / (2.0f * deviation * deviation)); };
  const auto smooth = kernel_of(radius, bell);
  const auto strength = [&](const Weight& weight) {
    const auto kernel = kernel_of(radius, weight);
    const auto across = blurred(blurred(grey, linear.width, kernel, false), linear.width, smooth, true);
    const auto down = blurred(blurred(grey, linear.width, smooth, false), linear.width, kernel, true);
    std::vector<float> length(count);
    for (size_t i = 0; i < count; i++) length[i] = std::hypot(across[i], down[i]);
    return length;
  };
  result.edges = strength([&](float t) { return -t * bell(t); });
  result.points = strength([&](float t) { return (t * t / (deviation * deviation) - 1.0f) * bell(t); });
  return result;
}

}  // namespace flip

// The mean over the picture, 0..1. Both are display light: linear Rec. 709, 0..1, of one size.
inline double flip_error(const Image& reference, const Image& test, float pixels_per_degree = kFlipPixelsPerDegree) {
  const flip::Seen a = flip::seen(reference, pixels_per_degree), b = flip::seen(test, pixels_per_degree);
  double sum = 0.0;
  for (size_t i = 0; i < a.colours.size(); i++) {
    const float colour = flip::colour_error(flip::distance_of(a.colours[i], b.colours[i]));
    const float step = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
    const float feature = std::min(std::sqrt(step / std::sqrt(2.0f)), 1.0f);
    sum += double{std::pow(colour, 1.0f - feature)};
  }
  return sum / static_cast<double>(a.colours.size());
}

}  // namespace ods
