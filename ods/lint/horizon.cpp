// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks whether the picture is level. Posts, walls and doors are vertical lines: great circles through the zenith. At
// an edge of the picture, the gradient is the normal n of the edge's great circle, so the zenith z is the direction
// with n z = 0 for the most edges. Pictures without such lines have no such direction, and are not judged.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ods/base/angles.h"
#include "ods/lint/checks.h"

namespace ods {

namespace {

constexpr double kMaxTilt = 15.0;   // degrees
constexpr double kWidth = 2.0;      // degrees: width of the peak of vertical edges
constexpr double kNearly = 30.0;    // degrees: edges this far from vertical are compared with the peak
constexpr float kEdge = 0.05f;      // minimum gradient, per pixel of the view
constexpr double kLine = 0.85;      // minimum coherence of a line
constexpr int kDirectionReach = 2;  // pixels around a point that determine its direction
constexpr int kFewestAround = 384;  // minimum pixels per turn; at 256, level rooms seem to lean by 14 degrees
constexpr size_t kEnoughPlaces = 400;
constexpr size_t kMaxEdges = 20000;

struct Edge {
  glm::dvec3 normal;
  double weight;
};

// Sums of products of the gradient's two components over a few pixels: lines
// have one direction, noise has none.
struct Tensor {
  double across = 0.0, up = 0.0, both = 0.0;

