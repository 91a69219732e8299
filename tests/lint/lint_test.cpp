// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults planted into pictures of up to three scenes, and none into as many more.
#include "ods/lint/lint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "ods/base/error.h"
#include "ods/compose/testcard.h"
#include "ods/files/atomic_file.h"
#include "ods/image/image_file.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/builtin/builtin.h"
#include "tests/support/temporary_folder.h"

namespace ods::lint_test {

constexpr int kWidth = 512;
constexpr double kSure = 0.5;  // the command's limit

// --- pictures ------------------------------------------------------------------------------------------------------

struct Pair {
  Image left, right;
};

// A scene, ready to be rendered: made once.
struct Set {
  Scene scene;
  CpuRenderer renderer{scene};
};

const Set& set_of(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Set>> sets;
  std::unique_ptr<Set>& set = sets[name];
  if (!set) set.reset(new Set{find_builtin(name)->make()});
  return *set;
}

struct Studio {
  std::string name;
  StereoCamera camera;
  RenderOptions options;

  explicit Studio(const char* its_name) : name(its_name) {
    camera.position = default_view(set_of(name).scene).position;
    options.width = kWidth;
    options.samples = 2;
    options.even_noise = false;
    options.bounces = 1;
    options.filter = PixelFilter::kBox;
    options.layers = false;
  }

  Picture render() const { return set_of(name).renderer.render(camera, options); }

  Pair both() const {
    Picture picture = render();
    return {std::move(picture.eyes[0].radiance), std::move(picture.eyes[1].radiance)};
  }

  Image mono_at(vec3 offset, uint32_t seed = 0) const {
    Studio one = *this;
    one.camera.position += offset;
    one.options.eyes = Eyes::kMonoEye;
    one.options.seed = seed;
    return std::move(one.render().eyes[0].radiance);
  }

  // A slit per heading, each from where its eye stands.
  Image slits(float side, int count, vec3 (*place)(float theta)) const {
    Image eye(kWidth, kWidth / 2, 3);
    const int width = kWidth / count;
    for (int i = 0; i < count; i++) {
      const float middle = 360.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 180.0f;
      Studio slit = *this;
      slit.camera.projection.longitude = vec2(middle) + vec2(-180.0f, 180.0f) / static_cast<float>(count);
      slit.options.width = width;
      const Image strip = slit.mono_at(0.5f * camera.ipd * side * place(glm::radians(middle)));
      for (int y = 0; y < eye.height; y++) std::copy_n(strip.at(0, y), 3 * width, eye.at(i * width, y));
    }
    return eye;
  }
};

// Rendered once.
const Pair& plain_pair(const Studio& studio) {
  static std::map<std::string, Pair> pairs;
  const auto found = pairs.find(studio.name);
  return found != pairs.end() ? found->second : pairs.emplace(studio.name, studio.both()).first->second;
}

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
                   finding.evidence + ". " + finding.remedy;
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

constexpr std::array kScenes = {"axis", "mirrors", "fractal"};
const auto kSceneName = [](const auto& scene) { return std::string(scene.param); };

class LintScene : public Lint, public ::testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Three, LintScene, ::testing::ValuesIn(kScenes), kSceneName);

// Checks that depend less on the scene: with the most planes, and with the most noise.
class LintForm : public LintScene {};
INSTANTIATE_TEST_SUITE_P(Two, LintForm, ::testing::Values("mirrors", "fractal"), kSceneName);

TEST_P(LintScene, FindsWhatIsWrongWithTheEyes) {
  const Studio studio(GetParam());
  const Pair pair = plain_pair(studio), swapped{pair.right, pair.left};
  expect_only(Fault::kRightOnTop, save(swapped, "right_on_top.png"));
  expect_only(Fault::kEyesSwapped, save_as(pair, Layout::kSideBySide, "swapped_RL.png"));
  expect_only(Fault::kEyesSwapped, save_as(swapped, Layout::kMultiview, "swapped.exr"));
  expect_only(Fault::kOneEyeTwice, save(Pair{pair.left, pair.left}, "twice.png"));
  const vec3 aside(0.5f * studio.camera.ipd, 0.0f, 0.0f);
  const Image left = studio.mono_at(-aside), right = studio.mono_at(aside, 7);
  expect_only(Fault::kTwoCameras, save(Pair{left, right}, "two_cameras.png"));
}

