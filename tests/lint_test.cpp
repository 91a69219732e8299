// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults planted into pictures of three scenes, and none into as many more.
#include "ods/image/lint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "ods/base/error.h"
#include "ods/cpu/render.h"
#include "ods/image/camera_file.h"
#include "ods/image/save.h"
#include "ods/scene/builtin.h"
#include "tests/temporary_folder.h"

namespace ods {
namespace {

constexpr int kWidth = 512;
constexpr double kSure = 0.5;  // what the command tells

// --- pictures ------------------------------------------------------------------------------------------------------

struct Pair {
  Image left, right;
};

struct Studio {
  Scene scene;
  CameraRig rig;
  RenderOptions options;

  explicit Studio(const char* name) : scene(find_builtin(name)->make()) {
    rig.position = default_view(scene).position;
    options.width = kWidth;
    options.samples = 4;
    options.filter = PixelFilter::kBox;
    options.layers = false;
  }

  Pair both() const {
    Picture picture = render_cpu(scene, rig, options);
    return {std::move(picture.eyes[0].radiance), std::move(picture.eyes[1].radiance)};
  }

  Image mono_at(vec3 offset, uint32_t seed = 0) const {
    CameraRig moved = rig;
    moved.position = rig.position + offset;
    RenderOptions one = options;
    one.eyes = Eyes::kMonoEye;
    one.seed = seed;
    return std::move(render_cpu(scene, moved, one).eyes[0].radiance);
  }

  // A slit per heading, each from where its eye stands.
  Image slits(float side, int count, vec3 (*place)(float theta)) const {
    Image eye(kWidth, kWidth / 2, 3);
    const int width = kWidth / count;
    for (int i = 0; i < count; i++) {
      const float middle = 360.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 180.0f;
      Studio slit = *this;
      slit.rig.projection.longitude = vec2(middle) + vec2(-180.0f, 180.0f) / static_cast<float>(count);
      slit.options.width = width;
      const Image strip = slit.mono_at(0.5f * rig.ipd * side * place(glm::radians(middle)));
      for (int y = 0; y < eye.height; y++) std::copy_n(strip.at(0, y), 3 * width, eye.at(i * width, y));
    }
    return eye;
  }
};

// The eye's place with its z negated, as a renderer has it that mirrored its rays and forgot the circle.
vec3 mirrored_place(float theta) {
  return vec3(std::cos(theta), 0.0f, -std::sin(theta));
}

Picture picture_of(const Pair& pair) {
  return {{{kLeft, pair.left, {}, {}, {}}, {kRight, pair.right, {}, {}, {}}}};
}

Picture picture_of(const Image& image) {
  return {{{kMono, image, {}, {}, {}}}};
}

Image resized(const Image& image, int width, int height) {
  Image result(width, height, 3);
  for (int y = 0; y < height; y++) {
    for (int x = 0; x < width; x++) {
      std::copy_n(image.at(x * image.width / width, y * image.height / height), 3, result.at(x, y));
    }
  }
  return result;
}

// The picture sinks by a share of its height and grows brighter on the way around.
Image drifting(const Image& image, float sink, float brighten) {
  Image result = image;
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const float turn = static_cast<float>(x) / static_cast<float>(image.width);
      const int from = y + static_cast<int>(turn * sink * static_cast<float>(image.height));
      for (int c = 0; c < 3; c++) {
        result.at(x, y)[c] = image.at(x, std::min(from, image.height - 1))[c] * (1.0f + turn * brighten);
      }
    }
  }
  return result;
}

// --- what lint says ------------------------------------------------------------------------------------------------

struct Told {
  std::set<std::string> faults;
  std::set<std::string> warnings;
  double certainty = 0.0;  // of the surest fault
  std::string text;
};

Told told(const LintReport& report) {
  Told result;
  for (const Finding& finding : report.findings) {
    result.text += "\n  " + std::string(fault_name(finding.fault)) + " " + std::to_string(finding.certainty) + ": " +
                   finding.evidence + ". " + finding.cure;
    if (finding.certainty < kSure) continue;
    const Severity severity = severity_of(finding.fault);
    if (severity == Severity::kFault) result.certainty = std::max(result.certainty, finding.certainty);
    if (severity == Severity::kFault) result.faults.emplace(fault_name(finding.fault));
    if (severity == Severity::kWarning) result.warnings.emplace(fault_name(finding.fault));
  }
  return result;
}

class Lint : public ::testing::Test {
 protected:
  template <class Picture_>
  std::string save(const Picture_& what, const std::string& name, SaveOptions options = {}) const {
    options.tone = ToneCurve::kLinear;
    save_picture(picture_of(what), options, folder.path(name));
    return folder.path(name);
  }

