// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/export/camera_formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>

#include "ods/base/decimal.h"

namespace ods {
namespace {

using Vector = std::array<Formula, 3>;

double radians(float degrees) {
  return decimal(degrees) * std::numbers::pi / 180.0;
}

Formula squared(const Formula& a) {
  return a * a;
}

Vector combine(const std::array<glm::dvec3, 3>& columns, const Vector& v) {
  Vector result{0.0, 0.0, 0.0};
  for (int row = 0; row < 3; row++) {
    for (size_t i = 0; i < 3; i++) {
      const double share = std::round(columns[i][row] * 1e14) / 1e14;  // makes the sine of half a turn 0
      result[static_cast<size_t>(row)] = result[static_cast<size_t>(row)] + share * v[i];
    }
  }
  return result;
}

// The fraction of the circle that a merge leaves at t, before its exponent: the curves of ods/kernel/camera/merge.h.
struct MergeCurve {
  int mode;
  Formula (*left)(const Formula& t);
};
const MergeCurve kMergeCurves[] = {
    {kMergeLinear, [](const Formula& t) { return 1.0 - t; }},
    {kMergeCosine, [](const Formula& t) { return max(cos(std::numbers::pi / 2.0 * t), 0.0); }},
    {kMergeSmoothstep, [](const Formula& t) { return 1.0 - t * t * (3.0 - 2.0 * t); }},
    {kMergeSmootherstep, [](const Formula& t) { return 1.0 - t * t * t * (t * (6.0 * t - 15.0) + 10.0); }},
    {kMergeGaussian, [](const Formula& t) { return (exp(-(t * t)) - std::exp(-1.0)) / (1.0 - std::exp(-1.0)); }},
    {kMergeTiltBrush, [](const Formula& t) { return 1.0 - sin(t / (2.0 * std::numbers::pi)); }},
};
static_assert(std::size(kMergeCurves) == kMergeCount - 3, "a new merge needs its curve; none, power and map have none");

Formula merge_curve(int mode, const Formula& t) {
  const MergeCurve* curve = std::find_if(std::begin(kMergeCurves), std::end(kMergeCurves),
                                         [&](const MergeCurve& each) { return each.mode == mode; });
  assert(curve != std::end(kMergeCurves));
  return curve->left(t);
}

class Writer {
 public:
  Writer(const Sidecar& file, const FormulaView& view)
      : file_(file),
        camera_(file.camera),
        setting_(file.camera.projection),
        view_(view),
        level_(is_level()),
        has_axis_(camera_.axis && !level_) {}

  CameraFormula write() {
    write_eyes();
    write_angles();
    write_ray();
    return std::move(out_);
  }

 private:
  // A rotation about the vertical axis only needs no matrix.
  bool is_level() const {
    const bool level = camera_.pitch == 0.0f && camera_.roll == 0.0f;
    const bool upright = !camera_.axis || (level && *camera_.axis == vec3(0.0f, 1.0f, 0.0f));
    return upright && (level || view_.camera_frame);
  }

  Formula parameter(const std::string& name, float value, const std::string& meaning) {
    for (const NamedFormula& each : out_.parameters) {
      if (each.name == name) return named(Operation::kParameter, name);
    }
    out_.parameters.push_back({name, decimal(value), meaning});
    return named(Operation::kParameter, name);
  }

  // Numbers and names do not become separate steps.
  Formula step(const std::string& name, const Formula& value) {
    if (value->operands.empty()) return value;
    out_.steps.push_back({name, value, ""});
    return named(Operation::kStep, name);
  }

  // Selects the eye, and the position within its picture.
  void write_eyes() {
    eye_u_ = view_.u, eye_v_ = view_.v;
    if (file_.eyes.size() == 1 && file_.eyes[0] == kMono) return;
    const auto share = [&](const std::string& name, Formula& place, double first) {
      const Formula second_half = place - 0.5;
      side_ = step("side", select(second_half, first, -first));
      place = step(name, select(second_half, 2.0 * place, 2.0 * place - 1.0));
    };
    if (file_.eyes.size() == 2) {
      const EyeArrangement eyes = arrangement_of(file_.layout);
      const double first = eyes.right_first ? 1.0 : -1.0;
      switch (eyes.how) {
        case EyePacking::kStacked:
          return share("eye_v", eye_v_, first);
        case EyePacking::kBeside:
          return share("eye_u", eye_u_, first);
        case EyePacking::kRows:
        case EyePacking::kColumns:
        case EyePacking::kCheckerboard:
        case EyePacking::kMixed:
          assert(false);  // rejected by formula_fault()
          break;
        case EyePacking::kAlone:
          break;
      }
    }
    side_ = parameter("eye", file_.eyes[0] == kLeft ? -1.0f : 1.0f, "-1 is the left eye, 1 the right");
  }

