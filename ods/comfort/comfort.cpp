// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/comfort.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "ods/base/angles.h"
#include "ods/base/error.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/areas.h"
#include "ods/kernel/counterpart.h"
#include "ods/picture/picture.h"

namespace ods {

using std::numbers::pi;

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr size_t kMostPlaces = 10;
constexpr double kBeside = 20.0 * kDegree;

double cross_length(vec3 a, vec3 b) {
  return double{length(cross(a, b))};
}

double elevation_of(const ViewDirection& look) {
  return std::asin(std::clamp(double{look.direction.y}, -1.0, 1.0));
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

using Strains = std::array<float, std::size(kStrains)>;

// Where a pixel's surface is.
struct JudgedPlace {
  double half_parallax = 0.0, across = 0.0, height = 0.0, distance = kFar;  // as in strain.h; from the centre
};

JudgedPlace place_of(const Camera& camera, int eye, vec2 uv, const ViewDirection& look, float depth) {
  if (!is_surface(depth)) return {};
  const Ray ray = camera_ray(camera, eye, uv);
  const vec3 away = ray.origin + ray.direction * depth - camera.center;
  const vec3 local(dot(away, camera.right), dot(away, camera.up), dot(away, camera.back));
  return {half_parallax_of(camera, eye, look, local), std::hypot(double{local.x}, double{local.z}), double{local.y},
          double{length(local)}};
}

// Whether all rays of a row leave one circle as its tangents, at one elevation.
bool has_even_rows(const Camera& camera, int eye) {
  const CameraMap& map = camera.merge_map;
  for (int i = 0; i < map.width * map.height; i++) {
    if (map.texels[i] != map.texels[i / map.width * map.width]) return false;
  }
  const vec3 right = cross(camera.up, camera.back);
  return camera.projection.kind == kLatLong && camera.axis.y == 1.0f && camera.neck == 0.0f && eye != kMono &&
         camera.convergence == kParallel && !has_head_tilt(camera) && dot(right, camera.right) > 0.0f;
}

class Judge {
 public:
  Judge(const SeenDepth& seen, const ComfortOptions& options)
      : seen_(seen),
        options_(options),
        camera_(make_camera(seen.camera)),
        is_even_(has_even_rows(camera_, seen.eye)),
        width_(seen.depth.width),
        height_(seen.depth.height),
        steradians_(steradians_of_pixel()),
        reach_(reach_of(options.viewer)) {
    for (const Strain strain : kStrains) limits_[static_cast<size_t>(strain)] = strain_limits(strain, options.viewer);
  }

  ComfortReport report();

 private:
  // What is kept of each pixel; the rest is found again where it is wanted.
  struct Point {
    bool is_known = false;  // it is in the picture, and has a depth or nothing there
    float solid_angle = 0.0f;
    double looked = 0.0;  // looked_at() its elevation
    float distance = std::numeric_limits<float>::infinity();
    float vergence = 0.0f;
    Strains strains{};
    ComfortLevel level = ComfortLevel::kOk;
  };
  // What does not depend on depth; of a whole row, if rows are even.
  struct View {
    ViewDirection look;
    double elevation, looked, radius;  // of the circle that the rays leave
    float solid_angle;
    double harmless = 0.0;  // up to this half parallax, vertical disparity there is no caution
  };

  View view_of(int x, int y) const;
  JudgedPlace place_at(int x, int y, const View& view) const;
  void judge_row(int y);
  void judge_pixel(int x, int y, View& view);
  void add_steps(int y);
  void add_edges(int y);
  void rate(Point& point) const;
  Strain worst_of(const Point& point) const;
  double most_of(const Point& point) const;  // of its strains, in limits of a warning
  double rank_of(const Point& point) const;
  double circle_for(size_t pixel) const;
  double circle_by_steps(const Point& point) const;
  size_t most_converged(int y) const;
  double circle_for_row(int y) const;
  double roll_for_row(int y) const;
  StrainedPlace describe(size_t pixel, double share) const;
  std::vector<int> things_or_areas() const;
  void list_places(ComfortReport& report, double all) const;
  double steradians_of_pixel() const;

  size_t pixel(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }
  double limit(Strain strain) const { return limits_[static_cast<size_t>(strain)].warning; }
  ViewDirection look_at(int x, int y) const {
    const vec2 uv = pixel_middle(x, y, seen_.depth);
    return look_of(camera_.projection, uv, uv);
  }

  const SeenDepth& seen_;
  const ComfortOptions& options_;
  const Camera camera_;
  const bool is_even_;
  const int width_, height_;
  const double steradians_;  // of relative_solid_angle()
  const HeadReach reach_;
  std::array<StrainLimits, std::size(kStrains)> limits_{};
  std::vector<Point> points_;
};

double rule_distance(const ComfortOptions& options, double elevation) {
  if (options.rules == ComfortRules::kSafeSphere) return double{options.safe_radius};
  return kGoogleAhead + (kGoogleAbove - kGoogleAhead) * std::abs(std::sin(elevation));
}

// By the size of one pixel: the middle one, or the first face's.
double Judge::steradians_of_pixel() const {
  const Projection& projection = camera_.projection;
  vec2 home(0.5f);
  if (is_cube(projection.kind)) {
    const auto columns = static_cast<float>(cube_columns(projection.kind));
    home = vec2(0.5f / columns, columns / 12.0f);
  }
  const vec2 size(1.0f / static_cast<float>(width_), 1.0f / static_cast<float>(height_));
  const auto at = [&](float x, float y) { return look_of(projection, home, home + size * vec2(x, y)).direction; };
  const double solid = cross_length(at(0.5f, 0.0f) - at(-0.5f, 0.0f), at(0.0f, 0.5f) - at(0.0f, -0.5f));
  return solid / double{relative_solid_angle(projection, home, home)};
}

Judge::View Judge::view_of(int x, int y) const {
  const vec2 uv = pixel_middle(x, y, seen_.depth);
  View view{look_of(camera_.projection, uv, uv), 0.0, 0.0, 0.0, 0.0f};
  view.elevation = elevation_of(view.look), view.looked = looked_at(view.elevation);
  view.solid_angle = static_cast<float>(steradians_ * double{relative_solid_angle(camera_.projection, uv, uv)});
  if (is_even_) view.radius = 0.5 * double{camera_.ipd * merge_at(camera_, view.look.direction, view.look.elevation)};
  return view;
}

// On an even row the eye, its ray and the circle's centre are a right triangle.
JudgedPlace Judge::place_at(int x, int y, const View& view) const {
  const float depth = *seen_.depth.at(x, y);
  if (!is_even_) return place_of(camera_, seen_.eye, pixel_middle(x, y, seen_.depth), view.look, depth);
  if (!is_surface(depth)) return {};
  const double along = double{depth} * std::cos(view.elevation), height = double{depth} * std::sin(view.elevation);
  const double across = std::hypot(along, view.radius);
  return {std::atan2(view.radius, along), across, height, std::hypot(across, height)};
}

void Judge::judge_row(int y) {
  View view = view_of(0, y);
  for (int x = 0; x < width_; x++) {
    if (!is_even_ && x > 0) view = view_of(x, y);
    judge_pixel(x, y, view);
  }
}

void Judge::judge_pixel(int x, int y, View& view) {
  Point& point = points_[pixel(x, y)];
  point.is_known = view.look.seen && *seen_.depth.at(x, y) > 0.0f;
  if (!point.is_known) return;
  point.solid_angle = view.solid_angle, point.looked = view.looked;
  const JudgedPlace place = place_at(x, y, view);
  if (place.distance == kFar) return;
  point.distance = static_cast<float>(place.distance);
  const double converged = vergence(place.half_parallax, view.elevation);
  point.vergence = static_cast<float>(converged);
  const auto set = [&](Strain strain, double value) {
    point.strains[static_cast<size_t>(strain)] = static_cast<float>(value);
  };
  if (options_.rules != ComfortRules::kStrain) {
    return set(Strain::kRule, rule_distance(options_, view.elevation) / place.distance);
  }
  set(Strain::kNear, vergence_dioptres(converged, options_.viewer));
  if (place.half_parallax <= view.harmless) return;  // vertical disparity grows with it
  const double vertical = worst_vertical_disparity(place.half_parallax, view.elevation, reach_) / kArcMinute;
  set(Strain::kVertical, vertical);
  if (vertical <= limits_[static_cast<size_t>(Strain::kVertical)].caution) view.harmless = place.half_parallax;
}

// Each pixel against those a degree to its sides, above and below; the nearer one has the strain.
void Judge::add_steps(int y) {
  const double least = limits_[static_cast<size_t>(Strain::kStep)].caution * kDegree;
  for (int x = 0; x < width_; x++) {
    Point& point = points_[pixel(x, y)];
    if (!(double{point.vergence} > least)) continue;
    const double side = std::sqrt(std::max(double{point.solid_angle}, 1e-12));  // of a pixel
    const int reach = std::clamp(static_cast<int>(std::lround(kDegree / side)), 1, width_ / 4 + 1);
    const auto compare = [&](int to_x, int to_y) {
      if (wraps_around(camera_.projection)) to_x = (to_x + width_) % width_;
      if (to_x < 0 || to_x >= width_ || to_y < 0 || to_y >= height_) return;
      const Point& beside = points_[pixel(to_x, to_y)];
      if (!beside.is_known) return;
      float& step = point.strains[static_cast<size_t>(Strain::kStep)];
      step = std::max(step, (point.vergence - beside.vergence) / static_cast<float>(kDegree));
    };
    for (const int to : {-reach, reach}) compare(x + to, y), compare(x, y + to);
  }
}

// What the sides of a picture cut that does not go all around: one eye shows more of it than the other.
void Judge::add_edges(int y) {
  if (wraps_around(camera_.projection) || is_cube(camera_.projection.kind)) return;
  for (int x = 0; x < width_; x++) {
    Point& point = points_[pixel(x, y)];
    if (!point.is_known) continue;
    const bool is_edge = x == 0 || x + 1 == width_ || !look_at(x - 1, y).seen || !look_at(x + 1, y).seen;
    if (is_edge) point.strains[static_cast<size_t>(Strain::kEdge)] = point.vergence / static_cast<float>(kDegree);
  }
}

void Judge::rate(Point& point) const {
  for (const Strain strain : kStrains) {
    const auto i = static_cast<size_t>(strain);
    point.level = std::max(point.level, level_of(double{point.strains[i]}, limits_[i]));
  }
}

Strain Judge::worst_of(const Point& point) const {
  Strain worst = Strain::kNear;
  double most = 0.0;
  for (const Strain strain : kStrains) {
    const auto i = static_cast<size_t>(strain);
    const double value = double{point.strains[i]} / limits_[i].warning;
    const bool is_worst = level_of(double{point.strains[i]}, limits_[i]) == point.level;
    if (is_worst && value > most) most = value, worst = strain;
  }
  return worst;
}

double Judge::most_of(const Point& point) const {
  double most = 0.0;
  for (size_t i = 0; i < limits_.size(); i++) most = std::max(most, double{point.strains[i]} / limits_[i].warning);
  return most;
}

double Judge::rank_of(const Point& point) const {
  const auto i = static_cast<size_t>(worst_of(point));
  return static_cast<double>(point.level) * 1e6 + double{point.strains[i]} / limits_[i].warning;
}

// The share of the circle's radius with which the pixel is no more than a caution. Strains are nearly proportional to
// the radius, but for points near the axis, which change their elevation with it.
double Judge::circle_for(size_t pixel) const {
  const Point& point = points_[pixel];
  if (point.level < ComfortLevel::kWarning || options_.rules != ComfortRules::kStrain) return 1.0;
  const int x = static_cast<int>(pixel) % width_, y = static_cast<int>(pixel) / width_;
  const JudgedPlace place = place_at(x, y, view_of(x, y));
  const double circle = place.across * std::sin(place.half_parallax);
  double share = 1.0;
  for (int i = 0; i < 8; i++) {
    const auto [half, elevation] = seen_from_circle(share * circle, place.across, place.height);
    const double near = vergence_dioptres(vergence(half, elevation), options_.viewer);
    const double vertical = worst_vertical_disparity(half, elevation, reach_) / kArcMinute;
    const double over = std::max(near / limit(Strain::kNear), vertical / limit(Strain::kVertical));
    if (over <= 1.0 && (over > 0.9999 || share == 1.0)) break;
    share = std::min(1.0, share / over);
  }
  return std::min(share, circle_by_steps(point));
}

double Judge::circle_by_steps(const Point& point) const {
  double share = 1.0;
  for (const Strain strain : {Strain::kStep, Strain::kEdge}) {
    share = std::min(share, limit(strain) / std::max(double{point.strains[static_cast<size_t>(strain)]}, 1e-9));
  }
  return share;
}

// The pixel for which the eyes converge most. On an even row it has the most of all but steps.
size_t Judge::most_converged(int y) const {
  const auto row = points_.begin() + static_cast<std::ptrdiff_t>(pixel(0, y));
  return static_cast<size_t>(std::ranges::max_element(row, row + width_, {}, &Point::vergence) - points_.begin());
}

double Judge::circle_for_row(int y) const {
  double share = circle_for(most_converged(y));
  for (size_t i = pixel(0, y); i < pixel(0, y + 1); i++) {
    share = std::min(share, is_even_ ? circle_by_steps(points_[i]) : circle_for(i));
  }
  return share;
}

// Up to which it is no more than a caution.
double Judge::roll_for_row(int y) const {
  const double most = limit(Strain::kVertical) * kArcMinute;
  const size_t worst = most_converged(y);
  double least = 0.5 * pi;
  for (int x = 0; x < width_; x++) {
    if ((is_even_ && pixel(x, y) != worst) || !(points_[pixel(x, y)].vergence > 0.0f)) continue;
    const View view = view_of(x, y);
    const double half = place_at(x, y, view).half_parallax;
    if (worst_vertical_disparity(half, view.elevation, {reach_.gaze, least}) <= most) continue;
    least = roll_for_disparity(half, view.elevation, reach_.gaze, most);
  }
  return least;
}

// Strains go nearly as one over the distance.
StrainedPlace Judge::describe(size_t pixel, double share) const {
  const Point& point = points_[pixel];
  const ViewDirection look = look_at(static_cast<int>(pixel) % width_, static_cast<int>(pixel) / width_);
  StrainedPlace place;
  place.strain = worst_of(point);
  place.value = double{point.strains[static_cast<size_t>(place.strain)]};
  place.level = point.level;
  place.azimuth = azimuth_of(look.direction) / kDegree;
  place.elevation = elevation_of(look) / kDegree;
  place.distance = double{point.distance};
  place.share = share;
  place.enough = place.distance * most_of(point);
  place.ipd = static_cast<float>(double{seen_.camera.ipd} * circle_for(pixel));
  return place;
}

// What strains and has no name is an area: numbered after the names.
std::vector<int> Judge::things_or_areas() const {
  AreaGrid grid{width_, height_, wraps_around(camera_.projection), {}, {}};
  const bool has_things = !seen_.things.empty();
  for (size_t i = 0; i < points_.size(); i++) {
    grid.is_in.push_back(points_[i].level != ComfortLevel::kOk && !(has_things && seen_.things[i] >= 0));
    grid.nearness.push_back(1.0f / points_[i].distance);
  }
  std::vector<int> areas = connected_areas(grid);
  for (size_t i = 0; i < areas.size(); i++) {
    if (areas[i] >= 0)
      areas[i] += static_cast<int>(seen_.names.size());
    else if (has_things)
      areas[i] = seen_.things[i];
  }
  return areas;
}

// Whether an area counts with a worse one beside it. Matched depth and bushes fall into many areas.
bool is_part_of(const StrainedPlace& place, const StrainedPlace& worse) {
  if (!place.name.empty() || !worse.name.empty() || place.strain != worse.strain) return false;
  const auto way = [](const StrainedPlace& each) {
    const double a = each.azimuth * kDegree, e = each.elevation * kDegree;
    return glm::dvec3(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a));
  };
  return glm::dot(way(place), way(worse)) > std::cos(kBeside);
}

void Judge::list_places(ComfortReport& report, double all) const {
  const std::vector<int> areas = things_or_areas();
  struct Thing {
    size_t worst = 0;
    double rank = 0.0, share = 0.0;
  };
  std::vector<Thing> things;
  for (size_t i = 0; i < points_.size(); i++) {
    if (points_[i].level == ComfortLevel::kOk || areas[i] < 0) continue;
    if (things.size() <= static_cast<size_t>(areas[i])) things.resize(static_cast<size_t>(areas[i]) + 1);
    Thing& thing = things[static_cast<size_t>(areas[i])];
    thing.share += double{points_[i].solid_angle};
    if (const double rank = rank_of(points_[i]); rank > thing.rank) thing.rank = rank, thing.worst = i;
  }
  std::vector<size_t> order;
  for (size_t i = 0; i < things.size(); i++) {
    if (things[i].rank > 0.0) order.push_back(i);
  }
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return things[a].rank > things[b].rank; });
  for (const size_t i : order) {
    StrainedPlace place = describe(things[i].worst, things[i].share / all);
    if (i < seen_.names.size()) place.name = seen_.names[i];
    const auto whole =
        std::ranges::find_if(report.places, [&](const StrainedPlace& worse) { return is_part_of(place, worse); });
    if (whole != report.places.end())
      whole->share += place.share;
    else if (report.places.size() < kMostPlaces)
      report.places.push_back(std::move(place));
  }
}

