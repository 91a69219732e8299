// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The exported formulas, read back as text, against camera_ray().
#include "ods/export/camera_formula.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ods/export/camera_export.h"
#include "tests/support/exact_camera.h"
#include "tests/support/formula_reader.h"
#include "tests/support/statistics.h"

namespace ods {
namespace {

using glm::dvec3;

// Returns the eye of a position in the whole picture, and the position in the eye's own picture.
struct EyePlace {
  int eye;
  vec2 uv;
};

EyePlace eye_place(const Sidecar& file, vec2 uv) {
  if (file.eyes.size() == 1) return {file.eyes[0], uv};
  const bool second =
      file.layout == Layout::kTopBottom || file.layout == Layout::kBottomTop || file.layout == Layout::kTopBottomHalf
          ? uv.y >= 0.5f
          : uv.x >= 0.5f;
  const float shift = second ? 1.0f : 0.0f;
  switch (file.layout) {
    case Layout::kTopBottom:
    case Layout::kTopBottomHalf:
      return {second ? kRight : kLeft, vec2(uv.x, 2.0f * uv.y - shift)};
    case Layout::kBottomTop:
      return {second ? kLeft : kRight, vec2(uv.x, 2.0f * uv.y - shift)};
    case Layout::kCrossEyed:
      return {second ? kLeft : kRight, vec2(2.0f * uv.x - shift, uv.y)};
    default:
      return {second ? kRight : kLeft, vec2(2.0f * uv.x - shift, uv.y)};
  }
}

// Too near to the edge of a cell or of an image circle for float and double to agree about the side.
bool on_an_edge(const ProjectionSetting& setting, vec2 uv) {
  const auto near_whole = [](float x) { return std::abs(x - std::round(x)) < 1e-4f; };
  if (is_cube(setting.kind)) {
    const int columns = cube_columns(setting.kind);
    return near_whole(uv.x * static_cast<float>(columns)) || near_whole(uv.y * static_cast<float>(6 / columns));
  }
  if (!has_image_circle(setting.kind)) return false;
  const vec2 circle = make_projection(setting).circle;
  if (setting.kind == kFisheyePolynomial) return std::abs(length((2.0f * uv - 1.0f) / circle) - 1.0f) < 1e-4f;
  // Close to straight behind, an equisolid lens makes much of the radius's last bits.
  const float sine = std::sin(glm::radians(setting.fov) / 4.0f);
  if (setting.kind == kFisheyeEquisolid && sine * length(2.0f * uv - 1.0f) > 0.98f) return true;
  return std::abs(length(2.0f * uv - 1.0f) - 1.0f) < 1e-4f;
}

using Triple = std::array<double, 3>;

// Whose coordinates a text has: of the image, and of the world.
enum class Words { kPovray, kGlsl, kHlsl, kOsl };

dvec3 ours(Words words, const StereoCamera& stereo, const Triple& v) {
  if (words == Words::kGlsl) return {v[0], v[1], v[2]};
  if (words != Words::kOsl) return {v[0], v[1], -v[2]};
  StereoCamera plain = stereo;
  plain.mirrored = false;
  const Camera camera = make_camera(plain);
  return v[0] * dvec3(camera.right) + v[1] * dvec3(camera.up) - v[2] * dvec3(camera.back);
}

// The worst disagreement of a text with the camera, metres or shares of a unit direction.
double disagreement(const Sidecar& file, const TextCamera& text, Words words, Dice& dice, int count) {
  const Camera camera = make_camera(file.camera);
  const dvec3 place = words == Words::kOsl ? dvec3(camera.center) : dvec3(0.0);
  double worst = 0.0;
  for (int i = 0; i < count; i++) {
    const vec2 uv = dice.pair();
    const EyePlace at = eye_place(file, uv);
    if (on_an_edge(file.camera.projection, at.uv) || std::abs(uv.x - 0.5f) < 1e-6f || std::abs(uv.y - 0.5f) < 1e-6f) {
      continue;
    }
    // A root of the cosine is so steep at the poles that the kernel's floats are 2e-6 off.
    if (file.camera.top.exponent < 1.0f && std::abs(at.uv.y - 0.5f) > 0.495f) continue;
    const Ray ray = camera_ray(camera, at.eye, at.uv);
    const double x = words == Words::kPovray ? double{uv.x} - 0.5 : double{uv.x};
    const double y = words == Words::kPovray ? 0.5 - double{uv.y}
                     : words == Words::kOsl  ? 1.0 - double{uv.y}
                                             : double{uv.y};
    const dvec3 direction = ours(words, file.camera, text.direction(x, y));
    worst = std::max(worst, length(direction - dvec3(ray.direction)));
    if (ray.direction == vec3(0.0f)) continue;
    worst = std::max(worst, length(place + ours(words, file.camera, text.location(x, y)) - dvec3(ray.origin)));
  }
  return worst;
}

enum class Pose { kLevel, kFree, kAxis, kMirrored, kMirroredFree };
constexpr Pose kPoses[] = {Pose::kLevel, Pose::kFree, Pose::kAxis, Pose::kMirrored, Pose::kMirroredFree};

StereoCamera posed(Dice& dice, Pose pose) {
  StereoCamera stereo;
  stereo.position = vec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
  stereo.yaw = dice.between(-90, 90);
  stereo.ipd = dice.between(0.05f, 0.08f);
  stereo.mirrored = pose == Pose::kMirrored || pose == Pose::kMirroredFree;
  if (pose == Pose::kLevel || pose == Pose::kMirrored) return stereo;
  stereo.pitch = dice.between(-80, 80);
  stereo.roll = dice.between(-80, 80);
  if (pose == Pose::kAxis) stereo.axis = normalize(vec3(dice.between(-1, 1), 1.0f, dice.between(-1, 1)));
  return stereo;
}

PoleMergeSetting merge_of_mode(Dice& dice, int mode) {
  PoleMergeSetting merge;
  merge.mode = mode;
  merge.start = dice.next() < 0.3f ? 0.0f : dice.between(0.0f, 60.0f);
  merge.end = dice.next() < 0.5f ? 90.0f : dice.between(65.0f, 90.0f);
  // A root is infinitely steep where nothing is left of the circle: there no two precisions agree.
  merge.exponent = dice.next() < 0.5f ? 1.0f : dice.between(1.0f, 3.0f);
  return merge;
}

// 1e-6, and what the kernel's own floats add at worst.
constexpr double kTolerance = 1.2e-6;

const std::vector<int> kClosedMerges = closed_merges();

struct Packing {
  Layout layout;
  std::vector<int> eyes;
};
const Packing kPackings[] = {{Layout::kTopBottom, {kLeft, kRight}},
                             {Layout::kBottomTop, {kLeft, kRight}},
                             {Layout::kSideBySide, {kLeft, kRight}},
                             {Layout::kCrossEyed, {kLeft, kRight}},
                             {Layout::kTopBottomHalf, {kLeft, kRight}},
                             {Layout::kSideBySideHalf, {kLeft, kRight}},
                             {Layout::kTopBottom, {kLeft}},
                             {Layout::kTopBottom, {kRight}},
                             {Layout::kTopBottom, {kMono}}};

std::string name_of(const NamedProjection& named, int convergence, float neck, Pose pose, int mode,
                    const Packing& packing) {
  return std::string(named.name) + ' ' + std::string(convergence_name(convergence)) + " neck " + std::to_string(neck) +
         " pose " + std::to_string(static_cast<int>(pose)) + ' ' + std::string(merge_name(mode)) + ' ' +
         std::string(layout_name(packing.layout)) + " eyes " + std::to_string(packing.eyes.size());
}

// Every projection x convergence x neck x pose x merge, the packings taking turns.
template <class Check>
void for_every_camera(Dice& dice, const Check& check) {
  size_t turn = 0;
  for (const NamedProjection& named : named_projections()) {
    for (const int convergence : kConvergences) {
      for (const float neck : {0.0f, 0.08f}) {
        for (const Pose pose : kPoses) {
          for (const int mode : kClosedMerges) {
            const Packing& packing = kPackings[turn++ % std::size(kPackings)];
            Sidecar file;
            file.layout = packing.layout, file.eyes = packing.eyes;
            file.camera = posed(dice, pose);
            file.camera.projection = named.setting;
            file.camera.convergence = convergence, file.camera.neck = neck;
            file.camera.top = merge_of_mode(dice, mode);
            file.camera.bottom =
                dice.next() < 0.5f ? file.camera.top : merge_of_mode(dice, kClosedMerges[turn % kClosedMerges.size()]);
            check(file, name_of(named, convergence, neck, pose, mode, packing));
            if (testing::Test::HasFatalFailure()) return;  // the next ones would fail in the same way, at length
          }
        }
      }
    }
  }
}

TEST(CameraFormula, PovrayTextIsTheCamera) {
  Dice dice(1);
  for_every_camera(dice, [&](const Sidecar& file, const std::string& name) {
    const CameraExport povray = export_camera(file, CameraTarget::kPovray);
    ASSERT_EQ(povray.refusal, "");
    const TextCamera text = TextCamera::from_povray(povray.text);
    ASSERT_LT(disagreement(file, text, Words::kPovray, dice, 12), kTolerance) << name << '\n' << povray.text;
  });
}

TEST(CameraFormula, ShaderTextsAreTheCamera) {
  Dice dice(2);
  const std::pair<CameraTarget, Words> shaders[] = {
      {CameraTarget::kGlsl, Words::kGlsl}, {CameraTarget::kHlsl, Words::kHlsl}, {CameraTarget::kOsl, Words::kOsl}};
  for_every_camera(dice, [&](const Sidecar& file, const std::string& name) {
    const auto& [target, words] =
        shaders[static_cast<size_t>(3.0f * dice.next())];  // they differ in how they are written
    const CameraExport shader = export_camera(file, target);
    const TextCamera text = TextCamera::from_shader(shader.text);
    ASSERT_LT(disagreement(file, text, words, dice, 4), kTolerance) << name << '\n' << shader.text;
  });
}

// 10,000 positions of the page's own layouts with its own merge, and of those that it lacks.
TEST(CameraFormula, PagesCameraAtManyPositions) {
  Dice dice(3);
  for (const Packing& packing : kPackings) {
    Sidecar file;
    file.layout = packing.layout, file.eyes = packing.eyes;
    file.camera.yaw = 33.0f;
    file.camera.top.mode = kMergeCosine, file.camera.top.start = 0.0f, file.camera.top.exponent = 0.2f;
    file.camera.bottom = file.camera.top;
    const TextCamera text = TextCamera::from_povray(export_camera(file, CameraTarget::kPovray).text);
    EXPECT_LT(disagreement(file, text, Words::kPovray, dice, 10000), kTolerance) << layout_name(packing.layout);
  }
}

TEST(CameraFormula, EyesThatShareNoPictureAreANumberAway) {
  Dice dice(4);
  Sidecar file;
  file.layout = Layout::kSeparate;
  TextCamera text = TextCamera::from_povray(export_camera(file, CameraTarget::kPovray).text);
  for (const int eye : {kLeft, kRight}) {
    text.set("odsEye", eye == kLeft ? -1.0 : 1.0);
    file.eyes = {eye};
    EXPECT_LT(disagreement(file, text, Words::kPovray, dice, 1000), kTolerance);
  }
}

// When every function called whatever it needed, a fisheye took 1124 operations and a cube map 813.
TEST(CameraFormula, PovrayComputesEveryStepOnce) {
  for (const auto& [projection, maximum] :
       {std::pair("fisheye", 250), std::pair("lat-long", 80), std::pair("cube-3x2", 300)}) {
    Sidecar file;
    file.layout = Layout::kSideBySide;
    file.camera.projection = find_projection(projection)->setting;
    file.camera.top.mode = file.camera.bottom.mode = kMergeCosine;
    const TextCamera text = TextCamera::from_povray(export_camera(file, CameraTarget::kPovray).text);
    EXPECT_LT(text.operations(0.1, 0.2), maximum) << projection;
    EXPECT_GT(text.operations(0.1, 0.2), 40) << projection;
  }
}

TEST(CameraFormula, WhatIsNoFormulaIsRefused) {
  Sidecar file;
  file.camera.top.mode = kMergeMap;
  EXPECT_NE(export_camera(file, CameraTarget::kPovray).refusal, "");
  file.camera.top.mode = kMergeNone;
  file.camera.head_tilt_map = std::make_shared<Image>(2, 1, 1);
  for (const CameraTarget target :
       {CameraTarget::kPovray, CameraTarget::kOsl, CameraTarget::kGlsl, CameraTarget::kHlsl, CameraTarget::kPython}) {
    EXPECT_NE(export_camera(file, target).refusal.find("a head-tilt map is not a formula"), std::string::npos);
  }
  EXPECT_EQ(export_camera(file, CameraTarget::kPovrayFork).refusal, "the fork has no head-tilt map");
  file.camera.head_tilt_map = nullptr;
  for (const Layout layout : kLayouts) {
    const EyeArrangement eyes = arrangement_of(layout);
    file.layout = layout;
    const bool is_refused = eyes.is_interleaved() || eyes.how == EyePacking::kMixed;
    EXPECT_EQ(formula_fault(file).empty(), !is_refused) << layout_name(layout);
  }
}

TEST(Formula, ReadsWell) {
  const Formula x = named(Operation::kVariable, "x"), p = named(Operation::kParameter, "ipd");
  const auto plain = [](const Formula& f) { return print(f, Language::kPlain); };
  EXPECT_EQ(plain(0.0 * x + 1.0 * p), "ipd");
  EXPECT_EQ(plain((x + 0.5) * 2.0 - 1.0), "2*x");
  EXPECT_EQ(plain(0.5 - x), "0.5 - x");
  EXPECT_EQ(plain(x - (p - x)), "x - (ipd - x)");
  EXPECT_EQ(plain(-(x + p)), "-(x + ipd)");
  EXPECT_EQ(plain(x * (p * x) / 2.0), "x*ipd*x/2");
  EXPECT_EQ(plain(x / (p / x)), "x/(ipd/x)");
  EXPECT_EQ(plain(std::acos(-1.0) / 180.0 * x), "pi/180*x");
  EXPECT_EQ(plain(select(x, 1.0, 1.0)), "1");
  EXPECT_EQ(plain(pow(max(x, 0.0), 1.0)), "max(x, 0)");
  EXPECT_EQ(print(atan2(x, p), Language::kPovray), "atan2(x, odsIPD)");
  EXPECT_EQ(print(atan2(x, p), Language::kGlsl), "atan(x, ipd)");
  EXPECT_EQ(print(select(x, 1.0, p), Language::kHlsl), "(x < 0.0 ? 1.0 : ipd)");
  EXPECT_EQ(print(select(x, 1.0, p), Language::kPython), "(1 if x < 0 else ipd)");
}

}  // namespace
}  // namespace ods
