// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The second half of the glTF reader; parts.h is the first. It places the objects of the file and reads their motion.
#pragma once
#include <vector>

#include "ods/scene/gltf/gltf.h"
#include "ods/scene/gltf/parts.h"

namespace ods {

// --- nodes.cpp
// Indices of the file's objects in the Scene, for animation; -1 if they are not in it.
struct Places {
  struct PlacedLight {
    int light;  // index in the Scene
    int source;
    int node;
  };
  std::vector<int> nodes;    // per node: its index in Animation::nodes
  std::vector<int> weights;  // per node: the index of its mesh in Animation::weights
  std::vector<PlacedLight> lights;
};

struct AnimatedNodes {
  std::vector<char> moves;   // per node: whether an animation or a skin refers to it
  std::vector<char> blinks;  // per node: whether an animation shows and hides it
};

// Reads the chosen scene: instances with their meshes, lights, cameras. Meshes and lights of
// nodes that are always hidden are left out.
Places read_nodes(GltfFile& file, Scene& scene, const SceneOptions& options, const AnimatedNodes& animated);

Lamp read_lamp(const GltfFile& file, int light);

// --- losses.cpp
// Sets Scene::generator and Scene::losses.
void find_losses(const GltfFile& file, Scene& scene, const AnimatedNodes& animated);

// --- image_light.cpp
// Sets the environment to the image-based light of the chosen scene, if it has one. Precondition: the scene exists.
void read_image_light(const GltfFile& file, Scene& scene, int chosen);

// --- clips.cpp
AnimatedNodes find_animated_nodes(const GltfFile& file);
void read_clips(GltfFile& file, Scene& scene, const Places& places);

}  // namespace ods
