// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/support/scenes.h"

namespace ods {

// A room of materials with layers: smooth and rough coats, cloth, brushed metal, a film, leaves, a prism.
inline Scene layered_scene() {
  Scene scene;
  MaterialLayers coat = default_layers();
  coat.clearcoat = 1.0f;
  coat.clearcoat_roughness = 0.3f;
  add_box(scene, vec3(-1.5f, -1.0f, -2.0f), vec3(1.5f, 1.2f, 2.0f),
          add_layered(scene, matte(vec3(0.7f, 0.5f, 0.3f)), coat));
  Material lamp = matte(vec3(0.0f));
  lamp.emission = vec3(4.0f, 3.0f, 2.0f);
  add_sphere(scene, vec3(0.6f, 0.8f, -0.8f), 0.2f, add_material(scene, lamp), 16);
  Material metal = matte(vec3(0.9f, 0.7f, 0.4f));
  metal.metallic = 1.0f;
  metal.roughness = 0.4f;
  MaterialLayers brushed = default_layers();
  brushed.anisotropy = 0.7f;
  brushed.clearcoat = 0.5f;
  add_sphere(scene, vec3(0.5f, -0.3f, -0.5f), 0.15f, add_layered(scene, metal, brushed), 24);
  MaterialLayers film = default_layers();
  film.iridescence = 1.0f;
  add_sphere(scene, vec3(0.0f, -0.1f, 0.8f), 0.3f, add_layered(scene, metal, film), 24);
  MaterialLayers cloth = default_layers();
  cloth.sheen_color = vec3(0.8f, 0.6f, 0.9f);
  cloth.sheen_roughness = 0.4f;
  cloth.specular = 0.3f;
  add_sphere(scene, vec3(-0.2f, 0.0f, -0.7f), 0.3f, add_layered(scene, matte(vec3(0.5f, 0.2f, 0.6f)), cloth), 24);
  MaterialLayers leaf = default_layers();
  leaf.diffuse_transmission = 0.6f;
  add_rectangle(scene, vec3(-1.0f, -0.5f, 0.4f), vec3(0.4f, 0.0f, 0.3f), vec3(0.0f, 0.8f, 0.0f),
                add_layered(scene, matte(vec3(0.3f, 0.6f, 0.2f)), leaf));
  Material glass = matte(vec3(1.0f));
  glass.transmission = 1.0f;
  glass.thickness = 1.0f;
  glass.roughness = 0.3f;
  MaterialLayers prism = default_layers();
  prism.dispersion = 2.0f;
  add_sphere(scene, vec3(-0.7f, -0.4f, -0.1f), 0.2f, add_layered(scene, glass, prism), 24);
  return scene;
}

}  // namespace ods
