// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Films of layers in a .glb, read by the reader of scenes and by Khronos' validator
// (tests/layers/file/write_layers_test.cpp).
#include "ods/layers/file/film_glb.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "ods/base/error.h"
#include "ods/kernel/surface.h"
#include "ods/layers/file/write_layers.h"
#include "ods/scene/gltf/gltf.h"
#include "ods/scene/motion.h"
#include "tests/support/layered_film.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods::film_glb_test {

// The bounds of an object of a file now; none if it is hidden.
std::optional<Bounds> bounds_of(const Scene& scene, const std::string& name) {
  std::optional<Bounds> bounds;
  for (const NamedObject& object : scene.objects) {
    if (object.name != name || is_hidden(scene, object.first_instance)) continue;
    const Instance& instance = scene.instances[object.first_instance];
    const Mesh& mesh = scene.meshes[static_cast<size_t>(instance.mesh)];
    for (uint v = 0; v < mesh.vertex_count; v++) {
      const vec3 at = to_world(instance, scene.vertices[mesh.first_vertex + v].position);
      if (!bounds) bounds = Bounds{at, at};
      bounds->low = min(bounds->low, at), bounds->high = max(bounds->high, at);
    }
  }
  return bounds;
}

Bounds bounds_of(const LayerMover& mover, size_t frame) {
  const MoverMesh& mesh = mover.meshes[0];
  Bounds bounds{vec3(1e9f), vec3(-1e9f)};
  for (const vec3& position : mesh.shapes.empty() ? mesh.positions : mesh.shapes[frame]) {
    const vec3 at = at_pose(mover.poses[frame], position);
    bounds.low = min(bounds.low, at), bounds.high = max(bounds.high, at);
  }
  return bounds;
}

TEST(FilmGlb, PlaysInOtherReaders) {
  const TemporaryFolder folder;
  const LayeredScene layers = layered_film::film();
  for (const bool is_plain : {false, true}) {
    write_layers(layers, folder.path("film.glb"), {.plain = is_plain});
    Scene scene = load_gltf(folder.path("film.glb"));
    EXPECT_TRUE(scene.warnings.empty());
    play(scene.animation, "");
    EXPECT_NEAR(length_of(scene.animation), 1.0, 1e-6);
    for (size_t frame = 0; frame < layers.film.times.size(); frame++) {
      set_time(scene, double{layers.film.times[frame]});
      for (const LayerMover& mover : layers.film.movers) {
        const std::optional<Bounds> found = bounds_of(scene, mover.name);
        ASSERT_EQ(found.has_value(), mover.poses[frame].shown) << mover.name << " " << frame;
        if (!found) continue;
        const Bounds wanted = bounds_of(mover, frame);
        EXPECT_LT(length(found->low - wanted.low), 1e-3f) << mover.name << " " << frame;
        EXPECT_LT(length(found->high - wanted.high), 1e-3f) << mover.name << " " << frame;
      }
    }
  }
  EXPECT_THROW(write_layers(layers, folder.path("film.usdz")), Error);
}

TEST(FilmGlb, IsValid) {
  const char* const modules = std::getenv("ODS_NODE_MODULES");
  if (!modules || !std::filesystem::exists(std::string(modules) + "/gltf-validator")) {
    GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no gltf-validator (npm install gltf-validator)";
  }
  const TemporaryFolder folder;
  write_layers(layered_film::film(), folder.path("a.glb"));
  write_layers(layered_film::film(), folder.path("b.glb"), {.plain = true});
  folder.write("test.mjs", R"(
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';
for (const name of ['a.glb', 'b.glb']) {
  const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(name)));
  console.log(name, issues.numErrors, issues.numWarnings, info.animationCount, info.hasMorphTargets);
  for (const { severity, code, message, pointer } of issues.messages) {
    if (severity < 2) console.log(code, message, pointer);
  }
}
)");
  std::filesystem::create_directory_symlink(modules, folder.path("node_modules"));
  EXPECT_EQ(run_line("cd '" + folder.path("") + "' && timeout 60 node test.mjs").out,
            "a.glb 0 0 1 true\nb.glb 0 0 1 true\n");
}

}  // namespace ods::film_glb_test
