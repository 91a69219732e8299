// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes that Blender itself has made, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "ods/image/image_file.h"
#include "ods/scene/load/load.h"
#include "ods/scene/motion.h"
#include "tests/support/cli_runner.h"
#include "tests/support/lambert.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods::blender_bridge_test {

namespace fs = std::filesystem;

constexpr const char* kStart = R"(
import bpy, math
bpy.ops.wm.read_factory_settings(use_empty=True)
S = bpy.context.scene
S.render.engine = 'CYCLES'
def link(name, data):
    o = bpy.data.objects.new(name, data); S.collection.objects.link(o); return o
def light(name, kind, place, watts, **more):
    l = bpy.data.lights.new(name, kind); l.energy = watts
    for key, value in more.items(): setattr(l, key, value)
    o = link(name, l); o.location = place; return o
def material(name, color=(1, 1, 1), node='ShaderNodeBsdfDiffuse'):
    m = bpy.data.materials.new(name); m.use_nodes = True; t = m.node_tree; t.nodes.clear()
    b = t.nodes.new(node); b.inputs[0].default_value = (*color, 1)
    t.links.new(b.outputs[0], t.nodes.new('ShaderNodeOutputMaterial').inputs[0]); return m
def plane(name, size, place, m):
    bpy.ops.mesh.primitive_plane_add(size=size, location=place); o = bpy.context.object
    o.name = name; o.data.materials.append(m); return o
def camera(place, turn=0):
    c = bpy.data.cameras.new('Camera'); c.type = 'PANO'
    (c if hasattr(c, 'panorama_type') else c.cycles).panorama_type = 'EQUIRECTANGULAR'
    o = link('Camera', c); o.location = place; o.rotation_euler = (math.pi / 2, 0, turn); S.camera = o; return o
def world(color):
    w = bpy.data.worlds.new('w'); S.world = w; w.use_nodes = True
    w.node_tree.nodes['Background'].inputs[0].default_value = (*color, 1); return w
)";

class BlenderBridge : public ::testing::Test {
 protected:
  void SetUp() override {
    static const std::string kMissing = missing("Blender", "blender --version");
    if (!kMissing.empty()) GTEST_SKIP() << kMissing;
    setenv("XDG_CACHE_HOME", folder_.path("cache").c_str(), 1);
  }

  // Makes a scene with Python and returns its file.
  std::string make(const std::string& python) const {
    const std::string file = folder_.path("scene.blend");
    folder_.write("make.py", kStart + python + "\nbpy.ops.wm.save_as_mainfile(filepath='" + file + "')\n");
    const Ran ran = run_line("blender --background --factory-startup --python " + folder_.path("make.py"));
    EXPECT_TRUE(fs::exists(file)) << ran.out;
    return file;
  }

  // The command's messages about it.
  std::string info(const std::string& file, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"info", file});
    Ods ods(more);
    EXPECT_EQ(ods.finish(), 0) << ods.err;
    return ods.out + ods.err;
  }

  // The scene as the bridge has converted it.
  Scene converted(const std::string& file) const {
    info(file);
    for (const auto& entry : fs::directory_iterator(folder_.path("cache/ods/scenes"))) {
      if (entry.is_directory()) return load_scene((entry.path() / "scene.glb").native());
    }
    ADD_FAILURE() << "nothing is kept";
    return {};
  }

  static Material material_of(const Scene& scene, const std::string& object) {
    for (const NamedObject& each : scene.objects) {
      if (each.name != object) continue;
      return scene.materials[size_t(scene.meshes[size_t(scene.instances[each.first_instance].mesh)].material)];
    }
    ADD_FAILURE() << object;
    return Material();
  }

  Image render(const std::string& file, std::vector<std::string> more) const {
    const std::string picture = folder_.path("picture.exr");
    more.insert(more.begin(), {"render", file, "-o", picture, "--eyes", "mono", "--indirect", "path"});
    Ods ods(more);
    EXPECT_EQ(ods.finish(), 0) << ods.err;
    return read_image(picture);
  }

  const TemporaryFolder folder_;
};

