// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/layers/film/film_geometry.h"

#include "ods/base/error.h"
#include "tests/layers/film/film_scene.h"

namespace ods::film_geometry_test {

using namespace film_scene;

// Every side that an eye sees in any of the frames is there; others are not.
TEST(FilmGeometry, HasEverySideThatEyesSee) {
  for (const bool is_double_sided : {false, true}) {
    Scene scene = playing(turning(is_double_sided).load());
    const std::vector<Mover> movers = find_movers(scene, kTimes);
    ASSERT_EQ(movers.size(), 1u);
    const FilmGeometry geometry = build_film(scene, movers, kTimes, small_box(), 1024);
    int fronts = 0, backs = 0;
    for_each_look(scene, kTimes, small_box(), [&](size_t frame, vec3 point, vec3 eye, bool faces) {
      EXPECT_EQ(spot_at(geometry.film, frame, point, eye).found, faces || is_double_sided);
      (faces ? fronts : backs)++;
    });
    EXPECT_GT(fronts, 500);
    EXPECT_GT(backs, 500);
  }
}

// A plate of two double-sided triangles that does not turn: the inner side of the second one faces the box behind the
// first one.
TEST(FilmGeometry, LeavesOutWhatIsHidden) {
  GltfBuilder file = turning(true);
  file.json["animations"][0]["channels"].erase(0);
  file.primitive()["attributes"]["POSITION"] = file.add<float>(
      {0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0, 0, 0, -5e-3f, 0.1f, 0, -5e-3f, 0, 0.1f, -5e-3f}, kFloat, "VEC3");
  file.primitive()["indices"] = file.add<uint16_t>({0, 1, 2, 3, 5, 4}, kUshort, "SCALAR");
  Scene scene = playing(file.load());
  const FilmGeometry plate = build_film(scene, find_movers(scene, kTimes), kTimes, small_box(), 1024);
  ASSERT_EQ(plate.triangles.size(), 1u);
  EXPECT_FALSE(plate.surfaces[plate.triangles[0].surface].is_back);
}

TEST(FilmGeometry, FollowsWhatDeforms) {
  const std::vector<double> times = {0.0, 0.5, 1.0, 1.5};
  Scene scene = playing(make_skinned(false).load());
  const HeadBox box{vec3(0.8f, 0.3f, 2.0f), vec3(0.4f)};
  const std::vector<Mover> movers = find_movers(scene, times);
  ASSERT_EQ(movers.size(), 1u);
  const FilmGeometry geometry = build_film(scene, movers, times, box, 512);
  int fronts = 0;
  for_each_look(scene, times, box, [&](size_t frame, vec3 point, vec3 eye, bool faces) {
    if (!faces) return;
    EXPECT_TRUE(spot_at(geometry.film, frame, point, eye).found) << frame;
    fronts++;
  });
  EXPECT_GT(fronts, 250);
}

// As sharp as the panorama where it comes nearest: a texel is as large as a pixel there, or smaller.
TEST(FilmGeometry, IsAsSharpAsThePanorama) {
  Scene scene = playing(turning(false).load());
  constexpr int kWidth = 1024;
  const FilmGeometry geometry = build_film(scene, find_movers(scene, kTimes), kTimes, small_box(), kWidth);
  for (const FilmTriangle& triangle : geometry.triangles) {
    const FilmSurface& surface = geometry.surfaces[triangle.surface];
    const float metres = length(surface.positions[triangle.corners.y] - surface.positions[triangle.corners.x]);
    const float texels = glm::length(triangle.at[1] - triangle.at[0]);
    EXPECT_LT(metres / texels, 1.6f * 6.2832f / kWidth);
    EXPECT_GT(metres / texels, 0.8f * 6.2832f / kWidth);
  }
  EXPECT_GT(geometry.texels.size(), 1000u);
}

TEST(FilmGeometry, RefusesWhatComesTooNear) {
  Scene scene = playing(turning(true).load());
  const std::vector<Mover> movers = find_movers(scene, kTimes);
  const HeadBox box{vec3(-0.2f, 0.1f, -1.3f), vec3(0.3f)};
  try {
    build_film(scene, movers, kTimes, box, 512);
    FAIL() << "it was built";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find("frames in which what moves"), std::string::npos) << error.what();
  }
}

}  // namespace ods::film_geometry_test
