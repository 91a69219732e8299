// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every projection against its definition in double precision, its inverse, and the whole camera through each of them.
#include "ods/camera/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ods/camera/stereo_camera.h"
#include "ods/kernel/camera/project.h"
#include "tests/support/exact_projection.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

TEST(Projections, AgreeWithTheirDefinitionsAndComeBack) {
  Dice dice(1);
  for (const ProjectionSetting& setting : many_settings(dice)) {
    ASSERT_EQ(projection_fault(setting), "");
    const Projection projection = make_projection(setting);
    for (int i = 0; i < 10000; i++) {
      const vec2 uv = dice.pair();
      if (has_image_circle(setting.kind) && !in_circle(setting, uv)) continue;
      const ViewDirection look = look_of(projection, uv, uv);
      const dvec3 exact = normalize(exact_direction(setting, uv));
      ASSERT_TRUE(look.seen);
      ASSERT_LT(angle_between(look.direction, exact), 1e-6 + rounding(setting, uv))
          << projection_name(setting) << ' ' << uv.x << ' ' << uv.y;
      ASSERT_NEAR(length(look.direction), 1.0f, 5e-7f);
      ASSERT_NEAR(look.elevation, std::asin(glm::clamp(exact.y, -1.0, 1.0)), 1e-3);
      const double level = std::hypot(exact.x, exact.z);
      if (level > 1e-3) {
        ASSERT_LT(length(dvec3(look.heading) - dvec3(exact.x, 0.0, exact.z) / level),
                  (2e-6 + rounding(setting, uv)) / level);
      }
      // Back: the place where the found direction lies looks that way again.
      const ImagePoint place = place_of(projection, look.direction * 3.0f);
      const vec2 inside = clamp(place.uv, vec2(0.0f), vec2(1.0f));
      ASSERT_LT(length(place.uv - inside), 1e-5f) << projection_name(setting) << ' ' << uv.x << ' ' << uv.y;
      ASSERT_LT(angle_between(exact, exact_direction(setting, place.uv)), 3e-6 + 2.0 * rounding(setting, uv))
          << projection_name(setting) << ' ' << uv.x << ' ' << uv.y;
    }
  }
}

// Compared with the area spanned by the exact directions around a place, divided by the area at another place in the
// picture.
TEST(Projections, SolidAnglesAreThoseOfTheirDirections) {
  Dice dice(3);
  for (const ProjectionSetting& setting : many_settings(dice)) {
    const Projection projection = make_projection(setting);
    const auto exact = [&](vec2 uv) {
      const double h = 1e-4;
      const auto at = [&](double u, double v) {
        return normalize(exact_direction(setting, vec2(static_cast<float>(u), static_cast<float>(v))));
      };
      const double u = double{uv.x}, v = double{uv.y};
      return length(cross(at(u + h, v) - at(u - h, v), at(u, v + h) - at(u, v - h)));
    };
    double first = 0.0;
    for (int i = 0; i < 300; i++) {
      const vec2 uv = vec2(0.02f) + 0.96f * dice.pair();
      if (has_image_circle(setting.kind) && !in_circle(setting, uv)) continue;
      const vec2 place = place_in_cell(setting.kind, uv, uv);
      if (is_cube(setting.kind) && max(abs(place.x), abs(place.y)) > 0.99f) continue;  // no difference over an edge
      const double ratio = exact(uv) / double{relative_solid_angle(projection, uv, uv)};
      if (first == 0.0) first = ratio;
      ASSERT_NEAR(ratio / first, 1.0, 2e-2)
          << "relative_solid_angle(): " << projection_name(setting) << ' ' << uv.x << ' ' << uv.y;
    }
  }
}