// Below each light, the radiance of a white floor. Cycles' own figures (docs/blender.md) agree.
TEST_F(BlenderBridge, LightsHaveTheWattsOfCycles) {
  const std::string file = make(R"(
plane('floor', 200, (0, 0, 0), material('white'))
light('square', 'AREA', (0, 0, 1), 100, shape='SQUARE', size=1)
o = light('disc', 'AREA', (40, 0, 1), 100, shape='DISK', size=0.5); o.scale = (2, 2, 2)
light('point', 'POINT', (80, 0, 1), 100, shadow_soft_size=0.1)
world((0, 0, 0))
camera((0, 0, 0.5))
)");
  const double pi = std::numbers::pi;
  const std::vector<glm::dvec3> square = {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}};
  const double expected[] = {polygon_irradiance({0, 0, 0}, square, 25.0) / pi,
                             25.0 / (pi / 4) * 0.25 / 1.25,  // a disc of radius r at h: pi L r^2 / (r^2 + h^2)
                             100.0 / (4 * pi) / pi};
  for (int i = 0; i < 3; i++) {
    const std::string place = std::to_string(40 * i) + ",0.5,0";
    const Image picture = render(file, {"--position", place, "--width", "32", "--samples", "512", "--bounces", "1"});
    double sum = 0.0;
    for (int x = 0; x < 32; x++) sum += double{*picture.at(x, 15)} / 32;
    EXPECT_NEAR(sum, expected[i], 0.02 * expected[i]) << i;
  }
}

// Red to the east (+X), green to the north (+Y), blue above.
TEST_F(BlenderBridge, TheWorldIsWhereItWas) {
  const std::string file = make(R"(
plane('far', 0.01, (0, 0, -50), material('white'))
w = world((0, 0, 0)); t = w.node_tree
i = bpy.data.images.new('sky', 64, 32, float_buffer=True); p = []
for y in range(32):
    for x in range(64):
        a = (x + .5) / 64 * 2 * math.pi - math.pi; e = (y + .5) / 32 * math.pi - math.pi / 2
        d = (math.cos(e) * math.sin(a), math.cos(e) * math.cos(a), math.sin(e))
        p += [max(0, d[0]), max(0, d[1]), max(0, d[2]), 1]
i.pixels = p; i.pack()
e = t.nodes.new('ShaderNodeTexEnvironment'); e.image = i
m = t.nodes.new('ShaderNodeMapping'); m.inputs['Rotation'].default_value = (0, 0, math.radians(-90))
g = t.nodes.new('ShaderNodeTexCoord')
t.links.new(g.outputs['Generated'], m.inputs['Vector']); t.links.new(m.outputs[0], e.inputs[0])
t.links.new(e.outputs[0], t.nodes['Background'].inputs[0])
camera((0, 0, 0))
)");
  const Image picture = render(file, {"--width", "64", "--samples", "4"});
  // The judge is what Blender itself sees.
  const std::string script = R"(
import bpy
S = bpy.context.scene; S.cycles.samples = 1; S.cycles.device = 'CPU'; S.cycles.use_denoising = False
S.render.resolution_x = 64; S.render.resolution_y = 32; S.render.resolution_percentage = 100
m = S.render.image_settings; m.file_format = 'OPEN_EXR'; m.color_depth = '32'; m.color_mode = 'RGB'
S.render.filepath = ')" + folder_.path("own.exr") +
                             R"('
bpy.ops.render.render(write_still=True)
)";
  folder_.write("own.py", script);
  const Ran ran = run_line("blender --background --factory-startup " + file + " --python " + folder_.path("own.py"));
  ASSERT_TRUE(fs::exists(folder_.path("own.exr"))) << ran.out;
  const Image own = read_image(folder_.path("own.exr"));
  double maximum = 0.0;
  for (int y = 2; y < 30; y++) {
    for (int x = 0; x < 64; x++) {
      for (int c = 0; c < 3; c++) {
        EXPECT_NEAR(picture.at(x, y)[c], own.at(x, y)[c], 0.06f) << x << ' ' << y << ' ' << c;
        maximum = std::max(maximum, double{own.at(x, y)[c]});
      }
    }
  }
  EXPECT_GT(maximum, 0.9);
}

