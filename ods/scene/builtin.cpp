// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin.h"

#include <cassert>

#include "ods/scene/builtin_makers.h"

namespace ods {

static constexpr BuiltinScene kScenes[] = {
    {"room", "a living room at dusk, lit by its lamps"},
    {"wineglass", "red wine, water and glass on a table: refraction and absorption"},
    {"mirrors", "flat, round and hollow mirrors around the viewer: reflections in stereo"},
    {"fractal", "sphereflakes and sponges on all sides: millions of instanced triangles"},
    {"axis", "a labelled reference: directions, degrees, distances, poles"},
    {"furnace", "test: a glowing closed box, every pixel has the same known value"},
    {"spheres", "test: small glowing spheres at known positions"},
    {"lamp", "test: a floor under a disc lamp, radiance known at every point"},
    {"slab", "test: a glass slab before a bright sky, transmittance known in every direction"},
};

// In the order of kScenes.
static constexpr Scene (*kMakers[])() = {
    make_room,    make_wineglass,      make_mirrors, make_fractal, make_axis,
    make_furnace, make_marker_spheres, make_lamp,    make_slab,
};
static_assert(std::size(kScenes) == std::size(kMakers));

std::span<const BuiltinScene> builtin_scenes() {
  return kScenes;
}

static size_t index_of(const std::string& name) {
  size_t i = 0;
  while (i < std::size(kScenes) && name != kScenes[i].name) i++;
  return i;
}

bool is_builtin(const std::string& name) {
  return index_of(name) < std::size(kScenes);
}

Scene make_builtin(const std::string& name) {
  assert(is_builtin(name));
  Scene scene = kMakers[index_of(name)]();
  scene.name = name;
  return scene;
}

}  // namespace ods
