// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The viewer's page in real browsers, against ods convert: every projection and every layout, each eye, at five looks.
// Chromium and Firefox run without a screen and are skipped where they are missing. The pages come from the server of
// `ods view` itself, with its policy of what a page may load.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/http/http_server.h"
#include "cli/view/export_site.h"
#include "ods/base/error.h"
#include "ods/image/tone.h"
#include "ods/video/make_video.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/made_frames.h"
#include "tests/support/picture_rows.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods::view_browser_test {

using Json = nlohmann::json;

constexpr int kWindow = 128;     // pixels
constexpr int kPerRadian = 163;  // of the pictures: 1024 around
constexpr double kAlike = 38.0;  // dB, at rest
constexpr double kAlikeMoving = 34.0;
constexpr auto kPatience = std::chrono::seconds(400);
const std::vector<int> kBothEyes{kLeft, kRight};

struct Look {
  float yaw, pitch, fov;
};
using Looks = std::array<Look, 5>;

constexpr Looks kAround = {{{0, 0, 90}, {179, 20, 70}, {100, -75, 90}, {-45, 85, 60}, {30, -10, 25}}};

// Within what the projection shows. The direction straight behind, where a texel of a mirrored ball is a streak, is
// left out.
Looks looks_in(const ProjectionSetting& setting) {
  if (is_full_lat_long(setting) || is_cube(setting.kind)) return kAround;
  const float across = glm::degrees(static_cast<float>(0.5 / pixels_per_radian(setting, 1.0)));
  const float half = std::min(across, across * static_cast<float>(natural_height(setting, 1000)) / 1000.0f);
  Looks looks = {
      {{0, 0, 0.7f}, {0.35f, 0.25f, 0.45f}, {-0.35f, -0.25f, 0.5f}, {0.1f, -0.35f, 0.4f}, {0.2f, 0.1f, 0.25f}}};
  for (Look& look : looks) {
    look = {setting.pan + look.yaw * half, setting.tilt + look.pitch * half, look.fov * half};
  }
  return looks;
}

// Waves from broad to about four texels, bent differently for each eye.
void world(int eye, vec3 d, float* out) {
  const float phase = eye == kRight ? 1.2f : 0.0f;
  const float fine = std::sin(28.0f * d.x + phase) * std::sin(31.0f * d.y) * std::sin(29.0f * d.z + phase);
  const vec3 broad(std::sin(5.0f * d.x + 2.0f * d.y + phase), std::sin(7.0f * d.z - 3.0f * d.x * d.y + phase),
                   std::cos(6.0f * d.y + d.x + phase));
  for (int c = 0; c < 3; c++) out[c] = 0.4f + 0.2f * broad[c] + 0.15f * fine;
}

Extent extent_of(const ProjectionSetting& projection) {
  const double width = kPerRadian / pixels_per_radian(projection, 1.0);
  const int step = 2 * width_step(projection);
  const int rounded = std::max(static_cast<int>(std::lround(std::min(width, 1400.0) / step)), 1) * step;
  return {rounded, natural_height(projection, rounded)};
}

enum class Edges { kSoft, kSharp };
enum class Filters { kBoth, kCheap };  // of pace.js, for frames that move

void save_world(const StereoCamera& stereo, Layout layout, const std::string& path, Edges edges) {
  MadePicture made = make_picture(stereo, extent_of(stereo.projection), kBothEyes);
  const Camera camera = make_camera(stereo);
  add_colour(made, [&camera, edges](int eye, vec2 uv, float* out) {
    const vec3 direction = camera_ray(camera, eye, uv).direction;
    out[0] = out[1] = out[2] = 0.0f;
    if (direction != vec3(0.0f)) world(eye, direction, out);
    if (edges == Edges::kSharp) std::for_each(out, out + 3, [](float& each) { each = each > 0.4f ? 0.8f : 0.1f; });
  });
  made.picture.is_float = true;
  SaveOptions save;
  save.layout = layout;
  save.tone = ToneCurve::kLinear;
  const Conversion conversion = convert(made.picture, same_format(made.picture));
  save_picture(conversion.rows, keeps_layers(path) ? &stereo : nullptr, save, path);
}

// A look's colours as a screen has them. The light of an EXR has been through the tone curve.
Image shown(Image image, ToneCurve curve, float exposure = 0.0f) {
  for (size_t i = 0; i < image.pixels.size(); i += 3) {
    float* const pixel = image.pixels.data() + i;
    const vec3 light = tone_map(vec3(pixel[0], pixel[1], pixel[2]), exposure, curve);
    for (int c = 0; c < 3; c++) pixel[c] = srgb_encode(light[c]);
  }
  return image;
}