// Light behind a window is there, and lamps of many watts are as bright as Blender means them.
TEST_F(BlenderBridge, InfoKnowsTheWorldAndTheUnits) {
  const std::string file = make(R"(
glow = material('glow', (1, 1, 1), 'ShaderNodeEmission')
plane('floor', 20, (0, 0, 0), material('white')); plane('glow', 1, (0, 5, 1), glow)
light('lamp', 'POINT', (0, 0, 3), 8000)
world((0.2, 0.3, 0.4)); camera((0, 0, 1.6))
)");
  const std::string said = info(file);
  EXPECT_NE(said.find(" an environment"), std::string::npos) << said;
  EXPECT_EQ(said.find("\nlost"), std::string::npos) << said;
  EXPECT_EQ(said.find("683"), std::string::npos) << said;
  const Image with = render(file, {"--width", "32", "--samples", "4", "--bounces", "1"});
  const Image same = render(file, {"--width", "32", "--samples", "4", "--bounces", "1", "--light-unit", "candela"});
  EXPECT_EQ(*with.at(16, 14), *same.at(16, 14));
}

TEST_F(BlenderBridge, MovesAsInBlender) {
  const std::string file = make(R"(
S.frame_start = 10; S.frame_end = 34; S.render.fps = 24
pivot = link('pivot', None); pivot.rotation_euler = (0, 0, 0); pivot.keyframe_insert('rotation_euler', frame=10)
pivot.rotation_euler = (0, 0, math.pi / 2); pivot.keyframe_insert('rotation_euler', frame=34)
door = plane('door', 1, (2, 0, 0), material('white')); door.parent = pivot
c = camera((0, 0, 1.6)); c.keyframe_insert('location', frame=10)
c.location = (1, 2, 1.6); c.keyframe_insert('location', frame=34)
for action in bpy.data.actions:
    for curve in action.fcurves:
        for key in curve.keyframe_points: key.interpolation = 'LINEAR'
l = light('lamp', 'POINT', (0, 0, 3), 100); l.data.keyframe_insert('energy', frame=10)
l.data.energy = 300; l.data.keyframe_insert('energy', frame=34)
for curve in l.data.animation_data.action.fcurves:
    for key in curve.keyframe_points: key.interpolation = 'LINEAR'
)");
  Scene scene = converted(file);
  ASSERT_EQ(scene.view_points.size(), 1u);
  ASSERT_EQ(scene.objects.size(), 1u);
  ASSERT_TRUE(play(scene.animation, ""));
  for (int frame = 0; frame <= 24; frame++) {
    const float share = static_cast<float>(frame) / 24.0f;
    set_time(scene, frame / 24.0);
    const vec3 camera = scene.view_points[0].position;
    EXPECT_LT(length(camera - vec3(share, 1.6f, -2.0f * share)), 1e-5f) << frame;
    EXPECT_NEAR(scene.view_points[0].yaw, 0.0f, 1e-3f);
    const Instance& door = scene.instances[scene.objects[0].first_instance];
    const vec3 at(door.row0.w, door.row1.w, door.row2.w);
    const float turn = share * static_cast<float>(std::numbers::pi) / 2.0f;
    EXPECT_LT(length(at - vec3(2.0f * std::cos(turn), 0.0f, -2.0f * std::sin(turn))), 1e-4f) << frame;
    EXPECT_NEAR(scene.lights[0].intensity.x, (100.0f + 200.0f * share) / (4 * 3.14159265f), 1e-3f) << frame;
  }
}

