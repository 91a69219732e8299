// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Blender's lights whose own nodes make their colour and power.
#include <gtest/gtest.h>

#include <filesystem>

#include "ods/scene/load/load.h"
#include "tests/support/blender_cli.h"

namespace ods::blender_lights_test {

constexpr const char* kScene = R"(
import bpy, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_plane_add(size=8)
def light(name, place, color):
    l = bpy.data.lights.new(name, 'POINT'); l.energy = 1256.637061; l.color = color; l.use_nodes = True
    o = bpy.data.objects.new(name, l); o.location = (place, 0, 2); bpy.context.scene.collection.objects.link(o)
    t = l.node_tree; return t, next(n for n in t.nodes if n.type == 'EMISSION')
t, e = light('a warm', -2, (1, 1, 1))
n = t.nodes.new('ShaderNodeBlackbody'); n.inputs[0].default_value = 2700; t.links.new(n.outputs[0], e.inputs[0])
t, e = light('b strong', 0, (1, .5, .25))
n = t.nodes.new('ShaderNodeLightFalloff'); n.inputs[0].default_value = 3; t.links.new(n.outputs['Quadratic'], e.inputs[1])
t, e = light('c even', 2, (1, 1, 1))
n = t.nodes.new('ShaderNodeLightFalloff'); n.inputs[0].default_value = 5; t.links.new(n.outputs['Linear'], e.inputs[1])
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
)";

class BlenderLights : public BlenderCli {};

TEST_F(BlenderLights, ShineAsTheirNodesSay) {
  folder.write("make.py", kScene);
  const std::string file = folder.path("lights.blend");
  const Ran made = run_line("blender -b --factory-startup --python " + folder.path("make.py") + " -- " + file);
  ASSERT_TRUE(std::filesystem::exists(file)) << made.out;
  ASSERT_EQ(run("info " + file), 0) << err;
  EXPECT_NE(out.find("it shines as at 1 m in front of it: light 'c even'"), std::string::npos) << out;
  Scene scene;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("cache/ods/scenes"))) {
    if (entry.is_directory()) scene = load_scene((entry.path() / "scene.glb").native());
  }
  ASSERT_EQ(scene.lights.size(), 3u);
  const vec3 warm = scene.lights[0].intensity;
  EXPECT_NEAR(dot(warm, vec3(0.2126f, 0.7152f, 0.0722f)), 100.0f, 2.0f) << "Cycles keeps the luminance of black bodies";
  EXPECT_GT(warm.x, 1.5f * warm.y);
  EXPECT_GT(warm.y, 3.0f * warm.z);
  EXPECT_LT(length(scene.lights[1].intensity - vec3(300.0f, 150.0f, 75.0f)), 0.1f);
  EXPECT_LT(length(scene.lights[2].intensity - vec3(500.0f)), 0.5f) << "as strong as at 1 m";
}

}  // namespace ods::blender_lights_test