  Formula turn_to_right() {
    if (view_.camera_frame || !level_ || camera_.yaw == 0.0f) return 0.0;
    const Formula yaw = parameter("yaw", camera_.yaw, "degrees to the right");
    return (camera_.mirrored ? -1.0 : 1.0) * (std::numbers::pi / 180.0) * yaw;
  }

  // theta and phi of the direction, relative to the viewing circle's axis.
  void write_angles() {
    const bool even = has_range(setting_.kind);
    Formula theta = 0.0, phi = 0.0;
    if (even) {
      const double left = radians(setting_.longitude.x), right = radians(setting_.longitude.y);
      theta = left + (right - left) * eye_u_;
      double bottom = radians(setting_.latitude.x), top = radians(setting_.latitude.y);
      const bool cylinder = setting_.kind == kCylinder;
      if (cylinder) bottom = std::tan(bottom), top = std::tan(top);
      phi = top + (bottom - top) * eye_v_;
      if (cylinder) phi = atan2(step("slope", phi), 1.0);
    }
    if (!even || has_axis_) {
      Vector d{0.0, 0.0, 0.0};
      if (even) {
        const Formula heading = step("heading", theta), elevation = step("elevation", phi);
        d = {sin(heading) * cos(elevation), sin(elevation), -(cos(heading) * cos(elevation))};
      } else {
        d = lens_direction();
      }
      const char* names[] = {"look_x", "look_y", "look_z"};
      for (size_t i = 0; i < 3; i++) d[i] = step(names[i], d[i]);
      if (has_axis_) d = about_axis(d);
      theta = atan2(d[0], -d[2]);
      phi = atan2(d[1], sqrt(squared(d[0]) + squared(d[2])));
    }
    theta = theta + turn_to_right();
    if (camera_.convergence == kShift && !is_number(side_, 0.0)) {
      theta = theta - side_ * asin(min(ipd() / (2.0 * distance()), 1.0));
    }
    theta_ = step("theta", theta);
    phi_ = step("phi", phi);
  }

  Formula ipd() { return parameter("ipd", camera_.ipd, "distance between the eyes"); }
  Formula distance() {
    return parameter("convergence_distance", camera_.convergence_distance, "of the point without parallax");
  }

  // A direction of any length, in the camera's frame.
  Vector lens_direction() {
    static_assert(kProjectionCount == 12, "a new projection needs its formula here");
    const std::array<glm::dvec3, 3> columns = orientation(radians(setting_.pan), radians(setting_.tilt), 0.0);
    const Formula x = 2.0 * eye_u_ - 1.0, y = 1.0 - 2.0 * eye_v_;
    if (setting_.kind == kPerspective) {
      const double half = std::tan(radians(setting_.fov) / 2.0);
      return combine(columns, {half * x, half / decimal(setting_.aspect) * y, -1.0});
    }
    if (is_cube(setting_.kind)) return cube_direction();
    if (setting_.kind == kEacFace)
      return combine(columns, {tan(std::numbers::pi / 4.0 * x), tan(std::numbers::pi / 4.0 * y), -1.0});
    if (setting_.kind == kFisheyePolynomial) return polynomial_direction(columns);
    const Formula px = step("lens_x", x), py = step("lens_y", y);
    const Formula radius = step("off_axis", sqrt(squared(px) + squared(py)));
    const Formula full = radians(1.0f) * parameter("fov", setting_.fov, "of the fisheye, degrees");
    const Formula angle = step("from_axis", fisheye_angle(full, radius));
    const Formula outwards = step("outwards", sin(angle) / max(radius, 1e-9));
    seen_ = step("seen", select(1.0 - radius, 0.0, 1.0));
    return combine(columns, {px * outwards, py * outwards, -cos(angle)});
  }

  Formula fisheye_angle(const Formula& full, const Formula& radius) const {
    if (setting_.kind == kFisheyeEquisolid) return 2.0 * asin(min(sin(full / 4.0) * radius, 1.0));
    if (setting_.kind == kFisheyeStereographic) return 2.0 * atan2(tan(full / 4.0) * radius, 1.0);
    assert(setting_.kind == kFisheye);
    return full * radius / 2.0;
  }

