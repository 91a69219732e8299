// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds the triangle in a direction: the directions are sorted into the cells of a grid on each face of a cube.
#include <algorithm>
#include <cmath>

#include "ods/camera/direction_map.h"

namespace ods {

constexpr size_t kMaxVertices = 200000;  // cameras write 40x40

std::string mesh_fault(const TextureMesh& mesh) {
  if (mesh.vertices.empty() || mesh.triangles.empty()) return "its mesh has no triangle";
  if (mesh.vertices.size() > kMaxVertices || mesh.triangles.size() > 2 * kMaxVertices) {
    return "its mesh has more than 200000 vertices or 400000 triangles";
  }
  for (const TextureMesh::Vertex& vertex : mesh.vertices) {
    const vec3 p = vertex.position;
    const float size = dot(p, p) + dot(vertex.uv, vertex.uv);
    if (!std::isfinite(size)) return "its mesh has numbers that are NaN or infinite";
  }
  for (const auto& triangle : mesh.triangles) {
    for (const uint32_t index : triangle) {
      if (index >= mesh.vertices.size()) return "its mesh has a triangle without a vertex";
    }
  }
  return {};
}

bool is_front_half(const TextureMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const TextureMesh::Vertex& vertex) {
    const float kBehind = 0.2f;  // lenses of VR180 cameras see slightly more than a half
    return vertex.position.z <= kBehind * length(vertex.position);
  });
}