  double coherence() const { return std::hypot(across - up, 2.0 * both) / std::max(across + up, 1e-12); }
  double angle() const { return 0.5 * std::atan2(2.0 * both, across - up); }
};

Tensor tensor_at(const GrayView& view, int x, int y, double stretch) {
  Tensor sum;
  for (int j = y - kDirectionReach; j <= y + kDirectionReach; j++) {
    for (int i = x - kDirectionReach; i <= x + kDirectionReach; i++) {
      const int column = (i + view.width) % view.width, left = (i + view.width - 1) % view.width;
      const double across = static_cast<double>(*view.at((i + 1) % view.width, j) - *view.at(left, j)) / 2.0 * stretch;
      const double up = static_cast<double>(*view.at(column, j - 1) - *view.at(column, j + 1)) / 2.0;
      sum.across += across * across, sum.up += up * up, sum.both += across * up;
    }
  }
  return sum;
}

std::vector<Edge> find_edges(const GrayView& view) {
  std::vector<Edge> edges;
  const double pixel = 2.0 * std::numbers::pi / view.width;
  const double minimum = static_cast<double>(kEdge * kEdge) * (2 * kDirectionReach + 1);
  for (int y = kDirectionReach + 1; y + kDirectionReach + 1 < view.height; y++) {
    const double phi = pixel * (0.5 * view.height - y - 0.5);
    if (std::abs(phi) > 60.0 * kDegree) continue;
    for (int x = 0; x < view.width; x++) {
      const Tensor tensor = tensor_at(view, x, y, 1.0 / std::cos(phi));
      const double angle = tensor.angle();
      if (!(tensor.across + tensor.up > minimum) || tensor.coherence() < kLine) continue;
      if (std::abs(angle) > 40.0 * kDegree) continue;
      const double theta = pixel * (x + 0.5 - 0.5 * view.width);
      const glm::dvec3 east(std::cos(theta), 0.0, std::sin(theta));
      const glm::dvec3 north(-std::sin(phi) * std::sin(theta), std::cos(phi), std::sin(phi) * std::cos(theta));
      edges.push_back({std::cos(angle) * east + std::sin(angle) * north, 1.0});
    }
  }
  return edges;
}

std::vector<Edge> some_of(const std::vector<Edge>& edges) {
  std::vector<Edge> some;
  const size_t step = edges.size() / kMaxEdges + 1;
  for (size_t i = 0; i < edges.size(); i += step) some.push_back(edges[i]);
  return some;
}

// The zenith tilted to the right and back, by angles in degrees.
glm::dvec3 zenith(double right, double back) {
  return glm::normalize(glm::dvec3(std::tan(right * kDegree), 1.0, std::tan(back * kDegree)));
}

// Fraction of the nearly vertical edges that are vertical, 0..1.
double share_of(const std::vector<Edge>& edges, glm::dvec3 up) {
  double inside = 0.0, all = 0.0;
  for (const Edge& edge : edges) {
    const double off = std::abs(std::asin(std::clamp(glm::dot(edge.normal, up), -1.0, 1.0))) / kDegree;
    if (off > kNearly) continue;
    all += edge.weight;
    inside += edge.weight * std::exp(-0.5 * off * off / (kWidth * kWidth));
  }
  return all > 0.0 ? inside / all : 0.0;
}

struct Tilt {
  double right = 0.0, back = 0.0;  // degrees
  double share = 0.0;
  double angle() const { return std::hypot(right, back); }
};

// The best of a grid around a tilt.
Tilt best_around(const std::vector<Edge>& edges, Tilt middle, double reach, double step) {
  Tilt best = middle;
  for (double right = middle.right - reach; right <= middle.right + reach; right += step) {
    for (double back = middle.back - reach; back <= middle.back + reach; back += step) {
      const double share = share_of(edges, zenith(right, back));
      if (share > best.share) best = {right, back, share};
    }
  }
  return best;
}

Tilt find_tilt(const std::vector<Edge>& edges) {
  Tilt level;
  level.share = share_of(edges, zenith(0.0, 0.0));
  const size_t few = edges.size() / 3000 + 1;
  std::vector<Edge> sparse;
  for (size_t i = 0; i < edges.size(); i += few) sparse.push_back(edges[i]);
  Tilt best = best_around(sparse, {}, kMaxTilt, 1.0);
  best.share = share_of(edges, zenith(best.right, best.back));
  for (const double step : {0.5, 0.1}) best = best_around(edges, best, 2.0 * step, step);
  return best;
}

}  // namespace

void check_horizon(const Subject& subject, LintReport& report) {
  const std::vector<GrayView>& views = subject.scales.back();
  if (views[0].width < kFewestAround) {
    return skip(report, Check::kHorizon, fmt::format("at {} pixels around, lines are too short", views[0].width));
  }
  std::vector<Edge> edges;
  for (const GrayView& view : views) {
    for (const Edge& edge : find_edges(view)) edges.push_back(edge);
  }
  edges = some_of(edges);
  if (edges.size() < kEnoughPlaces) return skip(report, Check::kHorizon, "too few lines that could be vertical");
  const Tilt tilt = find_tilt(edges);
  // The fraction of uniformly distributed edges that falls within the peak.
  const double chance = kWidth * std::sqrt(0.5 * std::numbers::pi) / kNearly;
  const double peak = std::clamp((tilt.share - 2.0 * chance) / (1.5 * chance), 0.0, 1.0);
  if (peak < 0.5) return skip(report, Check::kHorizon, "too few lines that are certainly vertical");
  judge(report, Check::kHorizon);
  const double level = share_of(edges, zenith(0.0, 0.0));
  const double better = std::clamp(3.5 * (tilt.share - level) / tilt.share, 0.0, 1.0);
  const double certainty = peak * better * std::clamp((tilt.angle() - 0.5) / 1.0, 0.0, 1.0);
  if (certainty < 0.1) return;
  const std::string angles = fmt::format("`pitch` {:.1f} `roll` {:.1f}", tilt.back, tilt.right);
  const std::string remedy = subject.eyes.size() == 1 ? "level it: " + convert_command(subject, angles)
                                                      : "render or stitch it level: the eyes of a "
                                                        "stereo picture cannot be tilted afterwards";
  report.findings.push_back(
      {Fault::kNotLevel, certainty,
       fmt::format("lines that should be vertical meet {:.1f} degrees {} and {:.1f} "
                   "degrees {} the zenith: {:.0f} % of "
                   "the nearly vertical edges, and {:.0f} % at the zenith itself",
                   std::abs(tilt.right), tilt.right > 0.0 ? "to the right of" : "to the left of", std::abs(tilt.back),
                   tilt.back > 0.0 ? "behind" : "in front of", 100.0 * tilt.share, 100.0 * level),
       remedy});
}

}  // namespace ods
