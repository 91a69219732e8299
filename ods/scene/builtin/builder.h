// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Short functions for building a Scene in code.
#pragma once
#include <functional>

#include "ods/scene/builtin/shapes.h"
#include "ods/scene/scene.h"

namespace ods {

// around(): a position at an azimuth, in degrees to the right of the front, and a distance on the floor.
// placed(): scales, then rotates to the right by yaw degrees (seen from above), then moves.
vec3 around(float azimuth, float distance, float height = 0.0f);
glm::mat4 placed(vec3 position, float yaw = 0.0f, vec3 scale = vec3(1.0f));

// Rotates about an axis by degrees, counter-clockwise when looking against the axis.
glm::mat4 turned(vec3 axis, float degrees);

// A diffuse or glossy dielectric.
Material paint(vec3 color, float roughness = 0.8f);

// A Lambert surface without specular reflection, for scenes with known answers.
Material matte(vec3 color);

Material metal(vec3 color, float roughness);

// A black, emissive material.
Material glow(vec3 radiance);

// Clear solid glass; its mesh must be closed.
Material glass(float ior);

// Adds a texture of color(u, v), u and v in 0..1 with v down; linear Rec. 709 in, stored as sRGB. Returns its index.
// Several threads call color() at once.
int add_texture(Scene& scene, int width, int height, const std::function<vec3(vec2)>& color);

// Returns the material with its base colour multiplied by a texture that repeats every `size` metres.
Material textured(Material material, int texture, vec2 size);

int add_material(Scene& scene, const Material& material, const std::string& name = {});

// Adds a mesh of the shape and one instance of it. Returns the mesh.
int add(Scene& scene, const Shape& shape, int material, const glm::mat4& object_to_world = glm::mat4(1.0f));

// A lat-long environment of width x width / 2 texels; several threads call radiance() at once, with unit vectors.
Environment make_environment(int width, const std::function<vec3(vec3 direction)>& radiance);

// A directional light from this azimuth and elevation (degrees, clockwise from -Z).
PunctualLight make_sun(float azimuth, float elevation, vec3 irradiance);

}  // namespace ods