TEST_F(BlenderBridge, ShowsWhatTheRenderShows) {
  const std::string file = make(R"(
m = material('white')
hidden = plane('hidden', 1, (0, 0, 0), m); hidden.hide_render = True
screen = plane('viewport only', 1, (0, 0, 1), m); screen.hide_viewport = True
ghost = plane('ghost', 1, (0, 0, 2), m); ghost.visible_camera = False
a = screen.modifiers.new('array', 'ARRAY'); a.count = 3; a.show_viewport = False
kit = bpy.data.collections.new('kit')
tree = plane('tree', 1, (0, 0, 0), m); S.collection.objects.unlink(tree); kit.objects.link(tree)
for x in (5, 6, 7):
    e = link('copy', None); e.instance_type = 'COLLECTION'; e.instance_collection = kit; e.location = (x, 0, 0)
leaf = plane('leaf', .1, (0, 0, -9), m); leaf.hide_render = False
ground = plane('ground', 4, (0, 20, 0), m)
ground.modifiers.new('scatter', 'PARTICLE_SYSTEM')
p = ground.particle_systems[0].settings
p.type = 'HAIR'; p.count = 7; p.render_type = 'OBJECT'; p.instance_object = leaf; p.use_advanced_hair = True
fur = plane('fur', 1, (0, 30, 0), m); fur.modifiers.new('hair', 'PARTICLE_SYSTEM')
fur.particle_systems[0].settings.type = 'HAIR'
lamp = light('flat', 'POINT', (0, 0, 9), 1).data
setattr(*(lamp.cycles, 'cast_shadow') if hasattr(lamp.cycles, 'cast_shadow') else (lamp, 'use_shadow'), False)
)");
  const Scene scene = converted(file);
  std::map<std::string, size_t> counts;
  size_t unseen = 0;
  for (const NamedObject& each : scene.objects) counts[each.name.substr(0, 4)] += each.count;
  for (const Instance& each : scene.instances) unseen += each.role == kUnseen ? 1 : 0;
  EXPECT_EQ(counts["hidd"], 0u);
  EXPECT_EQ(counts["view"], 1u);
  EXPECT_EQ(counts["tree"], 3u);
  EXPECT_EQ(counts["leaf"], 8u) << "itself and seven copies";
  EXPECT_EQ(unseen, 1u);
  for (const NamedObject& each : scene.objects) {
    if (each.name != "viewport only") continue;
    const Mesh& mesh = scene.meshes[size_t(scene.instances[each.first_instance].mesh)];
    EXPECT_EQ(mesh.triangle_count, 6u) << "the render's modifiers";
  }
  const std::string said = info(file);
  EXPECT_NE(said.find("hair does not come across: object 'fur'"), std::string::npos) << said;
  EXPECT_NE(said.find("does not come across: light 'flat'"), std::string::npos) << said;
}

