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
  std::vector<float*> (*numbers)(StereoCamera&);
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
  // In the order of CameraField.
  static const FieldRow kRows[] = {
      {"position", kPlace, [](StereoCamera& camera) { return numbers_of(camera.position); }},
      {"yaw", kAngle, [](StereoCamera& camera) { return Numbers{&camera.yaw}; }},
      {"pitch", kAngle, [](StereoCamera& camera) { return Numbers{&camera.pitch}; }},
      {"roll", kAngle, [](StereoCamera& camera) { return Numbers{&camera.roll}; }},
      {"ipd", {0.0f, 1e4f}, [](StereoCamera& camera) { return Numbers{&camera.ipd}; }},
      {"neck", {-1e3f, 1e3f}, [](StereoCamera& camera) { return Numbers{&camera.neck}; }},
      {"merge start", kElevation,
       [](StereoCamera& camera) {
         return Numbers{&camera.top.start, &camera.bottom.start};
       }},
      {"merge end", kElevation,
       [](StereoCamera& camera) {
         return Numbers{&camera.top.end, &camera.bottom.end};
       }},
      {"merge exponent",
       {1e-6f, 100.0f},
       [](StereoCamera& camera) {
         return Numbers{&camera.top.exponent, &camera.bottom.exponent};
       }},
      {"convergence distance", kDistance, [](StereoCamera& camera) { return Numbers{&camera.convergence_distance}; }},
      {"axis", kPlace, [](StereoCamera& camera) { return camera.axis ? numbers_of(*camera.axis) : Numbers(); }},
      {"lens radius", {0.0f, 10.0f}, [](StereoCamera& camera) { return Numbers{&camera.lens_radius}; }},
      {"focus distance", kDistance, [](StereoCamera& camera) { return Numbers{&camera.focus_distance}; }},
      {"longitude", kAngle,
       [](StereoCamera& camera) {
         return Numbers{&camera.projection.longitude.x, &camera.projection.longitude.y};
       }},
      {"latitude",
       {-90.0f, 90.0f},
       [](StereoCamera& camera) {
         return Numbers{&camera.projection.latitude.x, &camera.projection.latitude.y};
       }},
      {"fov", {0.001f, 360.0f}, [](StereoCamera& camera) { return Numbers{&camera.projection.fov}; }},
      {"aspect", {1.0f / 32768.0f, 32768.0f}, [](StereoCamera& camera) { return Numbers{&camera.projection.aspect}; }},
      {"pan", kAngle, [](StereoCamera& camera) { return Numbers{&camera.projection.pan}; }},
      {"tilt", kAngle, [](StereoCamera& camera) { return Numbers{&camera.projection.tilt}; }},
      {"sensor",
       {0.1f, 1000.0f},
       [](StereoCamera& camera) {
         return Numbers{&camera.projection.sensor.x, &camera.projection.sensor.y};
       }},
      {"lens polynomial",
       {-10.0f, 10.0f},
       [](StereoCamera& camera) {
         Numbers numbers;
         for (float& k : camera.projection.polynomial) numbers.push_back(&k);
         return numbers;
       }},
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

std::vector<float*> numbers_of(StereoCamera& camera, CameraField field) {
  return row_of(field).numbers(camera);
}

std::string camera_fault(const StereoCamera& camera) {
  StereoCamera copy = camera;
  for (const CameraField field : kCameraFields) {
    const FieldRange range = range_of(field);
    for (const float* number : numbers_of(copy, field)) {
      if (range.contains(*number)) continue;
      return fmt::format("{} is from {:g} to {:g}, not {:g}", field_name(field), range.least, range.most, *number);
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