  // Positions on the sensor are in millimetres.
  Vector polynomial_direction(const std::array<glm::dvec3, 3>& columns) {
    const Formula width = parameter("sensor_width", setting_.sensor.x, "millimetres");
    const Formula height = parameter("sensor_height", setting_.sensor.y, "millimetres");
    const Formula px = step("lens_x", width * (eye_u_ - 0.5)), py = step("lens_y", height * (0.5 - eye_v_));
    const Formula radius = step("off_axis", sqrt(squared(px) + squared(py)));
    std::vector<Formula> k;
    for (const float each : setting_.polynomial) {
      k.push_back(parameter(fmt::format("k{}", k.size()), each, "of the lens polynomial"));
    }
    Formula polynomial = 0.0;
    for (size_t i = k.size(); i-- > 0;) polynomial = k[i] + radius * polynomial;
    const Formula angle = step("from_axis", max(-polynomial, 0.0));
    const Formula outwards = step("outwards", sin(angle) / max(radius, 1e-9));
    const Formula full = radians(1.0f) * parameter("fov", setting_.fov, "of the fisheye, degrees");
    seen_ = step("seen", select(full / 2.0 - angle, 0.0, 1.0));
    return combine(columns, {px * outwards, py * outwards, -cos(angle)});
  }

  // The cell determines the face; s and t run from -1 to 1 across it.
  Vector cube_direction() {
    const int columns = cube_columns(setting_.kind), rows = 6 / columns;
    const auto cell_of = [&](const Formula& place, int count) {
      return min(max(floor(double(count) * place), 0.0), count - 1.0);
    };
    const Formula column = columns == 1 ? Formula(0.0) : step("column", cell_of(eye_u_, columns));
    const Formula row = rows == 1 ? Formula(0.0) : step("row", cell_of(eye_v_, rows));
    Formula s = 2.0 * (double(columns) * eye_u_ - column) - 1.0;
    Formula t = 1.0 - 2.0 * (double(rows) * eye_v_ - row);
    if (setting_.kind == kEac) s = tan(std::numbers::pi / 4.0 * s), t = tan(std::numbers::pi / 4.0 * t);
    s = step("face_s", s), t = step("face_t", t);
    Vector d{0.0, 0.0, 0.0};
    for (int axis = 0; axis < 3; axis++) {
      Formula by_row = 0.0;
      for (int r = rows - 1; r >= 0; r--) {
        Formula by_column = 0.0;
        for (int c = columns - 1; c >= 0; c--) {
          const CubeFace face = cube_cell(setting_.kind, r * columns + c);
          const Formula part = double(face.middle[axis]) + double(face.right[axis]) * s + double(face.top[axis]) * t;
          by_column = c == columns - 1 ? part : select(column - (c + 0.5), part, by_column);
        }
        by_row = r == rows - 1 ? by_column : select(row - (r + 0.5), by_column, by_row);
      }
      d[static_cast<size_t>(axis)] = by_row;
    }
    return d;
  }

  // The camera's frame in the world: right, up and back.
  std::array<glm::dvec3, 3> frame() const {
    std::array<glm::dvec3, 3> columns =
        orientation(radians(camera_.yaw), radians(camera_.pitch), radians(camera_.roll));
    if (camera_.mirrored) columns[2] = -columns[2];
    return columns;
  }

  // A frame, relative to the camera's, whose up is the viewing circle's axis; right and back are as close to the
  // camera's as possible.
  std::array<glm::dvec3, 3> circle() const {
    if (!camera_.axis) return {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    const std::array<glm::dvec3, 3> camera = frame();
    const glm::dvec3 axis = glm::normalize(glm::dvec3(*camera_.axis));
    const glm::dvec3 up(glm::dot(axis, camera[0]), glm::dot(axis, camera[1]), glm::dot(axis, camera[2]));
    const glm::dvec3 near_back = std::abs(up.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, up.z < 0.0 ? 1 : -1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, near_back));
    return {right, up, glm::cross(right, up)};
  }

  Vector about_axis(const Vector& d) {
    const std::array<glm::dvec3, 3> to = circle();
    const std::array<glm::dvec3, 3> columns{glm::dvec3(to[0].x, to[1].x, to[2].x),
                                            glm::dvec3(to[0].y, to[1].y, to[2].y),
                                            glm::dvec3(to[0].z, to[1].z, to[2].z)};
    Vector turned = combine(columns, d);
    const char* names[] = {"turned_x", "turned_y", "turned_z"};
    for (size_t i = 0; i < 3; i++) turned[i] = step(names[i], turned[i]);
    return turned;
  }

  // The fraction that a merge leaves, by the elevation from the horizon.
  Formula merge_of_pole(const PoleMergeSetting& merge, const std::string& pole) {
    if (merge.mode == kMergeNone) return 1.0;
    if (merge.mode == kMergeCosine && merge.start == 0.0f && merge.end == 90.0f) {
      const std::string name = pole + "cosine_exponent";
      return pow(abs(cos(phi_)),
                 parameter(name, merge.exponent, "power of the merge, which is the elevation's cosine"));
    }
    const Formula start = parameter(pole + "merge_start", merge.start, "elevation, degrees");
    const Formula end = parameter(pole + "merge_end", merge.end, "elevation, degrees");
    const Formula elevation = 180.0 / std::numbers::pi * abs(phi_);
    const Formula t = step(pole + "merge_t", min(max((elevation - start) / (end - start), 0.0), 1.0));
    if (merge.mode == kMergePower) return 1.0 - pow(t, merge_exponent(merge, pole));
    const Formula left = merge_curve(merge.mode, t);
    return merge.exponent == 1.0f ? left : pow(max(left, 0.0), merge_exponent(merge, pole));
  }