Image converted_light(const StoredPicture& picture, int eye, const Look& look) {
  ConvertTarget target = same_format(picture);
  target.camera.projection = projection_named("perspective");
  target.camera.projection.fov = look.fov;
  target.eye = {kWindow, kWindow};
  target.eyes = {kMono};
  target.mono_from = eye;
  turn(target.camera, look.yaw, look.pitch, 0.0f);
  const Conversion conversion = convert(picture, target);
  return images_of(conversion.rows)[0];
}

Image converted(const StoredPicture& picture, int eye, const Look& look) {
  return shown(converted_light(picture, eye, look), picture.is_float ? ToneCurve::kNeutral : ToneCurve::kLinear);
}

Image drawn(const std::string& path, int column = 0, Extent size = {kWindow, kWindow}) {
  return part_of_sent(path, column, size);
}

// --- the harness ----------------------------------------------------------------------------------------------------

class ViewBrowser : public ::testing::Test {
 protected:
  // Adds a picture of the world as an item of the page; returns its index.
  size_t add(const std::string& name, const StereoCamera& stereo, Layout layout, Edges edges = Edges::kSoft) {
    const std::string path = folder_.path(name);
    save_world(stereo, layout, path, edges);
    FormatHint known;
    known.layout = layout;
    if (!keeps_layers(path)) known.projection = stereo.projection;
    items_.push_back(open_view_item(path, known));
    OpenOptions options;
    options.format = known;
    pictures_.push_back(open_picture(path, options));
    return items_.size() - 1;
  }

  static std::string name_of(size_t item, size_t look, int eye, bool moves) {
    return fmt::format("{}_{}_{}{}", item, look, eye, moves ? "_moves" : "");
  }

  // At both speeds.
  void ask(size_t item, const Looks& looks, Filters filters = Filters::kBoth) {
    Json asked = Json::array();
    for (size_t i = 0; i < looks.size(); i++) {
      for (const int eye : kBothEyes) {
        Json look = {{"eye", eye}, {"yaw", looks[i].yaw}, {"pitch", looks[i].pitch}, {"fov", looks[i].fov}};
        for (const bool moves : {false, true}) {
          look["name"] = name_of(item, i, eye, moves);
          look["moves"] = moves;
          look["cheap"] = moves && (i % 2 == 1 || filters == Filters::kCheap);
          asked.push_back(look);
        }
      }
    }
    jobs_.push_back(
        {{"item", item}, {"choice", Json::object()}, {"width", kWindow}, {"height", kWindow}, {"looks", asked}});
  }

  // Lets a browser do the jobs; returns what it said at the end.
  std::string run(const std::vector<std::string>& browser) {
    export_site(items_, folder_.path("site"));
    const auto site = [this](const WebRequest& request) { return serve(request); };
    return run_harness({browser, folder_.path(""), jobs_.dump(), site, kPatience});
  }

  // Both eyes of every look are what ods convert makes, and not the other eye's, at rest and moving.
  void expect_looks(size_t item, const Looks& looks, const std::string& what) {
    for (size_t i = 0; i < looks.size(); i++) {
      const Image wanted[] = {converted(pictures_[item], kLeft, looks[i]),
                              converted(pictures_[item], kRight, looks[i])};
      for (const bool moves : {false, true}) {
        const double enough = moves ? kAlikeMoving : kAlike;
        for (const int eye : kBothEyes) {
          const Image got = drawn(folder_.path(name_of(item, i, eye, moves)));
          const std::string which = fmt::format("{}, look {}, eye {}{}", what, i, eye, moves ? ", moving" : "");
          EXPECT_GE(likeness(got, wanted[eye]), enough) << which;
          EXPECT_LT(likeness(got, wanted[1 - eye]), enough) << which << " is the other one";
        }
      }
    }
  }

  TemporaryFolder folder_;
  std::vector<ViewItem> items_;
  std::vector<StoredPicture> pictures_;
  Json jobs_ = Json::array();

 private:
  WebAnswer serve(const WebRequest& request) const {
    const std::string file = folder_.path("site/" + request.path), type(media_type(request.path));
    if (std::filesystem::exists(file)) return {.type = type, .file = file};
    const PageFile* const page = find_page_file(request.path);  // of the studio, which is not exported
    return page ? WebAnswer{.type = type, .body = std::string(page->data)} : nothing_there();
  }
};

