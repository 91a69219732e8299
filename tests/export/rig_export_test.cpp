// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The exports of a rig to other renderers: its views are read back out of every text, and the installed compilers
// accept the texts. tests/peers/peers_test.cpp renders with the exports to Blender and POV-Ray.
#include "ods/export/rig_export.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "ods/scene/load/load.h"
#include "ods/scene/motion.h"
#include "ods/stitch/rig_mark.h"
#include "tests/support/temporary_folder.h"

namespace ods::rig_export_test {

// 8 slits of two views for both eyes, none of them upright.
SlitRig make_rig(ViewDepth depth = ViewDepth::kNone) {
  StereoCamera camera;
  camera.position = vec3(1.5f, -0.25f, 3.0f);
  camera.yaw = 25.0f, camera.pitch = 15.0f, camera.roll = -10.0f;
  SlitOptions options;
  options.slits = 8;
  options.depth = depth;
  return make_slit_rig(camera, {256, 128}, {kLeft, kRight}, options);
}

std::string text_of(const SlitRig& rig, RigTarget target, size_t script = 0) {
  return export_rig(rig, target, "rig").scripts.at(script).text;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// All numbers from behind `from` up to `to`.
std::vector<double> numbers(const std::string& text, const std::string& from, const std::string& to) {
  const size_t start = text.find(from) + from.size();
  EXPECT_TRUE(has(text, from)) << from;
  const std::string part = text.substr(start, text.find(to, start) - start);
  static const std::regex number("-?[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?");
  std::vector<double> values;
  for (std::sregex_iterator it(part.begin(), part.end(), number), end; it != end; ++it) {
    values.push_back(std::stod(it->str()));
  }
  return values;
}

struct Pose {
  glm::dvec3 right, up, back, place;
};

glm::dvec3 three(const std::vector<double>& values, size_t from) {
  return {values.at(from), values.at(from + 1), values.at(from + 2)};
}

// A matrix in three rows.
Pose of_rows(const std::vector<double>& v, size_t from) {
  const auto column = [&](size_t i) { return glm::dvec3(v.at(from + i), v.at(from + 4 + i), v.at(from + 8 + i)); };
  return {column(0), column(1), column(2), column(3)};
}

void expect_views(const SlitRig& rig, const char* target, const std::function<Pose(size_t view)>& read) {
  for (size_t i = 0; i < rig.views.size(); i++) {
    const Camera camera = make_camera(rig.views[i]);
    const Pose pose = read(i);
    for (const auto& [is, should] : {std::pair(pose.right, camera.right), std::pair(pose.up, camera.up),
                                     std::pair(pose.back, camera.back), std::pair(pose.place, camera.center)}) {
      ASSERT_LT(glm::length(is - glm::dvec3(should)), 1e-6) << target << " view " << i + 1;
    }
  }
}

TEST(RigExport, EveryTargetHasANameAndTexts) {
  const SlitRig rig = make_rig();
  std::set<std::string> names, endings;
  for (const RigTarget target : kRigTargets) {
    EXPECT_TRUE(names.insert(std::string(rig_target_name(target))).second);
    const RigExport result = export_rig(rig, target, "rig");
    EXPECT_TRUE(result.warnings.empty()) << rig_target_name(target);
    ASSERT_FALSE(result.scripts.empty());
    for (const RigScript& script : result.scripts) {
      EXPECT_TRUE(endings.insert(script.ending).second) << script.ending;
      EXPECT_TRUE(script.ending.starts_with("."));
      EXPECT_FALSE(has(script.text, "nan") || has(script.text, "inf,"));
      if (target == RigTarget::kCsv) continue;
      EXPECT_TRUE(has(script.text, "32 views of ")) << script.ending;
      EXPECT_TRUE(has(script.text, "show the same moment")) << script.ending;
      EXPECT_TRUE(has(script.text, "Then: ods stitch rig.json 'views/")) << script.ending;
      EXPECT_TRUE(has(script.text, "at most 4 pixels")) << script.ending;
    }
  }
}

TEST(RigExport, BlendersMatricesAreTheViews) {
  const SlitRig rig = make_rig();
  const std::string text = text_of(rig, RigTarget::kBlender);
  const std::vector<double> v = numbers(text, "VIEWS = [", "]\n");
  ASSERT_EQ(v.size(), 12 * rig.views.size());
  const auto ours = [](glm::dvec3 b) { return glm::dvec3(b.x, b.z, -b.y); };
  expect_views(rig, "blender", [&](size_t i) {
    const Pose pose = of_rows(v, 12 * i);
    return Pose{ours(pose.right), ours(pose.up), ours(pose.back), ours(pose.place)};
  });
  const double half = std::tan(glm::radians(0.5 * static_cast<double>(rig.views[0].projection.fov)));
  EXPECT_NEAR(numbers(text, "HALF_WIDTH = ", "#").at(0), half, 1e-7);
}

TEST(RigExport, PovraysVectorsAreTheViews) {
  const SlitRig rig = make_rig();
  const std::string text = text_of(rig, RigTarget::kPovray);
  const auto array = [&](const char* name) {
    const std::string from = std::string("#declare ods_") + name + " = array[32] {";
    const std::vector<double> values = numbers(text, from, "}");
    EXPECT_EQ(values.size(), 3 * rig.views.size());
    return values;
  };
  const std::vector<double> place = array("place"), ahead = array("ahead"), right = array("right"), up = array("up");
  const auto ours = [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, -p.z); };
  expect_views(rig, "povray", [&](size_t i) {
    return Pose{ours(three(right, 3 * i)), ours(three(up, 3 * i)), -ours(three(ahead, 3 * i)),
                ours(three(place, 3 * i))};
  });
  const double wide = numbers(text, "right ods_right[ods_view] * ", "\n").at(0);
  EXPECT_NEAR(2.0 * glm::degrees(std::atan(0.5 * wide)), rig.views[0].projection.fov, 1e-5);
  const double high = numbers(text, "up ods_up[ods_view] * ", "\n").at(0);
  EXPECT_NEAR(wide / high, static_cast<double>(rig.view.width) / rig.view.height, 1e-6);
  const std::string options = text_of(rig, RigTarget::kPovray, 1);
  EXPECT_EQ(numbers(options, "Subset_End_Frame=", "\n").at(0), 32.0);
  EXPECT_EQ(numbers(options, "Final_Frame=", "\n").at(0), 9999.0) << "four digits in the names, whatever the number";
}

TEST(RigExport, TheEnginesViewsAreTheViews) {
  const SlitRig rig = make_rig();
  std::vector<double> v = numbers(text_of(rig, RigTarget::kThree), "views = [", "];");
  ASSERT_EQ(v.size(), 12 * rig.views.size());
  expect_views(rig, "three", [&](size_t i) { return of_rows(v, 12 * i); });

  // A left-handed world: what is right is up x ahead.
  v = numbers(text_of(rig, RigTarget::kUnity), "float[] Views = {", "};");
  ASSERT_EQ(v.size(), 9 * rig.views.size());
  const auto of_unity = [](glm::dvec3 u) { return glm::dvec3(u.x, u.y, -u.z); };
  expect_views(rig, "unity", [&](size_t i) {
    const glm::dvec3 ahead = three(v, 9 * i + 3), up = three(v, 9 * i + 6);
    return Pose{of_unity(glm::cross(up, ahead)), of_unity(up), -of_unity(ahead), of_unity(three(v, 9 * i))};
  });

  v = numbers(text_of(rig, RigTarget::kUnreal), "VIEWS = [", "]\n");
  ASSERT_EQ(v.size(), 9 * rig.views.size());
  const auto of_unreal = [](glm::dvec3 u) { return glm::dvec3(u.y, u.z, -u.x); };
  expect_views(rig, "unreal", [&](size_t i) {
    const glm::dvec3 ahead = three(v, 9 * i + 3), up = three(v, 9 * i + 6);
    return Pose{of_unreal(glm::cross(up, ahead)), of_unreal(up), -of_unreal(ahead), 0.01 * of_unreal(three(v, 9 * i))};
  });
}

TEST(RigExport, UsdAndCsvAreTheViews) {
  const SlitRig rig = make_rig();
  const std::string usd = text_of(rig, RigTarget::kUsd);
  EXPECT_TRUE(usd.starts_with("#usda 1.0\n"));
  std::vector<double> v = numbers(usd, "timeSamples = {", "}");
  ASSERT_EQ(v.size(), 17 * rig.views.size());
  expect_views(rig, "usd", [&](size_t i) {
    EXPECT_EQ(v.at(17 * i), static_cast<double>(i + 1));
    return Pose{three(v, 17 * i + 1), three(v, 17 * i + 5), three(v, 17 * i + 9), three(v, 17 * i + 13)};
  });
  const double wide = numbers(usd, "horizontalAperture = ", "\n").at(0) / numbers(usd, "focalLength = ", "\n").at(0);
  EXPECT_NEAR(2.0 * glm::degrees(std::atan(0.5 * wide)), rig.views[0].projection.fov, 1e-4);

  const std::string csv = text_of(rig, RigTarget::kCsv);
  EXPECT_TRUE(has(csv, "\n1,left,0,0,") && has(csv, "\n32,right,7,1,")) << csv;
  v = numbers(std::regex_replace(csv, std::regex("left|right,"), "0,"), "height\n", "nothing");
  ASSERT_EQ(v.size() % 20, 0u);
  expect_views(rig, "csv", [&](size_t i) {
    EXPECT_EQ(v.at(20 * i + 18), rig.view.width);
    EXPECT_NEAR(v.at(20 * i + 16), rig.views[0].projection.fov, 1e-5);
    return Pose{three(v, 20 * i + 7), three(v, 20 * i + 10), three(v, 20 * i + 13), three(v, 20 * i + 4)};
  });
}

// Our own reader sees the views go by, at 24 frames a second.
TEST(RigExport, GltfsCameraMovesFromViewToView) {
  const SlitRig rig = make_rig();
  const TemporaryFolder folder;
  nlohmann::json json = nlohmann::json::parse(text_of(rig, RigTarget::kGltf));
  EXPECT_NEAR(json["cameras"][0]["perspective"]["aspectRatio"].get<double>(),
              static_cast<double>(rig.view.width) / rig.view.height, 1e-6);
  // A scene has to have something to see.
  const std::string bytes = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  json["buffers"].push_back({{"byteLength", 36}, {"uri", bytes}});
  json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 36}});
  json["accessors"].push_back({{"bufferView", 3}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  json["meshes"] = nlohmann::json::parse(R"([{"primitives": [{"attributes": {"POSITION": 3}}]}])");
  json["nodes"].push_back({{"mesh", 0}});
  json["scenes"][0]["nodes"].push_back(1);
  folder.write("rig.gltf", json.dump());
  Scene scene = load_scene(folder.path("rig.gltf"));
  ASSERT_EQ(scene.view_points.size(), 1u);
  ASSERT_EQ(scene.animation.clips.size(), 1u);
  scene.animation.playing = {0};
  expect_views(rig, "gltf", [&](size_t i) {
    set_time(scene, static_cast<double>(i + 1) / 24.0);
    StereoCamera seen;
    seen.position = scene.view_points[0].position;
    seen.yaw = scene.view_points[0].yaw, seen.pitch = scene.view_points[0].pitch;
    seen.roll = scene.view_points[0].roll;
    const Camera camera = make_camera(seen);
    return Pose{glm::dvec3(camera.right), glm::dvec3(camera.up), glm::dvec3(camera.back), glm::dvec3(camera.center)};
  });
}

TEST(RigExport, WhatWritesNoDepthSaysSo) {
  for (const RigTarget target : {RigTarget::kPovray, RigTarget::kThree, RigTarget::kUnity, RigTarget::kUnreal}) {
    const RigExport result = export_rig(make_rig(ViewDepth::kRay), target, "rig");
    ASSERT_EQ(result.warnings.size(), 1u) << rig_target_name(target);
    EXPECT_TRUE(has(result.scripts[0].text, result.warnings[0])) << rig_target_name(target);
  }
  const RigExport along = export_rig(make_rig(ViewDepth::kPlane), RigTarget::kBlender, "rig");
  EXPECT_TRUE(along.warnings.empty() && has(along.scripts[0].text, "\nDEPTH = True\n"));
  const RigExport ray = export_rig(make_rig(ViewDepth::kRay), RigTarget::kBlender, "rig");
  EXPECT_TRUE(ray.warnings.size() == 1 && has(ray.scripts[0].text, "\nDEPTH = False\n"));
}

TEST(RigExport, NamesStayInTheirComments) {
  for (const RigTarget target : kRigTargets) {
    for (const RigScript& script : export_rig(make_rig(), target, "a\nexit() \xff").scripts) {
      EXPECT_FALSE(has(script.text, "\nexit()")) << script.ending;
      if (target == RigTarget::kGltf) {
        EXPECT_TRUE(nlohmann::json::accept(script.text));
      }
    }
  }
}

bool runs(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

TEST(RigExport, PythonTakesTheScripts) {
  if (!runs("python3 -c pass")) GTEST_SKIP() << "skipped: python3 is not installed";
  const TemporaryFolder folder;
  for (const RigTarget target : {RigTarget::kBlender, RigTarget::kUnreal}) {
    folder.write("x.py", text_of(make_rig(), target));
    EXPECT_TRUE(runs("python3 -m py_compile " + folder.path("x.py"))) << rig_target_name(target);
  }
  folder.write("x.py", text_of(make_rig(), RigTarget::kThree));
  EXPECT_FALSE(runs("python3 -m py_compile " + folder.path("x.py"))) << "it takes anything";
}

TEST(RigExport, JavaScriptTakesTheModule) {
  if (!runs("node --version")) GTEST_SKIP() << "skipped: node is not installed";
  const TemporaryFolder folder;
  folder.write("rig.mjs", text_of(make_rig(), RigTarget::kThree));
  folder.write("check.mjs",
               "import { views, fileName, width } from './rig.mjs';\n"
               "if (views.length !== 32 || views[31].length !== 12 || fileName(7) !== '0007.png') process.exit(1);\n");
  EXPECT_TRUE(runs("node " + folder.path("check.mjs")));
}

// The part of Unity that the script uses, with the types of its scripting reference.
constexpr const char* kUnity = R"(
using System;
namespace UnityEngine {
  public struct Vector3 { public Vector3(float x, float y, float z) {} }
  public struct Quaternion { public static Quaternion LookRotation(Vector3 ahead, Vector3 up) { return new Quaternion(); } }
  public struct Rect { public Rect(float x, float y, float width, float height) {} }
  public class Object { public static void DestroyImmediate(Object each) {} }
  public class Transform : Object { public void SetPositionAndRotation(Vector3 place, Quaternion turn) {} }
  public class GameObject : Object {
    public GameObject(string name) {}
    public Transform transform { get { return null; } }
    public T AddComponent<T>() where T : Object { return null; }
  }
  public class Camera : Object {
    public static Camera main { get { return null; } }
    public void CopyFrom(Camera other) {}
    public void Render() {}
    public bool enabled { get; set; }
    public bool orthographic { get; set; }
    public float nearClipPlane { get; set; }
    public float aspect { get; set; }
    public float fieldOfView { get; set; }
    public Rect rect { get; set; }
    public RenderTexture targetTexture { get; set; }
  }
  public enum ColorSpace { Gamma, Linear }
  public class QualitySettings { public static ColorSpace activeColorSpace { get { return ColorSpace.Linear; } } }
  public enum RenderTextureFormat { ARGBHalf }
  public enum RenderTextureReadWrite { Linear }
  public class Texture : Object {}
  public class RenderTexture : Texture {
    public RenderTexture(int width, int height, int depth, RenderTextureFormat format, RenderTextureReadWrite light) {}
    public int antiAliasing { get; set; }
    public static RenderTexture active { get; set; }
  }
  public enum TextureFormat { RGBAHalf }
  public class Texture2D : Texture {
    [Flags] public enum EXRFlags { CompressZIP = 2 }
    public Texture2D(int width, int height, TextureFormat format, bool mips, bool linear) {}
    public void ReadPixels(Rect from, int x, int y) {}
  }
  public static class ImageConversion {
    public static byte[] EncodeToEXR(this Texture2D texture, Texture2D.EXRFlags flags) { return null; }
    public static byte[] EncodeToPNG(this Texture2D texture) { return null; }
  }
  public class Debug { public static void LogError(object text) {} }
}
namespace UnityEditor {
  public class MenuItem : Attribute { public MenuItem(string name) {} }
  public class EditorUtility {
    public static bool DisplayCancelableProgressBar(string title, string text, float done) { return false; }
    public static void ClearProgressBar() {}
  }
}
)";

TEST(RigExport, CSharpTakesTheScript) {
  if (!runs("mcs --version")) GTEST_SKIP() << "skipped: mcs is not installed";
  const TemporaryFolder folder;
  folder.write("unity.cs", kUnity);
  const auto compiles = [&](const std::string& script) {
    folder.write("rig.cs", script);
    return runs("mcs -target:library " + folder.path("unity.cs") + " " + folder.path("rig.cs"));
  };
  const std::string script = text_of(make_rig(), RigTarget::kUnity);
  EXPECT_TRUE(compiles(script));
  std::string wrong = script;
  wrong.replace(wrong.find("camera.aspect"), 13, "camera.aspekt");
  EXPECT_FALSE(compiles(wrong)) << "it takes anything";
}

// --- marks -----------------------------------------------------------------------------------------------------------

SlitRig other_rig() {
  SlitRig rig = make_rig();
  rig.camera.ipd = 0.1f;
  return make_slit_rig(rig.camera, rig.eye, rig.eyes, rig.options);
}

std::string mark_file(const SlitRig& rig) {
  return mark_file_text(rig_mark(rig));
}

TEST(RigExport, ScriptsSayWhichRigTheirViewsAreOf) {
  const SlitRig rig = make_rig();
  for (const RigTarget target :
       {RigTarget::kBlender, RigTarget::kPovray, RigTarget::kThree, RigTarget::kUnity, RigTarget::kUnreal}) {
    const std::string text = text_of(rig, target);
    EXPECT_TRUE(has(text, rig_mark(rig).substr(0, 48))) << rig_target_name(target);
    EXPECT_TRUE(has(text, std::string("ods-rig.txt\""))) << rig_target_name(target);
  }
}

// Renders as Blender would: views are files with a letter in them.
constexpr const char* kPretendBlender = R"(
import runpy, sys
from unittest.mock import MagicMock

bpy = MagicMock()
bpy.path.abspath = lambda path: path
bpy.context.scene.timeline_markers = []
bpy.ops.render.render = lambda write_still: open(bpy.context.scene.render.filepath, "w").write("x")
sys.modules["bpy"], sys.modules["mathutils"] = bpy, MagicMock()
script, sys.argv = sys.argv[1], ["blender", "--", "1", "2", sys.argv[2]]
runpy.run_path(script, run_name="__main__")
)";