// A head on its side has no parallax along the horizon, and no fault: what lint cannot judge it leaves out.
TEST_P(LintScene, AHeadTiltMapIsNoFault) {
  Studio studio(GetParam());
  auto map = std::make_shared<Image>(2, 1, 1);
  map->pixels = {1.0f, 1.0f};
  studio.camera.head_tilt_map = map;
  SaveOptions options;
  options.tone = ToneCurve::kLinear, options.sidecar = true;
  const std::string path = folder.path("tilted_360_TB.png");
  save_picture(picture_of(studio.both()), studio.camera, options, path);
  const LintReport report = lint(path, {});
  EXPECT_TRUE(told(report).faults.empty()) << told(report).text;
  for (const Check check : {Check::kTwoEyes, Check::kEyeOrder, Check::kCircle, Check::kTopPole, Check::kBottomPole}) {
    EXPECT_TRUE(std::any_of(report.not_judged.begin(), report.not_judged.end(), [&](const NotJudged& each) {
      return each.check == check && each.reason == "its head-tilt map turns the parallax";
    })) << static_cast<int>(check);
  }
  for (const Check check : {Check::kLayout, Check::kSeam}) {
    EXPECT_TRUE(std::count(report.judged.begin(), report.judged.end(), check) > 0) << static_cast<int>(check);
  }
}

TEST_P(LintForm, FindsOneEyeThatWasRenderedTwice) {
  Studio studio(GetParam());
  studio.options.width = 2 * kWidth, studio.options.samples = 4;
  const Pair twice{studio.mono_at(vec3(0.0f)), studio.mono_at(vec3(0.0f), 7)};
  expect_only(Fault::kOneEyeTwice, save(twice, "twice_other_noise.jpg"));
}

TEST_P(LintScene, FindsAMirroredCircle) {
  const Studio studio(GetParam());
  const Pair pair{studio.slits(-1.0f, 8, mirrored_place), studio.slits(1.0f, 8, mirrored_place)};
  expect_only(Fault::kMirroredCircle, save(pair, "mirrored_circle.png"));
}

TEST_P(LintForm, FindsAWrongLayout) {
  const Studio studio(GetParam());
  const Pair& pair = plain_pair(studio);
  const std::string beside = save_as(pair, Layout::kSideBySide, "beside.png");
  const std::string stacked = save_as(pair, Layout::kTopBottom, "stacked.png");
  expect_only(Fault::kLayoutMisread, beside, {Layout::kTopBottom, {}});
  expect_only(Fault::kLayoutMisread, stacked, {Layout::kSideBySide, {}});
  expect_only(Fault::kLayoutMisread, save_as(pair, Layout::kTopBottomHalf, "squeezed.png"));
  expect_only(Fault::kMonoAsStereo, save(resized(pair.left, kWidth, kWidth), "stretched.png"));
  expect_only(Fault::kMonoAsStereo, save(pair.left, "cut_TB.png"));
}

