// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Blender, POV-Ray and three.js render the views of a rig, each by our script for it, and ods stitch makes a picture of
// them; ods render takes one of the same scene. Both show the same silhouettes to each eye. It takes minutes and those
// programs, and is disabled in ./run test; ./run peers installs them and runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "ods/image/image_file.h"
#include "ods/picture/stored_picture.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

// White things on black, around the eyes.
struct Thing {
  vec3 middle;
  float size;  // of a box its edge, of a ball its diameter
  bool is_ball;
};
const Thing kThings[] = {{{0.35f, 0.05f, -0.5f}, 0.2f, false},  {{-0.4f, 0.3f, -0.3f}, 0.2f, true},
                         {{-0.2f, -0.25f, 0.4f}, 0.2f, false},  {{0.5f, 0.2f, 0.3f}, 0.22f, true},
                         {{0.1f, 0.6f, -0.15f}, 0.2f, false},   {{0.0f, -0.5f, -0.35f}, 0.2f, true},
                         {{-0.15f, 0.0f, -0.75f}, 0.25f, true}, {{-0.7f, -0.1f, 0.2f}, 0.2f, false}};

// The camera, beside the origin, turned and tilted.
constexpr const char* kCamera = "--position 0.02,0.03,-0.01 --yaw 25 --pitch 15 --roll -10 --width 1024 --merge none";

// --- the scene, told four times --------------------------------------------------------------------------------------

// A ball of rings; a box is one of eight corners, flat: each side has four of its own.
struct Surface {
  std::vector<float> points;
  std::vector<uint32_t> triangles;
};

void add_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, Surface& surface) {
  for (const uint32_t corner : {a, b, c, a, c, d}) surface.triangles.push_back(corner);
}

