// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/comfort.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ods/base/error.h"
#include "ods/comfort/areas.h"
#include "ods/picture/picture.h"

namespace ods {

using std::numbers::pi;

namespace {

constexpr double kDegree = pi / 180.0, kArcMinute = kDegree / 60.0;
constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr size_t kMostPlaces = 10;

double cross_length(vec3 a, vec3 b) {
  return double{length(cross(a, b))};
}

// How far around from -Z.
double azimuth_of(vec3 direction) {
  return std::atan2(double{direction.x}, -double{direction.z});
}

// The other eye shows a point as far on the other side of its own azimuth.
double half_parallax_of(const Camera& camera, int eye, const ViewDirection& look, vec3 point) {
  if (eye == kMono) {
    const double across = std::hypot(double{point.x}, double{point.z});
    const double radius = 0.5 * double{camera.ipd * merge_at(camera, look.direction, look.elevation)};
    return std::asin(std::min(radius / std::max(across, 1e-9), 1.0));
  }
  return double{eye_side(eye)} * std::remainder(azimuth_of(point) - azimuth_of(look.direction), 2.0 * pi);
}

class Judge {
 public:
  Judge(const SeenDepth& seen, const ComfortOptions& options)
      : seen_(seen),
        options_(options),
        camera_(make_camera(seen.camera)),
        width_(seen.depth.width),
        height_(seen.depth.height) {
    for (const Strain strain : kStrains) limits_[static_cast<size_t>(strain)] = strain_limits(strain, options.viewer);
  }

  ComfortReport report();

 private:
  // What is known of a pixel: the angle at which eyes must converge, the worst of the strains.
  struct Point {
    bool is_shown = false;
    double solid_angle = 0.0;
    double elevation = 0.0, azimuth = 0.0, distance = kFar, half_parallax = 0.0, vergence = 0.0;
    double across = 0.0, height = 0.0;  // from the circle's axis, above its plane
    std::array<double, 4> strains{};
    ComfortLevel level = ComfortLevel::kOk;
  };

  void place(int x, int y);
  void add_steps();
  void add_step(Point& point, const Point& beside);
  void rate(Point& point) const;
  Strain worst_of(const Point& point) const;
  double rank_of(const Point& point) const;
  double circle_for(const Point& point) const;
  StrainedPlace describe(const Point& point, double share) const;
  void list_places(ComfortReport& report) const;

  Point& at(int x, int y) {
    return points_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  }
  bool is_whole_turn() const {
    return camera_.projection.kind == kLatLong && std::abs(double{camera_.projection.span.x} - 2.0 * pi) < 1e-4;
  }
  double gaze() const { return double{options_.viewer.gaze_degrees} * kDegree; }
  vec2 middle_of(int x, int y) const {
    return {(static_cast<float>(x) + 0.5f) / static_cast<float>(width_),
            (static_cast<float>(y) + 0.5f) / static_cast<float>(height_)};
  }
  ViewDirection look_at(int x, int y) const {
    const vec2 uv = middle_of(x, y);
    return look_of(camera_.projection, uv, uv);
  }

