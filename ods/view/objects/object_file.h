// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene as an object that the viewer's page draws in real time, in the light of a layered scene: plain glTF 2.0, as a
// GLB without extensions.
//
// Every visible instance is a node with a matrix; every mesh has one primitive with POSITION, NORMAL and indices of 32
// bits, and TEXCOORD_0 (of the set that its colour reads, with the transform of that texture applied) if its material
// has a texture. A material has the factors of pbrMetallicRoughness and a picture of its colour, JPEG or, with alpha,
// PNG of at most 2048 texels a side. What the page does not draw is a mean: vertex colours, and textures of
// metalness, roughness and emission. Glass is blended. Cameras, lights and the environment are left out.
//
// asset.extras.omnistereo is {"object": 1, "frames": N, "rate": R}. With N > 1 it moves: N frames, R per second, then
// again from the first; what moves in between is interpolated linearly. A node that moves has
// extras.omnistereo.matrices, an accessor of N matrices that replace `matrix`; one that is hidden at a frame has the
// scale 0 there. A primitive that deforms has extras.omnistereo.frames, a list of N {"POSITION": a, "NORMAL": b}.
#pragma once
#include <cstddef>
#include <string>

#include "ods/scene/scene.h"

namespace ods {

inline constexpr size_t kMaxObjectTriangles = 1'000'000;

struct ObjectFile {
  std::string glb;
  std::string note;  // one line for people about what it lacks: its animation; usually empty
};

// path: the name of the scene in messages. All clips play that do not contradict each other, for up to 10 seconds and
// 64 MB, at 30 frames a second, or 15 or 10 if they need less; of longer ones there is the first moment. Throws
// Error(kInput) if the scene has no triangles, or more than kMaxObjectTriangles.
ObjectFile make_object_file(Scene scene, const std::string& path);

}  // namespace ods