ComfortReport Judge::report() {
  points_.resize(seen_.depth.pixels.size());
  tbb::parallel_for(0, height_, [&](int y) { judge_row(y); });
  std::vector<double> circles(static_cast<size_t>(height_), 1.0), rolls(circles.size(), 0.5 * pi);
  tbb::parallel_for(0, height_, [&](int y) {
    if (options_.rules == ComfortRules::kStrain) add_steps(y), add_edges(y);
    for (int x = 0; x < width_; x++) {
      rate(points_[pixel(x, y)]);
    }
    circles[static_cast<size_t>(y)] = circle_for_row(y);
    if (options_.rules == ComfortRules::kStrain) rolls[static_cast<size_t>(y)] = roll_for_row(y);
  });
  ComfortReport report;
  report.level = Image(width_, height_, 1);
  report.nearest = kFar;
  double all = 0.0, looked = 0.0;
  size_t unknown = 0;
  for (int y = 0; y < height_; y++) {
    for (int x = 0; x < width_; x++) {
      const Point& point = points_[pixel(x, y)];
      const auto level = static_cast<size_t>(point.level);
      unknown += !(*seen_.depth.at(x, y) > 0.0f);
      const double solid = double{point.solid_angle}, gazed = solid * point.looked;
      all += solid, looked += gazed;
      report.share[level] += solid, report.looked[level] += gazed;
      report.nearest = std::min(report.nearest, double{point.distance});
      *report.level.at(x, y) = static_cast<float>(point.level);
      for (size_t k = 0; k < limits_.size(); k++) report.most[k] = std::max(report.most[k], double{point.strains[k]});
    }
  }
  if (unknown == points_.size()) throw Error(ErrorKind::kInput, "no pixel has a depth above 0");
  for (double& share : report.share) share /= std::max(all, 1e-12);
  for (double& share : report.looked) share /= std::max(looked, 1e-12);
  report.unknown = static_cast<double>(unknown) / static_cast<double>(points_.size());
  report.largest_ipd = seen_.camera.ipd * static_cast<float>(*std::ranges::min_element(circles));
  report.head_roll = *std::ranges::min_element(rolls) / kDegree;
  list_places(report, std::max(all, 1e-12));
  return report;
}

}  // namespace

