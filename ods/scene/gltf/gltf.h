// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads glTF 2.0 files (.glb, .gltf, or one of them in a .zip archive with the files beside it) into a Scene.
//
// Supported: hierarchies (matrix or TRS), shared meshes as instances, triangles, strips and fans, every component type,
// sparse accessors, two sets of texture coordinates, vertex colours, metallic-roughness materials, cameras (as view
// points), skins (two sets of joints), morph targets, animations of nodes and weights, and the extensions that
// ods/scene/gltf/extensions.h lists as rendered or approximated. Buffers and pictures may be in the file, in data URIs,
// or in files named by relative paths, which may contain "..". If there is no such file, variants that other programs
// write are tried: with backslashes, without or with doubled percent codes, in another letter case. This causes a
// warning. Absolute paths and URLs are Errors.
//
// The Scene is at rest and no clip plays; play() (ods/scene/animation.h) and set_time() (ods/scene/motion.h)
// animate it.
//
// Other features in the file are listed in Scene::warnings, once each. Scene::extensions lists how each extension of
// the file was handled. An unsupported extension that the file requires is an Error.
//
// Whatever the file contains, the Scene returned guarantees, at rest and at every time:
//   - every number is finite; positions, in the mesh and in the world, lie within 1e9 m of the origin;
//   - normals are unit vectors, tangents too or zero; every triangle has an area and three corners in its mesh;
//   - every index (material, texture, mesh) exists, every texture has texels, no instance is flattened to a plane.
// To that end the reader drops triangles without an area or with a non-finite corner, replaces zero-length normals by
// those of the adjacent faces, gives a primitive without normals flat ones, computes tangents that a normal map needs
// from its texture coordinates, clamps factors to their legal range, and drops static instances whose matrix has no
// inverse; moving ones are hidden during that time. Channels with invalid keys (wrong number, decreasing times, no
// values) are dropped with a warning. All other faults are Errors.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

struct SceneOptions {
  int scene = -1;            // index of the file's scene; -1 for its default, or the first
  std::string scene_name{};  // name of the file's scene, which overrides the index; empty for none
  std::string confine{};     // the only folder that files are read from (ods/files/confined_file.h); empty for no limit
  std::string variant{};   // one of the file's material variants, by name; if empty, each mesh has its default material
  std::string camera{};    // if no camera has this name, nodes with this name become view points
  bool z_up = false;       // the file's z axis points up, instead of its y axis as in glTF
  glm::dvec3 origin{0.0};  // the place in the file, with y up, that becomes the scene's origin
  bool finds_origin = true;  // a scene that is small and far away is moved to its origin: far_middle(), Scene::origin
};

// Throws Error(kInput), naming the file, if it is missing, damaged, or unsupported. Throws Error(kUsage) if it has no
// scene with that index or name, or no variant of that name.
Scene load_gltf(const std::string& path, const SceneOptions& options = {});

// Reads a file from memory; `path` stands for it in messages, and relative paths start from its folder.
Scene load_gltf_bytes(std::span<const unsigned char> bytes, const std::string& path, const SceneOptions& options = {});

// The files that a glTF file refers to, buffers and pictures, relative to its folder: sorted, without duplicates; none
// for an archive. They need not exist. Throws Error(kInput) if its JSON cannot be read. confine: as in SceneOptions,
// for this file alone.
std::vector<std::string> gltf_files(const std::string& path, const std::string& confine = {});

}  // namespace ods
