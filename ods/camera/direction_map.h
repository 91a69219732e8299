// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Maps directions to image positions in cameras' own files: forms without a formula in ods/kernel/camera/projection.h,
// because they are measured for each lens. They are read and converted, but not rendered.
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

// Maps directions to positions in one eye's picture, or in the picture of one lens of a camera that looks ahead and
// back.
class DirectionMap {
 public:
  virtual ~DirectionMap() = default;

  // The image position of a direction of any length but 0, both as in projection.h.
  virtual ImagePoint place(vec3 direction) const = 0;

  // The distance of a direction from the picture's rim, radians; positive inside, negative outside. Only lenses have a
  // rim.
  virtual float inside(vec3 direction) const = 0;
};

// A fisheye lens whose image circle is anywhere in the picture, and may be cut by its edges.
struct FisheyeLens {
  vec2 center{0.0f};    // the circle's centre, pixels from the left and top edge of the eye's picture
  float radius = 0.0f;  // pixels
  float fov = 180.0f;   // degrees, from rim to rim of the circle
  int kind = kFisheye;  // is_fisheye()
  float yaw = 0.0f;     // degrees that the lens points to the right
  float pitch = 0.0f;   // degrees up
  float roll = 0.0f;    // degrees clockwise

  bool operator==(const FisheyeLens&) const = default;
};

// The reason why a picture of this size cannot have such a lens, for messages. Empty if it can.
std::string lens_fault(const FisheyeLens& lens, Extent picture);

// Precondition: lens_fault() is empty.
std::shared_ptr<const DirectionMap> make_map(const FisheyeLens& lens, Extent picture);

// The part of an eye's picture inside black bars. Image positions.
struct PicturePart {
  vec2 corner{0.0f};  // left and top
  vec2 size{1.0f};
};

// Maps a projection, but not a cube, in a part of the picture.
std::shared_ptr<const DirectionMap> make_map(const ProjectionSetting& projection, const PicturePart& part);

// A picture as the texture of a mesh around the viewer: a point on a triangle is seen in that point's direction.
struct TextureMesh {
  struct Vertex {
    vec3 position;  // x right, y up, z back
    vec2 uv;        // image position
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

// The reason why the mesh cannot be shown, for messages. Empty if it can.
std::string mesh_fault(const TextureMesh& mesh);

// Returns whether the mesh has nothing behind the viewer.
bool is_front_half(const TextureMesh& mesh);

// Maps a mesh; where triangles overlap, the nearest one is seen. Precondition: mesh_fault() is empty.
std::shared_ptr<const DirectionMap> make_map(const TextureMesh& mesh);

// Pixels per radian straight ahead, in a picture of this size; 0 if it shows nothing there.
double pixels_per_radian(const DirectionMap& map, Extent picture, vec3 ahead);

}  // namespace ods
