// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The viewer's page and its element in Chromium, as visitors, keyboards, scripts and other pages use them
// (tests/web/page-test.js); exported pages from disk; how much of it goes over the wire.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/http/http_server.h"
#include "cli/view/export_site.h"
#include "cli/view/view_site.h"
#include "ods/base/base64.h"
#include "ods/base/gzip.h"
#include "ods/convert/convert.h"
#include "ods/image/image_file.h"
#include "ods/video/make_video.h"
#include "ods/view/bundle.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/made_frames.h"
#include "tests/support/picture_rows.h"
#include "tests/support/stored_pictures.h"
#include "tests/support/temporary_folder.h"

namespace ods::page_browser_test {

constexpr auto kPatience = std::chrono::seconds(600);

class PageBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    browser_ = chromium(folder_.path("profile"));
    NEEDS_CHROMIUM();
    save_waves();
  }

  // Broad waves, other ones for each eye: a picture that has no place twice.
  void save_waves() {
    StereoCamera stereo;
    MadePicture made = make_picture(stereo, {1024, 512}, {kLeft, kRight});
    const Camera camera = make_camera(stereo);
    add_colour(made, [&camera](int eye, vec2 uv, float* out) {
      const vec3 d = camera_ray(camera, eye, uv).direction;
      const float phase = eye == kRight ? 1.2f : 0.0f;
      out[0] = 0.5f + 0.4f * std::sin(5.0f * d.x + 2.0f * d.y + phase);
      out[1] = 0.5f + 0.4f * std::sin(7.0f * d.z - 3.0f * d.x * d.y + phase);
      out[2] = 0.5f + 0.4f * std::cos(6.0f * d.y + d.x + phase);
    });
    made.picture.is_float = true;
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(convert(made.picture, same_format(made.picture)).rows, nullptr, save, picture_);
    folder_.write("waves_360_TB.notes.json",
                  R"({"caption": "A <b>card</b>",
                      "hotspots": [{"yaw": 20, "pitch": 10, "title": "Lamp", "text": "<i>On</i>"}]})");
  }

  std::string site() const { return folder_.path("site"); }
  void export_waves() { export_site({open_view_item(picture_)}, site()); }

  // The browser's report at the end of a test of page-test.js.
  std::string run(const nlohmann::json& job, const std::vector<std::string>& more = {}) {
    export_waves();
    std::vector<std::string> words = browser_;
    words.insert(words.end(), more.begin(), more.end());
    const auto site = [this](const WebRequest& request) { return serve(request); };
    return run_harness({words, folder_.path(""), nlohmann::json::array({job}).dump(), site, kPatience});
  }

  // A page of the site from disk, with a script that reports texts by say(name, text) and ends by say('done', text).
  // Returns its last text; the others are in said_. The clock is the real one: a browser's virtual clock runs while
  // pictures are decoded, and does not wait for the GPU.
  std::string run_from_disk(const std::string& page, const std::string& script, Extent window) {
    constexpr const char* kBegin = R"(<script>
const say = (name, text) => fetch(`${location.search.slice(1)}${name}?text=${encodeURIComponent(text)}`, { mode: 'no-cors' }).catch(() => {});
const until = async (test) => {
  while (!test()) await new Promise((go) => setTimeout(go, 50));
};
addEventListener('load', async () => {
)";
    folder_.write("site/checked.html", folder_.read("site/" + page) + kBegin + script + "});\n</script>");
    std::vector<std::string> words = browser_;
    words.push_back(fmt::format("--window-size={},{}", window.width, window.height));
    said_.clear();
    const auto hear = [this](const WebRequest& request) {
      said_[request.path] += value_of(request, "text");
      return WebAnswer{};
    };
    return run_in_browser({words, folder_.path("home"), "file://" + site() + "/checked.html", hear, kPatience});
  }

  TemporaryFolder folder_;
  std::string picture_ = folder_.path("waves_360_TB.png");
  std::vector<std::string> browser_;
  std::map<std::string, std::string> said_;  // one thing at a time

 private:
  WebAnswer serve(const WebRequest& request) const {
    std::string name = request.path, type(media_type(name)), place = site() + "/" + name;
    const char* const modules = std::getenv("ODS_NODE_MODULES");
    if (modules && name.starts_with("npm/")) place = modules + name.substr(3);
    if (name.starts_with("src/")) place.clear(), name.erase(0, 4);
    if (std::filesystem::is_regular_file(place)) return {.type = type, .file = std::filesystem::canonical(place)};
    const PageFile* const page = find_page_file(name);
    return page ? WebAnswer{.type = type, .body = std::string(page->data)} : nothing_there();
  }
};

// Keys, tooltips, hotspots, comparing, little planet, contrast.
TEST_F(PageBrowser, ThePageInTheDark) {
  EXPECT_EQ(run({{"page", "page"}}, {"--window-size=600,600", "--blink-settings=preferredColorScheme=0"}), "ok");
}

TEST_F(PageBrowser, ThePageInTheLight) {
  EXPECT_EQ(run({{"page", "light"}}, {"--window-size=600,600", "--blink-settings=preferredColorScheme=1"}), "ok");
}

