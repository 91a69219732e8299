// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/comfort.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ods/base/angles.h"
#include "ods/camera/pixel.h"
#include "ods/kernel/counterpart.h"
#include "ods/picture/picture.h"

namespace ods {

using std::numbers::pi;

namespace {

constexpr double kNothingThere = std::numeric_limits<double>::infinity();

double cross_length(vec3 a, vec3 b) {
  return double{length(cross(a, b))};
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

// The place of a pixel's surface. The first three are as in strain.h, the distance is from the circle's centre.
struct JudgedPlace {
  double half_parallax = 0.0, across = 0.0, height = 0.0, distance = kNothingThere;
};

JudgedPlace place_of(const Camera& camera, int eye, vec2 uv, const ViewDirection& look, float depth) {
  if (!is_surface(depth)) return {};
  const Ray ray = camera_ray(camera, eye, uv);
  const vec3 away = ray.origin + ray.direction * depth - camera.center;
  const vec3 local(dot(away, camera.right), dot(away, camera.up), dot(away, camera.back));
  return {half_parallax_of(camera, eye, look, local), std::hypot(double{local.x}, double{local.z}), double{local.y},
          double{length(local)}};
}

// Returns whether all rays of a row leave one circle as its tangents, at one elevation.
bool has_even_rows(const Camera& camera, int eye) {
  const vec3 right = cross(camera.up, camera.back);
  return merges_same_around(camera) && camera.projection.kind == kLatLong && camera.axis.y == 1.0f &&
         camera.neck == 0.0f && eye != kMono && camera.convergence == kParallel && !has_head_tilt(camera) &&
         dot(right, camera.right) > 0.0f;
}

// The solid angle of a pixel over relative_solid_angle(), by the pixel in the middle of the picture or of a cube's
// first face.
double steradians_of_pixel(const Projection& projection, Extent size) {
  vec2 home(0.5f);
  if (is_cube(projection.kind)) {
    const auto columns = static_cast<float>(cube_columns(projection.kind));
    home = vec2(0.5f / columns, columns / 12.0f);
  }
  const vec2 pixel(1.0f / static_cast<float>(size.width), 1.0f / static_cast<float>(size.height));
  const auto at = [&](float x, float y) { return look_of(projection, home, home + pixel * vec2(x, y)).direction; };
  const double solid = cross_length(at(0.5f, 0.0f) - at(-0.5f, 0.0f), at(0.0f, 0.5f) - at(0.0f, -0.5f));
  return solid / double{relative_solid_angle(projection, home, home)};
}

// The properties that all pixels of an eye share.
struct EyeView {
  const SeenDepth& seen;
  const ComfortOptions& options;
  Camera camera = make_camera(seen.camera);
  Extent size{seen.depth.width, seen.depth.height};
  bool is_even = has_even_rows(camera, seen.eye);
  double steradians = steradians_of_pixel(camera.projection, size);  // of relative_solid_angle()
  HeadReach reach = reach_of(options.viewer);
  EnumArray<Strain, StrainLimits> limits = strain_limits(options.viewer);

  size_t pixel(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(size.width) + static_cast<size_t>(x);
  }
  ViewDirection look_at(int x, int y) const {
    const vec2 uv = pixel_middle(x, y, size);
    return look_of(camera.projection, uv, uv);
  }
};

// A line of sight, without its depth. If rows are even, one serves a whole row.
struct Sight {
  ViewDirection look;
  double elevation, looked;
  double radius;  // of the circle that the rays leave; set if rows are even
  float solid_angle;
};

Sight sight_at(const EyeView& eye, int x, int y) {
  const vec2 uv = pixel_middle(x, y, eye.size);
  const Camera& camera = eye.camera;
  const ViewDirection look = look_of(camera.projection, uv, uv);
  const double elevation = elevation_of(look.direction);
  const double radius = eye.is_even ? 0.5 * double{camera.ipd * merge_at(camera, look.direction, look.elevation)} : 0.0;
  return {look, elevation, gaze_density(elevation), radius,
          static_cast<float>(eye.steradians * double{relative_solid_angle(camera.projection, uv, uv)})};
}

// On an even row the eye, its ray and the circle's centre are a right triangle.
JudgedPlace place_at(const EyeView& eye, int x, int y, const Sight& sight) {
  const float depth = *eye.seen.depth.at(x, y);
  if (!eye.is_even) return place_of(eye.camera, eye.seen.eye, pixel_middle(x, y, eye.size), sight.look, depth);
  if (!is_surface(depth)) return {};
  const double along = double{depth} * std::cos(sight.elevation), height = double{depth} * std::sin(sight.elevation);
  const double across = std::hypot(along, sight.radius);
  return {std::atan2(sight.radius, along), across, height, std::hypot(across, height)};
}

double rule_distance(const ComfortOptions& options, double elevation) {
  if (options.rules == ComfortRules::kSafeSphere) return double{options.safe_radius};
  return kGoogleAhead + (kGoogleAbove - kGoogleAhead) * std::abs(std::sin(elevation));
}

// harmless: the largest half parallax known to keep the vertical disparity of this line of sight below a caution.
// Vertical disparity grows with it, so smaller ones do not need a search. Points that are harmless extend it.
ComfortPoint measure_point(const EyeView& eye, int x, int y, const Sight& sight, double& harmless) {
  ComfortPoint point;
  point.is_known = sight.look.seen && *eye.seen.depth.at(x, y) > 0.0f;
  if (!point.is_known) return point;
  point.solid_angle = sight.solid_angle;
  point.looked = sight.looked;
  const JudgedPlace place = place_at(eye, x, y, sight);
  if (place.distance == kNothingThere) return point;
  point.distance = static_cast<float>(place.distance);
  const double converged = vergence(place.half_parallax, sight.elevation);
  point.vergence = static_cast<float>(converged);
  if (eye.options.rules != ComfortRules::kStrain) {
    point.strains[Strain::kRule] = static_cast<float>(rule_distance(eye.options, sight.elevation) / place.distance);
    return point;
  }
  point.strains[Strain::kNear] = static_cast<float>(vergence_dioptres(converged, eye.options.viewer));
  if (place.half_parallax <= harmless) return point;
  const double vertical = worst_vertical_disparity(place.half_parallax, sight.elevation, eye.reach) / kArcMinute;
  point.strains[Strain::kVertical] = static_cast<float>(vertical);
  if (vertical <= eye.limits[Strain::kVertical].caution) harmless = place.half_parallax;
  return point;
}

void measure_row(const EyeView& eye, int y, std::vector<ComfortPoint>& points) {
  Sight sight = sight_at(eye, 0, y);
  double harmless = 0.0;
  for (int x = 0; x < eye.size.width; x++) {
    if (!eye.is_even && x > 0) {
      sight = sight_at(eye, x, y);
      harmless = 0.0;
    }
    points[eye.pixel(x, y)] = measure_point(eye, x, y, sight, harmless);
  }
}

// Compares each pixel with those a degree to its sides, above and below; the nearer one has the strain.
void add_steps(const EyeView& eye, int y, std::vector<ComfortPoint>& points) {
  const auto [width, height] = eye.size;
  const bool wraps = wraps_around(eye.camera.projection);
  const double min = eye.limits[Strain::kStep].caution * kDegree;
  for (int x = 0; x < width; x++) {
    ComfortPoint& point = points[eye.pixel(x, y)];
    if (!(double{point.vergence} > min)) continue;
    const double side = std::sqrt(std::max(double{point.solid_angle}, 1e-12));  // of a pixel
    const int reach = std::clamp(static_cast<int>(std::lround(kDegree / side)), 1, width / 4 + 1);
    const glm::ivec2 neighbours[] = {{-reach, 0}, {reach, 0}, {0, -reach}, {0, reach}};
    for (const glm::ivec2 to : neighbours) {
      const int to_x = wraps ? (x + to.x + width) % width : x + to.x, to_y = y + to.y;
      if (to_x < 0 || to_x >= width || to_y < 0 || to_y >= height) continue;
      const ComfortPoint& beside = points[eye.pixel(to_x, to_y)];
      if (!beside.is_known) continue;
      float& step = point.strains[Strain::kStep];
      step = std::max(step, (point.vergence - beside.vergence) / static_cast<float>(kDegree));
    }
  }
}

// The sides of a picture that does not go all around cut things: one eye shows more of them than the other.
void add_edges(const EyeView& eye, int y, std::vector<ComfortPoint>& points) {
  if (wraps_around(eye.camera.projection) || is_cube(eye.camera.projection.kind)) return;
  for (int x = 0; x < eye.size.width; x++) {
    ComfortPoint& point = points[eye.pixel(x, y)];
    if (!point.is_known) continue;
    const bool is_edge =
        x == 0 || x + 1 == eye.size.width || !eye.look_at(x - 1, y).seen || !eye.look_at(x + 1, y).seen;
    if (is_edge) point.strains[Strain::kEdge] = point.vergence / static_cast<float>(kDegree);
  }
}

ComfortLevel worst_level(const ComfortPoint& point, const EnumArray<Strain, StrainLimits>& limits) {
  ComfortLevel worst = ComfortLevel::kOk;
  for (const Strain strain : kStrains) {
    worst = std::max(worst, level_of(double{point.strains[strain]}, limits[strain]));
  }
  return worst;
}

double circle_by_steps(const EyeView& eye, const ComfortPoint& point) {
  double share = 1.0;
  for (const Strain strain : {Strain::kStep, Strain::kEdge}) {
    share = std::min(share, eye.limits[strain].warning / std::max(double{point.strains[strain]}, 1e-9));
  }
  return share;
}

// Strains are nearly proportional to the radius, except near the circle, and near the axis, where the elevation
// changes, too.
double circle_for(const EyeView& eye, const ComfortPoint& point, size_t pixel) {
  if (point.level < ComfortLevel::kWarning || eye.options.rules != ComfortRules::kStrain) return 1.0;
  const int x = static_cast<int>(pixel) % eye.size.width, y = static_cast<int>(pixel) / eye.size.width;
  const JudgedPlace place = place_at(eye, x, y, sight_at(eye, x, y));
  const double circle = place.across * std::sin(place.half_parallax);
  double share = 1.0, low = 0.0, high = 1.0;
  for (int i = 0; i < 16; i++) {
    const auto [half, elevation] = seen_from_circle(share * circle, place.across, place.height);
    const double near = vergence_dioptres(vergence(half, elevation), eye.options.viewer);
    const double vertical = worst_vertical_disparity(half, elevation, eye.reach) / kArcMinute;
    const double over =
        std::max(near / eye.limits[Strain::kNear].warning, vertical / eye.limits[Strain::kVertical].warning);
    (over <= 1.0 ? low : high) = share;
    if (low == 1.0) break;
    const double next = share / over;
    if (std::abs(over - 1.0) < 1e-4) {
      low = std::min(next, 1.0);
      break;
    }
    share = next > low && next < high ? next : 0.5 * (low + high);
  }
  return std::min(low, circle_by_steps(eye, point));
}

// The pixel for which the eyes converge most. On an even row it has the largest of all strains but steps.
size_t max_convergence(const EyeView& eye, int y, const std::vector<ComfortPoint>& points) {
  const auto row = points.begin() + static_cast<std::ptrdiff_t>(eye.pixel(0, y));
  const auto maximum = std::ranges::max_element(row, row + eye.size.width, {}, &ComfortPoint::vergence);
  return static_cast<size_t>(maximum - points.begin());
}

double circle_for_row(const EyeView& eye, int y, const std::vector<ComfortPoint>& points) {
  const size_t maximum = max_convergence(eye, y, points);
  double share = circle_for(eye, points[maximum], maximum);
  for (size_t i = eye.pixel(0, y); i < eye.pixel(0, y + 1); i++) {
    share = std::min(share, eye.is_even ? circle_by_steps(eye, points[i]) : circle_for(eye, points[i], i));
  }
  return share;
}

double roll_for_row(const EyeView& eye, int y, const std::vector<ComfortPoint>& points) {
  const double limit = eye.limits[Strain::kVertical].warning * kArcMinute;
  const size_t worst = max_convergence(eye, y, points);
  double roll = 0.5 * pi;
  for (int x = 0; x < eye.size.width; x++) {
    if ((eye.is_even && eye.pixel(x, y) != worst) || !(points[eye.pixel(x, y)].vergence > 0.0f)) continue;
    const Sight sight = sight_at(eye, x, y);
    const double half = place_at(eye, x, y, sight).half_parallax;
    if (worst_vertical_disparity(half, sight.elevation, {eye.reach.gaze, roll}) <= limit) continue;
    roll = roll_for_disparity(half, sight.elevation, eye.reach.gaze, limit);
  }
  return roll;
}

}  // namespace

ComfortPoints measure_points(const SeenDepth& seen, const ComfortOptions& options) {
  assert(seen.depth.channels == 1 && (seen.things.empty() || seen.things.size() == seen.depth.pixels.size()));
  const EyeView eye{seen, options};
  const bool has_strains = options.rules == ComfortRules::kStrain;
  ComfortPoints measured;
  std::vector<ComfortPoint>& points = measured.points;
  points.resize(seen.depth.pixels.size());
  tbb::parallel_for(0, eye.size.height, [&](int y) { measure_row(eye, y, points); });
  std::vector<double> circles(static_cast<size_t>(eye.size.height), 1.0), rolls(circles.size(), 0.5 * pi);
  tbb::parallel_for(0, eye.size.height, [&](int y) {
    if (has_strains) {
      add_steps(eye, y, points);
      add_edges(eye, y, points);
    }
    for (size_t i = eye.pixel(0, y); i < eye.pixel(0, y + 1); i++) points[i].level = worst_level(points[i], eye.limits);
    circles[static_cast<size_t>(y)] = circle_for_row(eye, y, points);
    if (has_strains) rolls[static_cast<size_t>(y)] = roll_for_row(eye, y, points);
  });
  measured.circle = *std::ranges::min_element(circles);
  measured.roll = *std::ranges::min_element(rolls);
  return measured;
}

double comfortable_circle(const SeenDepth& seen, const ComfortOptions& options, const ComfortPoint& point,
                          size_t pixel) {
  return circle_for(EyeView{seen, options}, point, pixel);
}

WorstStrain worst_strain(const ComfortPoint& point, const EnumArray<Strain, StrainLimits>& limits) {
  WorstStrain worst;
  for (const Strain strain : kStrains) {
    const double ratio = double{point.strains[strain]} / limits[strain].warning;
    const bool decides = level_of(double{point.strains[strain]}, limits[strain]) == point.level;
    if (decides && ratio > worst.ratio) worst = {strain, ratio};
  }
  return worst;
}

PointComfort judge_point(const StereoCamera& setting, int eye, vec2 uv, float depth, const Viewer& viewer) {
  const Camera camera = make_camera(setting);
  const ViewDirection look = look_of(camera.projection, uv, uv);
  const JudgedPlace place = place_of(camera, eye, uv, look, depth);
  const double elevation = elevation_of(look.direction);
  PointComfort point{ComfortLevel::kOk, place.distance};
  point.near = vergence_dioptres(vergence(place.half_parallax, elevation), viewer);
  point.vertical = worst_vertical_disparity(place.half_parallax, elevation, reach_of(viewer)) / kArcMinute;
  point.level = std::max(level_of(point.near, strain_limits(Strain::kNear, viewer)),
                         level_of(point.vertical, strain_limits(Strain::kVertical, viewer)));
  return point;
}

double azimuth_of(vec3 direction) {
  return std::atan2(double{direction.x}, -double{direction.z});
}

double elevation_of(vec3 direction) {
  return std::asin(std::clamp(double{direction.y}, -1.0, 1.0));
}

}  // namespace ods