  std::string save_as(const Pair& pair, Layout layout, const std::string& name) const {
    SaveOptions options;
    options.layout = layout;
    return save(pair, name, options);
  }

  static void expect_only(Fault fault, const std::string& path, const LintOptions& options = {}) {
    const Told result = told(lint(path, options));
    EXPECT_EQ(result.faults, std::set<std::string>{std::string(fault_name(fault))}) << path << result.text;
    std::printf("  %-16s %.2f  %s\n", std::string(fault_name(fault)).c_str(), result.certainty,
                path.substr(path.rfind('/') + 1).c_str());
  }

  static void expect_silence(const std::string& path, const LintOptions& options = {}) {
    const Told result = told(lint(path, options));
    EXPECT_TRUE(result.faults.empty()) << path << result.text;
  }

  TemporaryFolder folder;
};

class LintScene : public Lint, public ::testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Three, LintScene, ::testing::Values("axis", "mirrors", "fractal"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST_P(LintScene, FindsWhatIsWrongWithTheEyes) {
  const Studio studio(GetParam());
  const Pair pair = studio.both(), swapped{pair.right, pair.left};
  expect_only(Fault::kRightOnTop, save(swapped, "right_on_top.png"));
  expect_only(Fault::kEyesSwapped, save_as(pair, Layout::kSideBySide, "swapped_RL.png"));
  expect_only(Fault::kEyesSwapped, save_as(swapped, Layout::kMultiview, "swapped.exr"));
  expect_only(Fault::kOneEyeTwice, save(Pair{pair.left, pair.left}, "twice.png"));
  expect_only(Fault::kOneEyeTwice, save(Pair{studio.mono_at({}), studio.mono_at({}, 7)}, "twice_other_noise.jpg"));
  const vec3 aside(0.5f * studio.rig.ipd, 0.0f, 0.0f);
  expect_only(Fault::kTwoCameras, save(Pair{studio.mono_at(-aside), studio.mono_at(aside)}, "two_cameras.png"));
}

TEST_P(LintScene, FindsAMirroredCircle) {
  const Studio studio(GetParam());
  const Pair pair{studio.slits(-1.0f, 16, mirrored_place), studio.slits(1.0f, 16, mirrored_place)};
  expect_only(Fault::kMirroredCircle, save(pair, "mirrored_circle.png"));
}

TEST_P(LintScene, FindsAWrongLayout) {
  const Studio studio(GetParam());
  const Pair pair = studio.both();
  const std::string beside = save_as(pair, Layout::kSideBySide, "beside.png");
  const std::string stacked = save_as(pair, Layout::kTopBottom, "stacked.png");
  expect_only(Fault::kLayoutMisread, beside, {Layout::kTopBottom, {}});
  expect_only(Fault::kLayoutMisread, stacked, {Layout::kSideBySide, {}});
  expect_only(Fault::kLayoutMisread, save_as(pair, Layout::kTopBottomHalf, "squeezed.png"));
  expect_only(Fault::kMetadata, save_as(pair, Layout::kTopBottom, "named_LR.png"));
  expect_only(Fault::kMonoAsStereo, save(resized(pair.left, kWidth, kWidth), "stretched.png"));
  expect_only(Fault::kMonoAsStereo, save(pair.left, "cut_TB.png"));
}

TEST_P(LintScene, FindsWhatIsWrongWithTheForm) {
  const Studio studio(GetParam());
  const Pair pair = studio.both();
  const int squat = kWidth * 9 / 20;
  expect_only(Fault::kWrongAspect,
              save(Pair{resized(pair.left, kWidth, squat), resized(pair.right, kWidth, squat)}, "squat_TB.png"));
  expect_only(Fault::kRaggedSeam,
              save(Pair{drifting(pair.left, 0.04f, 0.0f), drifting(pair.right, 0.04f, 0.0f)}, "sinking.png"));
  expect_only(Fault::kRaggedSeam,
              save(Pair{drifting(pair.left, 0.0f, 0.3f), drifting(pair.right, 0.0f, 0.3f)}, "brighter.png"));
  Pair doubled = pair;
  for (int y = 0; y < kWidth / 2; y++) {
    std::copy_n(pair.left.at(0, y), 3, doubled.left.at(kWidth - 1, y));
    std::copy_n(pair.right.at(0, y), 3, doubled.right.at(kWidth - 1, y));
  }
  expect_only(Fault::kRaggedSeam, save(doubled, "doubled.png"));
}

}  // namespace
}  // namespace ods
