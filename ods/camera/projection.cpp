// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/projection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "ods/base/names.h"
#include "ods/camera/camera_fields.h"

namespace ods {

static ProjectionSetting of_kind(int kind) {
  ProjectionSetting setting;
  setting.kind = kind;
  return setting;
}

static ProjectionSetting part(int kind, vec2 longitude, vec2 latitude) {
  ProjectionSetting setting = of_kind(kind);
  setting.longitude = longitude;
  setting.latitude = latitude;
  return setting;
}

static ProjectionSetting lens(int kind, float fov, float tilt) {
  ProjectionSetting setting = of_kind(kind);
  setting.fov = fov;
  setting.tilt = tilt;
  return setting;
}

std::span<const NamedProjection> named_projections() {
  static const NamedProjection kAll[] = {
      {"lat-long", "the whole sphere, or a part of it", of_kind(kLatLong), 0.0},
      {"vr180", "the front half of it", part(kLatLong, {-90.0f, 90.0f}, {-90.0f, 90.0f}), -0.5},
      {"cylinder", "all around, 60 degrees up and down", part(kCylinder, {-180.0f, 180.0f}, {-60.0f, 60.0f}), -1.0},
      {"fisheye", "equidistant, 180 degrees", lens(kFisheye, 180.0f, 0.0f), -0.5},
      {"fisheye-equisolid", "equal areas, 180 degrees", lens(kFisheyeEquisolid, 180.0f, 0.0f), -1.7},
      {"fisheye-stereographic", "keeps shapes, 180 degrees; looking down, a little planet",
       lens(kFisheyeStereographic, 180.0f, 0.0f), -2.5},
      {"fisheye-polynomial", "a measured lens, as Cycles describes it", of_kind(kFisheyePolynomial), -4.0},
      // An orthographic camera sees the point of the ball that reflects its ray by 2 b at the radius sin(b).
      {"mirror-ball", "a mirrored sphere seen from far away: all directions", lens(kFisheyeEquisolid, 360.0f, 0.0f),
       -1.5},
      {"dome", "a fisheye that looks up", lens(kFisheye, 180.0f, 90.0f), -1.5},
      {"perspective", "a flat window", lens(kPerspective, 90.0f, 0.0f), -1.5},
      {"cube-3x2", "six faces as the VR camera for Arnold packs them", of_kind(kCube3x2), -1.0},
      {"cube-6x1", "six faces in a row; two eyes side by side make a 12x1", of_kind(kCube6x1), -1.0},
      {"cube-1x6", "six faces in a column; two stacked eyes make a 1x12", of_kind(kCube1x6), -1.0},
      {"eac", "equi-angular cube, 3x2", of_kind(kEac), -1.0},
      {"eac-face", "one face of it", of_kind(kEacFace), -3.0},
  };
  return kAll;
}

const NamedProjection* find_projection(std::string_view name) {
  for (const NamedProjection& named : named_projections()) {
    if (named.name == name) return &named;
  }
  return nullptr;
}

static bool same_numbers(const ProjectionSetting& a, const ProjectionSetting& b) {
  return a.longitude == b.longitude && a.latitude == b.latitude && a.fov == b.fov && a.pan == b.pan &&
         a.tilt == b.tilt && a.sensor == b.sensor && a.polynomial == b.polynomial;
}

std::string_view projection_name(const ProjectionSetting& setting) {
  std::string_view first;
  for (const NamedProjection& named : named_projections()) {
    if (named.setting.kind != setting.kind) continue;
    if (same_numbers(named.setting, setting)) return named.name;
    if (first.empty()) first = named.name;
  }
  return first;
}

bool is_full_lat_long(const ProjectionSetting& setting) {
  return setting.kind == kLatLong && same_numbers(setting, of_kind(kLatLong));
}

bool is_vr180(const ProjectionSetting& setting) {
  static const ProjectionSetting kVr180 = find_projection("vr180")->setting;
  return setting.kind == kVr180.kind && same_numbers(setting, kVr180);
}

constexpr float kMinRange = 0.01f;  // degrees

static std::string range_fault(const ProjectionSetting& setting) {
  const float limit = setting.kind == kLatLong ? range_of(CameraField::kLatitude).maximum : 89.0f;
  const FieldRange angles = range_of(CameraField::kLongitude);
  const float turn = setting.longitude.y - setting.longitude.x;
  if (!angles.contains(setting.longitude.x) || !angles.contains(setting.longitude.y)) {
    return "longitudes are within 36000 degrees";
  }
  if (!(turn > 0.0f && turn <= 360.0f)) return "longitudes run from left to right over at most 360 degrees";
  if (!(setting.latitude.x >= -limit && setting.latitude.x < setting.latitude.y && setting.latitude.y <= limit)) {
    return setting.kind == kLatLong ? "latitudes run from bottom to top within -90 and 90 degrees"
                                    : "a cylinder's latitudes run from bottom to top within -89 and 89 degrees";
  }
  if (turn < kMinRange || setting.latitude.y - setting.latitude.x < kMinRange) {
    return "a part of the sphere is at least 0.01 degrees wide and high";
  }
  return {};
}

// The negated polynomial, in radians, and its derivative per millimetre.
static double polynomial_angle(const std::array<float, 5>& k, double r) {
  return -(double{k[0]} + r * (double{k[1]} + r * (double{k[2]} + r * (double{k[3]} + r * double{k[4]}))));
}

static double polynomial_slope(const std::array<float, 5>& k, double r) {
  return -(double{k[1]} + r * (2.0 * double{k[2]} + r * (3.0 * double{k[3]} + r * 4.0 * double{k[4]})));
}

// Steps from the axis to the corner, in the search for the radius where a polynomial reaches an angle.
constexpr int kPolynomialSteps = 4096;

// The radius of the image circle, millimetres: where the angle first reaches half the field of view,
// at most the corner.
static double polynomial_edge(const ProjectionSetting& setting) {
  const double corner = std::hypot(double{setting.sensor.x}, double{setting.sensor.y}) / 2.0;
  const double half = glm::radians(double{setting.fov}) / 2.0;
  const auto is_beyond = [&](double r) { return polynomial_angle(setting.polynomial, r) > half; };
  int step = 1;
  while (step <= kPolynomialSteps && !is_beyond(corner * step / kPolynomialSteps)) step++;
  if (step > kPolynomialSteps) return corner;
  double low = corner * (step - 1) / kPolynomialSteps, high = corner * step / kPolynomialSteps;
  for (int i = 0; i < 60; i++) {
    const double middle = (low + high) / 2.0;
    (is_beyond(middle) ? high : low) = middle;
  }
  return low;
}

static std::string polynomial_fault(const ProjectionSetting& setting) {
  for (const float side : {setting.sensor.x, setting.sensor.y}) {
    if (!range_of(CameraField::kSensor).contains(side)) return "a sensor's sides are 0.1 to 1000 millimetres";
  }
  for (const float k : setting.polynomial) {
    if (!range_of(CameraField::kPolynomial).contains(k)) return "a lens polynomial's numbers are within 10";
  }
  if (!(std::abs(setting.polynomial[0]) <= 0.01f)) return "a lens polynomial's K0 is within 0.01 radians of the axis";
  const double corner = std::hypot(double{setting.sensor.x}, double{setting.sensor.y}) / 2.0;
  const double half = glm::radians(double{setting.fov}) / 2.0;
  for (int i = 0; i <= kPolynomialSteps; i++) {
    const double r = corner * i / kPolynomialSteps;
    if (!(polynomial_slope(setting.polynomial, r) > 1e-6)) {
      return fmt::format("a lens polynomial's angle grows with the radius, and this one turns back at {:.4g} mm", r);
    }
    if (polynomial_angle(setting.polynomial, r) > half) break;
  }
  return {};
}

constexpr float kWidestStereographic = 350.0f;  // degrees

static std::string lens_fault(const ProjectionSetting& setting) {
  const FieldRange fov = range_of(CameraField::kFov);
  if (has_image_circle(setting.kind) && !(setting.fov >= 1.0f && setting.fov <= fov.maximum)) {
    return "a fisheye sees 1 to 360 degrees";
  }
  if (setting.kind == kFisheyeStereographic && !(setting.fov <= kWidestStereographic)) {
    return fmt::format("a stereographic fisheye sees 1 to {:g} degrees: straight behind it is infinitely far out",
                       kWidestStereographic);
  }
  if (setting.kind == kFisheyePolynomial) {
    const std::string fault = polynomial_fault(setting);
    if (!fault.empty()) return fault;
  }
  if (setting.kind == kPerspective) {
    if (!(setting.fov >= fov.minimum && setting.fov <= 170.0f)) return "a flat window shows 0.001 to 170 degrees";
    if (!range_of(CameraField::kAspect).contains(setting.aspect)) {
      return "a window's sides differ by at most 32768 to 1";
    }
  }
  const bool points =
      range_of(CameraField::kPan).contains(setting.pan) && range_of(CameraField::kTilt).contains(setting.tilt);
  return points ? "" : "a lens points to within 36000 degrees";
}

std::string projection_fault(const ProjectionSetting& setting) {
  if (has_range(setting.kind)) return range_fault(setting);
  return has_lens(setting.kind) ? lens_fault(setting) : "";
}

// --- the kinds -------------------------------------------------------------------------------------------------------

namespace {

double tangent(float degrees) {
  return std::tan(glm::radians(static_cast<double>(degrees)));
}

double turn_of(const ProjectionSetting& setting) {
  return glm::radians(static_cast<double>(setting.longitude.y - setting.longitude.x));
}

double fov_of(const ProjectionSetting& setting) {
  return glm::radians(static_cast<double>(setting.fov));
}

using Setting = const ProjectionSetting&;

// One row per kind of ods/kernel/camera/projection.h.
struct KindRow {
  int member;
  std::string_view name;                               // name of the kind, for messages
  double (*aspect)(Setting);                           // width over height of a picture in its true shape
  double (*pixels_per_radian)(Setting, double width);  // horizontally, at the centre
};

double square(Setting) {
  return 1.0;
}

double turn_pixels(Setting setting, double width) {
  return width / turn_of(setting);
}

double face_pixels(Setting setting, double width) {
  return width / cube_columns(setting.kind) / 2.0;
}

double lat_long_aspect(Setting setting) {
  return turn_of(setting) / glm::radians(static_cast<double>(setting.latitude.y - setting.latitude.x));
}

double cylinder_aspect(Setting setting) {
  return turn_of(setting) / (tangent(setting.latitude.y) - tangent(setting.latitude.x));
}

constexpr KindRow kKinds[] = {
    {kLatLong, "lat-long", lat_long_aspect, turn_pixels},
    {kCylinder, "cylinder", cylinder_aspect, turn_pixels},
    {kFisheye, "fisheye", square, [](Setting s, double width) { return width / fov_of(s); }},
    {kFisheyeEquisolid, "fisheye-equisolid", square,
     [](Setting s, double width) { return width / (4.0 * std::sin(fov_of(s) / 4.0)); }},
    {kFisheyeStereographic, "fisheye-stereographic", square,
     [](Setting s, double width) { return width / (4.0 * std::tan(fov_of(s) / 4.0)); }},
    {kPerspective, "perspective", [](Setting s) { return static_cast<double>(s.aspect); },
     [](Setting s, double width) { return width / (2.0 * std::tan(fov_of(s) / 2.0)); }},
    {kCube3x2, "cube-3x2", [](Setting) { return 1.5; }, face_pixels},
    {kCube6x1, "cube-6x1", [](Setting) { return 6.0; }, face_pixels},
    {kCube1x6, "cube-1x6", [](Setting) { return 1.0 / 6.0; }, face_pixels},
    {kEac, "eac", [](Setting) { return 1.5; },
     [](Setting, double width) { return width / 3.0 * (2.0 / static_cast<double>(kPi)); }},
    {kEacFace, "eac-face", square, [](Setting, double width) { return width * (2.0 / static_cast<double>(kPi)); }},
    {kFisheyePolynomial, "fisheye-polynomial",
     [](Setting s) { return static_cast<double>(s.sensor.x) / static_cast<double>(s.sensor.y); },
     [](Setting s, double width) {
       return width / (static_cast<double>(s.sensor.x) * polynomial_slope(s.polynomial, 0.0));
     }},
};
static_assert(has_each_of(kKinds, kProjectionCount), "a new projection needs its row");

}  // namespace

int natural_height(const ProjectionSetting& setting, int width) {
  return std::max(1, static_cast<int>(std::lround(width / row_in(kKinds, setting.kind).aspect(setting))));
}

double pixels_per_radian(const ProjectionSetting& setting, double width) {
  return row_in(kKinds, setting.kind).pixels_per_radian(setting, width);
}

std::string kinds_with(bool (*trait)(int kind)) {
  std::vector<std::string_view> names;
  for (const KindRow& row : kKinds) {
    if (trait(row.member)) names.push_back(row.name);
  }
  const std::string last = names.size() > 1 ? fmt::format(" and {}", names.back()) : "";
  if (!last.empty()) names.pop_back();
  return fmt::format("{}{}", fmt::join(names, ", "), last);
}

int width_step(const ProjectionSetting& setting) {
  return is_cube(setting.kind) ? cube_columns(setting.kind) : 1;
}

// Columns of Ry(-yaw) * Rx(pitch) * Rz(-roll).
std::array<glm::dvec3, 3> orientation(double yaw, double pitch, double roll) {
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  const double cr = std::cos(roll), sr = std::sin(roll);
  const glm::dvec3 level_right(cy, 0.0, sy);
  const glm::dvec3 back(-sy * cp, -sp, cy * cp);
  const glm::dvec3 level_up = glm::cross(back, level_right);
  return {cr * level_right - sr * level_up, sr * level_right + cr * level_up, back};
}

Projection make_projection(const ProjectionSetting& setting) {
  assert(projection_fault(setting).empty());
  const auto radians = [](vec2 degrees) { return glm::dvec2(degrees) * (std::acos(-1.0) / 180.0); };
  const glm::dvec2 longitude = radians(setting.longitude);
  glm::dvec2 height = radians(setting.latitude);
  if (setting.kind == kCylinder) height = glm::tan(height);
  Projection projection;
  projection.kind = setting.kind;
  projection.center = vec2((longitude.x + longitude.y) / 2.0, (height.x + height.y) / 2.0);
  projection.span = vec2(longitude.y - longitude.x, height.y - height.x);
  projection.angle = glm::radians(setting.fov);
  projection.circle = vec2(1.0f);
  projection.sensor = setting.sensor;
  if (setting.kind == kFisheyePolynomial) {
    projection.circle = vec2(2.0 * polynomial_edge(setting) / glm::dvec2(setting.sensor));
  }
  const std::array<float, 5>& k = setting.polynomial;
  projection.k0 = k[0], projection.k1 = k[1], projection.k2 = k[2], projection.k3 = k[3], projection.k4 = k[4];
  const double half = setting.kind == kPerspective ? tangent(setting.fov / 2.0f) : 1.0;
  projection.half_size = vec2(half, half / static_cast<double>(setting.aspect));
  const auto [right, up, back] =
      orientation(glm::radians(static_cast<double>(setting.pan)), glm::radians(static_cast<double>(setting.tilt)), 0.0);
  projection.lens_right = vec3(right);
  projection.lens_up = vec3(up);
  projection.lens_back = vec3(back);
  return projection;
}

}  // namespace ods
