// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every legal camera comes back from everything that it is written into.
#include "ods/camera/camera_fields.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "ods/camera/camera_move.h"
#include "ods/camera/camera_preset.h"
#include "ods/picture/metadata/metadata.h"
#include "ods/picture/metadata/sidecar.h"
#include "tests/support/exact_camera.h"
#include "tests/support/places.h"
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

// Attributes as a header stores them; a real file keeps floats bit for bit (metadata_test).
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

TEST(CameraFields, EveryFieldHasItsOwnPlacesAndARange) {
  std::set<std::string_view> names, places;
  const ProjectionSetting lens = find_projection("fisheye-polynomial")->setting;
  StereoCamera camera = full_rig(lens);
  for (const CameraFieldRow& row : camera_fields()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(places.insert(row.place).second) << row.name;
    EXPECT_LT(row.range.minimum, row.range.maximum) << row.name;
    EXPECT_FALSE(row.numbers(camera).empty()) << row.name;
    for (const float number : values_of(camera, row)) EXPECT_TRUE(row.range.contains(number));
    for (const float beyond : {row.range.minimum - 1.0f, row.range.maximum * 1.01f, std::nanf("")}) {
      StereoCamera bad = full_rig(lens);
      *row.numbers(bad)[0] = beyond;
      EXPECT_NE(camera_fault(bad).find(row.name), std::string::npos) << camera_fault(bad);
    }
  }
  for (const CameraModeRow& row : camera_modes()) EXPECT_TRUE(places.insert(row.place).second) << row.place;
}

// A new member does not compile here: it gets a row or a place among those that have none.
TEST(CameraFields, EveryMemberHasARow) {
  [[maybe_unused]] const auto& [position, yaw, pitch, roll, ipd, top, bottom, merge_map, head_tilt_map, projection,
                                convergence, distance, neck, axis, lens_radius, focus_distance, mirrored, texel_rays] =
      StereoCamera();
  [[maybe_unused]] const auto& [kind, longitude, latitude, fov, aspect, sensor, polynomial, pan, tilt] = projection;
  [[maybe_unused]] const auto& [mode, start, end, exponent] = top;
  const size_t of_camera =
      18 - std::size({"top", "bottom", "merge_map", "head_tilt_map", "projection", "mirrored", "texel_rays"});
  const size_t of_lens = 9 - std::size({"kind"}), of_merges = 2 * 4;
  EXPECT_EQ(camera_fields().size() + camera_modes().size(), of_camera + of_lens + of_merges);
}

TEST(CameraFields, TheSidecarsPageNamesEveryKey) {
  std::ifstream file(source_folder() + "/docs/camera-sidecar.md");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  std::vector<std::string_view> places;
  for (const CameraFieldRow& row : camera_fields()) places.push_back(row.place);
  for (const CameraModeRow& row : camera_modes()) places.push_back(row.place);
  for (const std::string_view place : places) {
    const std::string key(place.substr(place.find('.') + 1));
    EXPECT_TRUE(page.find(fmt::format("`{}`", place)) != std::string::npos ||
                page.find(fmt::format("`{}`", key)) != std::string::npos)
        << place;
  }
}

TEST(CameraFields, TheStudioHasAControlForEach) {
  std::ifstream file(source_folder() + "/web/studio-fields.js");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  const auto expect_control = [&](std::string_view place) {
    const std::string_view key = place.substr(place.find('.') + 1);
    const bool is_there = page.find(fmt::format("camera('{}')", place)) != std::string::npos ||
                          page.find(fmt::format("camera(`{}.${{i}}`)", place)) != std::string::npos ||
                          page.find(fmt::format("camera(`${{which}}.{}`)", key)) != std::string::npos;
    EXPECT_TRUE(is_there) << place;
  };
  for (const CameraFieldRow& row : camera_fields()) expect_control(row.place);
  for (const CameraModeRow& row : camera_modes()) expect_control(row.place);
}

// The last of a field's numbers is at an end of its range, in every projection that allows it.
TEST(CameraFields, ExtremesComeBack) {
  using enum CameraField;
  for (const CameraFieldRow& row : camera_fields()) {
    const CameraField field = row.member;
    int legal[2] = {0, 0};
    for (const NamedProjection& named : named_projections()) {
      for (const bool maximum : {false, true}) {
        StereoCamera camera = full_rig(named.setting);
        const std::vector<float*> numbers = row.numbers(camera);
        if (numbers.empty()) continue;
        *numbers.back() = maximum ? row.range.maximum : row.range.minimum;
        if (field == kLongitude) camera.projection.longitude.x = camera.projection.longitude.y - 300.0f;
        if (field == kLongitude && !maximum) camera.projection.longitude += 300.0f;
        if (field == kLatitude && !maximum) std::swap(camera.projection.latitude.x, camera.projection.latitude.y);
        if (!camera_fault(camera).empty()) continue;
        SCOPED_TRACE(std::string(row.name) + " " + std::string(named.name));
        legal[maximum ? 1 : 0]++;
        expect_round_trips(camera);
      }
    }
    // A merge cannot start at the pole nor end at the horizon.
    const bool is_end = field == kTopMergeEnd || field == kBottomMergeEnd;
    const bool is_start = field == kTopMergeStart || field == kBottomMergeStart;
    EXPECT_GT(legal[0] + (is_end ? 1 : 0), 0) << row.name;
    const bool turns_back = field == kPolynomial;  // with so large a K4
    EXPECT_GT(legal[1] + (is_start || turns_back ? 1 : 0), 0) << row.name;
  }
}

// Values that our own reader refused: windows of less than a degree or wider than 100 to 1.
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
    for (const CameraFieldRow& row : camera_fields()) {
      const FieldRange range = row.range;
      for (float* number : row.numbers(camera)) {
        if (dice.next() < 0.5f) continue;
        // Near either end as often as anywhere.
        const float share = dice.next(), power = dice.next() < 0.5f ? 1.0f : 6.0f;
        *number = range.minimum + (range.maximum - range.minimum) * std::pow(share, power);
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