  const SeenDepth& seen_;
  const ComfortOptions& options_;
  const Camera camera_;
  const int width_, height_;
  std::array<StrainLimits, 4> limits_{};
  std::vector<Point> points_;
};

double rule_distance(const ComfortOptions& options, double elevation) {
  if (options.rules == ComfortRules::kSafeSphere) return double{options.safe_radius};
  return kGoogleAhead + (kGoogleAbove - kGoogleAhead) * std::abs(std::sin(elevation));
}

void Judge::place(int x, int y) {
  Point& point = at(x, y);
  const ViewDirection look = look_at(x, y);
  if (!look.seen) return;
  point.is_shown = true;
  point.elevation = std::asin(std::clamp(double{look.direction.y}, -1.0, 1.0));
  point.azimuth = azimuth_of(look.direction);
  const vec3 right = look_at(x + (x + 1 < width_ ? 1 : -1), y).direction;
  const vec3 below = look_at(x, y + (y + 1 < height_ ? 1 : -1)).direction;
  point.solid_angle = cross_length(right - look.direction, below - look.direction);
  const float depth = seen_.depth.at(x, y)[0];
  if (!is_surface(depth)) return;
  const Ray ray = camera_ray(camera_, seen_.eye, middle_of(x, y));
  const vec3 away = ray.origin + ray.direction * depth - camera_.center;
  const vec3 local(dot(away, camera_.right), dot(away, camera_.up), dot(away, camera_.back));
  const double half = point.half_parallax = half_parallax_of(camera_, seen_.eye, look, local);
  point.distance = double{length(local)};
  point.across = std::hypot(double{local.x}, double{local.z}), point.height = double{local.y};
  point.vergence = vergence(half, point.elevation);
  if (options_.rules != ComfortRules::kStrain) {
    point.strains[static_cast<size_t>(Strain::kRule)] = rule_distance(options_, point.elevation) / point.distance;
    return;
  }
  point.strains[static_cast<size_t>(Strain::kNear)] = vergence_dioptres(point.vergence, options_.viewer);
  point.strains[static_cast<size_t>(Strain::kVertical)] =
      worst_vertical_disparity(half, point.elevation, gaze()) / kArcMinute;
}

void Judge::add_step(Point& point, const Point& beside) {
  if (!point.is_shown || !beside.is_shown) return;
  double& step = point.strains[static_cast<size_t>(Strain::kStep)];
  step = std::max(step, (point.vergence - beside.vergence) / kDegree);
}

// Each pixel against those a degree to its sides, above and below; the nearer one has the strain.
void Judge::add_steps() {
  const double least = limits_[static_cast<size_t>(Strain::kStep)].caution * kDegree;
  for (int y = 0; y < height_; y++) {
    for (int x = 0; x < width_; x++) {
      Point& point = at(x, y);
      if (!(point.vergence > least)) continue;
      const double side = std::sqrt(std::max(point.solid_angle, 1e-12));  // of a pixel
      const int reach = std::clamp(static_cast<int>(std::lround(kDegree / side)), 1, width_ / 4 + 1);
      for (const int to : {x - reach, x + reach}) {
        const int wrapped = is_whole_turn() ? (to + width_) % width_ : to;
        if (wrapped >= 0 && wrapped < width_) add_step(point, at(wrapped, y));
      }
      for (const int to : {y - reach, y + reach}) {
        if (to >= 0 && to < height_) add_step(point, at(x, to));
      }
    }
  }
}

void Judge::rate(Point& point) const {
  for (const Strain strain : kStrains) {
    const auto i = static_cast<size_t>(strain);
    point.level = std::max(point.level, level_of(point.strains[i], limits_[i]));
  }
}

Strain Judge::worst_of(const Point& point) const {
  Strain worst = Strain::kNear;
  double most = 0.0;
  for (const Strain strain : kStrains) {
    const auto i = static_cast<size_t>(strain);
    const double value = point.strains[i] / limits_[i].warning;
    const bool is_worst = level_of(point.strains[i], limits_[i]) == point.level;
    if (is_worst && value > most) most = value, worst = strain;
  }
  return worst;
}

double Judge::rank_of(const Point& point) const {
  const auto i = static_cast<size_t>(worst_of(point));
  return static_cast<double>(point.level) * 1e6 + point.strains[i] / limits_[i].warning;
}

// The share of the circle's radius with which the point is no more than a caution. Strains are nearly proportional to
// the radius, but for points near the axis, which change their elevation with it.
double Judge::circle_for(const Point& point) const {
  if (point.level < ComfortLevel::kWarning || options_.rules != ComfortRules::kStrain) return 1.0;
  const auto limit = [&](Strain strain) { return limits_[static_cast<size_t>(strain)].warning; };
  const double circle = point.across * std::sin(point.half_parallax);
  double share = 1.0;
  for (int i = 0; i < 8; i++) {
    const auto [half, elevation] = seen_from_circle(share * circle, point.across, point.height);
    const double near = vergence_dioptres(vergence(half, elevation), options_.viewer);
    const double vertical = worst_vertical_disparity(half, elevation, gaze()) / kArcMinute;
    const double over = std::max(near / limit(Strain::kNear), vertical / limit(Strain::kVertical));
    share = std::min(1.0, share / over);
  }
  const double step = limit(Strain::kStep) / std::max(point.strains[static_cast<size_t>(Strain::kStep)], 1e-9);
  return std::min(share, step);
}

// Strains go nearly as one over the distance.
StrainedPlace Judge::describe(const Point& point, double share) const {
  StrainedPlace place;
  place.strain = worst_of(point);
  const auto i = static_cast<size_t>(place.strain);
  place.value = point.strains[i];
  place.level = point.level;
  place.azimuth = point.azimuth / kDegree;
  place.elevation = point.elevation / kDegree;
  place.distance = point.distance;
  place.share = share;
  double most = 0.0;
  for (size_t k = 0; k < limits_.size(); k++) most = std::max(most, point.strains[k] / limits_[k].warning);
  place.enough = point.distance * most;
  return place;
}

void Judge::list_places(ComfortReport& report) const {
  AreaGrid grid{width_, height_, is_whole_turn(), {}, {}};
  for (const Point& point : points_) {
    grid.is_in.push_back(point.level != ComfortLevel::kOk);
    grid.nearness.push_back(static_cast<float>(1.0 / point.distance));
  }
  const std::vector<int> areas = seen_.things.empty() ? connected_areas(grid) : seen_.things;
  struct Thing {
    size_t worst = 0;
    double rank = 0.0, share = 0.0;
  };
  std::vector<Thing> things;
  double all = 0.0;
  for (size_t i = 0; i < points_.size(); i++) {
    all += points_[i].solid_angle;
    if (points_[i].level == ComfortLevel::kOk || areas[i] < 0) continue;
    if (things.size() <= static_cast<size_t>(areas[i])) things.resize(static_cast<size_t>(areas[i]) + 1);
    Thing& thing = things[static_cast<size_t>(areas[i])];
    thing.share += points_[i].solid_angle;
    if (const double rank = rank_of(points_[i]); rank > thing.rank) thing.rank = rank, thing.worst = i;
  }
  std::vector<size_t> order;
  for (size_t i = 0; i < things.size(); i++) {
    if (things[i].rank > 0.0) order.push_back(i);
  }
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return things[a].rank > things[b].rank; });
  order.resize(std::min(order.size(), kMostPlaces));
  for (const size_t i : order) {
    report.places.push_back(describe(points_[things[i].worst], things[i].share / all));
    if (i < seen_.names.size()) report.places.back().name = seen_.names[i];
  }
}

