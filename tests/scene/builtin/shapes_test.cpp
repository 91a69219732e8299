// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/shape_checks.h"

namespace ods {
namespace {

struct NamedShape {
  const char* name;
  Shape shape;
  double volume;  // of the exact solid; 0: not closed, or not known
  double error;   // share that flat triangles may lose
};

std::vector<NamedShape> all_shapes() {
  const double pi = std::numbers::pi;
  const double r = 0.2, a = 1 - 2 * r, b = 2 - 2 * r, c = 3 - 2 * r;
  const double rounded =
      a * b * c + 2 * r * (a * b + b * c + c * a) + pi * r * r * (a + b + c) + 4 * pi * r * r * r / 3;
  std::vector<NamedShape> shapes;
  shapes.push_back({"quad", make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 2, 0)), 0, 0});
  shapes.push_back({"floor", make_floor(2, 3), 0, 0});
  shapes.push_back({"disc", make_disc(1, 24), 0, 0});
  shapes.push_back({"box", make_box(vec3(1, 2, 3)), 6, 1e-6});
  shapes.push_back({"rounded box", make_rounded_box(vec3(1, 2, 3), 0.2f, 4), rounded, 0.002});
  shapes.push_back({"cylinder", make_cylinder(0.5f, 2, 96), pi * 0.5, 0.002});
  shapes.push_back({"cone", make_cone(0.5f, 2, 96), pi * 0.5 / 3, 0.002});
  shapes.push_back({"sphere", make_sphere(1, 96), 4 * pi / 3, 0.003});
  shapes.push_back({"torus", make_torus(1, 0.25f, 96, 48), pi * pi / 8, 0.005});
  shapes.push_back({"tube", make_tube({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, 0.1f, 96), pi * 0.02, 0.002});
  shapes.push_back({"prism", make_prism({{0, 0}, {2, 0}, {0, 1}}, 3), 3, 1e-6});
  shapes.push_back({"cushion", make_cushion(vec3(0.5f, 0.2f, 0.5f), 16), 0, 0});
  shapes.push_back({"inside out twice", inside_out(inside_out(make_box(vec3(1)))), 1, 1e-6});
  shapes.push_back({"mirrored", transformed(make_box(vec3(1)), glm::mat4(glm::mat3(-2.0f))), 8, 1e-6});
  return shapes;
}

TEST(Shapes, CornersNormalsAndWindingAgree) {
  for (const NamedShape& s : all_shapes()) {
    SCOPED_TRACE(s.name);
    expect_sound(s.shape.vertices, s.shape.triangles);
  }
}

TEST(Shapes, SolidsAreClosedAndHaveTheirVolume) {
  for (const NamedShape& s : all_shapes()) {
    if (s.volume == 0) continue;
    SCOPED_TRACE(s.name);
    EXPECT_EQ(open_edges(s.shape.vertices, s.shape.triangles), 0);
    EXPECT_NEAR(enclosed_volume(s.shape.vertices, s.shape.triangles) / s.volume, 1.0, s.error);
  }
}

TEST(Shapes, OpenEdgesAreCounted) {
  const Shape quad = make_floor(2, 3);
  EXPECT_EQ(open_edges(quad.vertices, quad.triangles), 4);
  const Shape cushion = make_cushion(vec3(0.5f, 0.2f, 0.5f), 16);
  EXPECT_EQ(open_edges(cushion.vertices, cushion.triangles), 0);
}

TEST(Shapes, SphereNormalsAreExact) {
  for (const Vertex& v : make_sphere(2, 32).vertices) {
    EXPECT_NEAR(length(v.normal - v.position / 2.0f), 0.0f, 1e-6f);
  }
}

TEST(Shapes, TextureCoordinatesAreMetres) {
  vec2 largest(0);
  for (const Vertex& v : make_box(vec3(1, 2, 3)).vertices) {
    EXPECT_GE(min(v.uv0.x, v.uv0.y), 0.0f);
    largest = max(largest, v.uv0);
  }
  EXPECT_EQ(largest, vec2(3, 3));
}

TEST(Shapes, SmoothProfilePassesThroughItsPoints) {
  const std::vector<vec2> points = {{0, 0}, {1, 0.5f}, {0.5f, 2}, {0, 3}};
  const std::vector<vec2> curve = smooth_profile(points, 5);
  ASSERT_EQ(curve.size(), 16u);
  for (size_t i = 0; i < points.size(); i++) EXPECT_EQ(curve[5 * i], points[i]);
}

TEST(Shapes, EveryLetterHasStrokesInsideItsBox) {
  for (const char letter : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.")) {
    SCOPED_TRACE(letter);
    const Shape shape = make_text(std::string(1, letter), 1.0f, 0.1f);
    expect_sound(shape.vertices, shape.triangles);
    for (const Vertex& v : shape.vertices) EXPECT_LT(max(abs(v.position.x), abs(v.position.y)), 0.56f);
  }
  EXPECT_TRUE(make_text(" ?", 1.0f, 0.1f).triangles.empty());
}

}  // namespace
}  // namespace ods
