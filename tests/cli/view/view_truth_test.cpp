// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Layered scenes in Chromium against ods render: the same eye, view and moment. tests/web/layered-test.js drives the
// browser.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/view/view_site.h"
#include "ods/layers/file/layers_info.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"

namespace ods::view_truth_test {

constexpr Extent kView{200, 200};
constexpr float kEye = 0.0315f;  // metres from the middle of the head

struct Look {
  vec3 head{0.0f};  // from the middle of the box
  float yaw = 0.0f, pitch = 0.0f;
  float time = 0.0f;  // seconds
};

class ViewTruth : public Cli {
 protected:
  // The view of the left eye in Chromium.
  std::vector<Image> looks(const std::string& path, const std::vector<Look>& all) {
    nlohmann::json list;
    for (size_t i = 0; i < all.size(); i++) {
      const Look& look = all[i];
      list.push_back({{"name", fmt::format("look{}", i)},
                      {"item", 0},
                      {"time", look.time},
                      {"x", look.head.x},
                      {"y", look.head.y},
                      {"z", look.head.z},
                      {"yaw", look.yaw},
                      {"pitch", look.pitch}});
    }
    const nlohmann::json job = {
        {"layered", "draw"}, {"item", 0}, {"width", kView.width}, {"height", kView.height}, {"looks", list}};
    ViewSite site({open_view_item(path)}, {});
    EXPECT_EQ(run_harness({chromium(folder.path("profile")), folder.path(""), nlohmann::json::array({job}).dump(),
                           [&](const WebRequest& request) { return site.answer(request); }, std::chrono::seconds(300)}),
              "ok");
    std::vector<Image> seen;
    for (size_t i = 0; i < all.size(); i++) {
      seen.push_back(part_of_sent(folder.path(fmt::format("look{}", i)), 0, kView));
    }
    return seen;
  }

  // The same as ods render sees it, with the exposure of the layers. Precondition: the scene's yaw is 0.
  Image truth(const std::string& scene, const std::string& path, const Look& look) {
    const LayersInfo info = *read_layers_info(path);
    const float yaw = glm::radians(look.yaw);
    const vec3 eye = info.box.center + look.head - kEye * vec3(std::cos(yaw), 0.0f, std::sin(yaw));
    const std::string picture = folder.path("truth.png");
    const std::string command = fmt::format(
        "render {} -o {} --projection perspective --fov 90 --eyes mono --width {} --height {} --position {},{},{} "
        "--yaw {} --pitch {} --exposure {} --samples 128 --noise none --time {}",
        scene, picture, kView.width, kView.height, eye.x, eye.y, eye.z, look.yaw, look.pitch, info.light.exposure,
        look.time);
    EXPECT_EQ(run(command), 0) << err;
    return part_of_sent(picture, 0, kView);
  }
};

// PSNR over the pixels in which two pictures differ; and their share.
struct Shadows {
  double share = 0.0;
  double before = 0.0, now = 0.0;  // dB
};

Shadows shadows_of(const Image& before, const Image& now, const Image& truth) {
  double off_before = 0.0, off_now = 0.0, count = 0.0;
  for (size_t i = 0; i < truth.pixels.size(); i++) {
    if (std::abs(before.pixels[i] - now.pixels[i]) < 4.0f / 255.0f) continue;
    off_before += std::pow(before.pixels[i] - truth.pixels[i], 2.0f);
    off_now += std::pow(now.pixels[i] - truth.pixels[i], 2.0f);
    count += 1.0;
  }
  const auto psnr = [&](double off) { return -10.0 * std::log10(off / count); };
  return {count / static_cast<double>(truth.pixels.size()), psnr(off_before), psnr(off_now)};
}

// In a frame that has a light, and between two: the change of the still layers' light is worth several dB where there is
// one, and costs nothing elsewhere. Without it the file is what players see that do not know it.
TEST_F(ViewTruth, FilmsHaveTheShadowsOfWhatMoves) {
  if (chromium("").empty()) GTEST_SKIP() << "skipped: there is no chromium";
  const std::string path = folder.path("toys.layers.glb"), still = folder.path("still.layers.glb");
  ASSERT_EQ(run("layers toys -o " + path + " --frames 0-6 --fps 12 --width 768 --samples 64"), 0) << err;
  std::string bytes = folder.read("toys.layers.glb");
  const size_t mark = bytes.find("\"changes\":");
  ASSERT_NE(mark, std::string::npos);
  folder.write("still.layers.glb", bytes.replace(mark, 10, "\"chances\":"));
  const std::vector<Look> all = {{{0.0f, 0.0f, 0.0f}, 0.0f, 0.0f, 0.0f},
                                 {{0.05f, 0.0f, 0.05f}, 0.0f, -30.0f, 0.375f},
                                 {{0.0f, 0.05f, 0.0f}, 0.0f, -30.0f, 0.25f}};
  const std::vector<Image> now = looks(path, all), before = looks(still, all);
  for (size_t i = 0; i < all.size(); i++) {
    const Image wanted = truth("toys", path, all[i]);
    const Shadows shadows = shadows_of(before[i], now[i], wanted);
    const double whole = likeness(now[i], wanted), whole_before = likeness(before[i], wanted);
    RecordProperty(fmt::format("look{}", i),
                   fmt::format("{:.2f} dB, {:.2f} before; shadows {:.3f} {:.2f} {:.2f}", whole, whole_before,
                               shadows.share, shadows.now, shadows.before));
    EXPECT_GT(shadows.share, 0.002) << i;
    EXPECT_GT(shadows.now, shadows.before + 3.0) << i;
    EXPECT_GT(whole, whole_before) << i;
  }
}

}  // namespace ods::view_truth_test
