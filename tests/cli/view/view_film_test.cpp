// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Films of layered scenes in the viewer: in Chromium, at times between the frames, against rays at the triangles as
// they are then. tests/web/layered-test.js drives the browser.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/view/view_site.h"
#include "ods/layers/file/write_layers.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"
#include "tests/support/layered_film.h"

namespace ods::view_film_test {

using namespace layered_film;

constexpr Extent kView{160, 120};
constexpr float kEye = 0.0315f;  // metres from the middle of the head

// The light of the mover that is at a point of its plane at a time; -1 if none is.
vec3 light_at(vec3 at, float t) {
  const float angle = 0.8f * t;
  const vec2 from(at.x - (-0.5f + t), at.y - 0.2f);
  const vec2 turned(std::cos(angle) * from.x + std::sin(angle) * from.y,
                    std::cos(angle) * from.y - std::sin(angle) * from.x);
  const auto is_in = [](vec2 p, vec2 half) { return abs(p.x) < half.x && abs(p.y) < half.y; };
  if (is_in(turned, vec2(0.2f * (1.0f + 0.5f * t)))) return glm::mix(kFirst, kLast, t);
  if (is_in(vec2(at.x, at.y + 0.45f), vec2(0.15f * (1.0f + 2.0f * t), 0.15f))) return kOther;
  if (t < 0.5f && is_in(vec2(at.x, at.y - 0.5f), vec2(0.1f))) return kOther;
  return vec3(-1.0f);
}

struct Compared {
  int on_movers = 0;
  int wrong = 0;
};

// Pixels all of whose surroundings are on one mover, or on none: those on movers have its light, the others another
// one.
Compared compare(const Image& got, vec3 eye, float t) {
  Compared compared;
  const auto light = [&](int x, int y) {
    const vec2 p((static_cast<float>(x) + 0.5f) / 80.0f - 1.0f, (60.0f - static_cast<float>(y) - 0.5f) / 80.0f);
    return light_at(eye + vec3(p, -1.0f) * (1.2f + eye.z), t);
  };
  for (int y = 2; y < kView.height - 2; y++) {
    for (int x = 2; x < kView.width - 2; x++) {
      const vec3 wanted = light(x, y);
      bool is_pure = true;
      for (int i = 0; i < 25; i++) is_pure = is_pure && light(x + i % 5 - 2, y + i / 5 - 2) == wanted;
      if (!is_pure) continue;
      const bool is_mover = wanted.x >= 0.0f;
      compared.on_movers += is_mover ? 1 : 0;
      bool is_like = true;
      for (int c = 0; c < 3; c++) is_like = is_like && abs(got.at(x, y)[c] - srgb_encode(wanted[c])) < 0.03f;
      compared.wrong += is_mover && !is_like ? 1 : 0;
    }
  }
  return compared;
}

using FilmView = Cli;

TEST_F(FilmView, PlaysBetweenItsFrames) {
  NEEDS_CHROMIUM();
  write_layers(film(), folder.path("film.layers.glb"));
  const std::vector<float> times = {0.0f, 0.25f, 0.6f, 1.0f};
  const vec3 head(0.05f, 0.02f, 0.05f);
  nlohmann::json looks;
  for (size_t i = 0; i < times.size(); i++) {
    looks.push_back(
        {{"name", fmt::format("film{}", i)}, {"time", times[i]}, {"x", head.x}, {"y", head.y}, {"z", head.z}});
  }
  const nlohmann::json job = {
      {"layered", "film"}, {"item", 0}, {"width", kView.width}, {"height", kView.height}, {"looks", looks}};
  ViewSite site({open_view_item(folder.path("film.layers.glb"))}, {});
  ASSERT_EQ(run_harness({chromium(folder.path("profile")), folder.path(""), nlohmann::json::array({job}).dump(),
                         [&](const WebRequest& request) { return site.answer(request); }, std::chrono::seconds(200)}),
            "ok");
  const vec3 eye = head - vec3(kEye, 0, 0);
  for (size_t i = 0; i < times.size(); i++) {
    const Image got = part_of_sent(folder.path(fmt::format("film{}", i)), 0, kView);
    const Compared compared = compare(got, eye, times[i]);
    EXPECT_GT(compared.on_movers, 300) << times[i];
    EXPECT_EQ(compared.wrong, 0) << times[i] << ": of " << compared.on_movers;
    EXPECT_GT(compare(got, eye, 1.0f - times[i]).wrong, 100) << "other times look alike";
  }
}

// Vision Pro's own player gets the file with Apple's tags itself.
TEST_F(FilmView, AnExportNamesTaggedFiles) {
  const std::string card = folder.path("pair_LR.png"), photo = folder.path("photo.heic"), site = folder.path("site"),
                    film = folder.path("film_360_TB.mp4"), tagged = folder.path("tagged_360_TB.mp4");
  ASSERT_EQ(run("testcard -q --projection perspective --layout side-by-side --width 128 -o " + card), 0) << err;
  if (run("convert -q " + card + " --projection perspective --input-fov 70 --ipd 0.06 -o " + photo) != 0) {
    GTEST_SKIP() << "skipped: " << err;
  }
  ASSERT_EQ(run("testcard -q --video --duration 0.2 --width 128 -o " + film), 0) << err;
  ASSERT_EQ(run("inject -q --apple " + film + " -o " + tagged), 0) << err;
  ASSERT_EQ(run("view -q " + photo + " " + film + " " + tagged + " --export " + site), 0) << err;
  const nlohmann::json items = nlohmann::json::parse(folder.read("site/view.json"))["items"];
  EXPECT_EQ(items[0]["system"], "item/0/original.heic");
  EXPECT_EQ(folder.read("site/item/0/original.heic"), folder.read("photo.heic"));
  EXPECT_FALSE(items[1].contains("system"));
  EXPECT_EQ(items[2]["system"], items[2]["image"]);
}

}  // namespace ods::view_film_test
