// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/render/gpu/gpu_lacks.h"

#include <fmt/format.h>

#include "ods/render/gpu/tree.h"

namespace ods {

std::string gpu_lacks(const Scene& scene, const RenderOptions& options, bool is_blurred) {
  constexpr const char* kOnCpu = "`device` cpu renders it";
  if (is_blurred) return fmt::format("graphics cards cannot render motion blur yet: use `shutter` 0, or {}", kOnCpu);
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
