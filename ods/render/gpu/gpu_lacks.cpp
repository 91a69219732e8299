// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/gpu_lacks.h"

#include <fmt/format.h>

#include <algorithm>

#include "ods/render/gpu/tree.h"
#include "ods/scene/catchers.h"

namespace ods {
namespace {

bool has_layers(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.layers >= 0; });
}

}  // namespace

std::string gpu_lacks(const Scene& scene, const RenderOptions& options, bool is_blurred) {
  constexpr const char* kOnCpu = "`device` cpu renders it";
  if (is_blurred) return fmt::format("graphics cards cannot render motion blur yet: use `shutter` 0, or {}", kOnCpu);
  if (has_catchers(scene)) return fmt::format("graphics cards cannot render shadow catchers yet; {}", kOnCpu);
  if (has_layers(scene)) {
    return fmt::format("graphics cards cannot render coats, sheen and other layers of materials yet; {}", kOnCpu);
  }
  if (scene.portable)
    return fmt::format("cards of different makers differ in last bits; {} with the same bits", kOnCpu);
  if (options.indirect == Indirect::kCache) {
    return fmt::format("graphics cards have no light cache yet: use `indirect` path, or {}", kOnCpu);
  }
  const size_t triangles = triangles_in_tree(scene);
  if (triangles > kMaxCardTriangles) {
    return fmt::format(
        "the scene has {} million triangles, with all copies of its meshes, and graphics cards render {} "
        "million; {}",
        triangles / 1'000'000, kMaxCardTriangles / 1'000'000, kOnCpu);
  }
  return "";
}

}  // namespace ods
