// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Things of a scene put where a matrix says, within what a Scene may hold: for the glTF reader and for what moves.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// Nothing in a Scene lies further from its origin than this: squared areas still fit a float.
inline constexpr float kFarthest = 1e9f;  // metres

// Texture coordinates, and each number of their transforms, are cut here: further out a float has no digits left for
// the place within a texel.
inline constexpr float kLargestUv = 1e6f;

// T * R * S; a quaternion x, y, z, w without a length is no rotation.
glm::dmat4 trs_matrix(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

// Whether no element exceeds kFarthest.
bool is_bounded(const glm::dmat4& matrix);

// Whether the three axes span a volume, however small.
bool is_invertible(const glm::dmat4& matrix);

// Whether a box stays within kFarthest of the origin where a matrix puts it.
bool stays_near(const glm::dmat4& matrix, const Bounds& box);

// The box around a mesh's own vertices.
Bounds mesh_bounds(const Scene& scene, const Mesh& mesh);

// Rows of a matrix as an instance holds them.
void set_matrix(Instance& instance, const glm::dmat4& object_to_world);

// Colour, strength, range and cones of a lamp.
void set_light(PunctualLight& light, const Lamp& lamp);

// A light or a view point at a node: along its -Z. Precondition: the matrix is bounded.
void place_light(PunctualLight& light, const glm::dmat4& node);
void place_view(ViewPoint& view, const glm::dmat4& node);

// The matrices in the text of KHR_texture_transform and its first example disagree about the sense of rotation; the
// example, the conformance model TextureTransformTest and the viewers agree on this one.
void place_texture(TextureSlot& slot, const UvPlace& place);

}  // namespace ods