// Places outside are recognised: a visible place never has another direction.
TEST(Projections, KnowWhatTheyDoNotSee) {
  Dice dice(2);
  for (const ProjectionSetting& setting : many_settings(dice)) {
    const Projection projection = make_projection(setting);
    int seen = 0;
    for (int i = 0; i < 10000; i++) {
      const vec3 direction = normalize(vec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)));
      const ImagePoint place = place_of(projection, direction);
      if (!place.seen) continue;
      seen++;
      ASSERT_LT(angle_between(direction, exact_direction(setting, place.uv)), 3e-6 + rounding(setting, place.uv))
          << projection_name(setting);
    }
    EXPECT_GT(seen, 20) << projection_name(setting);
    const bool all =
        is_cube(setting.kind) || is_full_lat_long(setting) || (is_fisheye(setting.kind) && setting.fov == 360.0f);
    EXPECT_EQ(seen == 10000, all) << projection_name(setting);
  }
  const Projection half = make_projection(find_projection("vr180")->setting);
  EXPECT_FALSE(place_of(half, vec3(0.1f, 0.0f, 1.0f)).seen);
  EXPECT_TRUE(place_of(half, vec3(0.1f, 0.0f, -1.0f)).seen);
  const Projection dome = make_projection(find_projection("dome")->setting);
  EXPECT_FALSE(place_of(dome, vec3(0.0f, -0.1f, -1.0f)).seen);
  EXPECT_FALSE(look_of(dome, vec2(0.02f), vec2(0.02f)).seen);
  EXPECT_LT(length(look_of(dome, vec2(0.5f), vec2(0.5f)).direction - vec3(0, 1, 0)), 1e-6f);
}

// Cycles' equidistant lens is ours; known answers of its defaults, which come close to a lens of 50 mm.
TEST(Projections, APolynomialOfOneTermIsAFisheye) {
  ProjectionSetting lens = find_projection("fisheye-polynomial")->setting;
  lens.sensor = vec2(30.0f, 30.0f);
  lens.polynomial = {0.0f, -glm::radians(180.0f) / 30.0f, 0.0f, 0.0f, 0.0f};
  ASSERT_EQ(projection_fault(lens), "");
  const Projection one = make_projection(lens), other = make_projection(find_projection("fisheye")->setting);
  EXPECT_NEAR(one.circle.x, 1.0f, 1e-6f);
  Dice dice(9);
  for (int i = 0; i < 1000; i++) {
    const vec2 uv = dice.pair();
    if (length(uv - 0.5f) > 0.499f) continue;
    EXPECT_LT(angle_between(look_of(one, uv, uv).direction, look_of(other, uv, uv).direction), 1e-6);
  }
  const ProjectionSetting cycles = find_projection("fisheye-polynomial")->setting;
  EXPECT_EQ(natural_height(cycles, 3600), 2400);
  EXPECT_NEAR(pixels_per_radian(cycles, 3600.0), 3600.0 / 36.0 / 0.019988737, 1e-3);
  for (const float mm : {5.0f, 10.0f, 18.0f}) {
    const vec2 uv(0.5f + mm / 36.0f, 0.5f);
    const vec3 d = look_of(make_projection(cycles), uv, uv).direction;
    EXPECT_NEAR(std::atan2(d.x, -d.z), std::atan(mm / 50.0f), 4e-4f) << mm;
  }
}

TEST(Projections, APolynomialSeesHalfItsFieldOfView) {
  ProjectionSetting lens = find_projection("fisheye-polynomial")->setting;
  lens.fov = 20.0f;
  const Projection narrow = make_projection(lens);
  const auto off_axis = [](float degrees) {
    const float angle = glm::radians(degrees);
    return vec3(0.0f, std::sin(angle), -std::cos(angle));
  };
  EXPECT_TRUE(place_of(narrow, off_axis(9.99f)).seen);
  EXPECT_FALSE(place_of(narrow, off_axis(10.01f)).seen);
  EXPECT_TRUE(look_of(narrow, vec2(0.5f), vec2(0.5f)).seen);
  EXPECT_FALSE(look_of(narrow, vec2(0.99f, 0.5f), vec2(0.99f, 0.5f)).seen);
  EXPECT_FALSE(place_of(narrow, vec3(0.0f, 0.0f, 1.0f)).seen) << "behind it";
  EXPECT_EQ(place_of(narrow, vec3(0.0f, 0.0f, -1.0f)).uv, vec2(0.5f));
}

// A face that is pointed shows what the whole cube has there.
TEST(Projections, AnEacFaceIsACellOfEac) {
  const Projection eac = make_projection(find_projection("eac")->setting);
  ProjectionSetting setting = find_projection("eac-face")->setting;
  const vec2 middles[] = {{-90.0f, 0.0f}, {0.0f, 0.0f}, {90.0f, 0.0f}};
  Dice dice(8);
  for (int cell = 0; cell < 3; cell++) {
    setting.pan = middles[cell].x, setting.tilt = middles[cell].y;
    const Projection face = make_projection(setting);
    for (int i = 0; i < 1000; i++) {
      const vec2 uv = dice.pair(), whole((static_cast<float>(cell) + uv.x) / 3.0f, uv.y / 2.0f);
      EXPECT_LT(angle_between(look_of(face, uv, uv).direction, look_of(eac, whole, whole).direction), 2e-6);
    }
  }
  EXPECT_FALSE(place_of(make_projection(setting), vec3(-1.0f, 0.0f, 0.0f)).seen) << "behind it";
}

