// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every legal camera comes back from everything that it is written into.
#include "ods/camera/camera_fields.h"

#include <gtest/gtest.h>

#include <set>

#include "ods/camera/camera_move.h"
#include "ods/camera/dialect.h"
#include "ods/picture/metadata/camera_file.h"
#include "ods/picture/metadata/metadata.h"
#include "tests/support/statistics.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// EXR attributes leave out what means nothing to a camera: the distance of parallel eyes, the range of a lens. Those
// are as by default here.
CameraRig without_meaningless_numbers(CameraRig rig) {
  const CameraRig plain;
  const ProjectionSetting own = rig.projection;
  rig.projection = find_projection(projection_name(own))->setting;
  if (has_range(own.kind)) rig.projection.longitude = own.longitude, rig.projection.latitude = own.latitude;
  if (has_lens(own.kind)) rig.projection.fov = own.fov, rig.projection.pan = own.pan, rig.projection.tilt = own.tilt;
  if (own.kind == kPerspective) rig.projection.aspect = own.aspect;
  if (rig.convergence == kParallel) rig.convergence_distance = plain.convergence_distance;
  for (PoleMergeSetting* merge : {&rig.top, &rig.bottom}) {
    if (merge->mode == kMergeNone) *merge = {};
  }
  if (rig.lens_radius == 0.0f) rig.focus_distance = plain.focus_distance;
  return rig;
}

// As a header holds them; a real file keeps floats bit for bit (metadata_test).
FileInfo header_of(const CameraRig& rig) {
  std::vector<Attribute> attributes;
  add_camera(attributes, rig);
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

void expect_round_trips(const CameraRig& rig) {
  ASSERT_EQ(camera_fault(rig), "");
  std::vector<std::string> warnings;
  const auto from_exr = camera_of(header_of(rig), warnings);
  ASSERT_TRUE(from_exr.has_value()) << warnings[0];
  EXPECT_EQ(*from_exr, without_meaningless_numbers(rig));
  CameraFile file;
  file.rig = rig;
  EXPECT_EQ(read_camera(write_camera(file), "a sidecar", warnings).rig, rig);
  EXPECT_TRUE(warnings.empty()) << warnings[0];
}

CameraRig full_rig(const ProjectionSetting& projection) {
  CameraRig rig;
  rig.projection = projection;
  rig.top.mode = kMergeCosine, rig.bottom.mode = kMergeLinear;
  rig.top.start = rig.bottom.start = 0.0f;
  rig.top.end = 50.0f;
  rig.convergence = kToeIn;
  rig.lens_radius = 0.01f;
  rig.axis = vec3(0.0f, 1.0f, 0.0f);
  return rig;
}

TEST(CameraFields, EveryFieldHasANameARangeAndNumbers) {
  std::set<std::string_view> names;
  CameraRig rig = full_rig({});
  for (const CameraField field : kCameraFields) {
    EXPECT_TRUE(names.insert(field_name(field)).second) << field_name(field);
    EXPECT_LT(range_of(field).least, range_of(field).most) << field_name(field);
    EXPECT_FALSE(numbers_of(rig, field).empty()) << field_name(field);
    for (const float* number : numbers_of(rig, field)) EXPECT_TRUE(range_of(field).contains(*number));
    for (const float beyond : {range_of(field).least - 1.0f, range_of(field).most * 1.01f, std::nanf("")}) {
      CameraRig bad = full_rig({});
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
        CameraRig rig = full_rig(named.setting);
        const FieldRange range = range_of(field);
        *numbers_of(rig, field).back() = most ? range.most : range.least;
        if (field == CameraField::kLongitude) rig.projection.longitude.x = rig.projection.longitude.y - 300.0f;
        if (field == CameraField::kLongitude && !most) rig.projection.longitude += 300.0f;
        if (field == CameraField::kLatitude && !most) std::swap(rig.projection.latitude.x, rig.projection.latitude.y);
        if (!camera_fault(rig).empty()) continue;
        SCOPED_TRACE(std::string(field_name(field)) + " " + std::string(named.name));
        legal[most ? 1 : 0]++;
        expect_round_trips(rig);
      }
    }
    // A merge cannot start at the pole nor end at the horizon.
    EXPECT_GT(legal[0] + (field == CameraField::kMergeEnd ? 1 : 0), 0) << field_name(field);
    EXPECT_GT(legal[1] + (field == CameraField::kMergeStart ? 1 : 0), 0) << field_name(field);
  }
}

// What our own reader refused: windows of less than a degree or wider than 100 to 1.
TEST(CameraFields, NarrowWindowsComeBack) {
  CameraRig rig;
  rig.projection = find_projection("perspective")->setting;
  rig.projection.fov = 0.5f;
  expect_round_trips(rig);
  rig.projection.aspect = 150.0f;
  expect_round_trips(rig);
}

TEST(CameraFields, RandomCamerasComeBack) {
  Dice dice(7);
  int legal = 0;
  for (size_t i = 0; i < 20000; i++) {
    CameraRig rig = full_rig(named_projections()[i % named_projections().size()].setting);
    if (dice.next() < 0.3f) rig.axis.reset();
    for (const CameraField field : kCameraFields) {
      const FieldRange range = range_of(field);
      for (float* number : numbers_of(rig, field)) {
        if (dice.next() < 0.5f) continue;
        // Near either end as often as anywhere.
        const float share = dice.next(), power = dice.next() < 0.5f ? 1.0f : 6.0f;
        *number = range.least + (range.most - range.least) * std::pow(share, power);
      }
    }
    rig.top.mode = static_cast<int>(dice.next() * 6.99f);  // but for maps, which only a sidecar holds
    rig.convergence = kConvergences[i % 3];
    rig.mirrored = i % 5 == 0;
    if (!camera_fault(rig).empty()) continue;
    legal++;
    expect_round_trips(rig);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(legal, 500);
}

// Other systems' parameters at their ends make cameras that come back, or are refused.
TEST(CameraFields, PresetsAreLegal) {
  for (const Dialect& dialect : dialects()) {
    for (const DialectParameter& parameter : dialect.parameters) {
      for (const char* value : {"0", "1e-8", "0.0005", "1", "90", "100", "5000", "10000", "36000", "-36000", "1e6"}) {
        CameraRig rig;
        try {
          rig = rig_like(dialect, {{std::string(parameter.name), value}});
        } catch (const std::invalid_argument&) {
          continue;
        }
        SCOPED_TRACE(std::string(dialect.name) + " " + std::string(parameter.name) + "=" + value);
        expect_round_trips(rig);
      }
    }
  }
}

TEST(CameraFields, TurningStaysInRange) {
  EXPECT_EQ(angle_in_range(-36000.0), -36000.0f);
  EXPECT_EQ(angle_in_range(36090.0), 90.0f);
  CameraRig rig;
  rig.yaw = 36000.0f;
  CameraMove move;
  move.turns = 1.0;
  EXPECT_EQ(camera_fault(moved(rig, move, 0.25 * move.seconds)), "");
}

}  // namespace
}  // namespace ods
