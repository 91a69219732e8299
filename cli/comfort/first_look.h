// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A scene as comfort sees it: what the ray through the centre of each pixel meets, and which thing that is.
#pragma once
#include <string>
#include <vector>

#include "ods/comfort/comfort.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/scene.h"

// What each instance of a scene is called: a name for each, and each instance's index in the names. Instances that have
// none go by their material.
struct Things {
  std::vector<std::string> names;
  std::vector<int> of_instance;
};
Things things_of(const ods::Scene& scene);

// Of each eye. Precondition: options.height > 0.
std::vector<ods::SeenDepth> look_from(const ods::CpuRenderer& renderer, const Things& things,
                                      const ods::StereoCamera& camera, const ods::RenderOptions& options);

// The worst thing that a small picture from there shows, in a line with its cure; empty if none has this level.
std::string strain_line(const ods::CpuRenderer& renderer, const ods::Scene& scene, const ods::StereoCamera& camera,
                        ods::ComfortLevel level);