ComfortReport Judge::report() {
  ComfortReport report;
  points_.resize(static_cast<size_t>(width_) * static_cast<size_t>(height_));
  size_t unknown = 0;
  for (int y = 0; y < height_; y++) {
    for (int x = 0; x < width_; x++) {
      place(x, y);
      unknown += !(seen_.depth.at(x, y)[0] > 0.0f);
    }
  }
  if (unknown == points_.size()) throw Error(ErrorKind::kInput, "no pixel has a depth above 0");
  if (options_.rules == ComfortRules::kStrain) add_steps();
  report.level = Image(width_, height_, 1);
  report.nearest = kFar;
  double all = 0.0, circle = 1.0;
  for (size_t i = 0; i < points_.size(); i++) {
    Point& point = points_[i];
    rate(point);
    all += point.solid_angle;
    report.share[static_cast<size_t>(point.level)] += point.solid_angle;
    report.nearest = std::min(report.nearest, point.distance);
    report.level.pixels[i] = static_cast<float>(point.level);
    for (size_t k = 0; k < limits_.size(); k++) report.most[k] = std::max(report.most[k], point.strains[k]);
    circle = std::min(circle, circle_for(point));
  }
  for (double& share : report.share) share /= std::max(all, 1e-12);
  report.unknown = static_cast<double>(unknown) / static_cast<double>(points_.size());
  report.largest_ipd = static_cast<float>(double{seen_.camera.ipd} * circle);
  list_places(report);
  return report;
}

}  // namespace

ComfortReport judge_comfort(const SeenDepth& seen, const ComfortOptions& options) {
  assert(seen.depth.channels == 1 && (seen.things.empty() || seen.things.size() == seen.depth.pixels.size()));
  return Judge(seen, options).report();
}

ComfortLevel worst_level(const ComfortReport& report) {
  ComfortLevel worst = ComfortLevel::kOk;
  for (const ComfortLevel level : kComfortLevels) {
    if (report.share[static_cast<size_t>(level)] > 0.0) worst = level;
  }
  return worst;
}

Image nearest_of_blocks(const Image& depth, int most_width) {
  const int block = (depth.width + most_width - 1) / most_width;
  if (block <= 1) return depth;
  Image nearest((depth.width + block - 1) / block, (depth.height + block - 1) / block, 1);
  std::ranges::fill(nearest.pixels, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < depth.height; y++) {
    for (int x = 0; x < depth.width; x++) {
      float& least = nearest.at(x / block, y / block)[0];
      const float value = depth.at(x, y)[0];
      if (value > 0.0f && !(value >= least)) least = value;
    }
  }
  return nearest;
}

}  // namespace ods