TEST_F(BlenderBridge, MaterialsAreWhatTheyMean) {
  const std::string file = make(R"(
def use(name, m): plane(name, 1, (0, 0, 0), m)
glass = material('glass', (1, 1, 1), 'ShaderNodeBsdfGlass')
glass.node_tree.nodes['Glass BSDF'].inputs['IOR'].default_value = 1.6; use('glass', glass)
use('metal', material('metal', (.9, .8, .7), 'ShaderNodeBsdfGlossy'))
lamp = material('lamp', (1, .5, .25), 'ShaderNodeEmission')
lamp.node_tree.nodes['Emission'].inputs[1].default_value = 8; use('lamp', lamp)
veil = bpy.data.materials.new('veil'); veil.use_nodes = True; t = veil.node_tree
x = t.nodes.new('ShaderNodeMixShader'); c = t.nodes.new('ShaderNodeBsdfTransparent'); x.inputs[0].default_value = .3
t.links.new(c.outputs[0], x.inputs[1]); t.links.new(t.nodes['Principled BSDF'].outputs[0], x.inputs[2])
t.links.new(x.outputs[0], t.nodes['Material Output'].inputs[0]); use('veil', veil)
marble = bpy.data.materials.new('marble'); marble.use_nodes = True; t = marble.node_tree
n = t.nodes.new('ShaderNodeTexNoise'); n.inputs['Scale'].default_value = 40
t.links.new(n.outputs['Fac'], t.nodes['Principled BSDF'].inputs['Base Color']); use('marble', marble)
)");
  const Scene scene = converted(file);
  EXPECT_EQ(material_of(scene, "glass").transmission, 1.0f);
  EXPECT_NEAR(material_of(scene, "glass").ior, 1.6f, 1e-5f);
  EXPECT_EQ(material_of(scene, "metal").metallic, 1.0f);
  EXPECT_NEAR(material_of(scene, "metal").base_color.z, 0.7f, 1e-5f);
  EXPECT_LT(length(material_of(scene, "lamp").emission - vec3(8, 4, 2)), 1e-4f);
  EXPECT_EQ(material_of(scene, "lamp").double_sided, 1);
  EXPECT_EQ(material_of(scene, "veil").alpha_mode, kAlphaBlend);
  EXPECT_NEAR(material_of(scene, "veil").base_color.w, 0.3f, 1e-5f);
  const vec4 marble = material_of(scene, "marble").base_color;  // Cycles' noise is about a half
  for (int i = 0; i < 3; i++) EXPECT_NEAR(marble[i], 0.5f, 0.1f);
  EXPECT_NE(info(file).find("(Noise Texture): material 'marble'; --bake 1024"), std::string::npos);
  fs::remove_all(folder_.path("cache"));
  const std::string baked = info(file, {"--bake", "64"});
  EXPECT_EQ(baked.find("what nodes compute"), std::string::npos) << baked;
  EXPECT_NE(baked.find(" 1 textures"), std::string::npos) << baked;
}

TEST_F(BlenderBridge, GroupsAndMixesAreWhatTheyMean) {
  const std::string file = make(R"(
def use(name, m): plane(name, 1, (0, 0, 0), m)
group = bpy.data.node_groups.new('paint', 'ShaderNodeTree')
if hasattr(group, 'interface'):
    group.interface.new_socket('Tint', in_out='INPUT', socket_type='NodeSocketColor')
    group.interface.new_socket('BSDF', in_out='OUTPUT', socket_type='NodeSocketShader')
else:
    group.inputs.new('NodeSocketColor', 'Tint'); group.outputs.new('NodeSocketShader', 'BSDF')
d = group.nodes.new('ShaderNodeBsdfDiffuse'); g = group.nodes.new('ShaderNodeBsdfGlossy')
g.inputs['Roughness'].default_value = .25; f = group.nodes.new('ShaderNodeFresnel')
x = group.nodes.new('ShaderNodeMixShader'); i = group.nodes.new('NodeGroupInput'); o = group.nodes.new('NodeGroupOutput')
v = group.nodes.new('NodeReroute'); group.links.new(i.outputs[0], v.inputs[0]); group.links.new(v.outputs[0], d.inputs[0])
group.links.new(f.outputs[0], x.inputs[0])
group.links.new(d.outputs[0], x.inputs[1]); group.links.new(g.outputs[0], x.inputs[2]); group.links.new(x.outputs[0], o.inputs[0])
paint = material('paint'); t = paint.node_tree; n = t.nodes.new('ShaderNodeGroup'); n.node_tree = group
n.inputs['Tint'].default_value = (.1, .2, .3, 1); t.links.new(n.outputs[0], t.nodes['Material Output'].inputs[0]); use('paint', paint)
pane = material('pane', (1, 1, 1), 'ShaderNodeBsdfGlossy'); t = pane.node_tree; t.nodes['Glossy BSDF'].inputs['Roughness'].default_value = 0
x = t.nodes.new('ShaderNodeMixShader'); t.links.new(t.nodes.new('ShaderNodeFresnel').outputs[0], x.inputs[0])
t.links.new(t.nodes.new('ShaderNodeBsdfTransparent').outputs[0], x.inputs[1])
t.links.new(t.nodes['Glossy BSDF'].outputs[0], x.inputs[2])
t.links.new(x.outputs[0], t.nodes['Material Output'].inputs[0]); use('pane', pane)
)");
  const Scene scene = converted(file);
  EXPECT_NEAR(material_of(scene, "paint").base_color.y, 0.2f, 1e-4f) << "the group's input";
  EXPECT_NEAR(material_of(scene, "paint").roughness, 0.25f, 1e-5f);
  EXPECT_EQ(material_of(scene, "paint").metallic, 0.0f);
  EXPECT_EQ(material_of(scene, "pane").transmission, 1.0f);
}