// A pixel filter reaches over a face's edge: the face continues there, the neighbour in the picture does not matter.
TEST(Projections, FacesGoOnBeyondTheirCells) {
  for (int kind = 0; kind < kProjectionCount; kind++) {
    if (!is_cube(kind)) continue;
    ProjectionSetting setting;
    setting.kind = kind;
    const Projection projection = make_projection(setting);
    const int columns = cube_columns(kind), rows = 6 / columns;
    const vec2 cell(1.0f / static_cast<float>(columns), 1.0f / static_cast<float>(rows));
    for (int i = 0; i < 6; i++) {
      const vec2 home = (vec2(i % columns, i / columns) + vec2(0.99f, 0.5f)) * cell;
      const vec3 in = look_of(projection, home, home).direction;
      const vec3 out = look_of(projection, home, home + vec2(0.02f, 0.0f) * cell).direction;
      EXPECT_NEAR(angle_between(in, out), 0.02 * kExactPi / (kind == kEac ? 2.0 : 4.0) * (kind == kEac ? 1.0 : 1.27),
                  1e-2);
      EXPECT_LT(angle_between(in, out), 0.05) << kind << ' ' << i;
    }
  }
}

// Seen from inside, no face is mirrored; and in the rows that players show as strips, neighbours share an edge.
TEST(Projections, FacesAreSeenFromInside) {
  for (int kind = 0; kind < kProjectionCount; kind++) {
    if (!is_cube(kind)) continue;
    for (int cell = 0; cell < 6; cell++) {
      const CubeFace face = cube_cell(kind, cell);
      EXPECT_EQ(cross(face.right, face.top), -face.middle) << kind << ' ' << cell;
    }
  }
  const auto joined = [](int kind, int cell) {
    const CubeFace left = cube_cell(kind, cell), right = cube_cell(kind, cell + 1);
    return left.right == right.middle && right.right == -left.middle && left.top == right.top;
  };
  for (int cell : {0, 1, 3, 4}) EXPECT_TRUE(joined(kEac, cell)) << cell;
  for (int cell : {3, 4}) EXPECT_TRUE(joined(kCube3x2, cell)) << cell;
}

// By reflection, as Cycles' mirrorball_to_direction() has it: the camera looks along -z, sees the ball at n, and what
// it sees there comes along the reflected ray. Seen from the ball the picture is not mirrored, and its middle looks
// ahead.
TEST(Projections, MirrorBallsReflect) {
  const Projection ball = make_projection(find_projection("mirror-ball")->setting);
  Dice dice(7);
  for (int i = 0; i < 10000; i++) {
    const vec2 uv = dice.pair();
    const dvec2 at(2.0 * double{uv.x} - 1.0, 1.0 - 2.0 * double{uv.y});
    if (length(at) > 0.999) continue;
    const dvec3 normal(at, -std::sqrt(1.0 - dot(at, at))), ahead(0.0, 0.0, -1.0);
    const dvec3 reflected = 2.0 * dot(normal, ahead) * normal - ahead;
    EXPECT_LT(angle_between(look_of(ball, uv, uv).direction, reflected), 6e-6);
    EXPECT_LT(length(dvec2(place_of(ball, vec3(reflected)).uv) - dvec2(uv)), 1e-6);
  }
  EXPECT_FALSE(look_of(ball, vec2(0.01f), vec2(0.01f)).seen);
  EXPECT_EQ(place_of(ball, vec3(0.0f, 0.0f, -1.0f)).uv, vec2(0.5f));
}

