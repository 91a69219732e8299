// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/camera_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace ods {
namespace {

using Numbers = std::vector<float*>;

constexpr FieldRange kAngle{-36000.0f, 36000.0f};
constexpr FieldRange kPlace{-1e6f, 1e6f};
constexpr FieldRange kElevation{0.0f, 90.0f};
constexpr FieldRange kExponent{1e-6f, 100.0f};
constexpr FieldRange kApart{0.0f, 1e4f};
constexpr FieldRange kOffset{-1e3f, 1e3f};
constexpr FieldRange kDistance{1e-3f, 1e6f};

// A member of the camera, of its projection or of one of its merges.
template <auto member>
Numbers own(StereoCamera& camera) {
  return {&(camera.*member)};
}
template <auto member>
Numbers lens(StereoCamera& camera) {
  return {&(camera.projection.*member)};
}
template <auto member>
Numbers pair(StereoCamera& camera) {
  return {&(camera.projection.*member).x, &(camera.projection.*member).y};
}
template <auto merge, auto member>
Numbers pole(StereoCamera& camera) {
  return {&(camera.*merge.*member)};
}
Numbers numbers_in(vec3& v) {
  return {&v.x, &v.y, &v.z};
}
Numbers position(StereoCamera& camera) {
  return numbers_in(camera.position);
}
Numbers axis(StereoCamera& camera) {
  return camera.axis ? numbers_in(*camera.axis) : Numbers();
}
bool has_polynomial(const StereoCamera& camera) {
  return camera.projection.kind == kFisheyePolynomial;
}
Numbers sensor(StereoCamera& camera) {
  return has_polynomial(camera) ? pair<&ProjectionSetting::sensor>(camera) : Numbers();
}
Numbers polynomial(StereoCamera& camera) {
  Numbers numbers;
  if (!has_polynomial(camera)) return numbers;
  for (float& k : camera.projection.polynomial) numbers.push_back(&k);
  return numbers;
}

bool always(const StereoCamera&) {
  return true;
}
bool is_part(const StereoCamera& camera) {
  return has_range(camera.projection.kind) && !is_full_lat_long(camera.projection);
}
bool with_fov(const StereoCamera& camera) {
  return has_fov(camera.projection.kind);
}
bool is_window(const StereoCamera& camera) {
  return camera.projection.kind == kPerspective;
}
bool with_lens(const StereoCamera& camera) {
  return has_lens(camera.projection.kind);
}
bool has_neck(const StereoCamera& camera) {
  return camera.neck != 0.0f;
}
template <auto merge>
bool merges(const StereoCamera& camera) {
  return (camera.*merge).mode != kMergeNone;
}
bool converges(const StereoCamera& camera) {
  return camera.convergence != kParallel;
}
bool has_axis(const StereoCamera& camera) {
  return camera.axis.has_value();
}
bool has_aperture(const StereoCamera& camera) {
  return camera.lens_radius > 0.0f;
}

using Lens = ProjectionSetting;
using Merge = PoleMergeSetting;
using enum CameraField;

// In the order of CameraField. Adjacent rows with the same setting or attribute are its numbers, in this order.
constexpr CameraFieldRow kFields[] = {
    {kLongitude, "longitude", kAngle, "degrees", "range", "projection.longitude", "ods:longitude",
     pair<&Lens::longitude>, is_part},
    {kLatitude,
     "latitude",
     {-90.0f, 90.0f},
     "degrees",
     "range",
     "projection.latitude",
     "ods:latitude",
     pair<&Lens::latitude>,
     is_part},
    {kFov, "fov", {0.001f, 360.0f}, "degrees", "fov", "projection.fov", "ods:fov", lens<&Lens::fov>, with_fov},
    {kAspect,
     "aspect",
     {1.0f / 32768.0f, 32768.0f},
     "",
     "aspect",
     "projection.aspect",
     "ods:aspect",
     lens<&Lens::aspect>,
     is_window},
    {kPan, "pan", kAngle, "degrees", "lens-direction", "projection.pan", "ods:look", lens<&Lens::pan>, with_lens},
    {kTilt, "tilt", kAngle, "degrees", "lens-direction", "projection.tilt", "ods:look", lens<&Lens::tilt>, with_lens},
    {kSensor,
     "sensor",
     {0.1f, 1000.0f},
     "millimetres",
     "sensor",
     "projection.sensor",
     "ods:sensor",
     sensor,
     has_polynomial},
    {kPolynomial,
     "lens polynomial",
     {-10.0f, 10.0f},
     "",
     "lens-polynomial",
     "projection.polynomial",
     "ods:lensK#",
     polynomial,
     has_polynomial},
    {kPosition, "position", kPlace, "metres", "position", "position", "ods:position", position, always},
    {kYaw, "yaw", kAngle, "degrees", "yaw", "yaw", "ods:yaw", own<&StereoCamera::yaw>, always},
    {kPitch, "pitch", kAngle, "degrees", "pitch", "pitch", "ods:pitch", own<&StereoCamera::pitch>, always},
    {kRoll, "roll", kAngle, "degrees", "roll", "roll", "ods:roll", own<&StereoCamera::roll>, always},
    {kIpd, "ipd", kApart, "metres", "ipd", "ipd", "ods:ipd", own<&StereoCamera::ipd>, always,
     "distance between the eyes (interpupillary distance), metres"},
    {kNeck, "neck", kOffset, "metres", "eye-to-neck", "neck", "ods:neck", own<&StereoCamera::neck>, has_neck,
     "distance of the eyes in front of the axis they turn about, metres"},
    {kTopMergeStart, "top merge start", kElevation, "degrees", "merge-top", "merge_top.start", "ods:poleMergeTopStart",
     pole<&StereoCamera::top, &Merge::start>, merges<&StereoCamera::top>},
    {kTopMergeEnd, "top merge end", kElevation, "degrees", "merge-top", "merge_top.end", "ods:poleMergeTopEnd",
     pole<&StereoCamera::top, &Merge::end>, merges<&StereoCamera::top>},
    {kTopMergeExponent, "top merge exponent", kExponent, "", "merge-top", "merge_top.exponent",
     "ods:poleMergeTopExponent", pole<&StereoCamera::top, &Merge::exponent>, merges<&StereoCamera::top>},
    {kBottomMergeStart, "bottom merge start", kElevation, "degrees", "merge-bottom", "merge_bottom.start",
     "ods:poleMergeBottomStart", pole<&StereoCamera::bottom, &Merge::start>, merges<&StereoCamera::bottom>},
    {kBottomMergeEnd, "bottom merge end", kElevation, "degrees", "merge-bottom", "merge_bottom.end",
     "ods:poleMergeBottomEnd", pole<&StereoCamera::bottom, &Merge::end>, merges<&StereoCamera::bottom>},
    {kBottomMergeExponent, "bottom merge exponent", kExponent, "", "merge-bottom", "merge_bottom.exponent",
     "ods:poleMergeBottomExponent", pole<&StereoCamera::bottom, &Merge::exponent>, merges<&StereoCamera::bottom>},
    {kConvergenceDistance, "convergence distance", kDistance, "metres", "convergence", "convergence.distance",
     "ods:convergenceDistance", own<&StereoCamera::convergence_distance>, converges},
    {kAxis, "axis", kPlace, "", "axis", "axis", "ods:axis", axis, has_axis},
    {kLensRadius,
     "lens radius",
     {0.0f, 10.0f},
     "metres",
     "lens",
     "lens.radius",
     "ods:lens",
     own<&StereoCamera::lens_radius>,
     has_aperture},
    {kFocusDistance, "focus distance", kDistance, "metres", "lens", "lens.focus_distance", "ods:lens",
     own<&StereoCamera::focus_distance>, has_aperture},
};
static_assert(has_every_member(kFields));

constexpr CameraModeRow kModes[] = {
    {"merge-top", "merge_top.mode", "ods:poleMergeTop", kMergeTable,
     [](StereoCamera& camera) -> int& { return camera.top.mode; }, always},
    {"merge-bottom", "merge_bottom.mode", "ods:poleMergeBottom", kMergeTable,
     [](StereoCamera& camera) -> int& { return camera.bottom.mode; }, always},
    {"convergence", "convergence.mode", "ods:convergence", kConvergenceTable,
     [](StereoCamera& camera) -> int& { return camera.convergence; }, converges},
};

}  // namespace

