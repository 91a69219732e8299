// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Compares colour, exposure and contrast of the eyes. Tiles that match show the same objects: for each, the ratio of
// the mean light of the right eye to the left eye's is taken, per channel. The medians are the right eye's gains, so
// that reflections, which differ between the eyes, are outvoted. If the ratio depends on the light itself, the eyes
// differ by a power.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ods/base/median.h"
#include "ods/image/tone.h"
#include "ods/kernel/surface.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr int kViewWidth = 512;
constexpr float kDark = 0.06f, kBright = 0.93f;  // as displayed: noise dominates below, clipping above
constexpr size_t kEnoughColors = 20;

struct Pair {
  vec3 left, right;  // natural logarithms of linear light
};

// The views of a channel, per eye.
using ChannelViews = std::vector<std::vector<GrayView>>;

ChannelViews channel_views(const Subject& subject) {
  ChannelViews views;
  for (size_t c = 0; c < 3; c++) {
    std::vector<Image> eyes;
    for (const Image& small : subject.small) {
      Image& eye = eyes.emplace_back(small.width, small.height, 1);
      for (size_t i = 0; i < eye.pixels.size(); i++) eye.pixels[i] = small.pixels[3 * i + c];
    }
    views.push_back(make_gray_views(eyes, subject.projection(), subject.info.is_float, kViewWidth));
    if (moves_pixels(subject.correction)) views[c][1] = corrected_view(views[c][1], subject.correction);
  }
  return views;
}

// The mean of a view around a direction, over the area of a tile; NaN if the view does not contain all of it.
float mean_at(const GrayView& view, float theta, float phi) {
  const float pixel = 2.0f * kPi / static_cast<float>(view.width);
  const int rows = 2, columns = std::clamp(static_cast<int>(3.0f / std::cos(phi)), 2, view.width / 8);
  const int x = static_cast<int>(std::floor(theta / pixel + 0.5f * static_cast<float>(view.width)));
  const int y = static_cast<int>(std::floor(0.5f * static_cast<float>(view.height) - phi / pixel));
  if (y - rows < 0 || y + rows >= view.height) return NAN;
  float sum = 0.0f;
  for (int j = -rows; j <= rows; j++) {
    for (int i = -columns; i <= columns; i++) sum += *view.at((x + i + view.width) % view.width, y + j);
  }
  return sum / static_cast<float>((2 * rows + 1) * (2 * columns + 1));
}

std::vector<Pair> find_pairs(const Subject& subject) {
  const ChannelViews views = channel_views(subject);
  std::vector<Pair> pairs;
  for (const Match& match : subject.matches.back().found) {
    vec3 left, right;
    for (int c = 0; c < 3; c++) {
      const auto& both = views[static_cast<size_t>(c)];
      left[c] = mean_at(both[0], match.theta, match.phi);
      right[c] = mean_at(both[1], match.theta - match.around, match.phi - match.down);
    }
    const auto is_usable = [](float shown) { return shown > kDark && shown < kBright; };
    bool usable = true;
    for (int c = 0; c < 3; c++) usable = usable && is_usable(left[c]) && is_usable(right[c]);
    if (!usable) continue;
    Pair& pair = pairs.emplace_back();
    for (int c = 0; c < 3; c++) {
      pair.left[c] = std::log(srgb_decode(left[c]));
      pair.right[c] = std::log(srgb_decode(right[c]));
    }
  }
  return pairs;
}

// y = slope x + offset, by least squares with the weights of a Cauchy distribution.
struct Line {
  double slope = 0.0, offset = 0.0;
  double error = 0.0;   // error of the slope
  double spread = 0.0;  // standard deviation of y around the line
  double reach = 0.0;   // standard deviation of x
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  Line line;
  line.offset = median(y);
  for (int i = 0; i < 10; i++) {
    std::vector<double> sizes;
    for (size_t k = 0; k < x.size(); k++) sizes.push_back(std::abs(y[k] - line.slope * x[k] - line.offset));
    line.spread = std::max(1.4826 * median(sizes), 1e-3);
    double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0;
    for (size_t k = 0; k < x.size(); k++) {
      const double off = sizes[k] / (2.0 * line.spread), weight = 1.0 / (1.0 + off * off);
      w += weight, wx += weight * x[k], wy += weight * y[k];
      wxx += weight * x[k] * x[k], wxy += weight * x[k] * y[k];
    }
    const double square = wxx - wx * wx / w;
    if (square < 1e-9) return line;
    line.slope = (wxy - wx * wy / w) / square;
    line.offset = (wy - line.slope * wx) / w;
    line.error = 1.5 * line.spread / std::sqrt(square);  // neighbouring tiles are not independent
    line.reach = std::sqrt(square / w);
  }
  return line;
}

