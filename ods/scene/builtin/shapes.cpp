// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/shapes.h"

#include <cassert>
#include <glm/gtc/matrix_inverse.hpp>
#include <utility>

#include "ods/image/stroke_font.h"
#include "ods/kernel/camera/camera.h"

namespace ods {

static uint add_vertex(Shape& shape, vec3 position, vec3 normal, vec2 uv) {
  shape.vertices.push_back({position, normal, vec4(0.0f, 0.0f, 0.0f, 1.0f), uv, vec2(0.0f), vec4(1.0f)});
  return static_cast<uint>(shape.vertices.size()) - 1;
}

// A grid of (columns + 1) x (rows + 1) vertices from first on, rows upwards, as quads of two triangles.
static void add_grid_triangles(Shape& shape, uint first, uint columns, uint rows) {
  const uint stride = columns + 1;
  for (uint j = 0; j < rows; j++) {
    for (uint i = 0; i < columns; i++) {
      const uint a = first + j * stride + i;
      shape.triangles.push_back({a, a + 1, a + stride + 1});
      shape.triangles.push_back({a, a + stride + 1, a + stride});
    }
  }
}

void append(Shape& shape, const Shape& other) {
  const uint first = static_cast<uint>(shape.vertices.size());
  shape.vertices.insert(shape.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const uvec3& t : other.triangles) shape.triangles.push_back(t + uvec3(first));
}

static void turn_winding(Shape& shape) {
  for (uvec3& t : shape.triangles) std::swap(t.y, t.z);
}

Shape transformed(Shape shape, const glm::mat4& matrix) {
  const glm::mat3 linear(matrix);
  assert(glm::determinant(linear) != 0.0f);
  const glm::mat3 for_normals = glm::inverseTranspose(linear);
  for (Vertex& v : shape.vertices) {
    v.position = vec3(matrix * vec4(v.position, 1.0f));
    v.normal = normalize(for_normals * v.normal);
  }
  if (glm::determinant(linear) < 0.0f) turn_winding(shape);
  return shape;
}

Shape inside_out(Shape shape) {
  for (Vertex& v : shape.vertices) v.normal = -v.normal;
  turn_winding(shape);
  return shape;
}

Shape mapped_from_above(Shape shape) {
  for (Vertex& v : shape.vertices) v.uv0 = vec2(v.position.x, v.position.z);
  return shape;
}

Shape make_quad(vec3 corner, vec3 right, vec3 up) {
  Shape shape;
  const vec3 normal = normalize(cross(right, up));
  const float width = length(right), height = length(up);
  add_vertex(shape, corner, normal, vec2(0.0f, height));
  add_vertex(shape, corner + right, normal, vec2(width, height));
  add_vertex(shape, corner + up, normal, vec2(0.0f));
  add_vertex(shape, corner + right + up, normal, vec2(width, 0.0f));
  add_grid_triangles(shape, 0, 1, 1);
  return shape;
}

Shape make_floor(float width, float depth) {
  return make_quad(vec3(-0.5f * width, 0.0f, 0.5f * depth), vec3(width, 0.0f, 0.0f), vec3(0.0f, 0.0f, -depth));
}

// The six sides of a box as (to the right, upwards) seen from outside.
static const vec3 kSides[6][2] = {
    {{0, 0, -1}, {0, 1, 0}}, {{0, 0, 1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, -1}},
    {{1, 0, 0}, {0, 0, 1}},  {{1, 0, 0}, {0, 1, 0}}, {{-1, 0, 0}, {0, 1, 0}},
};

Shape make_box(vec3 size) {
  Shape shape;
  const vec3 half = 0.5f * size;
  for (const auto& side : kSides) {
    const vec3 right = side[0], up = side[1], out = cross(right, up);
    append(shape, make_quad((out - right - up) * half, right * size, up * size));
  }
  return shape;
}

Shape make_rounded_box(vec3 size, float radius, int steps) {
  assert(radius > 0.0f && steps >= 1);
  const vec3 inner = max(0.5f * size - vec3(radius), vec3(0.0f));
  Shape shape;
  const int line = 2 * (steps + 1);
  // For each direction of a side: from the middle of one rounded edge to the flat part, across it, and out again.
  const auto lean = [&](int i) {
    return i <= steps ? -tan(0.25f * kPi * float(steps - i) / float(steps))
                      : tan(0.25f * kPi * float(i - steps - 1) / float(steps));
  };
  for (const auto& side : kSides) {
    const vec3 right = side[0], up = side[1], out = cross(right, up);
    const uint first = static_cast<uint>(shape.vertices.size());
    for (int j = 0; j < line; j++) {
      for (int i = 0; i < line; i++) {
        const vec3 normal = normalize(out + lean(i) * right + lean(j) * up);
        const vec3 corner = out + (i <= steps ? -right : right) + (j <= steps ? -up : up);
        const vec3 position = corner * inner + radius * normal;
        const vec3 from_corner = position - 0.5f * (out - right - up) * size;
        const vec2 uv(dot(from_corner, right), dot(abs(up), size) - dot(from_corner, up));
        add_vertex(shape, position, normal, uv);
      }
    }
    add_grid_triangles(shape, first, static_cast<uint>(line - 1), static_cast<uint>(line - 1));
  }
  return shape;
}

static vec2 outward(vec2 a, vec2 b) {
  return normalize(vec2(b.y - a.y, a.x - b.x));
}

// One ring of quads, or of triangles where one end is on the axis.
static void add_band(Shape& shape, const vec2 ends[2], const vec2 normals[2], const float v[2], float u_scale,
                     int segments) {
  const uint first = static_cast<uint>(shape.vertices.size());
  for (int i = 0; i <= segments; i++) {
    const float angle = 2.0f * kPi * float(i % segments) / float(segments);
    const float u = u_scale * float(i) / float(segments);
    for (int k = 0; k < 2; k++) {
      const vec3 around(sin(angle), 0.0f, cos(angle));
      add_vertex(shape, ends[k].x * around + vec3(0.0f, ends[k].y, 0.0f),
                 normals[k].x * around + vec3(0.0f, normals[k].y, 0.0f), vec2(u, v[k]));
    }
  }
  for (uint i = 0; i < static_cast<uint>(segments); i++) {
    const uint a = first + 2 * i;
    if (ends[0].x > 0.0f) shape.triangles.push_back({a, a + 2, a + 3});
    if (ends[1].x > 0.0f) shape.triangles.push_back({a, a + 3, a + 1});
  }
}

Shape make_lathe(const std::vector<vec2>& profile, int segments) {
  assert(profile.size() >= 2 && segments >= 3);
  const size_t bands = profile.size() - 1;
  const bool ring = profile.front() == profile.back();
  float widest = 0.0f, total = 0.0f;
  for (size_t i = 0; i < profile.size(); i++) {
    widest = max(widest, profile[i].x);
    if (i > 0) total += glm::distance(profile[i - 1], profile[i]);
  }
  const auto band_normal = [&](size_t i) { return outward(profile[i], profile[i + 1]); };
  const auto shared = [](vec2 own, vec2 neighbour) {
    return dot(own, neighbour) > 0.766f ? normalize(own + neighbour) : own;
  };
  Shape shape;
  float along = 0.0f;
  for (size_t i = 0; i < bands; i++) {
    const vec2 own = band_normal(i);
    const vec2 ends[2] = {profile[i], profile[i + 1]};
    vec2 normals[2] = {own, own};
    if (i > 0 || ring) normals[0] = shared(own, band_normal(i > 0 ? i - 1 : bands - 1));
    if (i + 1 < bands || ring) normals[1] = shared(own, band_normal(i + 1 < bands ? i + 1 : 0));
    const float next = along + glm::distance(ends[0], ends[1]);
    const float v[2] = {total - along, total - next};
    add_band(shape, ends, normals, v, 2.0f * kPi * widest, segments);
    along = next;
  }
  return shape;
}

std::vector<vec2> smooth_profile(const std::vector<vec2>& points, int steps) {
  std::vector<vec2> curve;
  for (size_t i = 0; i + 1 < points.size(); i++) {
    const vec2 b = points[i], c = points[i + 1];
    const vec2 a = i > 0 ? points[i - 1] : b, d = i + 2 < points.size() ? points[i + 2] : c;
    for (int k = 0; k < steps; k++) {
      const float t = float(k) / float(steps);
      vec2 p = b + 0.5f * t * (c - a + t * (2.0f * a - 5.0f * b + 4.0f * c - d + t * (3.0f * (b - c) + d - a)));
      p.x = max(p.x, 0.0f);
      curve.push_back(p);
    }
  }
  curve.push_back(points.back());
  return curve;
}

Shape make_disc(float radius, int segments) {
  return make_lathe({{radius, 0.0f}, {0.0f, 0.0f}}, segments);
}

Shape make_cylinder(float radius, float height, int segments) {
  const float h = 0.5f * height;
  return make_lathe({{0.0f, -h}, {radius, -h}, {radius, h}, {0.0f, h}}, segments);
}

Shape make_cone(float radius, float height, int segments) {
  return make_lathe({{0.0f, 0.0f}, {radius, 0.0f}, {0.0f, height}}, segments);
}

Shape make_sphere(float radius, int segments) {
  std::vector<vec2> profile;
  const int rings = max(segments / 2, 2);
  for (int i = 0; i <= rings; i++) {
    const float angle = kPi * float(i) / float(rings);
    const bool pole = i == 0 || i == rings;
    profile.push_back(radius * vec2(pole ? 0.0f : sin(angle), -cos(angle)));
  }
  Shape shape = make_lathe(profile, segments);
  for (Vertex& v : shape.vertices) v.normal = normalize(v.position);
  return shape;
}

Shape make_torus(float radius, float tube, int segments, int around) {
  assert(radius > tube);
  std::vector<vec2> profile;
  for (int i = 0; i <= around; i++) {
    const float angle = 2.0f * kPi * float(i % around) / float(around);
    profile.push_back(vec2(radius, 0.0f) + tube * vec2(cos(angle), sin(angle)));
  }
  return make_lathe(profile, segments);
}

Shape make_tube(const std::vector<vec3>& path, float radius, int segments) {
  assert(path.size() >= 2);
  Shape shape;
  const size_t last = path.size() - 1;
  const auto heading = [&](size_t i) { return normalize(path[min(i + 1, last)] - path[i > 0 ? i - 1 : 0]); };
  const vec3 start = heading(0);
  vec3 side = normalize(cross(start, abs(start.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  float along = 0.0f;
  for (size_t i = 0; i <= last; i++) {
    const vec3 ahead = heading(i);
    side = normalize(side - dot(side, ahead) * ahead);  // parallel transport, so that the rod does not twist
    if (i > 0) along += glm::distance(path[i], path[i - 1]);
    for (int k = 0; k <= segments; k++) {
      const float angle = 2.0f * kPi * float(k % segments) / float(segments);
      const vec3 normal = cos(angle) * side + sin(angle) * cross(ahead, side);
      add_vertex(shape, path[i] + radius * normal, normal, vec2(radius * angle, along));
    }
  }
  add_grid_triangles(shape, 0, static_cast<uint>(segments), static_cast<uint>(last));
  const uint rim = static_cast<uint>(segments) + 1;
  for (uint end = 0; end < 2; end++) {
    const uint ring = end == 0 ? 0 : static_cast<uint>(last) * rim;
    const vec3 normal = end == 0 ? -heading(0) : heading(last);
    const uint middle = add_vertex(shape, path[end == 0 ? 0 : last], normal, vec2(0.0f));
    for (uint k = 0; k < rim; k++) add_vertex(shape, shape.vertices[ring + k].position, normal, vec2(0.0f));
    for (uint k = 0; k + 1 < rim; k++) {
      const uint a = middle + 1 + k, b = a + 1;
      shape.triangles.push_back(end == 0 ? uvec3(middle, b, a) : uvec3(middle, a, b));
    }
  }
  return shape;
}

Shape make_prism(const std::vector<vec2>& polygon, float depth) {
  assert(polygon.size() >= 3);
  Shape shape;
  const float z = 0.5f * depth;
  const uint count = static_cast<uint>(polygon.size());
  for (int side = 0; side < 2; side++) {
    const float sign = side == 0 ? 1.0f : -1.0f;
    const uint first = static_cast<uint>(shape.vertices.size());
    for (const vec2 p : polygon) add_vertex(shape, vec3(p, sign * z), vec3(0, 0, sign), vec2(sign * p.x, -p.y));
    for (uint i = 1; i + 1 < count; i++) {
      shape.triangles.push_back(side == 0 ? first + uvec3(0, i, i + 1) : first + uvec3(0, i + 1, i));
    }
  }
  for (uint i = 0; i < count; i++) {
    const vec3 a(polygon[i], z), b(polygon[(i + 1) % count], z);
    append(shape, make_quad(a, vec3(0, 0, -depth), b - a));
  }
  return shape;
}

Shape make_surface(int columns, int rows, vec2 size, const std::function<vec3(float s, float t)>& position) {
  Shape shape;
  for (int j = 0; j <= rows; j++) {
    for (int i = 0; i <= columns; i++) {
      const float s = float(i) / float(columns), t = float(j) / float(rows);
      const float ds = 0.02f / float(columns), dt = 0.02f / float(rows);
      const vec3 along_s = position(min(s + ds, 1.0f), t) - position(max(s - ds, 0.0f), t);
      const vec3 along_t = position(s, min(t + dt, 1.0f)) - position(s, max(t - dt, 0.0f));
      add_vertex(shape, position(s, t), normalize(cross(along_s, along_t)), vec2(s, 1.0f - t) * size);
    }
  }
  add_grid_triangles(shape, 0, static_cast<uint>(columns), static_cast<uint>(rows));
  return shape;
}

Shape make_text(const std::string& text, float height, float stroke) {
  const float unit = (height - stroke) / 6.0f;
  Shape shape;
  for (const Stroke& line : text_strokes(text)) {
    const vec2 from = unit * line.from, to = unit * line.to;
    const vec2 along = normalize(to - from);
    glm::mat4 turn(1.0f);
    turn[0] = vec4(along, 0.0f, 0.0f);
    turn[1] = vec4(-along.y, along.x, 0.0f, 0.0f);
    turn[3] = vec4(0.5f * (from + to), 0.0f, 1.0f);
    append(shape, transformed(make_box(vec3(glm::distance(from, to) + stroke, stroke, stroke)), turn));
  }
  return shape;
}

Shape make_cushion(vec3 size, int columns) {
  const vec2 extent(size.x, size.z);
  const auto puffed = [&](float side) {
    return [size, side](float s, float t) {
      const float x = 2.0f * s - 1.0f, z = 1.0f - 2.0f * t;
      const float full = pow(max((1.0f - x * x) * (1.0f - z * z), 0.0f), 0.4f);
      // The seam is pulled in along the sides, so the corners stick out.
      const float pull_x = 1.0f - 0.08f * (1.0f - z * z), pull_z = 1.0f - 0.08f * (1.0f - x * x);
      return 0.5f * size * vec3(x * pull_x, side * full, z * pull_z);
    };
  };
  // At corners the tangents are parallel; a normal straight up or down is good enough there.
  Shape shape;
  for (const float side : {1.0f, -1.0f}) {
    Shape half = make_surface(columns, columns, extent, puffed(side));
    if (side < 0.0f) half = inside_out(half);
    append(shape, half);
  }
  return shape;
}

}  // namespace ods