// Seen from the south pole of the unit sphere, on the plane of its equator. Small circles stay circles.
TEST(Projections, StereographicPicturesAreThoseOfASphereSeenFromItsPole) {
  ProjectionSetting setting = find_projection("fisheye-stereographic")->setting;
  const auto place = [&](vec3 d) { return dvec2(place_of(make_projection(setting), d).uv) * 2.0 - 1.0; };
  EXPECT_NEAR(place(vec3(1.0f, 0.0f, -std::sqrt(3.0f))).x, std::tan(kExactPi / 12.0), 1e-6) << "30 degrees off axis";
  setting.fov = 270.0f;
  Dice dice(9);
  for (int i = 0; i < 100; i++) {
    const dvec3 middle = turned(dvec3(0.0, 0.0, -1.0), dice.between(-1.0f, 1.0f), dice.between(-1.0f, 1.0f));
    const dvec3 side = normalize(cross(middle, dvec3(0.3, 1.0, 0.2))), other = cross(middle, side);
    const auto on_rim = [&](double turn) {
      return place(vec3(middle + 0.4 * (std::cos(turn) * side + std::sin(turn) * other)));
    };
    const dvec2 a = on_rim(0.0), b = on_rim(2.0), c = on_rim(4.0), d = on_rim(5.0);
    const auto square = [](dvec2 v) { return dot(v, v); };
    const double twice = 2.0 * (a.x * (b.y - c.y) + b.x * (c.y - a.y) + c.x * (a.y - b.y));
    const dvec2 center = dvec2(square(a) * (b.y - c.y) + square(b) * (c.y - a.y) + square(c) * (a.y - b.y),
                               square(a) * (c.x - b.x) + square(b) * (a.x - c.x) + square(c) * (b.x - a.x)) /
                         twice;
    EXPECT_NEAR(length(d - center), length(a - center), 1e-5);
  }
  setting.fov = 351.0f;
  EXPECT_NE(projection_fault(setting).find("350"), std::string::npos);
}

// Straight behind a lens is the rim of a whole circle, and nowhere in a smaller one.
TEST(Projections, StraightBehindIsOnTheRim) {
  for (const int kind : {kFisheye, kFisheyeEquisolid}) {
    ProjectionSetting setting;
    setting.kind = kind;
    setting.fov = 360.0f;
    const ImagePoint place = place_of(make_projection(setting), vec3(0.0f, 0.0f, 1.0f));
    EXPECT_NEAR(length(place.uv - 0.5f), 0.5f, 1e-6f) << kind;
    setting.fov = 180.0f;
    const ImagePoint outside = place_of(make_projection(setting), vec3(0.0f, 0.0f, 1.0f));
    EXPECT_FALSE(outside.seen) << kind;
    EXPECT_GT(length(outside.uv - 0.5f), 0.6f) << kind;
  }
}

// Places where formulas of lenses are most likely to go wrong.
TEST(Projections, StraightBehindIsSeenByWholePicturesOnly) {
  for (const NamedProjection& named : named_projections()) {
    const Projection projection = make_projection(named.setting);
    if (!has_lens(projection.kind)) continue;
    const bool is_whole = has_image_circle(projection.kind) && named.setting.fov > 359.0f;
    EXPECT_EQ(place_of(projection, projection.lens_back).seen, is_whole) << named.name;
  }
}

TEST(Projections, HaveNames) {
  for (const NamedProjection& named : named_projections()) {
    EXPECT_EQ(find_projection(named.name), &named);
    EXPECT_EQ(projection_name(named.setting), named.name);
    EXPECT_EQ(projection_fault(named.setting), "");
  }
  EXPECT_EQ(find_projection("mercator"), nullptr);
  for (int kind = 0; kind < kProjectionCount; kind++) {
    ProjectionSetting setting;
    setting.kind = kind;
    EXPECT_FALSE(projection_name(setting).empty()) << kind;
  }
}

TEST(Projections, HaveTheirNaturalHeight) {
  const auto height = [](const char* name, int width) { return natural_height(find_projection(name)->setting, width); };
  EXPECT_EQ(height("lat-long", 4096), 2048);
  EXPECT_EQ(height("vr180", 2048), 2048);
  EXPECT_EQ(height("fisheye", 1000), 1000);
  EXPECT_EQ(height("cube-3x2", 1536), 1024);
  EXPECT_EQ(height("cube-6x1", 1536 * 6), 1536);
  EXPECT_EQ(height("cube-1x6", 1536), 1536 * 6);
  EXPECT_EQ(height("eac", 3000), 2000);
  EXPECT_EQ(height("cylinder", 6283), 3464);  // 2 pi wide, 2 tan(60) high
}