TEST_F(BlenderBridge, WithoutNodesItIsMatt) {
  const Scene scene = converted(make(R"(
bpy.ops.mesh.primitive_plane_add(); bpy.context.object.name = 'bare'
m = bpy.data.materials.new('old'); m.diffuse_color = (.8, .2, .3, 1); plane('old', 1, (0, 0, 0), m)
)"));
  for (const char* name : {"bare", "old"}) {
    const Material material = material_of(scene, name);
    EXPECT_NEAR(material.base_color.x, 0.8f, 1e-5f);
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.roughness, 1.0f);
  }
}

// Neither a text that Blender registers, nor a driver's expression.
TEST_F(BlenderBridge, RunsNoPythonOfTheFile) {
  const std::string mark = folder_.path("mark");
  const std::string file = make("mark = '" + mark + R"py('
text = bpy.data.texts.new('evil.py'); text.use_module = True
text.write("open('" + mark + "', 'w')")
o = plane('thing', 1, (0, 0, 0), material('white'))
d = o.driver_add('location', 0).driver; d.type = 'SCRIPTED'
d.expression = "__import__('os').system('touch " + mark + "')"
)py");
  fs::remove(mark);
  info(file);
  EXPECT_FALSE(fs::exists(mark));
}

TEST_F(BlenderBridge, NamesWhatItCannotOpen) {
  const std::string file = make("plane('a', 1, (0, 0, 0), material('white'))");
  const std::string bytes = folder_.read("scene.blend");
  ASSERT_EQ(bytes.substr(0, 7), "BLENDER");
  const auto refused = [&](const std::string& content) {
    folder_.write("bad.blend", content);
    Ods ods({"info", folder_.path("bad.blend")});
    EXPECT_EQ(ods.finish(), 3);
    EXPECT_EQ(std::count(ods.err.begin(), ods.err.end(), '\n'), 2) << ods.err;
    return ods.err;
  };
  EXPECT_NE(refused(bytes.substr(0, 7) + "-v999" + bytes.substr(12)).find("saved by Blender 9.99"), std::string::npos);
  EXPECT_NE(refused("BLENDER-v999 and what crashes this one").find("saved by Blender 9.99"), std::string::npos);
  const std::string packed = std::string("\x28\xb5\x2f\xfd\x00\x58\xa9\x00\x00", 9) + "BLENDER17-01v1203REND";  // zstd
  EXPECT_NE(refused(packed).find("saved by Blender 12.3"), std::string::npos);
  EXPECT_NE(refused(bytes.substr(0, bytes.size() / 2)).find("Blender cannot open it"), std::string::npos);
  EXPECT_TRUE(!fs::exists(folder_.path("cache/ods/scenes")) || fs::is_empty(folder_.path("cache/ods/scenes")));
}

