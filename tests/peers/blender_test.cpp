// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Blender, set up by our script, sees what the camera sees: silhouettes of boxes, pixel by pixel. Where Blender is
// installed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "ods/export/camera_export.h"
#include "ods/image/image_file.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

struct Box {
  vec3 middle;
  float size;
};
const Box kBoxes[] = {{{0.35f, 0.05f, -0.5f}, 0.2f}, {{-0.4f, 0.3f, -0.3f}, 0.15f}, {{-0.2f, -0.25f, 0.4f}, 0.2f},
                      {{0.5f, 0.2f, 0.3f}, 0.18f},   {{0.1f, 0.6f, -0.15f}, 0.2f},  {{0.0f, -0.5f, -0.35f}, 0.2f}};

bool hits(const Box& box, const Ray& ray) {
  float near_end = 0.0f, far_end = 1e9f;
  for (int i = 0; i < 3; i++) {
    const float a = (box.middle[i] - 0.5f * box.size - ray.origin[i]) / ray.direction[i];
    const float b = (box.middle[i] + 0.5f * box.size - ray.origin[i]) / ray.direction[i];
    near_end = std::max(near_end, std::min(a, b)), far_end = std::min(far_end, std::max(a, b));
  }
  return near_end <= far_end;
}

// The share of the pixels in either silhouette that are in both: ours of one eye, and what Blender rendered.
double overlap(const Sidecar& file, int eye, const Image& theirs) {
  const Camera camera = make_camera(file.camera);
  int either = 0, both = 0;
  for (int y = 0; y < theirs.height; y++) {
    for (int x = 0; x < theirs.width; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(theirs.width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(theirs.height));
      bool ours = false;
      for (const Box& box : kBoxes) ours = ours || hits(box, camera_ray(camera, eye, uv));
      const bool their = theirs.at(x, y)[0] > 0.5f;
      either += ours || their ? 1 : 0;
      both += ours && their ? 1 : 0;
    }
  }
  return static_cast<double>(both) / std::max(either, 1);
}

// White boxes on black.
std::string scene_script() {
  std::string text =
      "import bpy\nbpy.ops.object.select_all(action='SELECT')\nbpy.ops.object.delete()\n"
      "white = bpy.data.materials.new('white')\nwhite.use_nodes = True\nnodes = white.node_tree.nodes\nnodes.clear()\n"
      "glow = nodes.new('ShaderNodeEmission')\nout = nodes.new('ShaderNodeOutputMaterial')\n"
      "white.node_tree.links.new(glow.outputs[0], out.inputs['Surface'])\n"
      "world = bpy.data.worlds.new('black')\nworld.use_nodes = True\n"
      "world.node_tree.nodes['Background'].inputs['Strength'].default_value = 0\nbpy.context.scene.world = world\n";
  for (const Box& box : kBoxes) {
    text += fmt::format(
        "bpy.ops.mesh.primitive_cube_add(size={}, location=({}, {}, {}))\n"
        "bpy.context.object.data.materials.append(white)\n",
        box.size, box.middle.x, -box.middle.z, box.middle.y);
  }
  return text;
}

TEST(Blender, SeesWhatTheCameraSees) {
  if (std::system("blender --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "skipped: Blender is not installed";
  const TemporaryFolder folder;
  Sidecar file;
  file.eye = {512, 256};
  file.layout = Layout::kSeparate;
  file.camera.yaw = 25.0f, file.camera.pitch = 15.0f, file.camera.roll = -10.0f;
  file.camera.position = vec3(0.02f, 0.03f, -0.01f);
  file.camera.top = file.camera.bottom = {kMergeCosine, 60.0f, 75.0f, 1.0f};
  const CameraExport blender = export_camera(file, CameraTarget::kBlender);
  ASSERT_TRUE(blender.warnings.empty()) << blender.warnings[0];
  folder.write("render.py", scene_script() + blender.text +
                                "scene.cycles.samples = 16\nscene.cycles.use_denoising = False\n"
                                "scene.cycles.use_adaptive_sampling = False\nscene.cycles.pixel_filter_type = 'BOX'\n"
                                "image.file_format = 'OPEN_EXR'\nscene.render.filepath = '" +
                                folder.path("eye") + "'\nbpy.ops.render.render(write_still=True)\n");
  ASSERT_EQ(std::system(("blender -b --factory-startup -P " + folder.path("render.py") + " > " +
                         folder.path("log.txt") + " 2>&1")
                            .c_str()),
            0)
      << folder.read("log.txt");
  const Image left = read_image(folder.path("eye_L.exr")), right = read_image(folder.path("eye_R.exr"));
  EXPECT_GE(overlap(file, kLeft, left), 0.99);
  EXPECT_GE(overlap(file, kRight, right), 0.99);
  EXPECT_LT(overlap(file, kLeft, right), 0.90);
  EXPECT_LT(overlap(file, kRight, left), 0.90);
}

// The boxes by the camera alone: were the eyes crossed, the test above would see it.
TEST(Blender, CrossedEyesWouldBeSeen) {
  Sidecar file;
  const Camera camera = make_camera(file.camera);
  Image right(512, 256, 1);
  for (int y = 0; y < 256; y++) {
    for (int x = 0; x < 512; x++) {
      const vec2 uv((static_cast<float>(x) + 0.5f) / 512.0f, (static_cast<float>(y) + 0.5f) / 256.0f);
      for (const Box& box : kBoxes) {
        if (hits(box, camera_ray(camera, kRight, uv))) *right.at(x, y) = 1.0f;
      }
    }
  }
  EXPECT_EQ(overlap(file, kRight, right), 1.0);
  EXPECT_LT(overlap(file, kLeft, right), 0.90);
}

}  // namespace
}  // namespace ods
