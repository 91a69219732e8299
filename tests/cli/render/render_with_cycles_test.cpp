// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// --renderer cycles. Tests that need Blender are skipped without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "ods/image/image_file.h"
#include "tests/support/cli_runner.h"
#include "tests/support/exr_files.h"
#include "tests/support/programs.h"

namespace ods::render_with_cycles_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Lamps of emission in a dark world: a picture without noise. One of them moves.
constexpr const char* kScene = R"(
import bpy, math
bpy.ops.wm.read_factory_settings(use_empty=True)
S = bpy.context.scene
S.render.engine = 'CYCLES'
S.cycles.samples, S.cycles.pixel_filter_type, S.cycles.use_adaptive_sampling = 64, 'BOX', False
S.view_settings.view_transform = 'Standard'
W = S.world = bpy.data.worlds.new('dark')
W.use_nodes = True
W.node_tree.nodes['Background'].inputs[1].default_value = 0
def lamp(name, place, color):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.15, location=place)
    o = bpy.context.object
    m = bpy.data.materials.new(name); m.use_nodes = True; t = m.node_tree; t.nodes.clear()
    e = t.nodes.new('ShaderNodeEmission'); e.inputs[0].default_value = (*color, 1); e.inputs[1].default_value = 0.5
    t.links.new(e.outputs[0], t.nodes.new('ShaderNodeOutputMaterial').inputs[0]); o.data.materials.append(m); return o
lamp('red', (0.3, 1.0, 1.6), (1, 0, 0))
lamp('green', (0.2, 0.5, 2.6), (0, 1, 0))  # where the poles merge
moving = lamp('blue', (-1.2, -0.4, 1.4), (0, 0, 1))
moving.keyframe_insert('location', frame=1); moving.location.z = 1.9; moving.keyframe_insert('location', frame=3)
S.frame_start, S.frame_end = 1, 3
c = bpy.data.cameras.new('Camera'); o = bpy.data.objects.new('Camera', c); S.collection.objects.link(o)
o.location = (0, 0, 1.6); o.rotation_euler = (math.pi / 2, 0, 0.4); S.camera = o
)";

class RenderWithCycles : public ::testing::Test {
 protected:
  void SetUp() override {
    static const std::string kMissing = missing("Blender", "blender --version");
    if (!kMissing.empty()) GTEST_SKIP() << kMissing;
    setenv("XDG_CACHE_HOME", folder_.path("cache").c_str(), 1);
    fs::create_directory(folder_.path("temporary"));
    setenv("TMPDIR", folder_.path("temporary").c_str(), 1);
  }
  void TearDown() override { unsetenv("TMPDIR"); }

  std::string make(const std::string& more = "") const {
    const std::string file = folder_.path("scene.blend");
    folder_.write("make.py", kScene + more + "\nbpy.ops.wm.save_as_mainfile(filepath='" + file + "')\n");
    const Ran ran = run_line("blender --background --factory-startup --python " + folder_.path("make.py"));
    EXPECT_TRUE(fs::exists(file)) << ran.out;
    return file;
  }

  // Runs the command on a scene. Returns its exit code.
  int run(const std::string& command, const std::string& scene, const std::string& output, const Words& more) {
    Words words = {command, scene, "-o", folder_.path(output)};
    words.insert(words.end(), more.begin(), more.end());
    Ods ods(words);
    const int code = ods.finish();
    err = ods.err, out = ods.out;
    return code;
  }

  Image render(const std::string& scene, const std::string& renderer, Words more) {
    more.insert(more.end(), {"--renderer", renderer});
    if (std::ranges::find(more, "--width") == more.end()) more.insert(more.end(), {"--width", "256"});
    if (renderer == "ods") more.insert(more.end(), {"--samples", "64", "--filter", "box", "--noise", "none"});
    const std::string output = renderer + ".exr";
    EXPECT_EQ(run("render", scene, output, more), 0) << err;
    return read_image(folder_.path(output));
  }

