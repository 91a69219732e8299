// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in layered scenes, in Chromium: tests/web/objects-test.js makes the files, drives the page and judges
// its pixels.
#include <gtest/gtest.h>

#include "ods/view/page.h"
#include "tests/support/browser.h"
#include "tests/support/browser_run.h"
#include "tests/support/cli_runner.h"

namespace ods::view_objects_page_test {

class ObjectsPage : public Cli {
 protected:
  std::string browse(const std::string& part) {
    const auto page = [](const WebRequest& request) -> WebAnswer {
      const PageFile* const file = find_page_file(request.path);
      return file ? WebAnswer{.type = std::string(media_type(request.path)), .body = std::string(file->data)}
                  : nothing_there();
    };
    return run_harness({chromium(folder.path("profile")), folder.path(""), "[{\"objects\":\"" + part + "\"}]", page,
                        std::chrono::seconds(200)});
  }

  void SetUp() override { NEEDS_CHROMIUM(); }
};

TEST_F(ObjectsPage, WhatIsNearerHidesThem) {
  EXPECT_EQ(browse("hide"), "ok");
}

TEST_F(ObjectsPage, AWhiteOneIsAsBrightAsTheLight) {
  EXPECT_EQ(browse("light"), "ok");
}

TEST_F(ObjectsPage, APolishedOneShowsTheScene) {
  EXPECT_EQ(browse("mirror"), "ok");
}

TEST_F(ObjectsPage, ShadowsDarkenTheFloorAndNothingElse) {
  EXPECT_EQ(browse("shade"), "ok");
}

TEST_F(ObjectsPage, AnimationsPlayAndStillOnesCostNothing) {
  EXPECT_EQ(browse("animate"), "ok");
}

TEST_F(ObjectsPage, DragsMoveThemAndAreSaved) {
  EXPECT_EQ(browse("drag"), "ok");
}

TEST_F(ObjectsPage, KeysMoveThemAndThePanelHasTheCommand) {
  EXPECT_EQ(browse("keys"), "ok");
}

TEST_F(ObjectsPage, FaultsAreOneLineAndTheSceneStays) {
  EXPECT_EQ(browse("fail"), "ok");
}

TEST_F(ObjectsPage, TheyReturnAfterAResetOfTheGpu) {
  EXPECT_EQ(browse("lose"), "ok");
}

}  // namespace ods::view_objects_page_test