TEST_F(PageBrowser, ThePageOnAPhone) {
  EXPECT_EQ(run({{"page", "phone"}}, {"--window-size=500,800"}), "ok");  // Chromium's narrowest
}

TEST_F(PageBrowser, TheStudio) {
  EXPECT_EQ(run({{"page", "studio"}}, {"--window-size=1000,800", "--blink-settings=preferredColorScheme=0"}), "ok");
}

TEST_F(PageBrowser, TheStudioInTheLight) {
  EXPECT_EQ(run({{"page", "studio"}}, {"--window-size=1000,800", "--blink-settings=preferredColorScheme=1"}), "ok");
}

TEST_F(PageBrowser, TheStudioOnAPhone) {
  EXPECT_EQ(run({{"page", "studio-phone"}}, {"--window-size=500,800"}), "ok");
}

TEST_F(PageBrowser, TheElementInOtherPages) {
  EXPECT_EQ(run({{"page", "element"}}), "ok");
}

// tests/web/element-test.js: each in a page of its own.
class ElementBrowser : public PageBrowser, public ::testing::WithParamInterface<const char*> {};

TEST_P(ElementBrowser, Shows) {
  EXPECT_EQ(run({{"page", "elements"}, {"test", GetParam()}}), "ok");
}

INSTANTIATE_TEST_SUITE_P(Pages, ElementBrowser,
                         ::testing::Values("translations", "visitors", "mounted", "upright", "many", "grid",
                                           "fullscreen", "lost", "strict", "tagged", "streams"),
                         [](const auto& each) { return std::string(each.param); });

TEST_F(PageBrowser, TheElementBesideAFrame) {
  const char* const modules = std::getenv("ODS_NODE_MODULES");
  if (!modules || !std::filesystem::exists(std::string(modules) + "/aframe")) {
    GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no aframe (npm install aframe)";
  }
  EXPECT_EQ(run({{"page", "aframe"}}), "ok");
}

TEST_F(PageBrowser, TheElementInThreeJs) {
  if (!std::getenv("ODS_NODE_MODULES")) GTEST_SKIP() << "skipped: ODS_NODE_MODULES has no three (npm install three)";
  EXPECT_EQ(run({{"page", "three"}}), "ok");
}

TEST_F(PageBrowser, HearsAmbisonicSoundFromWhereItComes) {
  EXPECT_EQ(run({{"page", "sound"}}), "ok");
}

TEST_F(PageBrowser, ShowsSubtitlesOfAVideo) {
  if (!has_encoder("libx264")) GTEST_SKIP() << "skipped: this machine has no libx264";
  for (int frame = 0; frame < 20; frame++) {
    Picture picture;
    picture.eyes.emplace_back().radiance = made::plain({256, 256}, vec3(100.0f));
    SaveOptions save;
    save.tone = ToneCurve::kLinear;
    save_picture(picture, save, folder_.path(fmt::format("frame.{:04}.png", frame)));
  }
  const FrameFiles files = find_frames(folder_.path("frame.####.png"));
  EncodeOptions options;
  options.encoder = "libx264";
  options.rate = {10, 1};
  picture_ = folder_.path("film_360_TB.mp4");
  make_video(files, plan_video(files, {}, Layout::kTopBottom), {}, options, picture_);
  folder_.write("film_360_TB.vtt",
                "WEBVTT\n\n00:00.000 --> 00:01.000\nFirst\n\n00:01.000 --> 00:02.000\n<b>Second</b> line\n");
  const std::string end = run({{"page", "video"}});
  if (end.find("has a codec") != std::string::npos) GTEST_SKIP() << "skipped: this chromium plays no H.264";
  EXPECT_EQ(end, "ok");
  EXPECT_EQ(read_image(site() + "/item/0/poster.jpg").width, 960) << "before it plays, too, a video shows something";
}

// The middle of a window that is 90 degrees wide.
Image middle_of(const StoredPicture& picture, int size, double window) {
  ConvertTarget target = same_format(picture);
  target.camera.projection = projection_named("perspective");
  target.camera.projection.fov = static_cast<float>(glm::degrees(2.0 * std::atan(size / window)));
  target.eye = {size, size};
  target.eyes = {kMono};
  target.mono_from = kLeft;
  return images_of(convert(picture, target).rows)[0];
}

// The picture at rest is as exact as from a server.
TEST_F(PageBrowser, OpensFromDisk) {
  export_waves();
  const std::string end = run_from_disk("index.html", R"(
  await until(() => window.omnistereo);
  const { viewer } = window.omnistereo;
  viewer.addEventListener('settled', async () => {
    const [middle, { canvas }] = [document.createElement('canvas'), viewer];
    middle.width = middle.height = 128;
    middle.getContext('2d').drawImage(canvas, 64 - canvas.width / 2, 64 - canvas.height / 2);
    const [, picture] = middle.toDataURL().split(',');
    for (let i = 0; i < picture.length; i += 6000) await say('picture', picture.slice(i, i + 6000));
    say('done', canvas.width);
  }, { once: true });
  viewer.set({ fov: 90 });
)",
                                        {512, 512});
  ASSERT_GE(std::atoi(end.c_str()), 256) << end;
  folder_.write("middle.png", decode_base64(said_["picture"]));
  EXPECT_GE(likeness(read_image(folder_.path("middle.png")), middle_of(open_picture(picture_), 128, std::stod(end))),
            38.0);
}