std::span<const CameraFieldRow> camera_fields() {
  return kFields;
}

const CameraFieldRow& row_of(CameraField field) {
  return row_in(kFields, field);
}

FieldRange range_of(CameraField field) {
  return row_of(field).range;
}

std::vector<float*> numbers_of(StereoCamera& camera, CameraField field) {
  return row_of(field).numbers(camera);
}

std::vector<float> values_of(const StereoCamera& camera, const CameraFieldRow& row) {
  StereoCamera copy = camera;
  std::vector<float> values;
  for (const float* number : row.numbers(copy)) values.push_back(*number);
  return values;
}

std::span<const CameraModeRow> camera_modes() {
  return kModes;
}

std::string_view mode_of(const StereoCamera& camera, const CameraModeRow& row) {
  StereoCamera copy = camera;
  const int value = row.value(copy);
  return std::ranges::find(row.names, value, &NameRow<int>::member)->name;
}

static void add_to(std::vector<CameraSetting>& settings, std::string_view name, const std::string& value) {
  auto setting = std::ranges::find(settings, name, &CameraSetting::name);
  if (setting == settings.end()) setting = settings.insert(setting, {name, ""});
  if (!setting->value.empty() && !value.empty()) setting->value += ',';
  setting->value += value;
}

std::vector<CameraSetting> camera_settings(const StereoCamera& camera) {
  std::vector<CameraSetting> settings;
  for (const CameraModeRow& row : kModes) {
    add_to(settings, row.setting, std::string(row.matters(camera) ? mode_of(camera, row) : ""));
  }
  for (const CameraFieldRow& row : kFields) {
    std::vector<float> values = values_of(camera, row);
    for (float& value : values) value += 0.0f;  // -0 reads as 0
    add_to(settings, row.setting, row.matters(camera) ? fmt::format("{}", fmt::join(values, ",")) : "");
  }
  return settings;
}

std::string camera_fault(const StereoCamera& camera) {
  for (const CameraFieldRow& row : kFields) {
    for (const float number : values_of(camera, row)) {
      if (row.range.contains(number)) continue;
      return fmt::format("{} is from {:g} to {:g}{}{}, not {:g}", row.name, row.range.minimum, row.range.maximum,
                         row.unit.empty() ? "" : " ", row.unit, number);
    }
  }
  for (const PoleMergeSetting& merge : {camera.top, camera.bottom}) {
    if (!(merge.start < merge.end)) return "a pole merge starts below its end";
  }
  if (camera.axis && !(length(*camera.axis) > 1e-6f)) return "axis is a direction, not 0";
  return projection_fault(camera.projection);
}

float angle_in_range(double degrees) {
  const float angle = static_cast<float>(degrees);
  return kAngle.contains(angle) ? angle : static_cast<float>(std::remainder(degrees, 360.0));
}

}  // namespace ods