  Formula merge_exponent(const PoleMergeSetting& merge, const std::string& pole) {
    return parameter(pole + "merge_exponent", merge.exponent, "power of the merge");
  }

  Formula merge() {
    const PoleMergeSetting &top = camera_.top, &bottom = camera_.bottom;
    if (same_merge(top, bottom)) return step("merge", merge_of_pole(top, ""));
    const Formula above = merge_of_pole(top, "top_");
    return step("merge", select(phi_, merge_of_pole(bottom, "bottom_"), above));
  }

  // From the viewing circle's frame, where x is right, y the axis and z back, to the world.
  Vector into_world(const Vector& v) {
    Vector result = v;
    if (has_axis_) result = combine(circle(), result);
    const bool by_matrix = !level_ && !view_.camera_frame;
    if (by_matrix) result = combine(frame(), result);
    const bool turned = view_.left_handed != (camera_.mirrored && !by_matrix);
    if (view_.left_handed && !by_matrix && !view_.camera_frame) {
      result[2] = parameter("handedness", turned ? -1.0f : 1.0f, "-1: z points ahead, 1: mirrored") * result[2];
    } else {
      result[2] = (turned ? -1.0 : 1.0) * result[2];
    }
    return result;
  }

  void write_ray() {
    const bool stereo = !is_number(side_, 0.0) && camera_.ipd > 0.0f;
    const Formula left = stereo || camera_.neck != 0.0f ? merge() : Formula(1.0);
    const Formula radius = stereo ? step("radius", side_ * ipd() * left / 2.0) : Formula(0.0);
    const Formula ahead =
        camera_.neck == 0.0f ? Formula(0.0) : parameter("neck", camera_.neck, "the eyes stand before it") * left;
    const Formula sine = sin(theta_), cosine = cos(theta_);
    Vector origin{radius * cosine + ahead * sine, 0.0, radius * sine - ahead * cosine};
    Vector d{sine * cos(phi_), sin(phi_), -(cosine * cos(phi_))};
    if (camera_.convergence == kToeIn && stereo) {
      const Formula far = distance();
      const Formula size = step("size", sqrt(squared(far) + squared(radius)));
      d = {(far * d[0] - radius * cosine) / size, far * d[1] / size, (far * d[2] - radius * sine) / size};
    }
    if (!level_) {
      const char* names[] = {"ray_x", "ray_y", "ray_z"};
      for (size_t i = 0; i < 3; i++) d[i] = step(names[i], d[i]);
      origin[0] = step("eye_across", origin[0]), origin[2] = step("eye_back", origin[2]);
    }
    d = into_world(d);
    for (Formula& part : d) part = seen_ * part;
    out_.direction = d;
    out_.location = into_world(origin);
    if (view_.camera_frame) return;
    const vec3 place = camera_.position * vec3(1.0f, 1.0f, view_.left_handed ? -1.0f : 1.0f);
    const char* names[] = {"location_x", "location_y", "location_z"};
    for (int i = 0; i < 3; i++) {
      Formula& part = out_.location[static_cast<size_t>(i)];
      part = parameter(names[i], place[i] == 0.0f ? 0.0f : place[i], "") + part;
    }
  }

  const Sidecar& file_;
  const StereoCamera& camera_;
  const ProjectionSetting& setting_;
  const FormulaView& view_;
  const bool level_;
  const bool has_axis_;
  CameraFormula out_;
  Formula side_ = 0.0;
  Formula eye_u_ = 0.0;
  Formula eye_v_ = 0.0;
  Formula theta_ = 0.0;
  Formula phi_ = 0.0;
  Formula seen_ = 1.0;
};

}  // namespace

std::string formula_fault(const Sidecar& file) {
  const StereoCamera& stereo = file.camera;
  if (stereo.top.mode == kMergeMap || stereo.bottom.mode == kMergeMap) return "a merge map is not a formula";
  if (stereo.head_tilt_map) return "a head-tilt map is not a formula";
  const EyeArrangement eyes = arrangement_of(file.layout);
  if (file.eyes.size() == 2 && !eyes.is_halves() && eyes.how != EyePacking::kAlone) {
    return fmt::format("{} mixes the eyes in a way that is not a function of the image position; export top-bottom",
                       layout_name(file.layout));
  }
  return {};
}

CameraFormula camera_formula(const Sidecar& file, const FormulaView& view) {
  assert(formula_fault(file).empty());
  return Writer(file, view).write();
}

}  // namespace ods
