// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Each exact camera preset against the formula of its system, restated in double precision in that system's own terms
// and brought into our frame at the end.
#include "ods/camera/camera_preset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "tests/support/exact_camera.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

using glm::dvec3;
using Given = std::map<std::string, std::string>;

// x, y: 0..1 of one eye's picture, from its top left. eye: -1 left, 1 right.
using Formula = std::function<ExactRay(double x, double y, double eye)>;

void expect_same(const char* name, const Given& given, const Formula& formula) {
  const CameraPreset* preset = find_camera_preset(name);
  ASSERT_NE(preset, nullptr) << name;
  EXPECT_TRUE(preset->exact) << name;
  const Camera camera = make_camera(camera_like(*preset, given));
  Dice dice(7);
  for (int i = 0; i < 10000; i++) {
    const vec2 uv = dice.pair();
    const double eye = i % 2 == 0 ? -1.0 : 1.0;
    const Ray ray = camera_ray(camera, i % 2 == 0 ? kLeft : kRight, uv);
    const ExactRay exact = formula(double{uv.x}, double{uv.y}, eye);
    const dvec3 direction = normalize(exact.direction);
    ASSERT_LT(length(dvec3(ray.direction) - direction), 1e-6) << name << ' ' << uv.x << ' ' << uv.y;
    // Small powers of a cosine are steep at the poles, where floats resolve elevations to 1e-7.
    ASSERT_LT(length(dvec3(ray.origin) - exact.origin), uv.y < 1e-3f || uv.y > 0.999f ? 1e-5 : 1e-6)
        << name << ' ' << uv.x << ' ' << uv.y;
  }
}

TEST(CameraPresets, Google) {
  expect_same("google", {{"IPD", "0.065"}}, [](double x, double y, double eye) {
    const double theta = x * 2.0 * kExactPi - kExactPi, phi = kExactPi / 2.0 - y * kExactPi;
    const double r = 0.065 / 2.0 * eye;
    return ExactRay{{std::cos(theta) * r, 0.0, std::sin(theta) * r},
                    {std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi)}};
  });
}

// x, y of the whole top-bottom picture from -1/2 to 1/2, y up; a left-handed world whose z is our -z.
ExactRay clodo(double x, double y, double eye, double ipd, double modulation, double handedness, double angle) {
  const double picture_x = x - 0.5, picture_y = eye < 0.0 ? 0.5 - y / 2.0 : -y / 2.0;
  const double theta = (picture_x + 0.5 + angle / 360.0) * 2.0 * kExactPi - kExactPi;
  const double c = picture_y > 0.0 ? 1.0 - 2.0 * picture_y : 1.0 - 2.0 * (picture_y + 0.5);
  const double phi = kExactPi / 2.0 - c * kExactPi;
  const double r = ipd / 2.0 * std::pow(std::abs(std::sin(c * kExactPi)), modulation) * eye;
  ExactRay ray{{std::cos(theta) * r, 0.0, std::sin(theta) * r * handedness},
               {std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi) * handedness}};
  ray.origin.z = -ray.origin.z, ray.direction.z = -ray.direction.z;
  return ray;
}

TEST(CameraPresets, PovrayAndItsFork) {
  for (double handedness : {-1.0, 1.0}) {
    const auto formula = [=](double x, double y, double eye) { return clodo(x, y, eye, 0.07, 0.3, handedness, 30.0); };
    const std::string hand = handedness < 0.0 ? "-1" : "1";
    expect_same("povray",
                {{"odsIPD", "0.07"}, {"odsVerticalModulation", "0.3"}, {"odsHandedness", hand}, {"odsAngle", "30"}},
                formula);
    expect_same("povray-fork",
                {{"ipd", "0.07"}, {"ods_modulation", "0.3"}, {"ods_handedness", hand}, {"ods_angle", "30"}}, formula);
  }
}

// T, B: latitudes from which the top and bottom merge act, T > 0 > B.
ExactRay arnold(double x, double y, double eye, double neck, double t, double b, double top_power, double bottom_power,
                bool linear_top) {
  const double sx = 2.0 * x - 1.0, sy = 1.0 - 2.0 * y, theta = kExactPi * sx, phi = kExactPi / 2.0 * sy;
  double factor = 1.0;
  if (phi > t) {
    factor = linear_top ? (kExactPi - 2.0 * phi) / (kExactPi - 2.0 * t)
                        : std::pow(std::max(0.0, std::cos((phi - t) * kExactPi / (kExactPi - 2.0 * t))), top_power);
  } else if (phi < b) {
    factor = std::pow(std::max(0.0, std::cos((phi - b) * -kExactPi / (kExactPi + 2.0 * b))), bottom_power);
  }
  const double half = 0.06 / 2.0 * eye;
  return {dvec3(half * std::cos(theta) + neck * std::sin(theta), 0.0, half * std::sin(theta) - neck * std::cos(theta)) *
              factor,
          {std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi)}};
}