StereoCamera camera_of(const ProjectionSetting& projection) {
  StereoCamera stereo;
  stereo.top = stereo.bottom = kUsualMerge;
  stereo.projection = projection;
  return stereo;
}

// Every projection, in two layouts by turns.
TEST_F(ViewBrowser, ShowsEveryProjectionAsConvertDoes) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  for (const NamedProjection& named : named_projections()) {
    const Layout layout = items_.size() % 2 ? Layout::kSideBySide : Layout::kTopBottom;
    ask(add(std::string(named.name) + ".png", camera_of(named.setting), layout), looks_in(named.setting));
  }
  ASSERT_EQ(run(browser), "ok");
  size_t item = 0;
  for (const NamedProjection& named : named_projections()) {
    expect_looks(item++, looks_in(named.setting), std::string(named.name));
  }
}

// Rows towards a pole of a lat-long have ever more texels for a pixel, while columns have less than one.
TEST_F(ViewBrowser, ShowsSharpEdgesAtAPole) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  constexpr Looks kPoles = {{{0, 90, 16}, {30, 88, 16}, {10, 87, 20}, {0, -90, 20}, {-40, -87, 16}}};
  ask(add("poles.png", camera_of(projection_named("lat-long")), Layout::kTopBottom, Edges::kSharp), kPoles);
  ASSERT_EQ(run(browser), "ok");
  expect_looks(0, kPoles, "a pole");
}

// Sharp edges, where a pixel covers two texels and more, as of an 8K picture on a laptop: at rest.
TEST_F(ViewBrowser, ShowsWhatIsReducedAsConvertDoes) {
  NEEDS_CHROMIUM();
  constexpr Looks kReduced = {{{0, 0, 76}, {100, -20, 76}, {30, 40, 90}, {200, 10, 110}, {-60, 0, 120}}};
  const size_t item = add("reduced.png", camera_of(projection_named("lat-long")), Layout::kTopBottom, Edges::kSharp);
  ask(item, kReduced);
  ASSERT_EQ(run(chromium(folder_.path("profile"))), "ok");
  for (size_t i = 0; i < kReduced.size(); i++) {
    const Image got = drawn(folder_.path(name_of(item, i, kLeft, false)));
    EXPECT_GE(likeness(got, converted(pictures_[item], kLeft, kReduced[i])), kAlike) << "look " << i;
  }
}

// Browsers read some layouts themselves; the others come as a JPEG of each eye.
TEST_F(ViewBrowser, ShowsEveryLayoutAsConvertDoes) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  std::vector<Layout> layouts;
  for (const Layout layout : kLayouts) {
    if (is_anaglyph(layout)) continue;
    const bool is_exr = layout == Layout::kMultiview, is_pair = layout == Layout::kSeparate;
    const std::string name = std::string(layout_name(layout)) + (is_exr ? ".exr" : is_pair ? "%V.png" : ".png");
    ask(add(name, camera_of(projection_named("lat-long")), layout), kAround);
    layouts.push_back(layout);
  }
  ASSERT_EQ(run(browser), "ok");
  for (size_t i = 0; i < layouts.size(); i++) expect_looks(i, kAround, std::string(layout_name(layouts[i])));
}

// Large pictures: the tiles that a look needs are brought, others make room; a coarse picture serves what is small.
TEST_F(ViewBrowser, ShowsLargePicturesByTiles) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  const std::vector<std::string> names = {"lat-long", "cube-3x2"};
  for (const std::string& name : names) {
    ask(add(name + ".png", camera_of(projection_named(name)), Layout::kTopBottom), looks_in(projection_named(name)));
    jobs_.back()["paging"] = {{"tile", 128}, {"coarse", 256}, {"budget", 24 * 160 * 160 * 4 * 1.35}};
  }
  ASSERT_EQ(run(browser), "ok");
  for (size_t i = 0; i < names.size(); i++)
    expect_looks(i, looks_in(projection_named(names[i])), names[i] + " by tiles");
}

TEST_F(ViewBrowser, IsExactAtRestAndQuickBefore) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  const size_t item = add("picture.png", camera_of(projection_named("lat-long")), Layout::kTopBottom);
  jobs_.push_back({{"item", item}, {"rest", true}});
  EXPECT_EQ(run(browser), "ok");
}