TEST_F(BlenderBridge, NamesMissingPicturesAndGoesOn) {
  const std::string picture = folder_.path("poster.png");
  const std::string file = make("picture = '" + picture + R"('
m = bpy.data.materials.new('poster'); m.use_nodes = True; t = m.node_tree
i = bpy.data.images.new('poster', 4, 4); i.filepath_raw = picture; i.file_format = 'PNG'; i.save(); i.source = 'FILE'
n = t.nodes.new('ShaderNodeTexImage'); n.image = i
t.links.new(n.outputs[0], t.nodes['Principled BSDF'].inputs['Base Color']); plane('poster', 1, (0, 0, 0), m)
)");
  ASSERT_TRUE(fs::exists(picture));
  EXPECT_EQ(info(file).find("cannot be found"), std::string::npos);
  fs::remove(picture);
  const std::string said = info(file);  // converted again, as a file that it reads has changed
  EXPECT_NE(said.find("poster.png' cannot be found"), std::string::npos) << said;
}

// A node that every FBX has that Blender imports.
TEST_F(BlenderBridge, ANormalMapWithoutAPictureIsNoLoss) {
  const std::string all = info(make(R"(
m = material('plain', node='ShaderNodeBsdfPrincipled'); t = m.node_tree
t.links.new(t.nodes.new('ShaderNodeNormalMap').outputs[0], t.nodes['Principled BSDF'].inputs['Normal'])
plane('floor', 2, (0, 0, 0), m))"));
  EXPECT_EQ(all.find("what nodes compute"), std::string::npos) << all;
}

// In Blender's folders for users that this test makes.
class BlenderAddOn : public BlenderBridge {
 protected:
  void SetUp() override {
    BlenderBridge::SetUp();
    for (const char* name : {"config", "scripts", "work"}) fs::create_directories(folder_.path(name));
    setenv("BLENDER_USER_CONFIG", folder_.path("config").c_str(), 1);
    setenv("BLENDER_USER_SCRIPTS", folder_.path("scripts").c_str(), 1);
  }

  // The output of Python in Blender with the user's settings. `say` prints a line that is kept.
  std::string blender(const std::string& python, const std::string& file = "") const {
    folder_.write("say.py", "import bpy, os\nout = open('" + folder_.path("said") +
                                "', 'w')\ndef say(*words): print(*words, file=out, flush=True)\n" + python);
    const Ran ran =
        run_line("blender --background " + file + " --python-exit-code 1 --python " + folder_.path("say.py"));
    EXPECT_EQ(ran.code, 0) << ran.out;
    return folder_.read("said");
  }
};

TEST_F(BlenderAddOn, RendersWhatIsOpen) {
  const std::string file = make(R"(
plane('floor', 20, (0, 0, 0), material('white'))
light('lamp', 'POINT', (0, 0, 3), 100)
fur = plane('fur', 1, (0, 3, 1), material('red', (1, 0, 0))); fur.modifiers.new('hair', 'PARTICLE_SYSTEM')
fur.particle_systems[0].settings.type = 'HAIR'
S.frame_start = 1; S.frame_end = 3; fur.keyframe_insert('location', frame=1); fur.location.x = 1
fur.keyframe_insert('location', frame=3)
world((0, 0, 0)); camera((0, 0, 1.6)); S.frame_set(2)
)");
  Ods install({"blender"});
  ASSERT_EQ(install.finish(), 0) << install.err;
  const std::string said = blender(R"(
import sys
add_on = sys.modules[next(key for key in bpy.context.preferences.addons.keys() if key.endswith('omnistereo'))]
settings = bpy.context.scene.omnistereo
settings.quality = 'draft'; settings.width = 64; settings.output = ')" +
                                       folder_.path("work") + R"('
say('PANEL', add_on.OmnistereoPanel.is_registered, add_on.OmnistereoPanel.bl_context)
bpy.context.scene.objects['floor'].name = 'renamed since it was saved'
for kind in ('render', 'video'):
    say(kind, bpy.ops.omnistereo.run(kind=kind), add_on.running.code, add_on.running.share, add_on.running.warnings)
    say('FOLDER', os.path.exists(add_on.running.folder))
settings.renderer = 'cycles'; bpy.context.scene.cycles.samples = 2
say('CYCLES', bpy.ops.omnistereo.run(kind='render'), add_on.running.code, 'hair' in str(add_on.running.warnings))
settings.renderer = 'ods'
job = add_on.job.Job(['sleep', '1000'], add_on.job.private_folder())
say('RUNNING', job.is_running())
job.cancel(); job.wait(); say('CANCELLED', job.cancelled, job.is_running())
settings.output = ')" + folder_.path("scene.blend") +
                                       R"('
try: bpy.ops.omnistereo.run(kind='render')
except RuntimeError as error: say('ERROR', error)
)",
                                   file);
  EXPECT_NE(said.find("PANEL True render\n"), std::string::npos) << said;
  EXPECT_NE(said.find("render {'FINISHED'} 0 1.0 [\"hair does not come across: object 'fur'"), std::string::npos)
      << said;
  EXPECT_NE(said.find("video {'FINISHED'} 0 1.0 ["), std::string::npos) << said;
  EXPECT_NE(said.find("CYCLES {'FINISHED'} 0 False\n"), std::string::npos) << said << "hair is there";
  EXPECT_NE(said.find("FOLDER False\n"), std::string::npos) << said;
  EXPECT_NE(said.find("RUNNING True\nCANCELLED True False\n"), std::string::npos) << said;
  EXPECT_NE(said.find("ERROR Error: "), std::string::npos) << said;
  EXPECT_TRUE(fs::exists(folder_.path("work/scene_360_TB.png")));
  EXPECT_TRUE(fs::exists(folder_.path("work/scene_360_TB.mp4")));
}

