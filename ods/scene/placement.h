// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Places objects by matrices within a Scene's limits: for the glTF reader and for animation.
#pragma once
#include "ods/scene/scene.h"

namespace ods {

// Maximum distance of a Scene's objects from its origin: squared areas still fit a float.
inline constexpr float kFarthest = 1e9f;  // metres

// Texture coordinates, and each number of their transforms, are clamped to this: beyond it a float cannot resolve
// positions within a texel.
inline constexpr float kLargestUv = 1e6f;

// T * R * S. The quaternion is x, y, z, w; one of zero length counts as no rotation.
glm::dmat4 trs_matrix(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

// Returns whether no element exceeds kFarthest.
bool is_bounded(const glm::dmat4& matrix);

// Returns whether the three axes span a volume, however small.
bool is_invertible(const glm::dmat4& matrix);

// Returns whether a box, transformed by a matrix, stays within kFarthest of the origin.
bool stays_near(const glm::dmat4& matrix, const Bounds& box);

// The box around a mesh's own vertices.
Bounds mesh_bounds(const Scene& scene, const Mesh& mesh);

// The middle of a box, in whole units, if the box is so far from the origin compared with its size that single
// precision would spoil its shape: beyond kFirmReach, and further than 8 times the half of its longest side. Otherwise
// 0. A scene's box is scene_bounds().
vec3 far_middle(const Bounds& box);
vec3 far_middle(const Scene& scene);

// The warning about a scene that extends further than kFirmReach. Empty for other scenes.
std::string reach_warning(const Scene& scene);

// Stores a matrix as the rows of an instance.
void set_matrix(Instance& instance, const glm::dmat4& object_to_world);

// Sets colour, intensity, range and cone angles.
void set_light(PunctualLight& light, const Lamp& lamp);

// Places a light or a view point at a node, facing its -Z. Precondition: the matrix is bounded.
void place_light(PunctualLight& light, const glm::dmat4& node);
void place_view(ViewPoint& view, const glm::dmat4& node);

// The matrices in the text of KHR_texture_transform contradict its first example about the sense of rotation; the
// example, the conformance model TextureTransformTest and viewers agree on the one used here.
void place_texture(TextureSlot& slot, const UvPlace& place);

}  // namespace ods