TEST(Projections, FaultsAreReported) {
  for (auto spoil :
       {+[](ProjectionSetting& s) { s.longitude = vec2(10.0f, 10.0f); },
        +[](ProjectionSetting& s) { s.longitude = vec2(0.0f, 361.0f); },
        +[](ProjectionSetting& s) { s.latitude.y = 91.0f; },
        +[](ProjectionSetting& s) { s.latitude.x = std::nanf(""); }, +[](ProjectionSetting& s) { s.kind = kCylinder; },
        +[](ProjectionSetting& s) { s.kind = kFisheye, s.fov = 361.0f; },
        +[](ProjectionSetting& s) { s.kind = kPerspective; },
        +[](ProjectionSetting& s) { s.kind = kFisheyePolynomial, s.sensor.x = 0.0f; },
        +[](ProjectionSetting& s) { s.kind = kFisheyePolynomial, s.polynomial[0] = 0.1f; },
        +[](ProjectionSetting& s) { s.kind = kFisheyePolynomial, s.polynomial[1] = 0.02f; },
        +[](ProjectionSetting& s) { s.kind = kFisheyePolynomial, s.polynomial[3] = 3e-4f; },
        +[](ProjectionSetting& s) { s.kind = kFisheyePolynomial, s.polynomial[4] = std::nanf(""); },
        +[](ProjectionSetting& s) { s.kind = kPerspective, s.fov = 90.0f, s.aspect = 0.0f; }}) {
    ProjectionSetting setting;
    spoil(setting);
    EXPECT_NE(projection_fault(setting), "") << setting.kind;
  }
}

// --- the camera through them -----------------------------------------------------------------------------------------

TEST(Cameras, AgreeWithTheirTwinThroughEveryProjection) {
  Dice dice(3);
  for (int round = 0; round < 6; round++) {
    for (const ProjectionSetting& setting : many_settings(dice)) {
      const StereoCamera stereo = odd_rig(dice, setting, kConvergences[round % 3]);
      ASSERT_NO_FATAL_FAILURE(expect_exact_rays(stereo, 500, 6e-7, dice));
    }
  }
}

TEST(Cameras, FindTheRayThatMeetsAPointThroughEveryProjection) {
  Dice dice(4);
  for (int round = 0; round < 6; round++) {
    for (const ProjectionSetting& setting : many_settings(dice)) {
      StereoCamera stereo = odd_rig(dice, setting, kConvergences[round % 3]);
      if (round < 3) stereo.neck = 0.0f, stereo.top = stereo.bottom = PoleMergeSetting();
      const Camera camera = make_camera(stereo);
      for (int i = 0; i < 300; i++) {
        const vec2 uv = dice.pair();
        if (has_image_circle(setting.kind) && !in_circle(setting, uv)) continue;
        const int eye = i % 3;
        const Ray ray = camera_ray(camera, eye, uv);
        const vec3 a = stereo.axis ? vec3(0, 1, 0) : camera.up;
        const float level = length(cross(ray.direction, a));
        if (level < 0.05f) continue;  // near the axis a rounded point has another heading
        const float t = std::exp(dice.between(std::log(0.5f), std::log(100.0f)));
        const ImagePosition found = project_point(camera, eye, ray.origin + t * ray.direction);
        ASSERT_NEAR(found.depth, t, t * 2e-5f) << projection_name(setting) << ' ' << stereo.convergence;
        const double error = angle_between(exact_direction(setting, found.uv), exact_direction(setting, uv));
        ASSERT_LT(error, 1e-5 / double{level}) << projection_name(setting) << ' ' << stereo.convergence << ' ' << t;
      }
    }
  }
}

// The closed forms of the two ways to put a point at the distance C on the same place of both pictures.
TEST(Cameras, ConvergeAtTheirDistance) {
  for (int convergence : {kToeIn, kShift}) {
    StereoCamera stereo;
    stereo.convergence = convergence;
    stereo.convergence_distance = 1.5f;
    const Camera camera = make_camera(stereo);
    for (double azimuth : {0.0, 1.0, -2.5}) {
      const auto at = [&](double distance) {
        return vec3(dvec3(std::sin(azimuth), 0.0, -std::cos(azimuth)) * distance);
      };
      const vec3 near = at(1.5);
      EXPECT_NEAR(project_point(camera, kLeft, near).uv.x, project_point(camera, kRight, near).uv.x, 1e-6f);
      EXPECT_NEAR(project_point(camera, kLeft, near).uv.x, 0.5 + azimuth / (2.0 * kExactPi), 1e-6);
      // theta = alpha - e (asin(r / (rho sqrt(1 + (r/C)^2))) - atan(r/C)), or with asin(r/C) for the shift.
      const double r = 0.0325, c = 1.5, rho = 0.7;
      double turn = std::asin(r / rho) - std::asin(r / c);
      if (convergence == kToeIn) turn = std::asin(r / (rho * std::sqrt(1.0 + r * r / (c * c)))) - std::atan(r / c);
      EXPECT_NEAR(project_point(camera, kLeft, at(rho)).uv.x, 0.5 + (azimuth + turn) / (2.0 * kExactPi), 1e-6);
      EXPECT_NEAR(project_point(camera, kRight, at(rho)).uv.x, 0.5 + (azimuth - turn) / (2.0 * kExactPi), 1e-6);
    }
  }
}