// The camera recorded in an EXR: a lens of its own, and eyes that converge.
TEST_F(ViewBrowser, ShowsTheFilesOwnCamera) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  StereoCamera lens = camera_of(projection_named("fisheye"));
  lens.projection.fov = 220.0f, lens.projection.pan = 15.0f, lens.projection.tilt = 10.0f;
  StereoCamera toe_in = camera_of(projection_named("lat-long"));
  toe_in.convergence = kToeIn, toe_in.convergence_distance = 0.4f;
  ask(add("lens.exr", lens, Layout::kMultiview), looks_in(lens.projection));
  ask(add("toe-in.exr", toe_in, Layout::kMultiview), kAround);
  ASSERT_EQ(run(browser), "ok");
  expect_looks(0, looks_in(lens.projection), "lens");
  expect_looks(1, kAround, "toe-in");
}

// Light comes as it is: the page applies exposure and tone curve as the library does, up to what is far above white,
// and divides the file as another layout has it.
TEST_F(ViewBrowser, DevelopsLightAsTheLibraryDoes) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  const size_t item = add("light.exr", camera_of(projection_named("lat-long")), Layout::kTopBottom);
  ASSERT_TRUE(has_light(items_[item]));
  const Look look = {30, -10, 60};
  std::vector<std::pair<ToneCurve, float>> ways;
  for (const ToneCurve tone : kToneCurves) {
    for (const float exposure : {-2.0f, 0.0f, 1.0f, 4.0f}) ways.emplace_back(tone, exposure);
  }
  for (const char* layout : {"top-bottom", "bottom-top"}) {
    for (const auto& [tone, exposure] : ways) {
      const std::string name = fmt::format("{}_{}_{}", layout, tone_curve_name(tone), exposure);
      const Json asked = {{"name", name}, {"eye", kRight}, {"yaw", look.yaw}, {"pitch", look.pitch}, {"fov", look.fov}};
      const Json choice = {{"exposure", exposure}, {"tone", tone_curve_name(tone)}, {"layout", layout}};
      jobs_.push_back(
          {{"item", item}, {"choice", choice}, {"width", kWindow}, {"height", kWindow}, {"looks", {asked}}});
    }
  }
  ASSERT_EQ(run(browser), "ok");
  for (const auto& [layout, eye] : {std::pair("top-bottom", kRight), std::pair("bottom-top", kLeft)}) {
    const Image light = converted_light(pictures_[item], eye, look);
    for (const auto& [tone, exposure] : ways) {
      const std::string name = fmt::format("{}_{}_{}", layout, tone_curve_name(tone), exposure);
      EXPECT_GE(likeness(drawn(folder_.path(name)), shown(light, tone, exposure)), kAlike) << name;
    }
  }
}

// Forwards, backwards, across key frames and by single steps: every frame is as bright as none of its neighbours.
TEST_F(ViewBrowser, ShowsTheFrameOfAVideo) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  if (!has_encoder("libx264")) GTEST_SKIP() << "skipped: this machine has no libx264";
  const auto code_of = [](int frame, int eye) { return eye == kRight ? 230 - 8 * frame : 20 + 8 * frame; };
  for (int frame = 0; frame < 24; frame++) {
    Picture picture;
    for (const int eye : kBothEyes) {
      const auto code = static_cast<float>(code_of(frame, eye));
      picture.eyes.emplace_back().eye = eye;
      picture.eyes.back().radiance = made::plain({256, 128}, vec3(code));
    }
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(picture, save, folder_.path(fmt::format("frame.{:04}.png", frame)));
  }
  const FrameFiles files = find_frames(folder_.path("frame.####.png"));
  EncodeOptions options;
  options.encoder = "libx264";
  options.rate = {10, 1};
  make_video(files, plan_video(files, {}, Layout::kTopBottom), {}, options, folder_.path("video_360_TB.mp4"));
  items_.push_back(open_view_item(folder_.path("video_360_TB.mp4")));
  Json looks = Json::array();
  const auto look_at = [&](int frame, int step) {
    for (const int eye : kBothEyes) {
      looks.push_back({{"name", fmt::format("{}_{}", looks.size() / 2, eye)}, {"eye", eye}, {"frame", frame}});
      if (step && eye == kLeft) looks.back()["step"] = step;
    }
  };
  std::vector<int> frames = {7, 3, 23, 0, 12, 11, 9, 10, 5, 15, 16, 17, 16, 15};
  for (size_t i = 0; i < frames.size(); i++) look_at(frames[i], i > 9 ? frames[i] - frames[i - 1] : 0);
  jobs_.push_back({{"item", 0}, {"choice", Json::object()}, {"width", kWindow}, {"height", kWindow}, {"looks", looks}});
  const std::string end = run(browser);
  if (end.find("has a codec") != std::string::npos) GTEST_SKIP() << "skipped: this chromium plays no H.264";
  ASSERT_EQ(end, "ok");
  for (size_t i = 0; i < frames.size(); i++) {
    for (const int eye : kBothEyes) {
      const Image image = drawn(folder_.path(fmt::format("{}_{}", i, eye)));
      EXPECT_NEAR(255.0f * image.at(kWindow / 2, kWindow / 2)[1], code_of(frames[i], eye), 3.0f) << i << " " << eye;
    }
  }
}