  // Waits until no process has this test's folder on its command line.
  bool has_no_blender() const {
    for (int i = 0; i < 100; i++) {
      const Ran ran = run_line("cat /proc/[0-9]*/cmdline 2>/dev/null | tr '\\0' ' ' | grep -a -c -- '-- rende[r] " +
                               folder_.path("scene.blend") + "'");
      if (ran.out == "0\n") return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }

  const TemporaryFolder folder_;
  std::string out, err;
};

struct Blob {
  double x = 0.0, y = 0.0, light = 0.0;
};

// The middle of the light of one channel in one half of a picture.
Blob blob_of(const Image& picture, int channel, int first, int last) {
  Blob blob;
  for (int y = first; y < last; y++) {
    for (int x = 0; x < picture.width; x++) {
      const double light = double{picture.at(x, y)[channel]};
      blob.x += light * x, blob.y += light * y, blob.light += light;
    }
  }
  blob.x /= blob.light, blob.y /= blob.light;
  return blob;
}

// Both eyes of both renderers show the lamps at the same places.
void expect_same_places(const Image& a, const Image& b, double pixels, const std::string& what) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  for (const int eye : {0, 1}) {
    for (const int channel : {0, 1, 2}) {
      const int first = eye * a.height / 2, last = first + a.height / 2;
      const Blob ours = blob_of(a, channel, first, last), theirs = blob_of(b, channel, first, last);
      ASSERT_GT(ours.light, 1.0) << what;
      EXPECT_NEAR(ours.x, theirs.x, pixels) << what << ", eye " << eye << ", channel " << channel;
      EXPECT_NEAR(ours.y, theirs.y, pixels) << what << ", eye " << eye << ", channel " << channel;
      EXPECT_NEAR(theirs.light / ours.light, 1.0, 0.02) << what << ", eye " << eye << ", channel " << channel;
    }
  }
}

TEST_F(RenderWithCycles, ShowsThingsWhereOurRendererDoes) {
  const std::string scene = make();
  const std::pair<Words, double> kViews[] = {
      {{}, 0.05},
      {{"--ipd", "0.2", "--merge", "none", "--position", "0.1,1.5,0.2", "--yaw", "30"}, 0.05},
      {{"--ipd", "0.2", "--pitch", "20", "--roll", "-10"}, 0.05},
      {{"--ipd", "0.2", "--convergence", "toe-in,2"}, 0.05},
      {{"--ipd", "0.2", "--merge", "power,0,90,2"}, 0.25},                     // in bands
      {{"--ipd", "0.2", "--time", "0.0416667"}, 0.05},                         // a frame
      {{"--ipd", "0.2", "--width", "384", "--projection", "cube-3x2"}, 0.15},  // converted
  };
  for (const auto& [view, pixels] : kViews) {
    const std::string what = view.empty() ? "the usual view" : view[view.size() - 2] + " " + view.back();
    expect_same_places(render(scene, "ods", view), render(scene, "cycles", view), pixels, what);
  }
}

// Writes a lat-long picture without any symmetry.
void write_light(const std::string& path) {
  ExrForm form;
  form.width = 64, form.height = 32;
  std::vector<float> values;
  for (int i = 0; i < form.width * form.height; i++) {
    const auto azimuth = static_cast<float>(i % form.width) / 64.0f,
               height = static_cast<float>(i / form.width) / 32.0f;
    values.insert(values.end(), {0.2f + 0.8f * azimuth, 0.2f + 0.6f * height, azimuth < 0.25f ? 1.0f : 0.1f});
  }
  write_exr_of(path, form, values);
}

// The mean difference of all values of two pictures, and the mean of the first.
std::pair<double, double> mean_difference(const Image& a, const Image& b) {
  double difference = 0.0, sum = 0.0;
  for (size_t i = 0; i < a.pixels.size(); i++) {
    difference += std::abs(double{a.pixels[i]} - double{b.pixels[i]}), sum += double{a.pixels[i]};
  }
  const auto count = static_cast<double>(a.pixels.size());
  return {difference / count, sum / count};
}

TEST_F(RenderWithCycles, TheGivenLightReplacesTheWorld) {
  const std::string scene = make(R"(
bpy.ops.mesh.primitive_cube_add(size=1.5, location=(0.4, -2, 1.2))
m = bpy.data.materials.new('white'); m.use_nodes = True
b = m.node_tree.nodes['Principled BSDF']
b.inputs['Base Color'].default_value = (0.8, 0.8, 0.8, 1)
b.inputs['Roughness'].default_value = 1
if 'Specular' in b.inputs: b.inputs['Specular'].default_value = 0
bpy.context.object.data.materials.append(m)
)");
  const std::string light = folder_.path("light.exr");
  write_light(light);
  const Words kLights[] = {{"--env", light},
                           {"--env", light, "--env-turn", "40", "--env-strength", "0.5"},
                           {"--env", "0.5", "--background", light},
                           {"--background", "0.2,0.4,0.6"}};
  for (Words words : kLights) {
    const std::string what = words.back();
    words.insert(words.end(), {"--width", "128"});
    const auto [difference, mean] = mean_difference(render(scene, "ods", words), render(scene, "cycles", words));
    EXPECT_GT(mean, 0.1) << what;
    EXPECT_LT(difference, 0.03 * mean) << what;
  }
  for (const char* const made : {"studio", "sky"}) {  // ours has a ground with the shadow of the cube
    const Words words = {"--env", made, "--width", "128", "--eyes", "left"};
    Image ours = render(scene, "ods", words), theirs = render(scene, "cycles", words);
    ours.pixels.resize(ours.pixels.size() / 4), theirs.pixels.resize(theirs.pixels.size() / 4);
    const auto [difference, mean] = mean_difference(ours, theirs);
    EXPECT_LT(difference, 0.03 * mean) << made;
    EXPECT_NE(err.find("ground"), std::string::npos) << err;
  }
}

