// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Tours in Chromium, against the server of ods view: tests/web/tour-test.js drives the page and judges it. Exported
// tours, and what ods view says about wrong ones.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/view/view_site.h"
#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"

namespace ods::view_tour_test {

using Json = nlohmann::ordered_json;

constexpr auto kPatience = std::chrono::seconds(300);

class ViewTour : public Cli {
 protected:
  // Hall, kitchen and garden on a line to the east, and a plan with 10 pixels to a metre.
  void make() {
    for (const char* name : {"hall_360_TB.jpg", "kitchen_360_TB.jpg", "garden_360_TB.jpg"}) {
      ASSERT_EQ(run(std::string("testcard -q --width 256 -o ") + folder.path(name)), 0) << err;
    }
    const std::string hall = folder.path("hall_360_TB.jpg"), plan = folder.path("plan.png");
    ASSERT_EQ(run("convert -q --mono --to perspective --fov 90 --width 100 " + hall + " -o " + plan), 0) << err;
    write_tour(Json::object());
  }

  void write_tour(const Json& changes) {
    Json tour = {{"panoramas",
                  {{{"file", "hall_360_TB.jpg"},
                    {"title", "Hall"},
                    {"text", "Built in 1870."},
                    {"place", {0, 1.6, 0}},
                    {"hotspots", {{{"yaw", -20}, {"title", "Lamp"}, {"text", "Made of brass."}}}}},
                   {{"file", "kitchen_360_TB.jpg"}, {"title", "Kitchen"}, {"place", {3, 1.6, 0}}, {"heading", 90}},
                   {{"file", "garden_360_TB.jpg"}, {"title", "Garden"}, {"place", {6, 1.6, 0}}, {"heading", 200}}}},
                 {"plan", {{"image", "plan.png"}, {"metres_per_pixel", 0.1}, {"origin", {10, 20}}}}};
    tour.merge_patch(changes);
    folder.write("tour.json", tour.dump());
  }

  std::string browse(const std::string& part) {
    make();
    const Tour tour = read_tour(folder.path("tour.json"));
    std::vector<ViewItem> items;
    for (const TourStop& stop : tour.panoramas) items.push_back(open_view_item(stop.file));
    add_tour(tour, items);
    folder.write("own-tour.json", R"({"panoramas": [{"file": "hall_360_TB.jpg", "place": [0, 1.6, 0]},
                                      {"file": "kitchen_360_TB.jpg", "place": [2, 1.6, 0], "heading": 90}]})");
    folder.write("broken-tour.json", R"({"panoramas": [{"file": "hall_360_TB.jpg", "links": ["cellar"]}]})");
    ViewSite site(items, {}, tour);
    const auto answer = [&](const WebRequest& request) -> WebAnswer {
      const std::string own = folder.path(std::filesystem::path(request.path).filename());
      if (!request.path.starts_with("files/") || !std::filesystem::is_regular_file(own)) return site.answer(request);
      return {.type = std::string(media_type(own)), .file = std::filesystem::canonical(own)};
    };
    return run_harness(
        {chromium(folder.path("profile")), folder.path(""), "[{\"tour\":\"" + part + "\"}]", answer, kPatience});
  }

  std::string fault(const Json& changes) {
    write_tour(changes);
    EXPECT_EQ(run("view --export " + folder.path("site") + " " + folder.path("tour.json")), 3) << err;
    return err;
  }
};

class ViewTourBrowser : public ViewTour {
 protected:
  void SetUp() override { NEEDS_CHROMIUM(); }
};

TEST_F(ViewTourBrowser, DirectionsFollowFromThePlaces) {
  EXPECT_EQ(browse("ways"), "ok");
}

TEST_F(ViewTourBrowser, SignsCompassAndPlanLeadOnAndKeepTheDirection) {
  EXPECT_EQ(browse("desk"), "ok");
}

TEST_F(ViewTourBrowser, TheElementShowsATour) {
  EXPECT_EQ(browse("element"), "ok");
}

TEST_F(ViewTourBrowser, SignsLeadOnInTheHeadset) {
  NEEDS_IWER();
  EXPECT_EQ(browse("worn"), "ok");
}

TEST_F(ViewTour, IsExported) {
  make();
  ASSERT_EQ(run("view --export " + folder.path("site") + " " + folder.path("tour.json")), 0) << err;
  const Json view = Json::parse(folder.read("site/view.json"));
  ASSERT_EQ(view["items"].size(), 3u);
  EXPECT_EQ(view["items"][1]["title"], "Kitchen");
  EXPECT_EQ(view["items"][0]["caption"], "Built in 1870.");
  EXPECT_EQ(view["items"][0]["hotspots"][0]["title"], "Lamp");
  EXPECT_EQ(view["tour"]["plan"]["image"], "plan.png");
  EXPECT_EQ(view["tour"]["panoramas"][2]["heading"], 200);
  EXPECT_EQ(folder.read("site/plan.png"), folder.read("plan.png"));
  EXPECT_NE(folder.read("site/index.html").find("<meta property=\"og:title\" content=\"Built in 1870.\">"),
            std::string::npos);
  EXPECT_FALSE(folder.read("site/later-tour.js").empty());
}

TEST_F(ViewTour, WrongOnesAreOneLine) {
  make();
  const auto is = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  };
  is(fault({{"plan", {{"image", "no.png"}}}}), "plan.image 'no.png' does not exist");
  folder.write("broken.png", "not a picture");
  is(fault({{"plan", {{"image", "broken.png"}}}}), "broken.png");
  EXPECT_EQ(run("view " + folder.path("tour.json") + " " + folder.path("hall_360_TB.jpg")), 2);
  is(err, "a tour is shown alone");
  EXPECT_FALSE(std::filesystem::exists(folder.path("site")));
}

}  // namespace ods::view_tour_test