TEST(CameraPresets, Arnold) {
  const double degree = kExactPi / 180.0;
  expect_same(
      "arnold",
      {{"eye_separation", "0.06"}, {"eye_to_neck", "0.09"}, {"top_merge_angle", "40"}, {"bottom_merge_angle", "70"}},
      [=](double x, double y, double eye) {
        return arnold(x, y, eye, 0.09, 50.0 * degree, -20.0 * degree, 1.0, 1.0, false);
      });
  expect_same("arnold", {{"eye_separation", "0.06"}, {"top_merge_mode", "none"}, {"bottom_merge_angle", "0"}},
              [=](double x, double y, double eye) { return arnold(x, y, eye, 0.0, 9.0, -9.0, 1.0, 1.0, false); });
  for (bool linear : {false, true}) {
    expect_same("arnold-proto",
                {{"eyeSeparation", "0.06"},
                 {"eyeToNeckDistance", "0.05"},
                 {"topMergeMode", linear ? "linear" : "cos"},
                 {"topMergeAngle", "30"},
                 {"topMergeExp", "2"},
                 {"bottomMergeAngle", "-60"},
                 {"bottomMergeExp", "0.5"}},
                [=](double x, double y, double eye) {
                  return arnold(x, y, eye, 0.05, 30.0 * degree, -60.0 * degree, 2.0, 0.5, linear);
                });
  }
}

// Its camera space: x ahead, -y right, z up.
TEST(CameraPresets, Cycles) {
  for (const bool toe_in : {false, true}) {
    for (const bool merge : {false, true}) {
      expect_same("cycles",
                  {{"convergence_mode", toe_in ? "OFFAXIS" : "PARALLEL"}, {"use_pole_merge", merge ? "1" : "0"}},
                  [=](double x, double y, double eye) {
                    const double azimuth = -2.0 * kExactPi * x + kExactPi, colatitude = kExactPi * y;
                    dvec3 d(std::sin(colatitude) * std::cos(azimuth), std::sin(colatitude) * std::sin(azimuth),
                            std::cos(colatitude));
                    const double from = kExactPi / 3.0, to = kExactPi * 75.0 / 180.0, alt = std::abs(std::asin(d.z));
                    double off = eye * 0.065 / 2.0;
                    if (merge && alt > to) off = 0.0;
                    if (merge && alt > from && alt <= to) off *= std::cos((alt - from) / (to - from) * kExactPi / 2.0);
                    const dvec3 side = normalize(cross(d, dvec3(0, 0, 1)));
                    if (toe_in) d = normalize(1.95 * d - side * off);
                    const auto ours = [](dvec3 v) { return dvec3(-v.y, v.z, -v.x); };
                    return ExactRay{ours(side * off), ours(d)};
                  });
    }
  }
}

// Its screen's origin is the lower left.
TEST(CameraPresets, Ospray) {
  expect_same("ospray", {}, [](double x, double y, double eye) {
    const double theta = 2.0 * kExactPi * x - kExactPi, phi = kExactPi * ((1.0 - y) - 0.5);
    const dvec3 d(std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi));
    return ExactRay{cross(d, dvec3(0, 1, 0)) * (0.0635 / 2.0 * eye), d};
  });
}

TEST(CameraPresets, Domemaster) {
  expect_same("domemaster", {{"parallax_distance", "2.5"}}, [](double x, double y, double eye) {
    const double azimuth = (2.0 * x - 1.0) * kExactPi, elevation = (1.0 - 2.0 * y) * kExactPi / 2.0;
    const dvec3 target(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                       -std::cos(azimuth) * std::cos(elevation));
    const dvec3 origin = dvec3(std::cos(azimuth), 0.0, std::sin(azimuth)) * (eye * 0.065 / 2.0);
    return ExactRay{origin, target * 2.5 - origin};
  });
}

TEST(CameraPresets, NerfstudioAndReplica) {
  const Formula tangent = [](double x, double y, double eye) {
    const double theta = (x - 0.5) * 2.0 * kExactPi, phi = (0.5 - y) * kExactPi;
    return ExactRay{dvec3(std::cos(theta), 0.0, std::sin(theta)) * (eye * 0.032),
                    {std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi)}};
  };
  expect_same("nerfstudio", {}, tangent);
  expect_same("replica360", {}, tangent);
}

TEST(CameraPresets, Mandelbulber) {
  expect_same("mandelbulber", {{"stereo_eye_distance", "0.05"}}, [](double x, double y, double eye) {
    const double theta = (x - 0.5) * 2.0 * kExactPi, phi = (0.5 - y) * kExactPi, row = y - 0.5;
    const dvec3 view(std::sin(theta) * std::cos(phi), std::sin(phi), -std::cos(theta) * std::cos(phi));
    const dvec3 side = dvec3(std::cos(theta), 0.0, std::sin(theta));
    return ExactRay{side * (eye * 0.05 * (1.0 - std::pow(2.0 * row, 10.0))), view};
  });
}

TEST(CameraPresets, AllStandAtTheirDefaults) {
  int exact = 0;
  for (const CameraPreset& preset : camera_presets()) {
    EXPECT_EQ(find_camera_preset(preset.name)->name, preset.name);
    EXPECT_FALSE(preset.note.empty());
    exact += preset.exact;
    const StereoCamera stereo = camera_like(preset, {});
    EXPECT_GT(stereo.ipd, 0.05f) << preset.name;
    EXPECT_LT(stereo.ipd, 0.21f) << preset.name;
    EXPECT_FALSE(stereo.mirrored) << preset.name;
    for (const PresetParameter& parameter : preset.parameters) {
      EXPECT_THROW(camera_like(preset, {{std::string(parameter.name), "cheese"}}), std::invalid_argument)
          << preset.name << ' ' << parameter.name;
    }
    EXPECT_THROW(camera_like(preset, {{"cheese", "1"}}), std::invalid_argument);
  }
  EXPECT_GE(exact, 9);
  EXPECT_EQ(find_camera_preset("cheese"), nullptr);
}

}  // namespace
}  // namespace ods