void add_ball(const Thing& thing, Surface& surface) {
  constexpr uint32_t kAround = 96, kRings = 48;
  const uint32_t first = static_cast<uint32_t>(surface.points.size() / 3);
  for (uint32_t ring = 0; ring <= kRings; ring++) {
    for (uint32_t i = 0; i <= kAround; i++) {
      const float theta = kPi * static_cast<float>(ring) / kRings, phi = 2.0f * kPi * static_cast<float>(i) / kAround;
      const vec3 out(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      for (int k = 0; k < 3; k++) surface.points.push_back(thing.middle[k] + 0.5f * thing.size * out[k]);
    }
  }
  for (uint32_t ring = 0; ring < kRings; ring++) {
    for (uint32_t i = 0; i < kAround; i++) {
      const uint32_t a = first + ring * (kAround + 1) + i;
      add_quad(a, a + kAround + 1, a + kAround + 2, a + 1, surface);
    }
  }
}

void add_box(const Thing& thing, Surface& surface) {
  for (int side = 0; side < 6; side++) {
    const int axis = side / 2;
    const float sign = side % 2 == 0 ? 1.0f : -1.0f;
    const uint32_t first = static_cast<uint32_t>(surface.points.size() / 3);
    for (const auto& [u, v] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
      vec3 corner;
      corner[axis] = sign, corner[(axis + 1) % 3] = sign * u, corner[(axis + 2) % 3] = v;
      for (int k = 0; k < 3; k++) surface.points.push_back(thing.middle[k] + 0.5f * thing.size * corner[k]);
    }
    add_quad(first, first + 1, first + 2, first + 3, surface);
  }
}

void write_gltf(const TemporaryFolder& folder) {
  Surface surface;
  for (const Thing& thing : kThings) thing.is_ball ? add_ball(thing, surface) : add_box(thing, surface);
  GltfBuilder file;
  file.json = GltfJson::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "materials": [{"emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}]})");
  file.add(surface.points, kFloat, "VEC3");
  file.add(surface.triangles, kUint, "SCALAR");
  const Binary glb = file.glb();
  folder.write("scene.glb", std::string(glb.begin(), glb.end()));
}

void write_blender(const TemporaryFolder& folder) {
  std::string text =
      "import bpy\nbpy.ops.object.select_all(action='SELECT')\nbpy.ops.object.delete()\n"
      "white = bpy.data.materials.new('white')\nwhite.use_nodes = True\nnodes = white.node_tree.nodes\nnodes.clear()\n"
      "glow = nodes.new('ShaderNodeEmission')\nout = nodes.new('ShaderNodeOutputMaterial')\n"
      "white.node_tree.links.new(glow.outputs[0], out.inputs['Surface'])\n"
      "world = bpy.data.worlds.new('black')\nworld.use_nodes = True\n"
      "world.node_tree.nodes['Background'].inputs['Strength'].default_value = 0\nscene = bpy.context.scene\n"
      "scene.world = world\nscene.render.engine = 'CYCLES'\nscene.cycles.samples = 16\n"
      "scene.cycles.use_denoising = False\nscene.cycles.use_adaptive_sampling = False\n"
      "scene.cycles.max_bounces = 0\n";
  for (const Thing& thing : kThings) {
    const std::string at = fmt::format("({}, {}, {})", thing.middle.x, -thing.middle.z, thing.middle.y);
    text +=
        thing.is_ball
            ? fmt::format("bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius={}, location={})\n",
                          0.5f * thing.size, at)
            : fmt::format("bpy.ops.mesh.primitive_cube_add(size={}, location={})\n", thing.size, at);
    text += "bpy.context.object.data.materials.append(white)\n";
  }
  folder.write("scene.py", text);
}

void write_povray(const TemporaryFolder& folder) {
  std::string text =
      "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#default { pigment { rgb 1 } finish {"
      " ambient 0 diffuse 0 emission 1 } }\n";
  for (const Thing& thing : kThings) {
    const glm::vec3 p(thing.middle.x, thing.middle.y, -thing.middle.z), half(0.5f * thing.size);
    const glm::vec3 low = p - half, high = p + half;
    text += thing.is_ball
                ? fmt::format("sphere {{ <{}, {}, {}>, {} }}\n", p.x, p.y, p.z, half.x)
                : fmt::format("box {{ <{}, {}, {}>, <{}, {}, {}> }}\n", low.x, low.y, low.z, high.x, high.y, high.z);
  }
  folder.write("scene.pov", text + "#include \"rig.povray.inc\"\n");
}

// With three.js beside it, as examples/three has pages.
void write_three(const TemporaryFolder& folder) {
  std::string text =
      "<!doctype html>\n<script src=\"three.js\"></script>\n<script type=\"module\">\n"
      "import { renderViews } from \"./rig.three.js\";\n"
      "const end = (words = \"\") => fetch(\"/end\", { method: \"POST\", body: words });\n"
      "addEventListener(\"unhandledrejection\", (event) => end(String(event.reason)));\n"
      "const scene = new THREE.Scene(), white = new THREE.MeshBasicMaterial({ color: 0xffffff });\n"
      "function add(shape, x, y, z) {\n"
      "  const thing = new THREE.Mesh(shape, white);\n  thing.position.set(x, y, z);\n  scene.add(thing);\n}\n";
  for (const Thing& thing : kThings) {
    const std::string shape = thing.is_ball
                                  ? fmt::format("SphereGeometry({}, 96, 48)", 0.5f * thing.size)
                                  : fmt::format("BoxGeometry({}, {}, {})", thing.size, thing.size, thing.size);
    text += fmt::format("add(new THREE.{}, {}, {}, {});\n", shape, thing.middle.x, thing.middle.y, thing.middle.z);
  }
  text +=
      "const save = (name, blob) => fetch(\"/views/\" + name, { method: \"PUT\", body: blob });\n"
      "await renderViews(THREE, new THREE.WebGLRenderer({ antialias: true }), scene, { save });\nawait end();\n"
      "</script>\n";
  folder.write("page.html", text);
}

// --- pictures --------------------------------------------------------------------------------------------------------

class Peers : public ::testing::Test {
 protected:
  void shell(const std::string& command) const {
    const std::string all = "cd " + folder.path("") + " && " + command + " > log.txt 2>&1 < /dev/null";
    ASSERT_EQ(std::system(all.c_str()), 0) << command << "\n" << folder.read("log.txt");
  }
  void ods(const std::string& words) const { shell(ods_command() + " " + words); }

  // The share of the pixels in either silhouette that are in both.
  double overlap(const std::string& a, const std::string& b) const {
    const Image x = read_image(folder.path(a)), y = read_image(folder.path(b));
    EXPECT_TRUE(x.width == 1024 && y.width == 1024 && x.height == y.height);
    size_t either = 0, both = 0;
    for (int row = 0; row < x.height; row++) {
      for (int column = 0; column < x.width; column++) {
        const bool in_x = x.at(column, row)[0] > 0.5f, in_y = y.at(column, row)[0] > 0.5f;
        either += in_x || in_y ? 1 : 0, both += in_x && in_y ? 1 : 0;
      }
    }
    EXPECT_GT(either, 10000u);
    return static_cast<double>(both) / static_cast<double>(std::max<size_t>(either, 1));
  }

  // Each eye against ods render's, and against its other eye: were they crossed, that would be seen.
  void compare(const char* peer, double minimum = 0.985) const {
    for (const auto& [eye, other] : {std::pair("left", "right"), std::pair("right", "left")}) {
      const std::string stitched = fmt::format("stitched_{}.exr", eye);
      const double same = overlap(stitched, fmt::format("ours_{}.exr", eye));
      std::printf("%s, %s eye: silhouettes IoU %.4f\n", peer, eye, same);
      EXPECT_GE(same, minimum);
      EXPECT_LT(overlap(stitched, fmt::format("ours_{}.exr", other)), 0.95);
    }
  }

  void direct_picture() const {
    write_gltf(folder);
    ods(fmt::format("render scene.glb {} --samples 16 --env 0 -o ours_%V.exr", kCamera));
  }

  TemporaryFolder folder;
};

bool is_there(const char* program) {
  return std::system(fmt::format("command -v {} > /dev/null", program).c_str()) == 0;
}

TEST_F(Peers, DISABLED_PovrayShowsTheSame) {
  ASSERT_TRUE(is_there("povray"));
  direct_picture();
  write_povray(folder);
  ods(fmt::format("rig {} --slits 48 -o rig.json --for povray", kCamera));
  shell("mkdir views && povray rig.povray.ini +Iscene.pov");
  ods("stitch rig.json views/view####.exr -o stitched_%V.exr");
  compare("POV-Ray");
}

TEST_F(Peers, DISABLED_BlenderShowsTheSame) {
  ASSERT_TRUE(is_there("blender"));
  direct_picture();
  write_blender(folder);
  ods(fmt::format("rig {} --slits 48 -o rig.json --for blender", kCamera));
  // In two parts, as a farm does; the second finds views that are there.
  const std::string blender = "blender -b --factory-startup --python-exit-code 1 -P scene.py -P rig.blender.py";
  shell(blender + " -- 1 50");
  shell(blender);
  ods("stitch rig.json views/####.exr -o stitched_%V.exr");
  compare("Blender");
}

TEST_F(Peers, DISABLED_ThreeShowsTheSame) {
  const std::string three = "/usr/share/javascript/three/three.js";
  if (!is_there("chromium-headless-shell")) GTEST_SKIP() << "skipped: chromium-headless-shell is not installed";
  direct_picture();
  write_three(folder);
  ods(fmt::format("rig {} --slits 48 -o rig.json --for three", kCamera));
  shell("cp " + three + " . && node " + source_folder() + "/examples/three/views.mjs page.html");
  ods("stitch rig.json views/####.png -o stitched_%V.exr");
  compare("three.js");
}

// The depth of every pixel's ray; kFarDepth where it met nothing.
std::vector<float> depths(const std::string& path) {
  const StoredPicture picture = open_picture(path);
  std::vector<float> values;
  for (const LayerPixels& layer : picture.eyes[0].layers) {
    if (!layer.channels[0].ends_with("Z") || layer.rule != LayerRule::kNearest) continue;
    for (int y = 0; y < picture.size.height; y++) {
      for (int x = 0; x < picture.size.width; x++) {
        values.push_back(sample_value(layer.sample, layer.first + y * layer.row_stride + x * layer.pixel_stride));
      }
    }
    break;
  }
  return values;
}

// A quarter of the slits, with Blender's depth: the stitched depth is the depth of our rays. At silhouettes one thing
// hides another, which depth alone does not correct; without depth they agree by 0.981.
TEST_F(Peers, DISABLED_BlendersDepthIsAlongTheAxis) {
  ASSERT_TRUE(is_there("blender"));
  direct_picture();
  write_blender(folder);
  ods(fmt::format("rig {} --slits 12 --depth plane -o rig.json --for blender", kCamera));
  shell("blender -b --factory-startup --python-exit-code 1 -P scene.py -P rig.blender.py");
  ods("stitch rig.json views/####.exr -o stitched_%V.exr");
  compare("Blender with depth", 0.983);
  const std::vector<float> theirs = depths(folder.path("stitched_left.exr")),
                           ours = depths(folder.path("ours_left.exr"));
  ASSERT_EQ(theirs.size(), ours.size());
  size_t met = 0, same = 0;
  for (size_t i = 0; i < ours.size(); i++) {
    if (!(ours[i] < 10.0f) || !(theirs[i] < 10.0f)) continue;
    met++, same += std::abs(theirs[i] - ours[i]) < 0.01f * ours[i] ? 1 : 0;
  }
  EXPECT_GT(met, 10000u);
  std::printf("Blender with depth: within 1%% of ours at %.4f of the pixels\n",
              static_cast<double>(same) / static_cast<double>(std::max<size_t>(met, 1)));
  EXPECT_GE(static_cast<double>(same), 0.98 * static_cast<double>(met));
}

}  // namespace
}  // namespace ods
