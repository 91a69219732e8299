// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/builtin.h"

#include "ods/scene/builtin/makers.h"

namespace ods {

static constexpr BuiltinScene kScenes[] = {
    {"room", "a living room at dusk, lit by its lamps", make_room},
    {"wineglass", "red wine, water and glass on a table: refraction and absorption", make_wineglass},
    {"mirrors", "flat, round and hollow mirrors around the viewer: reflections in stereo", make_mirrors},
    {"fractal", "sphereflakes and sponges on all sides: millions of instanced triangles", make_fractal},
    {"toys", "things that move in every way there is, a loop of eight seconds: for videos", make_toys},
    {"axis", "a labelled reference: directions, degrees, distances, poles", make_axis},
    {"furnace", "test: a glowing closed box, every pixel has the same known value", make_furnace},
    {"spheres", "test: small glowing spheres at known positions", make_marker_spheres},
    {"lamp", "test: a floor under a disc lamp, radiance known at every point", make_lamp},
    {"slab", "test: a glass slab before a bright sky, transmittance known in every direction", make_slab},
};

std::span<const BuiltinScene> builtin_scenes() {
  return kScenes;
}

const BuiltinScene* find_builtin(std::string_view name) {
  for (const BuiltinScene& scene : kScenes) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

}  // namespace ods
