// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/comfort/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "ods/base/angles.h"
#include "ods/base/error.h"
#include "ods/camera/pixel.h"
#include "ods/comfort/areas.h"
#include "ods/kernel/counterpart.h"

namespace ods {

namespace {

constexpr size_t kMaxPlaces = 10;
constexpr double kBeside = 20.0 * kDegree;

using Limits = EnumArray<Strain, StrainLimits>;

// A named thing, or an area of one eye, that is not ok everywhere.
struct Thing {
  std::pair<ComfortLevel, double> rank{ComfortLevel::kOk, 0.0};  // of the worst point: its level, then worst_strain()
  ComfortPoint worst;
  size_t eye = 0, pixel = 0;  // of the worst point
  double solid_angle = 0.0;
};

// The number of each pixel's thing: an index in `names`, or, for unnamed pixels that strain, an area from first_area
// on; negative: none.
std::vector<int> things_or_areas(const SeenDepth& seen, const std::vector<ComfortPoint>& points, size_t first_area) {
  const bool wraps = wraps_around(make_camera(seen.camera).projection), has_things = !seen.things.empty();
  AreaGrid grid{seen.depth.width, seen.depth.height, wraps, {}, {}};
  for (size_t i = 0; i < points.size(); i++) {
    grid.is_in.push_back(points[i].level != ComfortLevel::kOk && !(has_things && seen.things[i] >= 0));
    grid.nearness.push_back(1.0f / points[i].distance);
  }
  std::vector<int> areas = connected_areas(grid);
  for (size_t i = 0; i < areas.size(); i++) {
    if (areas[i] >= 0) {
      areas[i] += static_cast<int>(first_area);
    } else if (has_things) {
      areas[i] = seen.things[i];
    }
  }
  return areas;
}

void add_things(std::vector<Thing>& things, const SeenDepth& seen, size_t eye, const std::vector<ComfortPoint>& points,
                const Limits& limits) {
  const std::vector<int> numbers = things_or_areas(seen, points, things.size());
  for (size_t i = 0; i < points.size(); i++) {
    if (points[i].level == ComfortLevel::kOk || numbers[i] < 0) continue;
    const auto number = static_cast<size_t>(numbers[i]);
    if (things.size() <= number) things.resize(number + 1);
    Thing& thing = things[number];
    thing.solid_angle += double{points[i].solid_angle};
    const std::pair rank{points[i].level, worst_strain(points[i], limits).ratio};
    if (rank > thing.rank) thing = {rank, points[i], eye, i, thing.solid_angle};
  }
}

StrainedPlace describe(const Thing& thing, const SeenDepth& seen, const Limits& limits) {
  const Camera camera = make_camera(seen.camera);
  const int pixel = static_cast<int>(thing.pixel), width = seen.depth.width;
  const vec2 uv = pixel_middle(pixel % width, pixel / width, seen.depth);
  const vec3 direction = look_of(camera.projection, uv, uv).direction;
  StrainedPlace place;
  place.strain = worst_strain(thing.worst, limits).strain;
  place.value = double{thing.worst.strains[place.strain]};
  place.level = thing.worst.level;
  place.eye = thing.eye;
  place.azimuth = azimuth_of(direction) / kDegree;
  place.elevation = elevation_of(direction) / kDegree;
  place.distance = double{thing.worst.distance};
  return place;
}

// Returns whether an area counts with a worse one beside it. Matched depth and bushes fall into many areas, and both
// eyes see the same area.
bool is_part_of(const StrainedPlace& place, const StrainedPlace& worse) {
  if (!place.name.empty() || !worse.name.empty() || place.strain != worse.strain) return false;
  const auto way = [](const StrainedPlace& each) {
    const double a = each.azimuth * kDegree, e = each.elevation * kDegree;
    return glm::dvec3(std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a));
  };
  return glm::dot(way(place), way(worse)) > std::cos(kBeside);
}

std::vector<StrainedPlace> places_of(const std::vector<Thing>& things, std::span<const SeenDepth> eyes,
                                     const ComfortOptions& options, double all) {
  const Limits limits = strain_limits(options.viewer);
  std::vector<size_t> order;
  for (size_t i = 0; i < things.size(); i++) {
    if (things[i].rank.first != ComfortLevel::kOk) order.push_back(i);
  }
  std::ranges::stable_sort(order, [&](size_t a, size_t b) { return things[a].rank > things[b].rank; });
  std::vector<StrainedPlace> places;
  for (const size_t i : order) {
    const Thing& thing = things[i];
    const SeenDepth& seen = eyes[thing.eye];
    StrainedPlace place = describe(thing, seen, limits);
    place.share = thing.solid_angle / all;
    if (i < seen.names.size()) place.name = seen.names[i];
    const auto whole =
        std::ranges::find_if(places, [&](const StrainedPlace& worse) { return is_part_of(place, worse); });
    if (whole != places.end()) {
      whole->share += place.share;
    } else if (places.size() < kMaxPlaces) {
      const double circle = comfortable_circle(seen, options, thing.worst, thing.pixel);
      place.ipd = static_cast<float>(double{seen.camera.ipd} * circle);
      // A thing that is farther away by a factor is seen as from a circle that is smaller by it.
      place.enough = options.rules == ComfortRules::kStrain ? place.distance / circle
                                                            : place.distance * worst_strain(thing.worst, limits).ratio;
      places.push_back(std::move(place));
    }
  }
  return places;
}

// The sums of an eye are added to the verdict, as solid angles.
EyeComfort add_eye(ComfortVerdict& verdict, const SeenDepth& seen, const std::vector<ComfortPoint>& points) {
  EyeComfort eye{seen.eye, ComfortLevel::kOk, Image(seen.depth.width, seen.depth.height, 1)};
  for (size_t i = 0; i < points.size(); i++) {
    const ComfortPoint& point = points[i];
    eye.level = std::max(eye.level, point.level);
    eye.levels.pixels[i] = static_cast<float>(point.level);
    verdict.unknown += seen.depth.pixels[i] > 0.0f ? 0.0 : 1.0;
    verdict.share[point.level] += double{point.solid_angle};
    verdict.looked[point.level] += double{point.solid_angle} * point.looked;
    verdict.nearest = std::min(verdict.nearest, double{point.distance});
    for (const Strain strain : kStrains) {
      verdict.max[strain] = std::max(verdict.max[strain], double{point.strains[strain]});
    }
  }
  return eye;
}

// Makes shares of sums. Returns the sum.
double divide_by_sum(EnumArray<ComfortLevel, double>& shares) {
  double sum = 1e-12;
  for (const double share : shares) sum += share;
  for (double& share : shares) share /= sum;
  return sum;
}

}  // namespace