// The input of a headset's compositor: lat-long pictures of both eyes, whatever the file's projection.
TEST_F(ViewBrowser, LaysThePictureOutForAHeadsetsCompositor) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  const size_t item = add("picture.png", camera_of(projection_named("cube-3x2")), Layout::kTopBottom);
  jobs_.push_back({{"item", item}, {"layers", "layer"}});
  ASSERT_EQ(run(browser), "ok");
  const Json asked = Json::parse(folder_.read("layer.json"));
  EXPECT_EQ(asked["layout"], "stereo-left-right");
  EXPECT_NEAR(asked["centralHorizontalAngle"].get<double>(), 2.0 * kPi, 1e-6);
  EXPECT_NEAR(asked["upperVerticalAngle"].get<double>(), kPi / 2.0, 1e-6);
  EXPECT_NEAR(asked["lowerVerticalAngle"].get<double>(), -kPi / 2.0, 1e-6);
  // The layer turns to the left by as much as the shader turns lines of sight to the right.
  EXPECT_NEAR(asked["orientation"][1].get<double>(), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(asked["orientation"][3].get<double>(), std::sqrt(0.5), 1e-6);
  const Extent size{asked["viewPixelWidth"], asked["viewPixelHeight"]};
  for (const int eye : kBothEyes) {
    ConvertTarget target = same_format(pictures_[item]);
    target.camera.projection = projection_named("lat-long");
    target.eye = size;
    target.eyes = {kMono};
    target.mono_from = eye;
    const Conversion conversion = convert(pictures_[item], target);
    const Image wanted = shown(images_of(conversion.rows)[0], ToneCurve::kLinear);
    EXPECT_GE(likeness(drawn(folder_.path("layer"), eye * size.width, size), wanted), kAlike) << eye;
    EXPECT_LT(likeness(drawn(folder_.path("layer"), (1 - eye) * size.width, size), wanted), kAlike) << eye;
  }
}

// If a browser has cube layers, cubes are passed as such; a GPU looks faces up by direction, and interpolates linearly.
TEST_F(ViewBrowser, LaysACubeOutAsACube) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  const size_t item = add("picture.png", camera_of(projection_named("cube-3x2")), Layout::kTopBottom);
  jobs_.push_back({{"item", item}, {"layers", "layer"}, {"cube", true}});
  ASSERT_EQ(run(browser), "ok");
  const Json asked = Json::parse(folder_.read("layer.json"));
  EXPECT_EQ(asked["layout"], "stereo");
  EXPECT_EQ(asked["viewPixelWidth"], asked["viewPixelHeight"]);
  EXPECT_EQ(3 * asked["viewPixelWidth"].get<int>(), extent_of(projection_named("cube-3x2")).width);
  EXPECT_NEAR(asked["orientation"][1].get<double>(), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(asked["orientation"][3].get<double>(), std::sqrt(0.5), 1e-6);
  const int side = asked["viewPixelWidth"];
  ConvertTarget target = same_format(pictures_[item]);
  target.camera.projection = projection_named("lat-long");
  target.eye = {4 * side, 2 * side};
  target.eyes = {kMono};
  for (const int eye : kBothEyes) {
    target.mono_from = eye;
    const Image wanted = shown(images_of(convert(pictures_[item], target).rows)[0], ToneCurve::kLinear);
    EXPECT_GE(likeness(drawn(folder_.path("layer"), eye * target.eye.width, target.eye), wanted), kAlikeMoving) << eye;
    EXPECT_LT(likeness(drawn(folder_.path("layer"), (1 - eye) * target.eye.width, target.eye), wanted), kAlikeMoving);
  }
}

