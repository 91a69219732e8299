// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every legal camera comes back from everything that it is written into.
#include "ods/camera/camera_fields.h"

#include <gtest/gtest.h>

#include <set>

#include "ods/camera/camera_move.h"
#include "ods/camera/camera_preset.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/sidecar.h"
#include "tests/support/exact_camera.h"
#include "tests/support/statistics.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// EXR attributes leave out what means nothing to a camera: the distance of parallel eyes, the range of a lens. Those
// are as by default here.
StereoCamera without_meaningless_numbers(StereoCamera camera) {
  const StereoCamera plain;
  const ProjectionSetting own = camera.projection;
  camera.projection = find_projection(projection_name(own))->setting;
  if (has_range(own.kind)) camera.projection.longitude = own.longitude, camera.projection.latitude = own.latitude;
  if (has_fov(own.kind)) camera.projection.fov = own.fov;
  if (has_lens(own.kind)) camera.projection.pan = own.pan, camera.projection.tilt = own.tilt;
  if (own.kind == kPerspective) camera.projection.aspect = own.aspect;
  if (own.kind == kFisheyePolynomial) {
    camera.projection.sensor = own.sensor, camera.projection.polynomial = own.polynomial;
  }
  if (camera.convergence == kParallel) camera.convergence_distance = plain.convergence_distance;
  for (PoleMergeSetting* merge : {&camera.top, &camera.bottom}) {
    if (merge->mode == kMergeNone) *merge = {};
  }
  if (camera.lens_radius == 0.0f) camera.focus_distance = plain.focus_distance;
  return camera;
}

// As a header holds them; a real file keeps floats bit for bit (metadata_test).
FileInfo header_of(const StereoCamera& camera) {
  std::vector<Attribute> attributes;
  add_camera(attributes, camera);
  FileInfo info;
  for (const Attribute& attribute : attributes) {
    if (const auto* word = std::get_if<std::string>(&attribute.value)) info.text[attribute.name] = *word;
    if (const auto* number = std::get_if<float>(&attribute.value)) info.numbers[attribute.name] = {*number};
    if (const auto* flag = std::get_if<int>(&attribute.value))
      info.numbers[attribute.name] = {static_cast<float>(*flag)};
    if (const auto* list = std::get_if<std::vector<float>>(&attribute.value)) info.numbers[attribute.name] = *list;
  }
  return info;
}

void expect_round_trips(const StereoCamera& camera) {
  ASSERT_EQ(camera_fault(camera), "");
  std::vector<std::string> warnings;
  const auto from_exr = camera_of(header_of(camera), warnings);
  ASSERT_TRUE(from_exr.has_value()) << warnings[0];
  EXPECT_EQ(*from_exr, without_meaningless_numbers(camera));
  Sidecar file;
  file.camera = camera;
  StereoCamera expected = camera;  // a sidecar has the numbers of a polynomial only for a lens that has one
  if (camera.projection.kind != kFisheyePolynomial) {
    expected.projection.sensor = ProjectionSetting().sensor;
    expected.projection.polynomial = kCyclesPolynomial;
  }
  EXPECT_EQ(read_sidecar(write_sidecar(file), "a sidecar", warnings).camera, expected);
  EXPECT_TRUE(warnings.empty()) << warnings[0];
}

StereoCamera full_rig(const ProjectionSetting& projection) {
  StereoCamera camera;
  camera.projection = projection;
  camera.top.mode = kMergeCosine, camera.bottom.mode = kMergeLinear;
  camera.top.start = camera.bottom.start = 0.0f;
  camera.top.end = 50.0f;
  camera.convergence = kToeIn;
  camera.lens_radius = 0.01f;
  camera.axis = vec3(0.0f, 1.0f, 0.0f);
  return camera;
}

TEST(CameraFields, EveryFieldHasANameARangeAndNumbers) {
  std::set<std::string_view> names;
  StereoCamera camera = full_rig({});
  for (const CameraField field : kCameraFields) {
    EXPECT_TRUE(names.insert(field_name(field)).second) << field_name(field);
    EXPECT_LT(range_of(field).least, range_of(field).most) << field_name(field);
    EXPECT_FALSE(numbers_of(camera, field).empty()) << field_name(field);
    for (const float* number : numbers_of(camera, field)) EXPECT_TRUE(range_of(field).contains(*number));
    for (const float beyond : {range_of(field).least - 1.0f, range_of(field).most * 1.01f, std::nanf("")}) {
      StereoCamera bad = full_rig({});
      *numbers_of(bad, field)[0] = beyond;
      EXPECT_NE(camera_fault(bad).find(field_name(field)), std::string::npos) << camera_fault(bad);
    }
  }
}