TEST_F(RenderWithCycles, UnitScaleAndDepthAreMetres) {
  const std::string scene = make("S.unit_settings.system, S.unit_settings.scale_length = 'METRIC', 0.5\n");
  const Words kView = {"--ipd", "0.2", "--eyes", "left"};
  render(scene, "ods", kView), render(scene, "cycles", kView);
  const auto depth = [&](const std::string& name) { return read_channels(folder_.path(name), {"Z"}); };
  const Image a = depth("ods.exr"), b = depth("cycles.exr");
  int surfaces = 0, different = 0;
  for (size_t i = 0; i < a.pixels.size(); i++) {
    const bool both = a.pixels[i] < 1e9f && b.pixels[i] < 1e9f;
    surfaces += both;
    different += both && std::abs(a.pixels[i] - b.pixels[i]) > 0.02f * a.pixels[i];
  }
  EXPECT_GT(surfaces, 20);
  EXPECT_LT(different, surfaces / 5) << "but for edges";
}

TEST_F(RenderWithCycles, TheFileStaysAndItsSettingsHold) {
  const std::string scene = make("S.cycles.samples = 7\nS.view_settings.exposure = 2\n");
  const auto time = fs::last_write_time(scene);
  ASSERT_EQ(run("render", scene, "a_360_TB.png", {"--renderer", "cycles", "--width", "64", "--sidecar"}), 0) << err;
  EXPECT_NE(err.find("at most 7 samples"), std::string::npos) << err;
  EXPECT_EQ(fs::last_write_time(scene), time);
  const Image picture = read_image(folder_.path("a_360_TB.png"));
  EXPECT_EQ(picture.width, 64);
  EXPECT_EQ(picture.height, 64);
  EXPECT_GT(*std::max_element(picture.pixels.begin(), picture.pixels.end()), 0.9f) << "0.5, four times as bright";
  EXPECT_TRUE(fs::exists(folder_.path("a_360_TB.camera.json")));
  EXPECT_FALSE(fs::exists(folder_.path("a_360_TB.png.frames")));
  EXPECT_TRUE(fs::is_empty(folder_.path("temporary")));
}

TEST_F(RenderWithCycles, WhatItCannotDoIsOneLine) {
  const std::string scene = make("bpy.data.objects.remove(o)\n");
  const std::tuple<Words, int, const char*> kCases[] = {
      {{"--position", "0,1,0", "--quality", "final"}, 2, "--quality cannot be used with --renderer cycles"},
      {{"--position", "0,1,0", "--eye-to-neck", "0.1"}, 2, "--eye-to-neck"},
      {{"--position", "0,1,0", "--merge", "auto"}, 2, "--merge auto"},
      {{"--camera", "Bathroom"}, 3, "no camera 'Bathroom'"},
      {{"--scene", "Kitchen"}, 3, "no scene 'Kitchen'"},
      {{"--position", "0,1,0", "--env", "night.hdr"}, 3, "no such file as 'night.hdr'"},
      {{"--position", "0,1,0", "--env-turn", "20"}, 2, "--env-turn and --env-strength need --env"},
      {{"--position", "0,1,0", "--device", "gpu"}, 3, "--device gpu"},
  };
  for (const auto& [words, code, text] : kCases) {
    Words all = words;
    all.insert(all.end(), {"--renderer", "cycles", "--width", "16", "--samples", "1", "-q"});
    EXPECT_EQ(run("render", scene, "a.png", all), code) << text << err;
    EXPECT_NE(err.find(text), std::string::npos) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_FALSE(fs::exists(folder_.path("a.png")));
  }
}