TEST_F(Lint, FindsWordsThatDoNotFit) {
  const Studio studio("mirrors");
  const Pair& pair = plain_pair(studio);
  expect_only(Fault::kMetadata, save_as(pair, Layout::kTopBottom, "named_LR.png"));
  // The eyes are side by side in a file marked top-bottom.
  const Image beside = read_image(save_as(pair, Layout::kSideBySide, "beside.exr"));
  const std::vector<Image> halves = unpack(Layout::kTopBottom, beside);
  expect_only(Fault::kMetadata, save(Pair{halves[0], halves[1]}, "says_stacked.exr"));
  const std::string stacked = save_as(pair, Layout::kTopBottom, "sidecar.png");
  save_sidecar({studio.camera, {kWidth, kWidth / 2}, Layout::kSideBySide, {kLeft, kRight}}, sidecar_path(stacked));
  expect_only(Fault::kMetadata, stacked);
  // Stereo that is saved as one eye carries GPano.
  SaveOptions options;
  options.tone = ToneCurve::kLinear;
  const Image packed = read_image(save_as(pair, Layout::kTopBottom, "stacked.png"));
  save_picture(picture_of(packed), studio.camera, options, folder.path("gpano_TB.png"));
  expect_only(Fault::kMetadata, folder.path("gpano_TB.png"), {{}, ProjectionSetting{}});
}

