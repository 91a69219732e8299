// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Single frames of simulations, with Blender.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "ods/image/image_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/programs.h"

namespace ods::cycles_picture_test {

namespace fs = std::filesystem;

// A ball that glows and falls from 6 m, seen from 4 m away at 1.6 m. Nothing is baked.
constexpr const char* kFall = R"(
import bpy, math
bpy.ops.wm.read_factory_settings(use_empty=True)
S = bpy.context.scene
S.render.engine, S.cycles.samples, S.frame_start, S.frame_end, S.render.fps = 'CYCLES', 16, 1, 24, 24
W = S.world = bpy.data.worlds.new('dark'); W.use_nodes = True
W.node_tree.nodes['Background'].inputs[1].default_value = 0
m = bpy.data.materials.new('glow'); m.use_nodes = True; t = m.node_tree; t.nodes.clear()
e = t.nodes.new('ShaderNodeEmission')
t.links.new(e.outputs[0], t.nodes.new('ShaderNodeOutputMaterial').inputs[0])
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.3, location=(0, 4, 6)); bpy.context.object.data.materials.append(m)
bpy.ops.rigidbody.object_add()
bpy.context.object.rigid_body.linear_damping = 0
c = bpy.data.cameras.new('Camera'); o = bpy.data.objects.new('Camera', c); S.collection.objects.link(o)
o.location = (0, 0, 1.6); o.rotation_euler = (math.pi / 2, 0, 0); S.camera = o
)";

// Half a second after the start it is g t^2 / 2 lower, although no frame before was rendered.
TEST(CyclesPicture, ShowsWhatASimulationHasComeTo) {
  const std::string missing_program = missing("Blender", "blender --version");
  if (!missing_program.empty()) GTEST_SKIP() << missing_program;
  const TemporaryFolder folder;
  const std::string file = folder.path("scene.blend"), picture = folder.path("p.0013.exr");
  folder.write("make.py", kFall + ("\nbpy.ops.wm.save_as_mainfile(filepath='" + file + "')\n"));
  ASSERT_TRUE(
      (run_line("blender --background --factory-startup --python " + folder.path("make.py")), fs::exists(file)));
  Ods ods({"render", file, "-o", folder.path("p.####.exr"), "--frames", "13", "--renderer", "cycles", "--width", "512",
           "--eyes", "mono", "--denoise", "none"});
  ASSERT_EQ(ods.finish(), 0) << ods.err;
  const Image image = read_image(picture);
  double sum = 0.0, light = 0.0;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      light += double{*image.at(x, y)};
      sum += (y + 0.5) * double{*image.at(x, y)};
    }
  }
  ASSERT_GT(light, 0.0);
  const double up = std::atan2(6.0 - 9.81 * 0.5 * 0.5 / 2 - 1.6, 4.0);
  EXPECT_NEAR(sum / light, (0.5 - up / std::numbers::pi) * 256, 1.5)
      << "unmoved it would be at " << (0.5 - std::atan2(4.4, 4.0) / std::numbers::pi) * 256;
}

}  // namespace ods::cycles_picture_test