// After each part, the picture's folder has it; the same command renders the rest.
TEST_F(RenderWithCycles, AKilledPictureResumes) {
  const std::string scene = make();
  const Words words = {"render", scene, "-o", folder_.path("a.png"), "--renderer", "cycles", "--width", "256"};
  Words slow = words;
  slow.insert(slow.end(), {"--samples", "600", "--progress", "plain"});
  Ods first(slow);
  for (int i = 0; i < 1200 && !fs::exists(folder_.path("a.png.frames/frame.000001.exr")); i++) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  first.kill(SIGKILL);
  EXPECT_EQ(first.finish(), 1000 + SIGKILL) << first.err;
  EXPECT_TRUE(has_no_blender());
  EXPECT_FALSE(fs::exists(folder_.path("a.png")));
  Ods other(words);
  EXPECT_EQ(other.finish(), 2) << "with other samples";
  EXPECT_NE(other.err.find("--restart"), std::string::npos) << other.err;
  Ods second(slow);
  EXPECT_EQ(second.finish(), 0) << second.err;
  EXPECT_NE(second.err.find("of 4 parts exist already"), std::string::npos) << second.err;
  EXPECT_TRUE(fs::exists(folder_.path("a.png")));
  EXPECT_FALSE(fs::exists(folder_.path("a.png.frames")));
}

TEST_F(RenderWithCycles, CtrlCStopsBlender) {
  const std::string scene = make();
  Ods ods({"render", scene, "-o", folder_.path("a.png"), "--renderer", "cycles", "--samples", "100000", "--width",
           "512", "--noise", "none"});
  ods.wait_for("renders a picture");
  ods.kill(SIGINT);
  EXPECT_EQ(ods.finish(), 130) << ods.err;
  EXPECT_TRUE(has_no_blender());
  EXPECT_FALSE(fs::exists(folder_.path("a.png")));
}

TEST_F(RenderWithCycles, AVideoIsMadeFrameByFrame) {
  const std::string scene = make();
  const Words more = {"--renderer", "cycles", "--width", "64", "--samples", "2", "--keep-frames"};
  Words second = more;
  second.insert(second.end(), {"--only", "2"});
  ASSERT_EQ(run("video", scene, "a_360_TB.mp4", second), 0) << err;
  EXPECT_TRUE(fs::exists(folder_.path("a_360_TB.mp4.frames/frame.000002.exr")));
  EXPECT_FALSE(fs::exists(folder_.path("a_360_TB.mp4")));
  ASSERT_EQ(run("video", scene, "a_360_TB.mp4", more), 0) << err;
  EXPECT_NE(err.find("1 of 3 frames exist already"), std::string::npos) << err;
  EXPECT_TRUE(fs::exists(folder_.path("a_360_TB.mp4")));
  const auto frame = [&](int n) {
    return read_image(folder_.path("a_360_TB.mp4.frames/frame.00000" + std::to_string(n) + ".exr"));
  };
  EXPECT_GT(blob_of(frame(1), 2, 0, 32).y, blob_of(frame(3), 2, 0, 32).y + 2.0) << "the blue lamp rises";
}

TEST_F(RenderWithCycles, AFileWithoutACameraIsSeenFromWhereOurRendererStands) {
  const std::string scene = make("bpy.data.objects.remove(o)\n");
  expect_same_places(render(scene, "ods", {}), render(scene, "cycles", {}), 0.05, "without a camera");
  EXPECT_NE(err.find("camera at"), std::string::npos) << err;
  const std::string named = make();
  const Words none = {"--camera", "none"};
  expect_same_places(render(named, "ods", none), render(named, "cycles", none), 0.05, "without its camera");
}

TEST_F(RenderWithCycles, TheCameraMovesAsInOurRenderer) {
  const std::string scene = make();
  const auto frame = [&](const std::string& renderer, Words words) {
    words.insert(words.end(), {"--renderer", renderer, "--frames", "2", "--duration", "0.3", "--width", "256"});
    if (renderer == "ods") words.insert(words.end(), {"--samples", "64", "--filter", "box", "--noise", "none"});
    EXPECT_EQ(run("render", scene, renderer + ".#.exr", words), 0) << err;
    return read_image(folder_.path(renderer + ".2.exr"));
  };
  for (const Words& move : {Words{"--turntable", "1,0.2,1,-1"}, Words{"--turntable", "-1"},
                            Words{"--fly-to", "0.3,1.5,0.6"}, Words{"--turntable", "1", "--fly-to", "0.3,1.5,0.6"}}) {
    expect_same_places(frame("ods", move), frame("cycles", move), 0.1, move.front() + " " + move.back());
  }
}