TEST(Cameras, LensesFocusAtTheirDistance) {
  StereoCamera stereo;
  stereo.lens_radius = 0.02f;
  stereo.focus_distance = 3.0f;
  const Camera camera = make_camera(stereo);
  Dice dice(5);
  for (int i = 0; i < 1000; i++) {
    const vec2 uv = dice.pair();
    const Ray chief = camera_ray(camera, kRight, uv);
    const Ray ray = camera_ray(camera, kRight, uv, uv, dice.pair());
    const vec3 focus = chief.origin + 3.0f * chief.direction;
    EXPECT_LT(length(cross(focus - ray.origin, ray.direction)), 2e-6f);
    EXPECT_LT(length(ray.origin - chief.origin), 0.0200001f);
    EXPECT_NEAR(dot(ray.origin - chief.origin, chief.direction), 0.0f, 1e-7f);
  }
}

// The picture is 1 above, 0 below, with a step of two texels between.
TEST(Cameras, MergeMapsScaleTheCircle) {
  auto map = std::make_shared<Image>(8, 4, 1);
  for (int y = 0; y < 4; y++) {
    for (int x = 0; x < 8; x++) *map->at(x, y) = y < 2 ? 1.0f : 0.25f;
  }
  StereoCamera stereo;
  stereo.top.mode = stereo.bottom.mode = kMergeMap;
  stereo.merge_map = map;
  const Camera camera = make_camera(stereo);
  EXPECT_NEAR(length(camera_ray(camera, kLeft, vec2(0.3f, 0.1f)).origin), 0.0325f, 1e-7f);
  EXPECT_NEAR(length(camera_ray(camera, kLeft, vec2(0.3f, 0.9f)).origin), 0.0325f * 0.25f, 1e-7f);
  EXPECT_NEAR(length(camera_ray(camera, kLeft, vec2(0.99f, 0.5f)).origin), 0.0325f * 0.625f, 1e-7f);
  Dice dice(6);
  for (int i = 0; i < 1000; i++) {
    const vec2 uv(dice.next(), dice.between(0.05f, 0.95f));
    const Ray ray = camera_ray(camera, kLeft, uv);
    const ImagePosition found = project_point(camera, kLeft, ray.origin + 1.3f * ray.direction);
    EXPECT_LT(std::abs(std::remainder(found.uv.x - uv.x, 1.0f)), 1e-5f);
    EXPECT_NEAR(found.uv.y, uv.y, 1e-5f);
  }
}

// Every kind is one of these, and none is two: what is not known is not silently a cube.
TEST(Projection, EveryKindIsOfOneFamily) {
  for (int kind = 0; kind < kProjectionCount; kind++) {
    EXPECT_EQ(int{has_range(kind)} + int{has_lens(kind)} + int{is_cube(kind)}, 1) << kind;
    EXPECT_EQ(has_image_circle(kind), kind == kFisheye || kind == kFisheyeEquisolid || kind == kFisheyeStereographic ||
                                          kind == kFisheyePolynomial)
        << kind;
    EXPECT_EQ(std::count_if(named_projections().begin(), named_projections().end(),
                            [&](const NamedProjection& named) { return named.setting.kind == kind; }) > 0,
              true)
        << kind;
  }
  for (const int unknown : {kProjectionCount, -1, 1000}) {
    EXPECT_FALSE(has_range(unknown) || has_lens(unknown) || is_cube(unknown)) << unknown;
    ProjectionSetting setting;
    Projection projection = make_projection(setting);
    projection.kind = setting.kind = unknown;
    EXPECT_FALSE(look_of(projection, vec2(0.5f), vec2(0.5f)).seen);
    EXPECT_FALSE(place_of(projection, vec3(0.0f, 0.0f, -1.0f)).seen);
    EXPECT_EQ(width_step(setting), 1);
  }
}

}  // namespace
}  // namespace ods