TEST_P(LintForm, FindsWhatIsWrongWithTheForm) {
  const Studio studio(GetParam());
  const Pair& pair = plain_pair(studio);
  const int squat = kWidth * 9 / 20;
  const Pair squeezed{resized(pair.left, kWidth, squat), resized(pair.right, kWidth, squat)};
  expect_only(Fault::kWrongAspect, save(squeezed, "squat_TB.png"));
  EXPECT_NE(told(lint(save(squeezed, "squat_TB.png"))).text.find("ods convert stretches it"), std::string::npos);
  const int wide = kWidth * 9 / 32;  // both fill 16:9, which players stretch
  expect_silence(save(Pair{resized(pair.left, kWidth, wide), resized(pair.right, kWidth, wide)}, "wide_360_TB.png"));
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

// The layouts take turns: each is tried with one of the scenes.
TEST_P(LintScene, IsSilentAboutEveryLayout) {
  const Studio studio(GetParam());
  const Pair& pair = plain_pair(studio);
  expect_silence(save(pair, "plain.png"));
  expect_silence(save(pair.left, "mono.png"));
  size_t turn = 0;
  const auto is_its_turn = [&] { return kScenes[turn++ % kScenes.size()] == studio.name; };
  for (const char* name : {"top-bottom_TB.png", "bottom-top_BT.png", "side-by-side_LR.png", "cross-eyed_RL.png",
                           "top-bottom-half_HTB.png", "side-by-side-half_HSBS.png"}) {
    const std::string word = name;
    if (is_its_turn()) expect_silence(save_as(pair, *layout_of(word.substr(0, word.find('_'))), name));
  }
  for (Layout layout :
       {Layout::kRowInterleaved, Layout::kColumnInterleaved, Layout::kCheckerboard, Layout::kMultiview}) {
    if (is_its_turn()) expect_silence(save_as(pair, layout, std::string(layout_name(layout)) + ".exr"));
  }
  save_as(pair, Layout::kSeparate, "eye_%V.png");
  expect_silence(folder.path("eye_%V.png"));
  SaveOptions options;
  options.jpeg_quality = 80;
  expect_silence(save(pair, "compressed.jpg", options));
}

TEST_P(LintScene, IsSilentAboutOtherCameras) {
  Studio studio(GetParam());
  for (const char* name : {"vr180", "cube-3x2", "fisheye"}) {
    Studio other = studio;
    other.camera.projection = find_projection(name)->setting;
    other.options.width = name == std::string("cube-3x2") ? 384 : 256;
    const std::string path = folder.path(std::string(name) + ".exr");
    save_picture(other.render(), other.camera, {}, path);
    expect_silence(path);
  }
  studio.camera.convergence = kToeIn;
  studio.camera.convergence_distance = 1.0f;
  const Picture toed_in = studio.render();
  SaveOptions options;
  save_picture(toed_in, studio.camera, options, folder.path("unsaid.png"));
  // If much is farther than that metre, headsets show things for which eyes must diverge.
  for (const Finding& finding : lint(folder.path("unsaid.png")).findings) {
    const bool is_known = finding.certainty >= kSure && severity_of(finding.fault) == Severity::kFault;
    EXPECT_TRUE(!is_known || finding.fault == Fault::kEyesDiverge) << fault_name(finding.fault);
  }
  options.sidecar = true;
  save_picture(toed_in, studio.camera, options, folder.path("said.png"));
  expect_silence(folder.path("said.png"));
}

TEST_P(LintScene, FindsStereoAtThePoles) {
  // Pictures with something to see: so few samples leave noise of the fractals overhead.
  const std::string name = GetParam();
  Studio studio(name == "fractal" ? "wineglass" : name.c_str());
  if (name == "mirrors") studio.camera.position = vec3(1.5f, 1.2f, 1.0f);
  studio.options.samples = name == "fractal" ? 8 : 4;
  const Told apart = told(lint(save(studio.both(), "apart.png")));
  EXPECT_EQ(apart.warnings, std::set<std::string>{"no-pole-merge"}) << apart.text;
  studio.camera.top.mode = studio.camera.bottom.mode = kMergeCosine;
  const Told merged = told(lint(save(studio.both(), "merged.png")));
  EXPECT_TRUE(merged.warnings.empty()) << merged.text;
  EXPECT_TRUE(merged.faults.empty()) << merged.text;
}

// --- without a scene -----------------------------------------------------------------------------------------------

TEST(LintFaults, EveryFaultHasNames) {
  std::set<std::string_view> names;
  for (Fault fault : kFaults) {
    names.insert(fault_name(fault));
    EXPECT_FALSE(fault_title(fault).empty());
    EXPECT_FALSE(severity_name(severity_of(fault)).empty());
  }
  EXPECT_EQ(names.size(), std::size(kFaults));
}

// Every check is made, or the report has the reason why it is not.
void expect_every_check_once(const LintReport& report) {
  std::multiset<Check> checks(report.judged.begin(), report.judged.end());
  for (const NotJudged& each : report.not_judged) {
    checks.insert(each.check);
    EXPECT_FALSE(each.reason.empty()) << check_name(each.check);
  }
  for (const Check check : kChecks) EXPECT_EQ(checks.count(check), 1u) << check_name(check);
}

std::set<Check> judged(const LintReport& report) {
  expect_every_check_once(report);
  return {report.judged.begin(), report.judged.end()};
}

TEST_F(Lint, ListsWhatItJudgedAndWhatNot) {
  std::set<std::string_view> names;
  for (const Check check : kChecks) names.insert(check_name(check));
  EXPECT_EQ(names.size(), std::size(kChecks));

  // It is too small to judge whether one eye was rendered twice, its poles are smooth, and few of its lines are
  // vertical.
  const std::set<Check> words{Check::kShape, Check::kMetadata, Check::kVideoLevels, Check::kHeadsets, Check::kBlack};
  const auto with = [](std::set<Check> checks, const std::set<Check>& more) {
    checks.insert(more.begin(), more.end());
    return checks;
  };
  const std::set<Check> pixels = with(words, {Check::kSeam, Check::kDeadPoles, Check::kHighlights, Check::kBanding});
  const std::set<Check> made = with(pixels, {Check::kLayout, Check::kEyeOrder, Check::kCircle, Check::kAlignment,
                                             Check::kConvergence, Check::kColors, Check::kSharpness});
  const Pair pair = plain_pair(Studio("room"));
  EXPECT_EQ(judged(lint(save(pair, "good.png"))), made);

  EXPECT_EQ(judged(lint(save(Image(64, 32, 3), "small.png"), {Layout::kSeparate, {}})), words);
  const LintReport mono = lint(save(pair.left, "mono.png"), {Layout::kSeparate, {}});
  EXPECT_EQ(judged(mono), with(pixels, {Check::kLayout}));
  EXPECT_EQ(mono.not_judged[0].reason, "there is only one eye");
  Image grey(256, 128, 3);
  std::fill(grey.pixels.begin(), grey.pixels.end(), 0.5f);
  std::set<Check> of_grey = pixels;
  of_grey.erase(Check::kSeam);  // nothing is there that could break
  EXPECT_EQ(judged(lint(save(Pair{grey, grey}, "grey.png"))), of_grey);
}

TEST_F(Lint, SaysThatThereIsNothingToSee) {
  Image grey(256, 128, 3);
  std::fill(grey.pixels.begin(), grey.pixels.end(), 0.5f);
  const LintReport report = lint(save(Pair{grey, grey}, "grey.png"));
  EXPECT_TRUE(report.findings.empty()) << told(report).text;
  EXPECT_FALSE(report.not_judged.empty());
}

TEST_F(Lint, KnowsWhatVideosAreTooLarge) {
  const std::string tall = save(Image(256, 20000, 3), "tall.png");
  const LintReport video = lint(tall, {Layout::kSeparate, {}});
  EXPECT_TRUE(has_finding(video, Severity::kInformation, 1.0)) << told(video).text;
}

TEST_F(Lint, SurvivesBadInput) {
  for (const Extent size : {Extent{1, 1}, Extent{4096, 1}, Extent{1, 512}, Extent{63, 32}}) {
    const std::string path = save(Image(size.width, size.height, 3), "tiny.exr");
    EXPECT_FALSE(lint(path, {Layout::kSeparate, {}}).not_judged.empty());
  }
  EXPECT_THROW(lint(save(Image(65, 33, 3), "odd.png"), {Layout::kTopBottom, {}}), Error);
  const std::string whole = folder.read("odd.png");
  folder.write("cut.png", whole.substr(0, whole.size() / 2));
  EXPECT_THROW(lint(folder.path("cut.png")), Error);
  EXPECT_THROW(lint(folder.path("absent.png")), Error);
}

// Most of it is far away, and little of it moves.
TEST_F(Lint, IsSilentAboutTestCardsOfEverySize) {
  for (const int width : {128, 256, 512}) {
    const Testcard card = make_testcard(StereoCamera(), {width, width / 2}, {});
    Pair pair{Image(width, width / 2, 3), Image(width, width / 2, 3)};
    for (int y = 0; y < width / 2; y++) {
      fill_testcard_row(card, kLeft, y, {pair.left.at(0, y), static_cast<size_t>(3 * width)});
      fill_testcard_row(card, kRight, y, {pair.right.at(0, y), static_cast<size_t>(3 * width)});
    }
    expect_silence(save(pair, "card.png"));
    const LintReport swapped = lint(save(Pair{pair.right, pair.left}, "swapped.png"));
    const bool judged = std::count(swapped.judged.begin(), swapped.judged.end(), Check::kEyeOrder) > 0;
    EXPECT_TRUE(!judged || told(swapped).faults.contains("right-on-top")) << width << told(swapped).text;
  }
}

// Saving a picture takes them out.
TEST_F(Lint, LooksPastPixelsThatAreNoNumbers) {
  const Pair& pair = plain_pair(Studio("axis"));
  FileHeader header;
  header.format = FileFormat::kExr, header.width = header.height = kWidth;
  for (const char* name : {"R", "G", "B"}) header.channels.push_back({name, SampleType::kFloat});
  AtomicFile file(folder.path("holes.exr"));
  write_image(file, header, [&](int y, std::span<float> row) {
    std::copy_n((y < kWidth / 2 ? pair.left : pair.right).at(0, y % (kWidth / 2)), row.size(), row.begin());
    if (y % 97 == 0) std::fill_n(row.begin(), 300, std::numeric_limits<float>::quiet_NaN());
    if (y % 89 == 0) row.back() = std::numeric_limits<float>::infinity();
  });
  file.commit();
  const LintReport report = lint(folder.path("holes.exr"));
  EXPECT_TRUE(told(report).faults.empty()) << told(report).text;
  EXPECT_FALSE(report.not_judged.empty());
}

}  // namespace ods::lint_test