TEST(Layers, KnowTheKernelsCubes) {
  std::string list;
  for (int kind = 0; kind < kProjectionCount; kind++) {
    if (is_cube(kind)) list += fmt::format("{}{}", list.empty() ? "" : ", ", kind);
  }
  EXPECT_NE(find_page_file("layers.js")->data.find("CUBES = [" + list + "]"), std::string_view::npos) << list;
}

// Its GPU, Mesa's in software, claims to filter anisotropically, but takes the level of the longer derivative: frames
// of the fine filter have 30 dB. It is slow, so the page soon draws with the cheap one there.
TEST_F(ViewBrowser, ShowsTheSameInFirefox) {
  const std::vector<std::string> browser = firefox(folder_.path("profile"));
  if (browser.empty()) GTEST_SKIP() << "skipped: there is no firefox";
  std::filesystem::create_directories(folder_.path("home"));
  const std::vector<std::string> names = {"lat-long", "eac", "fisheye"};
  for (const std::string& name : names) {
    const size_t item = add(name + ".png", camera_of(projection_named(name)), Layout::kTopBottom);
    ask(item, looks_in(projection_named(name)), Filters::kCheap);
  }
  const std::string end = run(browser);
  if (end.find("no WebGL 2") != std::string::npos) GTEST_SKIP() << "skipped: this firefox has no WebGL 2";
  ASSERT_EQ(end, "ok");
  for (size_t i = 0; i < names.size(); i++) {
    expect_looks(i, looks_in(projection_named(names[i])), names[i]);
  }
}

// The studio's page: what it sends, shows and can undo, against a server that the page itself simulates.
TEST_F(ViewBrowser, KeepsTheStudiosSettings) {
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  jobs_.push_back({{"studio", true}});
  EXPECT_EQ(run(browser), "ok");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("site/studio.js"))) << "a folder has no server that renders";
}

// The page finds the kernel's numbers of the merges by a list of their names.
// In an emulated headset: each eye has its own picture in the direction in which its view points, wherever the head is.
TEST_F(ViewBrowser, ShowsEachEyeItsPictureInAHeadset) {
  NEEDS_IWER();
  const std::vector<std::string> browser = chromium(folder_.path("profile"));
  NEEDS_CHROMIUM();
  const size_t item = add("picture.png", camera_of(projection_named("lat-long")), Layout::kTopBottom);
  const Json looks = {{{"name", "ahead"}, {"yaw", 0}, {"pitch", 0}},
                      {{"name", "aside"}, {"yaw", 120}, {"pitch", 0}},
                      {{"name", "up"}, {"yaw", -40}, {"pitch", 50}},
                      {{"name", "swapped"}, {"yaw", 0}, {"pitch", 0}, {"press", "a-button"}},
                      {{"name", "back"}, {"yaw", 0}, {"pitch", 0}, {"press", "a-button"}},
                      {{"name", "centred"}, {"yaw", 75}, {"pitch", 0}, {"press", "thumbstick"}},
                      {{"name", "left"}, {"press", "b-button"}}};
  jobs_.push_back({{"item", item}, {"headset", true}, {"width", 2 * kWindow}, {"height", kWindow}, {"looks", looks}});
  ASSERT_EQ(run(browser), "ok");
  const auto expect = [&](const std::string& name, const Look& look, bool is_swapped) {
    for (const int eye : kBothEyes) {
      const Image wanted = converted(pictures_[item], is_swapped ? 1 - eye : eye, look);
      const Image other = converted(pictures_[item], is_swapped ? eye : 1 - eye, look);
      const Image got = drawn(folder_.path(name), eye * kWindow);
      EXPECT_GE(likeness(got, wanted), kAlike) << name << ", eye " << eye;
      EXPECT_LT(likeness(got, other), kAlike) << name << ", eye " << eye;
    }
  };
  expect("ahead", {0, 0, 90}, false);
  expect("aside", {120, 0, 90}, false);
  expect("up", {-40, 50, 90}, false);
  expect("swapped", {0, 0, 90}, true);
  expect("back", {0, 0, 90}, false);
  expect("centred", {0, 0, 90}, false);
  EXPECT_EQ(folder_.read("left"), "left");  // the session ended by the button
  EXPECT_EQ(folder_.read("ended"), "null");
}

}  // namespace ods::view_browser_test