TEST(RigExport, BlendersScriptMarksTheFolderAndKeepsToItsRig) {
  if (!runs("python3 -c pass")) GTEST_SKIP() << "skipped: python3 is not installed";
  const TemporaryFolder folder;
  folder.write("blender.py", kPretendBlender);
  folder.write("a.py", text_of(make_rig(), RigTarget::kBlender));
  folder.write("b.py", text_of(other_rig(), RigTarget::kBlender));
  const auto render = [&](const std::string& script) {
    return runs("python3 " + folder.path("blender.py") + " " + folder.path(script) + " " + folder.path("views"));
  };
  EXPECT_TRUE(render("a.py"));
  EXPECT_EQ(folder.read("views/ods-rig.txt"), mark_file(make_rig()));
  EXPECT_EQ(folder.read("views/0002.exr"), "x");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path("views")), {}), 3) << "nothing is left";
  EXPECT_FALSE(render("b.py"));
  EXPECT_EQ(folder.read("views/ods-rig.txt"), mark_file(make_rig()));
  EXPECT_TRUE(render("a.py"));
}

TEST(RigExport, PovraysCameraMarksTheFolderAndKeepsToItsRig) {
  if (!runs("command -v povray")) GTEST_SKIP() << "skipped: POV-Ray is not installed";
  const TemporaryFolder folder;
  const auto render = [&](const SlitRig& rig, const std::string& frame) {
    folder.write("rig.povray.inc", text_of(rig, RigTarget::kPovray));
    folder.write("rig.povray.ini", text_of(rig, RigTarget::kPovray, 1));
    return runs("cd " + folder.path("") + " && povray rig.povray.ini +Iscene.pov +SF" + frame + " +EF" + frame);
  };
  folder.write("scene.pov", "#version 3.7;\nsphere { <0, 0, 0>, 0.1 }\n#include \"rig.povray.inc\"\n");
  std::filesystem::create_directory(folder.path("views"));
  EXPECT_TRUE(render(make_rig(), "1"));
  EXPECT_EQ(folder.read("views/ods-rig.txt"), mark_file(make_rig()));
  EXPECT_TRUE(render(make_rig(), "2"));
  EXPECT_FALSE(render(other_rig(), "3"));
  EXPECT_FALSE(std::filesystem::exists(folder.path("views/view0003.exr")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("views/view0002.exr")));
}