// Its three examples: one is open, one is a poster until it is clicked, one has the page's own buttons.
TEST_F(PageBrowser, ThreeExamplesOpenFromDisk) {
  export_waves();
  EXPECT_EQ(run_from_disk("example.html", R"(
  const [a, b, c] = document.querySelectorAll('stereo-360');
  const state = () => [a.loaded, a.yaw, b.loaded, b.shadowRoot.getElementById('poster').naturalWidth, c.loaded].join();
  setTimeout(() => say('done', `after two minutes: ${state()}`), 120000);
  await until(() => state() === 'true,20,false,960,true');
  document.querySelector('[data-yaw="90"]').click();
  await until(() => c.yaw === 90 && document.getElementById('where').textContent.startsWith('yaw 90'));
  say('done', 'ok');
)",
                          {900, 2400}),
            "ok");
}

// The parts of the page that ods view sends over a real connection: first, and on demand.
TEST_F(PageBrowser, TheServedPageIsSmallOnTheWire) {
  std::filesystem::remove(folder_.path("waves_360_TB.notes.json"));  // hotspots are wanted at once
  ViewSite site({open_view_item(picture_)}, {});
  const auto answer = [&](const WebRequest& request) -> WebAnswer {
    if (request.path == "check.js") {
      return {.type = "text/javascript", .body = R"(
const timer = setInterval(async () => {
  const player = window.omnistereo;
  if (!player?.viewer.picture) return;
  clearInterval(timer);
  const pages = ({ name }) => !/item.|view.json|alive|check.js/.test(name);
  const files = [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource').filter(pages)];
  const body = `${files.reduce((sum, { encodedBodySize }) => sum + encodedBodySize, 0)} ${files.map(({ name }) => name.split('/').pop())}`;
  await Promise.all([player.compare(), player.toggleList()]).catch((error) => player.toast(error.message));
  const later = performance.getEntriesByType('resource').filter(({ name }) => name.endsWith('later.js')).length;
  fetch('done', { method: 'POST', body: `${body}; later ${later}, ${Boolean(player.viewer.compare)}` });
}, 500);)"};
    }
    WebAnswer sent = site.answer(request);
    if (request.path.empty()) sent.body += "<script src=\"check.js\"></script>";
    return sent;
  };
  const std::string end = run_in_browser({browser_, folder_.path("home"), "", answer, kPatience});
  const int bytes = std::atoi(end.c_str());
  fmt::print("{}\n", end);
  EXPECT_GT(bytes, 20'000) << end;
  EXPECT_LE(bytes, 43'000) << end;
  EXPECT_NE(end.find("main.js; later 1, true"), std::string::npos) << end;
}

// The page as web hosts send it: an exported page with everything that it loads later, and the element; and the page of
// ods view.
TEST(Page, IsSmallOnTheWire) {
  const auto size_of = [](const std::string& script, const std::vector<const char*>& files) {
    size_t size = gzip(script).size();
    for (const char* const name : files) size += gzip(find_page_file(name)->data).size();
    return size;
  };
  const std::vector<const char*> beside = {"index.html", "style.css", "player.css"};
  std::vector<const char*> studios = beside;
  studios.insert(studios.end(), {"studio.css", "merge-curve.frag"});
  const size_t page = size_of(bundle("main.js"), beside), element = size_of(bundle("stereo-360.js"), {}),
               view = size_of(bundle("main.js", PageHost::kView), beside),
               studio = size_of(bundle("main.js", PageHost::kStudio), studios),
               later = size_of(bundle_later("later.js", PageHost::kStudio), {}),
               tour = size_of(bundle_later("later-tour.js", PageHost::kStudio), {}),
               words = size_of(bundle_later("later-words.js", PageHost::kFolder), {}),
               objects = size_of(bundle_later("later-objects.js", PageHost::kStudio), {});
  fmt::print(
      "gzipped: page {} bytes, element {}, page of ods view {}, studio {}, what each loads later {}, for tours {}, "
      "other languages {}, for objects in pictures {}\n",
      page, element, view, studio, later, tour, words, objects);
  EXPECT_LE(page, 70'000u);
  EXPECT_LE(element, 70'000u);
  EXPECT_LE(view, 43'000u);
  EXPECT_LE(studio, 67'000u);
  EXPECT_LE(later, 55'000u);  // layered scenes need 8,000 of them, objects in them 17,000
  EXPECT_LE(tour, 12'000u);
  EXPECT_LE(words, 9'000u);
  EXPECT_LE(objects, 9'000u);
}

}  // namespace ods::page_browser_test
