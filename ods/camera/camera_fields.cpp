// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/camera/camera_fields.h"

#include <fmt/format.h>

#include <cmath>

namespace ods {
namespace {

struct FieldRow {
  std::string_view name;
  FieldRange range;
  std::vector<float*> (*numbers)(CameraRig&);
};

constexpr FieldRange kAngle{-36000.0f, 36000.0f};
constexpr FieldRange kPlace{-1e6f, 1e6f};
constexpr FieldRange kElevation{0.0f, 90.0f};
constexpr FieldRange kDistance{1e-3f, 1e6f};

std::vector<float*> numbers_of(vec3& v) {
  return {&v.x, &v.y, &v.z};
}

const FieldRow& row_of(CameraField field) {
  using Numbers = std::vector<float*>;
  // As CameraField counts.
  static const FieldRow kRows[] = {
      {"position", kPlace, [](CameraRig& rig) { return numbers_of(rig.position); }},
      {"yaw", kAngle, [](CameraRig& rig) { return Numbers{&rig.yaw}; }},
      {"pitch", kAngle, [](CameraRig& rig) { return Numbers{&rig.pitch}; }},
      {"roll", kAngle, [](CameraRig& rig) { return Numbers{&rig.roll}; }},
      {"ipd", {0.0f, 1e4f}, [](CameraRig& rig) { return Numbers{&rig.ipd}; }},
      {"neck", {-1e3f, 1e3f}, [](CameraRig& rig) { return Numbers{&rig.neck}; }},
      {"merge start", kElevation,
       [](CameraRig& rig) {
         return Numbers{&rig.top.start, &rig.bottom.start};
       }},
      {"merge end", kElevation,
       [](CameraRig& rig) {
         return Numbers{&rig.top.end, &rig.bottom.end};
       }},
      {"merge exponent",
       {1e-6f, 100.0f},
       [](CameraRig& rig) {
         return Numbers{&rig.top.exponent, &rig.bottom.exponent};
       }},
      {"convergence distance", kDistance, [](CameraRig& rig) { return Numbers{&rig.convergence_distance}; }},
      {"axis", kPlace, [](CameraRig& rig) { return rig.axis ? numbers_of(*rig.axis) : Numbers(); }},
      {"lens radius", {0.0f, 10.0f}, [](CameraRig& rig) { return Numbers{&rig.lens_radius}; }},
      {"focus distance", kDistance, [](CameraRig& rig) { return Numbers{&rig.focus_distance}; }},
      {"longitude", kAngle,
       [](CameraRig& rig) {
         return Numbers{&rig.projection.longitude.x, &rig.projection.longitude.y};
       }},
      {"latitude",
       {-90.0f, 90.0f},
       [](CameraRig& rig) {
         return Numbers{&rig.projection.latitude.x, &rig.projection.latitude.y};
       }},
      {"fov", {0.001f, 360.0f}, [](CameraRig& rig) { return Numbers{&rig.projection.fov}; }},
      {"aspect", {1.0f / 32768.0f, 32768.0f}, [](CameraRig& rig) { return Numbers{&rig.projection.aspect}; }},
      {"pan", kAngle, [](CameraRig& rig) { return Numbers{&rig.projection.pan}; }},
      {"tilt", kAngle, [](CameraRig& rig) { return Numbers{&rig.projection.tilt}; }},
  };
  static_assert(std::size(kRows) == std::size(kCameraFields));
  return kRows[static_cast<size_t>(field)];
}

}  // namespace

std::string_view field_name(CameraField field) {
  return row_of(field).name;
}

FieldRange range_of(CameraField field) {
  return row_of(field).range;
}

std::vector<float*> numbers_of(CameraRig& rig, CameraField field) {
  return row_of(field).numbers(rig);
}

std::string camera_fault(const CameraRig& rig) {
  CameraRig copy = rig;
  for (const CameraField field : kCameraFields) {
    const FieldRange range = range_of(field);
    for (const float* number : numbers_of(copy, field)) {
      if (range.contains(*number)) continue;
      return fmt::format("{} is from {:g} to {:g}, not {:g}", field_name(field), range.least, range.most, *number);
    }
  }
  for (const PoleMergeSetting& merge : {rig.top, rig.bottom}) {
    if (!(merge.start < merge.end)) return "a pole merge starts below its end";
  }
  if (rig.axis && !(length(*rig.axis) > 1e-6f)) return "axis is a direction, not 0";
  return projection_fault(rig.projection);
}

float angle_in_range(double degrees) {
  const float angle = static_cast<float>(degrees);
  return kAngle.contains(angle) ? angle : static_cast<float>(std::remainder(degrees, 360.0));
}

}  // namespace ods
