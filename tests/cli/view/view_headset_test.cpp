// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The headset's panel in a browser with an emulated headset, against the server of ods view. tests/web/headset-test.js
// drives it; what the wearer sees is judged here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/view/view_site.h"
#include "ods/base/error.h"
#include "ods/comfort/strain.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"
#include "tests/support/picture_rows.h"

namespace ods::headset_browser_test {

constexpr Extent kEye{256, 256};  // pixels of what is sent, 90 degrees wide
constexpr auto kPatience = std::chrono::seconds(290);

class HeadsetBrowser : public Cli {
 protected:
  void SetUp() override {
    NEEDS_IWER();
    NEEDS_CHROMIUM();
  }

  void make(const std::string& name, const std::string& how = "") {
    ASSERT_EQ(run("testcard -q --width 1024 " + how + " -o " + folder.path(name)), 0) << err;
    items.push_back(open_view_item(folder.path(name)));
  }

  void make_all() {
    for (const char* name : {"first_360_TB.png", "second_360_TB.png", "third_360_TB.png", "fourth_360_TB.png"})
      make(name);
    make("light.exr");
    make("film_360_TB.mp4", "--video --duration 5 --fps 10 --width 256");
  }

  // Lets the browser run a part of the test; returns what it said at the end.
  std::string run_part(const std::string& part, const std::optional<SceneSource>& scene = {}) {
    ViewSite site(items, scene);
    return run_harness({chromium(folder.path("profile")), folder.path(""), fmt::format("[{{\"panel\":\"{}\"}}]", part),
                        [&](const WebRequest& request) { return site.answer(request); }, kPatience});
  }

  // A part of what was sent.
  Image seen(const std::string& name, int column, Extent size = kEye) const {
    return part_of_sent(folder.path(name), column, size);
  }

  std::vector<ViewItem> items;
};

// By how many pixels a part of the left eye's picture is farther to the right than in the right eye's, to a tenth.
double disparity(const Image& left, const Image& right, int x0, int y0, int x1, int y1) {
  const auto difference = [&](int shift) {
    double sum = 0.0;
    for (int y = y0; y < y1; y++) {
      for (int x = x0; x < x1; x++) {
        const double d = double{left.at(x, y)[1]} - double{right.at(x - shift, y)[1]};
        sum += d * d;
      }
    }
    return sum;
  };
  int best = 0;
  for (int shift = -40; shift <= 40; shift++) {
    if (difference(shift) < difference(best)) best = shift;
  }
  const double before = difference(best - 1), at = difference(best), after = difference(best + 1);
  return best + 0.5 * (before - after) / (before - 2.0 * at + after);  // of a parabola
}

// The colour of the upper rows.
double brightness(const Image& image) {
  double sum = 0.0;
  const int rows = image.height / 5;
  for (int y = 0; y < rows; y++) {
    for (int x = 0; x < image.width; x++) sum += double{image.at(x, y)[1]};
  }
  return sum / (rows * image.width);
}

// Every control works by ray, look, hand and pinch; the panel is where it reports to be, and each eye sees it there.
TEST_F(HeadsetBrowser, EveryControlOfThePanelDoesWhatItSays) {
  make_all();
  ASSERT_EQ(run_part("panel"), "ok");
  EXPECT_EQ(folder.read("said"), "ok") << "films were left out";
  const Image left = seen("panel", 0), right = seen("panel", kEye.width);
  // The head looks at its middle, 1.2 m away; iwer's eyes are 63 mm apart.
  EXPECT_NEAR(disparity(left, right, 103, 103, 153, 153), 128.0 * 0.063 / 1.2, 0.25);
  EXPECT_GT(likeness(seen("left", 0, {128, 128}), seen("left", 128, {128, 128})), 60.0) << "one eye's picture for both";
  EXPECT_NEAR(brightness(left) / brightness(seen("left", 0, {128, 128})), 0.35, 0.03) << "the picture behind is dimmed";
  const auto expected = [this](const std::string& eye) {
    const std::string name = eye + ".png",
                      mono = "-q --mono --to perspective --fov 90 --yaw 25 --pitch 10 --width 128 ";
    EXPECT_EQ(run("convert " + mono + "--eyes " + eye + " " + items[0].path + " -o " + folder.path(name)), 0) << err;
    return seen(name, 0, {128, 128});
  };
  const Image mirror = seen("mirror", 0, {128, 128});
  EXPECT_GT(likeness(mirror, expected("left")), likeness(mirror, expected("right")) + 3.0);
  EXPECT_GT(likeness(mirror, expected("left")), 26.0);
}

// The merge by the panel, in a scene that is rendered meanwhile.
TEST_F(HeadsetBrowser, ThePanelChangesTheStudiosScene) {
  SceneSource scene;
  scene.name = "room";
  ASSERT_EQ(run_part("studio", scene), "ok");
}

// If the compositor shows the picture, the panel has a layer above it.
TEST_F(HeadsetBrowser, ThePanelIsAboveThePicturesLayer) {
  make("first_360_TB.png");
  EXPECT_EQ(run_part("layers"), "ok");
}

// A film is a layer of the browser where that shows the same to each eye, and the shader's otherwise.
TEST_F(HeadsetBrowser, FilmsAreLayersOfTheBrowserWhereTheseAreTrue) {
  make("first_360_TB.png");
  make("film_360_TB.mp4", "--video --duration 1 --fps 10 --width 512");
  make("film_180_LR.mp4", "--video --duration 1 --fps 10 --width 512 --projection vr180");
  ASSERT_EQ(run_part("films"), "ok");
  EXPECT_EQ(folder.read("said"), "ok") << "films were left out";
}

// A browser that shows the page itself to each eye.
TEST_F(HeadsetBrowser, BothEyesSeeThePageWhereTheBrowserCanShowIt) {
  make("first_360_TB.png");
  make("second_360_TB.png");
  EXPECT_EQ(run_part("inline"), "ok");
}

// The desk's view of the wearer, and the wearer's view of the desk, through the server.
TEST_F(HeadsetBrowser, TheDeskAndTheWearerShareWhatTheySee) {
  make_all();
  ASSERT_EQ(run_part("sharing"), "ok");
  EXPECT_EQ(folder.read("said"), "ok") << "films were left out";
}

// The panel's distance, judged by ods comfort's own rules for a headset that focuses at 1.3 m.
TEST(HeadsetPanel, IsAsFarAwayAsEyesLikeIt) {
  const std::string page(find_page_file("headset-panel.js")->data), words = "export const DISTANCE = ";
  const size_t at = page.find(words);
  ASSERT_NE(at, std::string::npos);
  const double metres = std::stod(page.substr(at + words.size()));
  const Viewer viewer;
  const StrainLimits limits = strain_limits(Strain::kNear, viewer);
  EXPECT_EQ(level_of(1.0 / metres, limits), ComfortLevel::kOk);
  EXPECT_GT(metres, 2.0 * kGoogleAhead - 1e-9);
  EXPECT_LT(std::abs(1.0 / metres - 1.0 / double{viewer.focus}), 0.1) << "dioptres between converging and focusing";
}

}  // namespace ods::headset_browser_test