// A cube in the light of the lamps, which Cycles finds by chance.
constexpr const char* kNoisy = R"(
bpy.ops.mesh.primitive_cube_add(size=1.5, location=(0.4, 2.5, 1.2))
m = bpy.data.materials.new('white'); m.use_nodes = True
bpy.context.object.data.materials.append(m)
)";

TEST_F(RenderWithCycles, StatisticsAreTheNoiseAndTheSamples) {
  const std::string scene = make(kNoisy);
  const auto shot = [&](const std::string& name, const char* seed) {
    EXPECT_EQ(run("render", scene, name,
                  {"--renderer", "cycles", "--width", "128", "--eyes", "left", "--samples", "32", "--statistics",
                   "--seed", seed}),
              0)
        << err;
    EXPECT_NE(err.find("at most 32 samples per pixel, at most"), std::string::npos) << err;
    return std::pair(read_image(folder_.path(name)),
                     read_channels(folder_.path(name), {"variance.R", "variance.G", "variance.B"}));
  };
  const auto [a, variance_a] = shot("a.exr", "1");
  const auto [b, variance_b] = shot("b.exr", "2");
  double squares = 0.0, expected = 0.0;
  for (size_t i = 0; i < a.pixels.size(); i++) {
    const double difference = double{a.pixels[i]} - double{b.pixels[i]};
    squares += difference * difference;
    expected += double{variance_a.pixels[i]} + double{variance_b.pixels[i]};
  }
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(squares / expected, 1.0, 0.5) << "two pictures differ by the noise that each states";
  for (const float samples : read_channels(folder_.path("a.exr"), {"samples"}).pixels) ASSERT_EQ(samples, 32.0f);
}

// The two parts are the halves whose difference is a picture's noise.
TEST_F(RenderWithCycles, PartsMergeToThePicture) {
  const std::string scene = make(kNoisy);
  const auto shot = [&](const std::string& name, const Words& more) {
    Words words = {"--renderer", "cycles", "--width", "64", "--samples", "8"};
    words.insert(words.end(), more.begin(), more.end());
    return run("render", scene, name, words);
  };
  ASSERT_EQ(shot("whole.exr", {"--statistics", "--denoise", "none"}), 0) << err;
  ASSERT_EQ(shot("part_1.exr", {"--part", "1/2"}), 0) << err;
  ASSERT_EQ(shot("part_2.exr", {"--part", "2/2"}), 0) << err;
  Ods merge({"merge", folder_.path("part_#.exr"), "-o", folder_.path("merged.exr"), "--denoise", "none"});
  ASSERT_EQ(merge.finish(), 0) << merge.err;
  const auto [difference, mean] =
      mean_difference(read_image(folder_.path("whole.exr")), read_image(folder_.path("merged.exr")));
  EXPECT_GT(mean, 0.0);
  EXPECT_LT(difference, 1e-5 * mean);
  EXPECT_EQ(shot("part_1.exr", {"--part", "1/2", "--projection", "fisheye-equisolid"}), 2);
  EXPECT_NE(err.find("needs a lat-long"), std::string::npos) << err;
  EXPECT_EQ(shot("part_1.exr", {"--part", "1/9"}), 2);
  EXPECT_NE(err.find("8 samples cannot be split into 9 parts"), std::string::npos) << err;
}

TEST_F(RenderWithCycles, AFarmSplitsAPictureIntoParts) {
  const std::string scene = make();
  Ods ods({"submit", "--dry-run", "--to", "slurm", "--", "render", scene, "-o", folder_.path("a.exr"), "--renderer",
           "cycles", "--width", "64", "--parts", "4"});
  ASSERT_EQ(ods.finish(), 0) << ods.err;
  EXPECT_NE((ods.out + ods.err).find("4 parts"), std::string::npos) << ods.out << ods.err;
}

TEST_F(RenderWithCycles, AFarmSplitsAVideo) {
  const std::string scene = make();
  Ods ods({"submit", "--dry-run", "--to", "slurm", "--", "video", scene, "-o", folder_.path("a.mp4"), "--renderer",
           "cycles", "--width", "64"});
  ASSERT_EQ(ods.finish(), 0) << ods.err;
  EXPECT_NE((ods.out + ods.err).find("3 frames"), std::string::npos) << ods.out << ods.err;
}

}  // namespace ods::render_with_cycles_test