TEST(RigExport, ThreesModuleSavesTheMarkBeforeTheViews) {
  if (!runs("node --version")) GTEST_SKIP() << "skipped: node is not installed";
  const TemporaryFolder folder;
  folder.write("rig.mjs", text_of(make_rig(), RigTarget::kThree));
  folder.write("check.mjs", R"(
import { writeFileSync } from "node:fs";
import { renderViews } from "./rig.mjs";
const anything = new Proxy(function () {}, { get: () => anything, apply: () => anything, construct: () => anything });
const domElement = { toBlob: (done) => done(new Blob(["x"])) };
const renderer = new Proxy({ domElement }, { get: (of, key) => of[key] ?? anything });
let names = "";
async function save(name, blob) {
  names += name + " ";
  if (name === "ods-rig.txt") writeFileSync(process.argv[2], await blob.text());
}
await renderViews({ PerspectiveCamera: anything }, renderer, anything, { save, last: 2 });
if (names !== "ods-rig.txt 0001.png 0002.png ") process.exit(1);
)");
  EXPECT_TRUE(runs("node " + folder.path("check.mjs") + " " + folder.path("mark.txt")));
  EXPECT_EQ(folder.read("mark.txt"), mark_file(make_rig()));
}

}  // namespace ods::rig_export_test
