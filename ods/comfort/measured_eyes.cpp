// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/measured_eyes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "ods/base/median.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/matched.h"
#include "ods/comfort/merge_from_depth.h"
#include "ods/disparity/dense_match.h"
#include "ods/picture/picture.h"

namespace ods {

using std::numbers::pi;

namespace {

constexpr int kMiddle = kMergeRows / 2;
constexpr int kHorizon = 30;         // rows to either side, which determine the eye distance and the convergence
constexpr double kMinPixels = 30.0;  // of parallax, all pixels of a row together: less is not evidence
constexpr double kMaxNoise = 0.4;    // of the parallax of a row, may be unexplained
constexpr int kMinRows = 30;
constexpr double kNearestMeeting = 0.3;  // metres: where eyes may converge
constexpr double kClearly = 0.95;        // convergence is believed if it leaves so much less unexplained
constexpr double kSameEyes = 0.04;       // an eye distance that is as the camera's but for this is the camera's
constexpr double kMinMerge = 0.1;        // of the circle: a smaller difference is not a merge
constexpr float kFull = 0.04f;           // a smaller loss is full stereo
constexpr double kSure = 6.0;            // differences below this many errors do not count either
constexpr double kTells = 50.0;          // degrees: merges begin about there
constexpr int kGoesOn = 10;              // rows whose slope extends the curve beyond the last measured row

// The evidence of a pixel: `shown`, the tangent of its half parallax times the cosine of its elevation, is radius *
// (nearness - meeting) with the nearness 1 / depth and 1 / the distance where the eyes converge.
struct Sighting {
  double nearness, shown;
};
using SightedRow = std::vector<Sighting>;

// The radius with the smallest absolute error: the weighted median of the ratios.
struct Circle {
  double radius = 0.0, weight = 0.0, unexplained = 0.0;
};

// apart: an error above this is a mismatch, and all mismatches count equally.
double unexplained_by(const SightedRow& row, double radius, double meeting, double apart) {
  double sum = 0.0;
  for (const Sighting& each : row) sum += std::min(std::abs(each.shown - radius * (each.nearness - meeting)), apart);
  return sum;
}

Circle circle_of(const SightedRow& row, double meeting, double apart) {
  struct Ratio {
    double radius, weight;
  };
  std::vector<Ratio> ratios;
  Circle circle;
  for (const Sighting& each : row) {
    const double lever = each.nearness - meeting;
    if (lever == 0.0) continue;
    ratios.push_back({each.shown / lever, std::abs(lever)});
    circle.weight += std::abs(lever);
  }
  std::ranges::sort(ratios, {}, &Ratio::radius);
  double below = 0.0;
  for (const Ratio& each : ratios) {
    circle.radius = each.radius;
    if ((below += each.weight) >= 0.5 * circle.weight) break;
  }
  circle.radius = std::max(circle.radius, 0.0);
  circle.unexplained = unexplained_by(row, circle.radius, meeting, apart);
  return circle;
}

std::vector<SightedRow> sightings(const Image& around, const SeenDepth& seen) {
  const Projection projection = make_camera(seen.camera).projection;
  const Projection lat_long = make_camera(StereoCamera()).projection;
  std::vector<SightedRow> rows(kMergeRows);
  for (int y = 0; y < around.height; y++) {
    for (int x = 0; x < around.width; x++) {
      const float apart = *around.at(x, y);
      if (std::isnan(apart)) continue;
      const vec2 uv = pixel_middle(x, y, around);
      const ImagePoint place = place_of(projection, look_of(lat_long, uv, uv).direction);
      if (!place.seen) continue;
      const glm::ivec2 pixel = pixel_at(place.uv, seen.depth);
      const float depth = *seen.depth.at(pixel.x, pixel.y);
      if (!(depth > 0.0f)) continue;
      const double elevation = pi * (0.5 - double{uv.y});
      const int row = pixel_at(uv, Extent{1, kMergeRows}).y;
      rows[static_cast<size_t>(row)].push_back(
          {double{inverse_depth(depth)}, std::tan(0.5 * double{apart}) * std::cos(elevation)});
    }
  }
  return rows;
}

// The point where the eyes converge, 1 / metres, and the circle at the horizon. Prefers usual values that explain the
// sightings nearly as well: parallel eyes, then the usual eye distance.
struct Stance {
  double meeting = 0.0;
  Circle circle;
};

Stance stance_of(const SightedRow& horizon, double usual, double apart) {
  constexpr int kSteps = 32;
  const auto best_of = [&](bool is_usual) {
    const auto at = [&](double meeting) {
      Stance stance{meeting, circle_of(horizon, meeting, apart)};
      if (is_usual) stance.circle.radius = usual;
      stance.circle.unexplained = unexplained_by(horizon, stance.circle.radius, meeting, apart);
      return stance;
    };
    Stance best = at(0.0);
    const auto look = [&](double meeting) {
      const Stance other = at(std::max(meeting, 0.0));
      if (other.circle.unexplained < best.circle.unexplained) best = other;
    };
    double step = 1.0 / kNearestMeeting / kSteps;
    for (int i = 1; i <= kSteps; i++) look(i * step);
    for (step *= 0.5; step > 0.005; step *= 0.5) {
      const double from = best.meeting;
      look(from - step), look(from + step);
    }
    return best;
  };
  Stance believed{0.0, circle_of(horizon, 0.0, apart)};
  for (const bool is_usual : {true, false}) {
    const Stance other = best_of(is_usual);
    if (other.circle.unexplained < kClearly * believed.circle.unexplained) believed = other;
  }
  return believed;
}

// From the horizon to a pole: never growing, nearest to the circles (pool adjacent violators), straight between
// measured rows and beyond the last one.
std::vector<double> falling(const std::vector<Circle>& circles) {
  struct Pool {
    double value, weight;
    size_t first, last;
  };
  std::vector<Pool> pools;
  for (size_t i = 0; i < circles.size(); i++) {
    if (circles[i].weight == 0.0) continue;
    pools.push_back({circles[i].radius, circles[i].weight, i, i});
    for (size_t n = pools.size(); n > 1 && pools[n - 2].value < pools[n - 1].value; n--) {
      Pool &into = pools[n - 2], &from = pools[n - 1];
      into.value = (into.value * into.weight + from.value * from.weight) / (into.weight + from.weight);
      into.weight += from.weight;
      into.last = from.last;
      pools.pop_back();
    }
  }
  std::vector<double> values(circles.size(), 1.0);
  if (pools.empty()) return values;
  for (size_t n = 0; n < pools.size(); n++) {
    const Pool& own = pools[n];
    for (size_t i = n == 0 ? 0 : own.first; i <= own.last; i++) values[i] = own.value;
    if (n == 0) continue;
    const Pool& before = pools[n - 1];
    for (size_t i = before.last + 1; i < own.first; i++) {
      const double part = static_cast<double>(i - before.last) / static_cast<double>(own.first - before.last);
      values[i] = before.value + part * (own.value - before.value);
    }
  }
  const size_t last = pools.back().last;
  const double slope = last >= kGoesOn ? (values[last - kGoesOn] - values[last]) / kGoesOn : 0.0;
  for (size_t i = last + 1; i < values.size(); i++) values[i] = std::max(0.0, values[i - 1] - slope);
  return values;
}

}  // namespace

std::optional<MeasuredEyes> measure_eyes(const std::vector<Image>& eyes, const SeenDepth& seen, bool is_float) {
  assert(eyes.size() == 2 && seen.eye == kLeft);
  const AlignedEyes aligned = align_eyes(eyes, seen.camera.projection, is_float);
  if (!aligned.are_one_picture) return std::nullopt;
  const std::vector<SightedRow> rows = sightings(match_densely(aligned.views[0], aligned.views[1]).around[0], seen);
  SightedRow horizon;
  for (int row = kMiddle - kHorizon; row < kMiddle + kHorizon; row++) {
    horizon.insert(horizon.end(), rows[static_cast<size_t>(row)].begin(), rows[static_cast<size_t>(row)].end());
  }
  const double pixel = 2.0 * pi / aligned.views[0].width;
  const Stance stance = stance_of(horizon, 0.5 * double{seen.camera.ipd}, pixel);
  if (!(stance.circle.radius > 0.0)) return std::nullopt;
  const auto circle_at = [&](int row) {
    const SightedRow& seen_there = rows[static_cast<size_t>(row)];
    Circle circle = circle_of(seen_there, stance.meeting, pixel);
    const double shown = stance.circle.radius * circle.weight;
    if (shown < kMinPixels * pixel || circle.unexplained > kMaxNoise * shown) circle.weight = 0.0;
    circle.radius = std::min(circle.radius / stance.circle.radius, 1.0);
    return circle;
  };
  MeasuredEyes measured{seen.camera};
  Image map(4, kMergeRows, 1);
  std::vector<double> off;
  const auto row_of = [](bool is_up, int i) { return is_up ? kMiddle - 1 - i : kMiddle + i; };
  for (const bool is_up : {true, false}) {
    std::vector<Circle> circles;
    double& reach = is_up ? measured.up : measured.down;
    for (int i = 0; i < kMiddle; i++) {
      circles.push_back(circle_at(row_of(is_up, i)));
      if (circles.back().weight > 0.0)
        reach = i + 1.0;
      else  // the other side is the best guess
        circles.back() = circle_at(row_of(!is_up, i));
    }
    const std::vector<double> shares = falling(circles);
    for (int i = 0; i < kMiddle; i++) {
      const auto at = static_cast<size_t>(i);
      std::fill_n(map.at(0, row_of(is_up, i)), map.width, static_cast<float>(shares[at]));
      if (circles[at].weight > 0.0) off.push_back(std::abs(circles[at].radius - shares[at]));
    }
  }
  if (off.size() < kMinRows) return std::nullopt;
  measured.error = 1.48 * median(off);
  const double minimum = 1.0 - std::max(kMinMerge, kSure * measured.error);
  const int up = kMiddle - static_cast<int>(measured.up), down = kMiddle - 1 + static_cast<int>(measured.down);
  // Eyes that converge show a floor and a ceiling without parallax, where merges are: a merge changes nothing there.
  measured.is_known = stance.meeting == 0.0 && std::max(measured.up, measured.down) >= kTells;
  measured.is_merged = measured.is_known && double{std::min(*map.at(0, up), *map.at(0, down))} < minimum;
  StereoCamera& camera = measured.camera;
  if (std::abs(2.0 * stance.circle.radius / double{camera.ipd} - 1.0) > kSameEyes)
    camera.ipd = static_cast<float>(2.0 * stance.circle.radius);
  if (stance.meeting > 0.0) {
    camera.convergence = kToeIn;
    camera.convergence_distance = static_cast<float>(1.0 / stance.meeting);
  }
  if (measured.is_merged) {
    for (float& share : map.pixels) share = share > 1.0f - kFull ? 1.0f : share;
    use_merge_map(camera, std::move(map));
  }
  return measured;
}

}  // namespace ods