double brightness(vec3 logs) {
  return std::log(static_cast<double>(luminance(exp(logs))));
}

// The right eye's light, per channel, is gain * left^gamma.
struct Response {
  double gamma = 1.0;
  double gamma_error = 0.0;
  glm::dvec3 gain{1.0};
  double error = 0.0;  // relative error of a gain
  size_t places = 0;
};

Response find_response(const std::vector<Pair>& pairs) {
  Response response;
  response.places = pairs.size();
  std::vector<double> x, y;
  for (const Pair& pair : pairs) {
    const double left = brightness(pair.left), right = brightness(pair.right);
    x.push_back(0.5 * (left + right)), y.push_back(right - left);  // noise of either eye does not tilt the line
  }
  const Line line = fit_line(x, y);
  response.gamma_error = line.reach > 0.3 ? line.error : 1.0;
  const bool is_power = std::abs(line.slope) > std::max(0.03, 4.0 * response.gamma_error);
  if (is_power) response.gamma = (2.0 + line.slope) / (2.0 - line.slope);
  for (int c = 0; c < 3; c++) {
    std::vector<double> logs, sizes;
    for (const Pair& pair : pairs) {
      logs.push_back(static_cast<double>(pair.right[c]) - response.gamma * static_cast<double>(pair.left[c]));
    }
    const double middle = median(logs);
    for (const double each : logs) sizes.push_back(std::abs(each - middle));
    response.gain[c] = std::exp(middle);
    response.error = std::max(response.error, 3.0 * median(sizes) / std::sqrt(static_cast<double>(logs.size())));
  }
  return response;
}

// The correction that makes the right eye's light equal to the left one's.
std::string remedy_of(const Subject& subject, const Response& response) {
  const glm::dvec3 gain = 1.0 / glm::pow(response.gain, glm::dvec3(1.0 / response.gamma));
  std::string options = fmt::format("`right-gain` {:.3f},{:.3f},{:.3f}", gain.x, gain.y, gain.z);
  if (response.gamma != 1.0) options = fmt::format("`right-gamma` {:.3f} ", 1.0 / response.gamma) + options;
  return "develop both eyes alike, or correct the picture: " + convert_command(subject, options);
}

}  // namespace

void check_colors(const Subject& subject, LintReport& report) {
  const std::vector<Pair> pairs = find_pairs(subject);
  if (pairs.size() < kEnoughColors) {
    return skip(report, Check::kColors, "not enough places that both eyes show, neither dark nor clipped");
  }
  judge(report, Check::kColors);
  const Response response = find_response(pairs);
  const glm::dvec3 gain = response.gain;
  const auto add = [&](Fault fault, double certainty, const std::string& evidence) {
    if (certainty < 0.1) return;
    report.findings.push_back({fault, certainty,
                               fmt::format("{}, by {} places that both eyes show", evidence, response.places),
                               remedy_of(subject, response)});
  };
  const double maximum = std::max({gain.x, gain.y, gain.z}), minimum = std::min({gain.x, gain.y, gain.z});
  add(Fault::kEyeTinted, certainty_of({maximum / minimum - 1.0, response.error, response.places}, 0.025, 0.06),
      fmt::format("the right eye has {:.1f} % of the left one's red, {:.1f} % of its green and {:.1f} % of its blue",
                  100.0 * gain.x, 100.0 * gain.y, 100.0 * gain.z));
  const double stops = std::log2(gain.x * gain.y * gain.z) / 3.0;
  add(Fault::kEyeBrighter, certainty_of({std::abs(stops), response.error, response.places}, 0.08, 0.2),
      fmt::format("the right eye is {:.2f} stops {} than the left one", std::abs(stops),
                  stops > 0.0 ? "brighter" : "darker"));
  add(Fault::kEyeGamma,
      certainty_of({std::abs(response.gamma - 1.0), response.gamma_error, response.places}, 0.03, 0.08),
      fmt::format("the right eye's light is proportional to the left eye's raised to the power {:.3f}",
                  response.gamma));
}

}  // namespace ods
