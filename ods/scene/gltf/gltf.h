// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// glTF 2.0 files (.glb and .gltf) -> Scene.
//
// Read: hierarchies (matrix or TRS), shared meshes as instances, EXT_mesh_gpu_instancing, triangles, strips and fans,
// every component type, sparse accessors, KHR_mesh_quantization, two sets of texture coordinates, vertex colours,
// metallic-roughness with KHR_materials_unlit, _emissive_strength, _ior, _transmission and _volume,
// KHR_texture_transform, EXT_texture_webp, KHR_lights_punctual, cameras (as view points), skins (two sets of joints),
// morph targets, animations of nodes and weights, KHR_animation_pointer to nodes, lights, and materials' factors and
// texture transforms. Buffers and pictures may lie in the file, in data URIs, or in files named relative to it, ".."
// included. Absolute paths and URLs are Errors.
//
// The Scene stands as the file has it at rest, and nothing plays; play() (ods/scene/animation/animation.h) and
// set_time() (ods/scene/motion.h) move it.
//
// What else the file has is named in Scene::warnings, once each. An extension that the file requires and that is not in
// the list above is an Error.
//
// Whatever the file says, the Scene returned holds these, at rest and at every time:
//   - every number is finite; positions, in the mesh and in the world, lie within 1e9 m of the origin;
//   - normals are unit vectors, tangents too or zero; every triangle has an area and three corners in its mesh;
//   - every index (material, texture, mesh) exists, every texture has texels, no instance is flattened to a plane.
// To get there triangles without an area or with a corner that is not finite are left out, normals of no length are
// replaced by those of the faces around them, a primitive without normals gets flat ones, one without the tangents its
// normal map needs gets them from its texture coordinates, factors are clamped to their legal range, instances whose
// matrix has no inverse are left out, those that move are hidden while that is so. Channels whose keys make no sense
// (of the wrong number, falling times, no numbers) are left out with a warning. Everything else that is wrong is an
// Error.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

struct SceneOptions {
  int scene = -1;         // which of the file's scenes; -1: its default, or the first
  std::string confine{};  // a folder: no file outside of it is read (ods/files/confined_file.h); empty: no such limit
};

// Throws Error(kInput) naming the file: absent, damaged, or not supported. Throws Error(kUsage): no scene of that
// number.
Scene load_gltf(const std::string& path, const SceneOptions& options = {});

// The same from memory; path stands in messages, and the files that the scene names are looked for beside it.
Scene load_gltf_bytes(std::span<const unsigned char> bytes, const std::string& path, const SceneOptions& options = {});

// The files beside it that it refers to, buffers and pictures, as paths from its folder: sorted, each once. They need
// not exist. Throws Error(kInput) where its JSON cannot be read. confine: as in SceneOptions; the files found are not
// checked against it.
std::vector<std::string> gltf_files(const std::string& path, const std::string& confine = {});

}  // namespace ods