ComfortVerdict judge_comfort(std::span<const SeenDepth> eyes, const ComfortOptions& options,
                             const std::optional<MatchQuality>& match) {
  assert(!eyes.empty());
  const Limits limits = strain_limits(options.viewer);
  ComfortVerdict verdict;
  verdict.nearest = std::numeric_limits<double>::infinity();
  std::vector<Thing> things;
  for (const SeenDepth& seen : eyes) things.resize(std::max(things.size(), seen.names.size()));
  double circle = 1.0, roll = 90.0 * kDegree, pixels = 0.0;
  for (size_t i = 0; i < eyes.size(); i++) {
    const ComfortPoints measured = measure_points(eyes[i], options);
    verdict.per_eye.push_back(add_eye(verdict, eyes[i], measured.points));
    verdict.level = std::max(verdict.level, verdict.per_eye[i].level);
    add_things(things, eyes[i], i, measured.points, limits);
    circle = std::min(circle, measured.circle);
    roll = std::min(roll, measured.roll);
    pixels += static_cast<double>(measured.points.size());
  }
  if (verdict.unknown == pixels) throw Error(ErrorKind::kInput, "no pixel has a depth above 0");
  verdict.unknown /= pixels;
  divide_by_sum(verdict.looked);
  verdict.places = places_of(things, eyes, options, divide_by_sum(verdict.share));
  verdict.largest_ipd = eyes[0].camera.ipd * static_cast<float>(circle);
  verdict.head_roll = roll / kDegree;
  verdict.match = match;
  if (match) verdict.apart = level_of(match->apart, limits[Strain::kVertical]);
  verdict.level = std::max(verdict.level, verdict.apart);
  return verdict;
}

ComfortVerdict judge_comfort(const SeenDepth& eye, const ComfortOptions& options) {
  return judge_comfort(std::span(&eye, 1), options);
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

std::string remedy_by_distance(const StrainedPlace& place) {
  if (place.level < ComfortLevel::kWarning || !std::isfinite(place.enough)) return "";
  return fmt::format("move it at least {:.2f} m away", std::ceil(100.0 * place.enough) / 100.0);
}

std::string strain_line(const ComfortVerdict& verdict, ComfortLevel level) {
  const StrainedPlace* const worst = verdict.worst();
  if (!worst || worst->level < level) return "";
  const StrainRow& strain = strain_row(worst->strain);
  const std::string remedy = remedy_by_distance(*worst);
  return fmt::format("{}, {:.2f} m away, {}, strains the viewer's eyes: {}, {:.3g} {}{}",
                     worst->name.empty() ? "an area" : "'" + worst->name + "'", worst->distance,
                     direction_text(worst->azimuth, worst->elevation), strain.title, worst->value, strain.unit,
                     remedy.empty() ? "" : "; " + remedy);
}

}  // namespace ods
