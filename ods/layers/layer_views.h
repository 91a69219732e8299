// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Looks at a layered scene from places that had no part in making it, as its users do.
#pragma once
#include <vector>

#include "ods/layers/layered_scene.h"
#include "ods/layers/rays/first_hits.h"

namespace ods {

class LayerViews {
 public:
  static constexpr int kEyes = 32;

  // The surfaces of these layers. Masked surfaces count as a whole; the sky and blended surfaces are not looked at.
  explicit LayerViews(const LayeredScene& layers);

  struct View {
    vec3 place{0.0f};
    std::vector<vec3> directions;  // of 55,296 rays, the same for all eyes
    std::vector<int> meshes;       // by ray: the index of the mesh whose front it meets first; -1: none
  };

  // The view of one of kEyes places, which are evenly spread in the box.
  View from_eye(int eye) const;

 private:
  HeadBox box_;
  std::vector<int> mesh_of_;  // by instance
  Scene surfaces_;
  FirstHits hits_;
};

}  // namespace ods