// The last of a field's numbers is at an end of its range, in every projection that allows it.
TEST(CameraFields, ExtremesComeBack) {
  for (const CameraField field : kCameraFields) {
    int legal[2] = {0, 0};
    for (const NamedProjection& named : named_projections()) {
      for (const bool most : {false, true}) {
        StereoCamera camera = full_rig(named.setting);
        const FieldRange range = range_of(field);
        *numbers_of(camera, field).back() = most ? range.most : range.least;
        if (field == CameraField::kLongitude) camera.projection.longitude.x = camera.projection.longitude.y - 300.0f;
        if (field == CameraField::kLongitude && !most) camera.projection.longitude += 300.0f;
        if (field == CameraField::kLatitude && !most)
          std::swap(camera.projection.latitude.x, camera.projection.latitude.y);
        if (!camera_fault(camera).empty()) continue;
        SCOPED_TRACE(std::string(field_name(field)) + " " + std::string(named.name));
        legal[most ? 1 : 0]++;
        expect_round_trips(camera);
      }
    }
    // A merge cannot start at the pole nor end at the horizon.
    EXPECT_GT(legal[0] + (field == CameraField::kMergeEnd ? 1 : 0), 0) << field_name(field);
    const bool turns_back = field == CameraField::kPolynomial;  // with so large a K4
    EXPECT_GT(legal[1] + (field == CameraField::kMergeStart || turns_back ? 1 : 0), 0) << field_name(field);
  }
}

// What our own reader refused: windows of less than a degree or wider than 100 to 1.
TEST(CameraFields, NarrowWindowsComeBack) {
  StereoCamera camera;
  camera.projection = find_projection("perspective")->setting;
  camera.projection.fov = 0.5f;
  expect_round_trips(camera);
  camera.projection.aspect = 150.0f;
  expect_round_trips(camera);
}

TEST(CameraFields, RandomCamerasComeBack) {
  Dice dice(7);
  int legal = 0;
  for (size_t i = 0; i < 20000; i++) {
    StereoCamera camera = full_rig(named_projections()[i % named_projections().size()].setting);
    if (dice.next() < 0.3f) camera.axis.reset();
    for (const CameraField field : kCameraFields) {
      const FieldRange range = range_of(field);
      for (float* number : numbers_of(camera, field)) {
        if (dice.next() < 0.5f) continue;
        // Near either end as often as anywhere.
        const float share = dice.next(), power = dice.next() < 0.5f ? 1.0f : 6.0f;
        *number = range.least + (range.most - range.least) * std::pow(share, power);
      }
    }
    camera.top.mode = any_closed_merge(dice);  // but for maps, which only a sidecar holds
    camera.convergence = kConvergences[i % 3];
    camera.mirrored = i % 5 == 0;
    if (!camera_fault(camera).empty()) continue;
    legal++;
    expect_round_trips(camera);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(legal, 500);
}

// Other systems' parameters at their ends make cameras that come back, or are refused.
TEST(CameraFields, PresetsAreLegal) {
  for (const CameraPreset& preset : camera_presets()) {
    for (const PresetParameter& parameter : preset.parameters) {
      for (const char* value : {"0", "1e-8", "0.0005", "1", "90", "100", "5000", "10000", "36000", "-36000", "1e6"}) {
        StereoCamera camera;
        try {
          camera = camera_like(preset, {{std::string(parameter.name), value}});
        } catch (const std::invalid_argument&) {
          continue;
        }
        SCOPED_TRACE(std::string(preset.name) + " " + std::string(parameter.name) + "=" + value);
        expect_round_trips(camera);
      }
    }
  }
}

TEST(CameraFields, TurningStaysInRange) {
  EXPECT_EQ(angle_in_range(-36000.0), -36000.0f);
  EXPECT_EQ(angle_in_range(36090.0), 90.0f);
  StereoCamera camera;
  camera.yaw = 36000.0f;
  CameraMove move;
  move.turns = 1.0;
  EXPECT_EQ(camera_fault(moved(camera, move, 0.25 * move.seconds)), "");
}

}  // namespace
}  // namespace ods