ComfortReport judge_comfort(const SeenDepth& seen, const ComfortOptions& options) {
  assert(seen.depth.channels == 1 && (seen.things.empty() || seen.things.size() == seen.depth.pixels.size()));
  return Judge(seen, options).report();
}

PointComfort judge_point(const StereoCamera& setting, int eye, vec2 uv, float depth, const Viewer& viewer) {
  const Camera camera = make_camera(setting);
  const ViewDirection look = look_of(camera.projection, uv, uv);
  const JudgedPlace place = place_of(camera, eye, uv, look, depth);
  const double elevation = elevation_of(look);
  PointComfort point{ComfortLevel::kOk, place.distance};
  point.near = vergence_dioptres(vergence(place.half_parallax, elevation), viewer);
  point.vertical = worst_vertical_disparity(place.half_parallax, elevation, reach_of(viewer)) / kArcMinute;
  point.level = std::max(level_of(point.near, strain_limits(Strain::kNear, viewer)),
                         level_of(point.vertical, strain_limits(Strain::kVertical, viewer)));
  return point;
}

ComfortLevel worst_level(const ComfortReport& report) {
  ComfortLevel worst = ComfortLevel::kOk;
  for (const ComfortLevel level : kComfortLevels) {
    if (report.share[static_cast<size_t>(level)] > 0.0) worst = level;
  }
  return worst;
}

double azimuth_of(vec3 direction) {
  return std::atan2(double{direction.x}, -double{direction.z});
}

std::string direction_text(double azimuth, double elevation) {
  const auto degrees = [](long count) { return fmt::format("{} degree{}", count, count == 1 ? "" : "s"); };
  const long around = std::lround(std::abs(azimuth)), above = std::lround(std::abs(elevation));
  const bool is_side = around != 0 && around != 180;
  std::string text = is_side       ? degrees(around) + (azimuth < 0.0 ? " left" : " right")
                     : around == 0 ? "ahead"
                                   : "behind";
  if (above == 0) return text;
  return text + ", " + (is_side ? std::to_string(above) : degrees(above)) + (elevation < 0.0 ? " down" : " up");
}

}  // namespace ods