// The archive that the build makes: as an add-on of Blender 3.4, and with the metadata that an extension of 4.2 needs.
TEST_F(BlenderAddOn, TheArchiveInstalls) {
  const std::string archive = fs::path(ods_command()).parent_path() / "omnistereo_blender.zip";
  ASSERT_TRUE(fs::exists(archive)) << archive;
  const std::string said = blender("archive = '" + archive + R"py('
if bpy.app.version >= (4, 2, 0):
    bpy.ops.extensions.package_install_files(filepath=archive, repo='user_default', enable_on_install=True)
else:
    bpy.ops.preferences.addon_install(filepath=archive)
    bpy.ops.preferences.addon_enable(module='omnistereo')
say('ENABLED', any(key.endswith('omnistereo') for key in bpy.context.preferences.addons.keys()))
say('SETTINGS', bpy.context.scene.omnistereo.quality)
import zipfile, tomllib
with zipfile.ZipFile(archive) as file:
    folders = {name.split('/')[0] for name in file.namelist()}
    manifest = tomllib.loads(file.read('omnistereo/blender_manifest.toml').decode())
say('FOLDERS', folders, any('__pycache__' in name for name in file.namelist()))
needed = {'schema_version', 'id', 'version', 'name', 'tagline', 'maintainer', 'type', 'blender_version_min', 'license'}
say('MISSING', needed - set(manifest), manifest['type'], manifest['blender_version_min'])
says = [manifest['tagline'], *manifest['permissions'].values()]
say('WORDS', all(len(text) <= 64 and text[-1].isalnum() for text in says))
import sys; own = sys.modules['omnistereo'].bl_info['version'] if 'omnistereo' in sys.modules else None
say('VERSION', own is None or '.'.join(map(str, own)) == manifest['version'])
)py");
  EXPECT_EQ(said,
            "ENABLED True\nSETTINGS preview\nFOLDERS {'omnistereo'} False\nMISSING set() add-on 4.2.0\nWORDS True\n"
            "VERSION True\n");
}

}  // namespace ods::blender_bridge_test