namespace {

using Point = glm::dvec3;

// A frame in which a face of the cube is at z = 1, with x and y from -1 to 1 on it.
Point on_face(int face, const Point& p) {
  const int axis = face / 2;
  const double side = face % 2 == 0 ? 1.0 : -1.0;
  return {p[(axis + 1) % 3], p[(axis + 2) % 3], side * p[axis]};
}

int face_of(const Point& p) {
  int axis = 0;
  for (int i = 1; i < 3; i++) {
    if (std::abs(p[i]) > std::abs(p[axis])) axis = i;
  }
  return 2 * axis + (p[axis] < 0.0 ? 1 : 0);
}

// The part of a polygon on the inner side of a plane through the origin.
std::vector<Point> clip(const std::vector<Point>& polygon, const Point& normal) {
  std::vector<Point> kept;
  for (size_t i = 0; i < polygon.size(); i++) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(normal, a), db = glm::dot(normal, b);
    if (da >= 0.0) kept.push_back(a);
    if ((da >= 0.0) != (db >= 0.0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

// Cells on one face, from low to high. Empty if the triangle is not on it.
struct CellRange {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
};

class MeshMap final : public DirectionMap {
 public:
  explicit MeshMap(const TextureMesh& mesh) {
    for (const auto& triangle : mesh.triangles) {
      Triangle& made = triangles_.emplace_back();
      for (size_t i = 0; i < 3; i++) {
        made.corner[i] = Point(mesh.vertices[triangle[i]].position);
        made.uv[i] = glm::dvec2(mesh.vertices[triangle[i]].uv);
      }
    }
    const double per_face = std::sqrt(static_cast<double>(triangles_.size()) / 6.0);
    for (side_ = std::clamp(static_cast<int>(2.0 * per_face), 4, 256); !fill_grid(); side_ /= 2) {
    }
  }

  ImagePoint place(vec3 direction) const override {
    const Point d(direction);
    const int face = face_of(d);
    const Point p = on_face(face, d);
    const size_t cell = cell_at(face, column_of(p.x / p.z), column_of(p.y / p.z));
    ImagePoint point;
    point.uv = vec2(0.0f), point.seen = false;
    double nearest = INFINITY;
    for (uint32_t i = starts_[cell]; i < starts_[cell + 1]; i++) {
      double distance = 0.0;
      glm::dvec2 uv(0.0);
      if (!meets(triangles_[listed_[i]], d, distance, uv) || distance >= nearest) continue;
      nearest = distance;
      point.uv = vec2(uv);
      point.seen = inside_picture(point.uv);
    }
    return point;
  }

  float inside(vec3 direction) const override { return place(direction).seen ? 1.0f : -1.0f; }

 private:
  struct Triangle {
    Point corner[3];
    glm::dvec2 uv[3];
  };

  int column_of(double x) const { return static_cast<int>(std::clamp((0.5 * x + 0.5) * side_, 0.0, side_ - 1.0)); }
  size_t cell_at(int face, int x, int y) const {
    return (static_cast<size_t>(face) * static_cast<size_t>(side_) + static_cast<size_t>(y)) *
               static_cast<size_t>(side_) +
           static_cast<size_t>(x);
  }

  CellRange cells_on(int face, const Triangle& triangle) const {
    std::vector<Point> polygon;
    for (const Point& corner : triangle.corner) polygon.push_back(on_face(face, corner));
    const double kMargin = 1.0001;  // adjacent faces overlap slightly, against rounding
    for (const Point& normal :
         {Point(1.0, 0.0, kMargin), Point(-1.0, 0.0, kMargin), Point(0.0, 1.0, kMargin), Point(0.0, -1.0, kMargin)}) {
      polygon = clip(polygon, normal);
    }
    CellRange range{side_, side_, -1, -1};
    for (const Point& p : polygon) {
      if (!(p.z > 0.0)) continue;
      range.x0 = std::min(range.x0, column_of(p.x / p.z - 1e-6)),
      range.x1 = std::max(range.x1, column_of(p.x / p.z + 1e-6));
      range.y0 = std::min(range.y0, column_of(p.y / p.z - 1e-6)),
      range.y1 = std::max(range.y1, column_of(p.y / p.z + 1e-6));
    }
    return range;
  }

  // Passes the cells of each triangle to `put`.
  template <class Put>
  void each_cell(const Put& put) const {
    for (uint32_t i = 0; i < triangles_.size(); i++) {
      for (int face = 0; face < 6; face++) {
        const CellRange range = cells_on(face, triangles_[i]);
        for (int y = range.y0; y <= range.y1; y++) {
          for (int x = range.x0; x <= range.x1; x++) put(cell_at(face, x, y), i);
        }
      }
    }
  }

  // Returns false if triangles are in too many cells.
  bool fill_grid() {
    constexpr uint64_t kMax = uint64_t{1} << 25;
    const size_t cells = 6 * static_cast<size_t>(side_) * static_cast<size_t>(side_);
    std::vector<uint32_t> counts(cells + 1);
    uint64_t all = 0;
    for (const Triangle& triangle : triangles_) {
      for (int face = 0; face < 6; face++) {
        const CellRange range = cells_on(face, triangle);
        if (range.x1 >= range.x0 && range.y1 >= range.y0)
          all += static_cast<uint64_t>(range.x1 - range.x0 + 1) * static_cast<uint64_t>(range.y1 - range.y0 + 1);
      }
    }
    if (all > kMax && side_ > 1) return false;
    each_cell([&](size_t cell, uint32_t) { counts[cell + 1]++; });
    for (size_t i = 0; i < cells; i++) counts[i + 1] += counts[i];
    starts_ = counts;
    listed_.resize(starts_.back());
    each_cell([&](size_t cell, uint32_t i) { listed_[counts[cell]++] = i; });
    return true;
  }

  // Source: T. Moeller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", with the ray at the origin.
  static bool meets(const Triangle& triangle, const Point& d, double& distance, glm::dvec2& uv) {
    const double kEdge = 1e-7;  // adjacent triangles share edges: no direction may fall between them
    const Point e1 = triangle.corner[1] - triangle.corner[0], e2 = triangle.corner[2] - triangle.corner[0];
    const Point p = glm::cross(d, e2), t = -triangle.corner[0], q = glm::cross(t, e1);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0) return false;
    const double b1 = glm::dot(t, p) / determinant, b2 = glm::dot(d, q) / determinant;
    distance = glm::dot(e2, q) / determinant;
    if (!(b1 >= -kEdge && b2 >= -kEdge && b1 + b2 <= 1.0 + kEdge && distance > 0.0)) return false;
    uv = triangle.uv[0] * (1.0 - b1 - b2) + triangle.uv[1] * b1 + triangle.uv[2] * b2;
    return true;
  }

  std::vector<Triangle> triangles_;
  int side_ = 0;                  // cells along a face
  std::vector<uint32_t> starts_;  // start of each cell's triangles in the list
  std::vector<uint32_t> listed_;
};

}  // namespace

std::shared_ptr<const DirectionMap> make_map(const TextureMesh& mesh) {
  return std::make_shared<MeshMap>(mesh);
}

}  // namespace ods
