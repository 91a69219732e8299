// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds what moves in a scene during a film, by comparing the geometry of its frames.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "ods/layers/layered_scene.h"
#include "ods/scene/scene.h"

namespace ods {

// Instances that move alike.
struct Mover {
  std::vector<int> instances;
  bool deforms = false;  // its vertices change, or it is sheared: no pose describes its motion. It has one instance
  size_t reference = 0;  // the first frame in which it is visible
  vec3 origin{0.0f};     // its middle there, in the world
  // By frame: a point that is at p in the world in frame `reference` is a point p - origin of the mover. If it deforms,
  // all are at `origin` without a rotation.
  std::vector<LayerPose> poses;
};

// Sets the scene to each of these times, in seconds, and then to the first. A mover is an instance that is visible at
// one of them, and that moves, deforms, appears, disappears, or changes its material, by more than a tenth of a
// millimetre. In the order of their first instances. Precondition: there is a time.
std::vector<Mover> find_movers(Scene& scene, std::span<const double> times);

// The matrix of an instance as it is now.
glm::dmat4 matrix_of(const Instance& instance);

// Hides the movers' instances, and takes their motion out of the scene's animation, so that set_time() does not show
// them again. The result restores both: pass it to show_movers(). Instances that emit light remain if `lamps_remain`.
struct HiddenMovers {
  std::vector<MovingInstance> instances;  // the whole list of before
  std::vector<char> hidden;
};
HiddenMovers hide_movers(Scene& scene, const std::vector<Mover>& movers, bool lamps_remain);
void show_movers(Scene& scene, HiddenMovers hidden);

}  // namespace ods
