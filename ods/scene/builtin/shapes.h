// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Basic shapes for scenes made in code.
//
// Metres, right-handed, +Y up. Triangles are counter-clockwise seen from outside, and normals are unit vectors pointing
// outwards. Texture coordinates are also in metres, u to the right and v down as seen from outside, so one texture
// repeats at the same size on everything (textured() in ods/scene/builtin/builder.h sets that size). Shapes are centred
// at the origin unless stated otherwise. "Closed" means that every edge belongs to exactly two triangles.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

struct Shape {
  std::vector<Vertex> vertices;
  std::vector<uvec3> triangles;
};

// Appends other to shape.
void append(Shape& shape, const Shape& other);

// The transformed shape; a mirroring matrix also flips the winding. Precondition: the matrix is invertible.
Shape transformed(Shape shape, const glm::mat4& matrix);

// The same surface facing the other way.
Shape inside_out(Shape shape);

// The same shape with texture coordinates projected from above: u along x, v along z.
Shape mapped_from_above(Shape shape);

// A rectangle: corner, then its edges to the right and upwards, which need not be perpendicular.
Shape make_quad(vec3 corner, vec3 right, vec3 up);

// A horizontal rectangle facing +Y, x by z.
Shape make_floor(float width, float depth);

// A closed box.
Shape make_box(vec3 size);

// A box with edges and corners rounded at this radius, in `steps` flat parts per 45 degrees. Closed. Precondition: 0 <
// radius <= half of every side, steps >= 1.
Shape make_rounded_box(vec3 size, float radius, int steps = 1);

// The surface of revolution around +Y of a profile of (radius, height). The outside lies to the right of the profile's
// direction: upwards at a positive radius faces outwards. Normals are smooth where the profile turns by less than 40
// degrees. Closed when the profile starts and ends on the axis, or ends where it starts.
// Precondition: two or more points, radius >= 0, no two neighbours equal, segments >= 3.
Shape make_lathe(const std::vector<vec2>& profile, int segments);

// A Catmull-Rom curve through all points, `steps` parts between neighbours; radii stay >= 0.
std::vector<vec2> smooth_profile(const std::vector<vec2>& points, int steps);

Shape make_disc(float radius, int segments);                    // faces +Y
Shape make_cylinder(float radius, float height, int segments);  // along Y, closed
Shape make_cone(float radius, float height, int segments);      // base at y = 0, closed
Shape make_sphere(float radius, int segments);                  // segments / 2 rings, exact normals, closed
Shape make_torus(float radius, float tube, int segments,
                 int around);  // around Y; `around` segments around the tube; closed

// A round rod along a path, with flat ends. Closed. Precondition: two or more points, no equal neighbours, no U-turns.
Shape make_tube(const std::vector<vec3>& path, float radius, int segments);

// A polygon (counter-clockwise, in x and y) whose first corner sees all others, extruded from -depth/2 to depth/2 along
// z. Closed, sharp edges.
Shape make_prism(const std::vector<vec2>& polygon, float depth);

// Any surface position(s, t), s and t in 0..1, of columns by rows quads; it faces cross(d/ds, d/dt).
// Texture coordinates are (s * size.x, (1 - t) * size.y).
Shape make_surface(int columns, int rows, vec2 size, const std::function<vec3(float s, float t)>& position);

// One line of text (ods/image/stroke_font.h) made of bars, centred, read from +Z, `height` tall,
// strokes `stroke` thick.
Shape make_text(const std::string& text, float height, float stroke);

// Two surfaces that meet in a seam at |x| = size.x / 2 and |z| = size.z / 2, like a filled cushion. Closed.
Shape make_cushion(vec3 size, int columns);

}  // namespace ods
