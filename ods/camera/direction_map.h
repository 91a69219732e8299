// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Where cameras' own files show a direction: forms that no formula of ods/kernel/camera/projection.h covers, because
// they are measured for each lens. They are read and converted; nothing is rendered in them.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ods/base/extent.h"
#include "ods/camera/projection.h"
#include "ods/kernel/camera/projection.h"

namespace ods {

// Of one eye's picture, or of one lens of a camera that looks ahead and back.
class DirectionMap {
 public:
  virtual ~DirectionMap() = default;

  // The image position of a direction, both as in projection.h. Any length but 0.
  virtual ImagePoint place(vec3 direction) const = 0;

  // How far inside the picture's rim a direction is, radians; below 0 outside. Only lenses have a rim.
  virtual float inside(vec3 direction) const = 0;
};

// A fisheye lens whose image circle is anywhere in the picture, and may be cut by its edges.
struct FisheyeLens {
  vec2 center{0.0f};    // of the circle, pixels from the left and top edge of the eye's picture
  float radius = 0.0f;  // pixels
  float fov = 180.0f;   // degrees, from rim to rim of the circle
  int kind = kFisheye;  // is_fisheye()
  float yaw = 0.0f;     // degrees: where the lens points, to the right,
  float pitch = 0.0f;   // up,
  float roll = 0.0f;    // and how it is turned, clockwise

  bool operator==(const FisheyeLens&) const = default;
};

// Why a picture of this size cannot have such a lens, for messages; empty: it can.
std::string lens_fault(const FisheyeLens& lens, Extent picture);

// Precondition: lens_fault() is empty.
std::shared_ptr<const DirectionMap> make_map(const FisheyeLens& lens, Extent picture);

// The part of an eye's picture that shows something; around it are black bars. Image positions.
struct PicturePart {
  vec2 corner{0.0f};  // left and top
  vec2 size{1.0f};
};

// A projection, of no cube, in a part of the picture.
std::shared_ptr<const DirectionMap> make_map(const ProjectionSetting& projection, const PicturePart& part);

// A picture as the texture of a mesh around the viewer: what is on a triangle is seen in the direction of the triangle.
struct TextureMesh {
  struct Vertex {
    vec3 position;  // x right, y up, z back
    vec2 uv;        // image position
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// Why nobody can look at such a mesh, for messages; empty: one can.
std::string mesh_fault(const TextureMesh& mesh);

// Whether the mesh has nothing behind the viewer.
bool is_front_half(const TextureMesh& mesh);

// Where triangles overlap, the nearest one is seen. Precondition: mesh_fault() is empty.
std::shared_ptr<const DirectionMap> make_map(const TextureMesh& mesh);

// Pixels of a picture of this width and height that cover a radian straight ahead; 0: it shows nothing there.
double pixels_per_radian(const DirectionMap& map, Extent picture, vec3 ahead);

}  // namespace ods
