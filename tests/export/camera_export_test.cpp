// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The exports to other renderers: compilers accept them, their numbers are the camera's, and nothing is dropped
// silently.
#include "ods/export/camera_export.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "tests/support/exact_camera.h"
#include "tests/support/places.h"
#include "tests/support/statistics.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

bool runs(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

PoleMergeSetting cosine(float start, float end, float exponent) {
  return {kMergeCosine, start, end, exponent};
}

// Cameras that together have everything.
std::vector<Sidecar> many_cameras() {
  std::vector<Sidecar> files;
  for (const NamedProjection& named : named_projections()) {
    for (const int mode : closed_merges()) {
      Sidecar file;
      file.eye = {200, 100};
      file.layout = files.size() % 2 == 0 ? Layout::kTopBottom : Layout::kCrossEyed;
      file.camera.projection = named.setting;
      file.camera.top.mode = mode, file.camera.top.exponent = 1.5f;
      file.camera.bottom = cosine(0.0f, 90.0f, 0.2f);
      file.camera.convergence = kConvergences[files.size() % 3];
      file.camera.yaw = 20.0f, file.camera.pitch = static_cast<float>(files.size() % 4) * 10.0f;
      if (files.size() % 5 == 0) file.camera.axis = vec3(0.0f, 1.0f, 0.0f);
      file.camera.neck = 0.05f;
      file.camera.mirrored = files.size() % 7 == 0;
      files.push_back(file);
    }
  }
  return files;
}

TEST(CameraExport, EveryTargetHasANameAndAText) {
  std::set<std::string_view> names;
  for (const CameraTarget target : kCameraTargets) {
    EXPECT_TRUE(names.insert(camera_target_name(target)).second);
    const CameraExport result = export_camera(Sidecar(), target);
    EXPECT_EQ(result.refusal, "") << camera_target_name(target);
    EXPECT_TRUE(has(result.text, "0.065") || has(result.text, "6.5")) << camera_target_name(target) << result.text;
    EXPECT_TRUE(result.text.ends_with("\n"));
    EXPECT_FALSE(has(result.text, "nan") || has(result.text, "inf"));
  }
}

TEST(CameraExport, WhatATargetLacksStandsInItsText) {
  size_t said = 0;
  for (const Sidecar& file : many_cameras()) {
    for (const CameraTarget target : kCameraTargets) {
      const CameraExport result = export_camera(file, target);
      EXPECT_EQ(result.refusal.empty(), !result.text.empty()) << camera_target_name(target);
      for (const std::string& warning : result.warnings) {
        EXPECT_TRUE(has(result.text, warning)) << camera_target_name(target) << ": " << warning;
        EXPECT_FALSE(has(warning, "\n"));
        said++;
      }
    }
  }
  EXPECT_GT(said, 500u);
}

// Each of these is something that some target lacks: every target that does not take formulas reports it.
TEST(CameraExport, NothingIsDroppedSilently) {
  std::vector<Sidecar> odd(6);
  odd[0].camera.convergence = kShift;
  odd[1].camera.lens_radius = 0.01f;
  odd[2].camera.axis = vec3(0.0f, 0.0f, 1.0f);
  odd[3].camera.top = {kMergePower, 10.0f, 80.0f, 3.0f};
  odd[4].camera.projection = find_projection("fisheye-equisolid")->setting;
  odd[5].camera.head_tilt_map = std::make_shared<Image>(2, 1, 1);
  for (const CameraTarget target :
       {CameraTarget::kPovrayFork, CameraTarget::kBlender, CameraTarget::kArnold, CameraTarget::kMtoa}) {
    for (size_t i = 0; i < odd.size(); i++) {
      const CameraExport plain = export_camera(Sidecar(), target), result = export_camera(odd[i], target);
      EXPECT_TRUE(!result.refusal.empty() || result.warnings.size() > plain.warnings.size())
          << camera_target_name(target) << ' ' << i;
    }
  }
}

TEST(CameraExport, TheForkHasItsKeywords) {
  Sidecar file;
  file.camera.top = file.camera.bottom = cosine(0.0f, 90.0f, 0.2f);
  file.camera.position = vec3(1.0f, 2.0f, 3.0f);
  file.camera.yaw = 45.0f;
  const CameraExport result = export_camera(file, CameraTarget::kPovrayFork);
  for (const char* line : {"ods 4\n", "ipd 0.065\n", "ods_angle 45\n", "ods_modulation 0.2\n", "ods_handedness -1\n",
                           "location <1, 2, -3>\n"}) {
    EXPECT_TRUE(has(result.text, line)) << line << result.text;
  }
  file.layout = Layout::kSideBySide;
  EXPECT_TRUE(has(export_camera(file, CameraTarget::kPovrayFork).text, "ods 3\n"));
  file.camera.pitch = 10.0f, file.camera.neck = 0.1f;
  const std::string refusal = export_camera(file, CameraTarget::kPovrayFork).refusal;
  EXPECT_TRUE(has(refusal, "pitch") && has(refusal, "eye-to-neck")) << refusal;
}

TEST(CameraExport, ArnoldsAnglesStartAtThePole) {
  Sidecar file;
  file.camera.top = cosine(60.0f, 90.0f, 1.0f);
  file.camera.neck = 0.1f;
  const CameraExport result = export_camera(file, CameraTarget::kArnold);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_TRUE(has(result.text, "top_merge_mode \"cosine\"\n top_merge_angle 30\n bottom_merge_mode \"none\"\n"));
  EXPECT_TRUE(has(result.text, "eye_to_neck 0.1\n"));
}

std::string with_main(const std::string& text, bool hlsl) {
  if (hlsl) {
    return text +
           "float4 main(float2 uv : TEXCOORD0) : SV_Target {\n  float3 o, d;\n  ods_camera_ray(uv.x, uv.y, o, d);\n"
           "  return float4(o + d, 1);\n}\n";
  }
  return "#version 300 es\nprecision highp float;\nin vec2 uv;\nout vec4 color;\n" + text +
         "void main() {\n  vec3 o, d;\n  ods_camera_ray(uv.x, uv.y, o, d);\n  color = vec4(o + d, 1.0);\n}\n";
}

TEST(CameraExport, GlslCompilesForWebGl) {
  const TemporaryFolder folder;
  std::string all = glslang();
  int i = 0;
  for (const Sidecar& file : many_cameras()) {
    const std::string name = std::to_string(i++) + ".frag";
    folder.write(name, with_main(export_camera(file, CameraTarget::kGlsl).text, false));
    all += " " + folder.path(name);
  }
  const bool is_right = runs(all);  // at once: most of its time goes into its start
  EXPECT_TRUE(is_right);
  for (int bad = 0; bad < i && !is_right; bad++) {
    const std::string name = std::to_string(bad) + ".frag";
    EXPECT_TRUE(runs(glslang() + " " + folder.path(name))) << folder.read(name);
  }
  folder.write("bad.frag", with_main("void nothing() {}\n", false));
  EXPECT_FALSE(runs(glslang() + " " + folder.path("bad.frag")));
}

TEST(CameraExport, HlslCompiles) {
  const TemporaryFolder folder;
  const std::string compile = glslang() + " -D -V -S frag -e main -o /dev/null ";
  for (const Sidecar& file : many_cameras()) {
    folder.write("x.hlsl", with_main(export_camera(file, CameraTarget::kHlsl).text, true));
    ASSERT_TRUE(runs(compile + folder.path("x.hlsl"))) << folder.read("x.hlsl");
  }
}

TEST(CameraExport, OslCompiles) {
  if (!runs("oslc --version")) GTEST_SKIP() << "skipped: oslc is not installed";
  const TemporaryFolder folder;
  // The additions of Blender's own header to the language.
  folder.write("stdcycles.h", "#include \"stdosl.h\"\npoint camera_shader_raster_position() { return P; }\n");
  for (const Sidecar& file : many_cameras()) {
    folder.write("x.osl", export_camera(file, CameraTarget::kOsl).text);
    ASSERT_TRUE(runs("cd " + folder.path("") + " && oslc -I. x.osl")) << folder.read("x.osl");
  }
}

// Prints rays at positions, as Python does it.
TEST(CameraExport, PythonIsTheCamera) {
  if (!runs("python3 -c pass")) GTEST_SKIP() << "skipped: python3 is not installed";
  const TemporaryFolder folder;
  for (const NamedProjection& named : named_projections()) {
    Sidecar file;
    file.camera.projection = named.setting;
    file.camera.position = vec3(0.5f, 1.0f, -0.25f);
    file.camera.yaw = 40.0f, file.camera.pitch = 20.0f, file.camera.neck = 0.1f;
    file.camera.top = cosine(20.0f, 80.0f, 2.0f);
    folder.write("x.py", export_camera(file, CameraTarget::kPython).text +
                             "for i in range(20):\n    x, y = (0.413 + i * 0.0061, 0.212 + i * 0.0131)\n"
                             "    o, d = ods_camera_ray(x, y)\n    print(x, y, *o, *d)\n");
    ASSERT_EQ(std::system(("python3 " + folder.path("x.py") + " > " + folder.path("out.txt")).c_str()), 0);
    std::istringstream lines(folder.read("out.txt"));
    const Camera camera = make_camera(file.camera);
    double x = 0, y = 0;
    glm::dvec3 o, d;
    int count = 0;
    while (lines >> x >> y >> o.x >> o.y >> o.z >> d.x >> d.y >> d.z) {
      const vec2 uv(static_cast<float>(x), static_cast<float>(2.0 * y - (y < 0.5 ? 0.0 : 1.0)));
      const Ray ray = camera_ray(camera, y < 0.5 ? kLeft : kRight, uv);
      EXPECT_LT(length(d - glm::dvec3(ray.direction)), 3e-6) << named.name;  // uv is float here
      EXPECT_LT(length(o - glm::dvec3(ray.origin)), 3e-6) << named.name;
      count++;
    }
    EXPECT_EQ(count, 20);
  }
}

TEST(CameraExport, BlendersScriptIsPython) {
  if (!runs("python3 -c pass")) GTEST_SKIP() << "skipped: python3 is not installed";
  const TemporaryFolder folder;
  std::string all;
  int i = 0;
  for (const Sidecar& file : many_cameras()) {
    const std::string name = std::to_string(i++) + ".py";
    folder.write(name, export_camera(file, CameraTarget::kBlender).text);
    all += ' ';
    all += folder.path(name);
  }
  EXPECT_TRUE(runs("python3 -m py_compile" + all));
}

}  // namespace
}  // namespace ods
