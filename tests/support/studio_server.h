// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A studio that ods view serves, asked as its page asks.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/processes.h"
#include "tests/support/served.h"

namespace ods {

struct StudioFrame {
  nlohmann::json about;
  std::string pixels;
};

class StudioServer : public Served {
 protected:
  using Json = nlohmann::json;

  void SetUp() override {
    std::filesystem::create_directory(folder.path("tmp"));
    setenv("TMPDIR", folder.path("tmp").c_str(), 1);
    std::filesystem::current_path(folder.path(""));  // where pictures are written
    serve({scene()});
  }
  virtual const char* scene() const { return "toys"; }
  void TearDown() override {
    Served::TearDown();
    std::filesystem::current_path("/");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path("tmp")));
    unsetenv("TMPDIR");
  }

  // Waits for the end of the rendering, and returns its state.
  Json ended_job() const {
    Json job = Json::object();
    for (int i = 0; i < 600 && job.value("state", "running") == "running"; i++) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      job = Json::parse(body_of(get("studio/job")));
    }
    return job;
  }
  void wait_for_progress() const {
    for (int i = 0; i < 600; i++) {
      if (Json::parse(body_of(get("studio/job")))["done"] > 0.0) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ADD_FAILURE() << "it does not begin";
  }

  // The answer to a file that is dropped onto the page.
  std::string drop(const std::string& name, const std::string& bytes) const {
    return post("studio/drop?name=" + name, bytes);
  }
  Json shown() const { return Json::parse(body_of(get("view.json")))["studio"]; }

  Json asked(const std::string& path, const Json& body = Json::object()) const {
    const std::string answer = post("studio/" + path, body.dump());
    EXPECT_EQ(status_of(answer), 200) << path << ": " << answer;
    return Json::parse(body_of(answer), nullptr, false);
  }

  // The next frame of this revision and part that is so wide.
  StudioFrame frame_of(int revision, const std::string& part, int width) const {
    for (int number = 0, tries = 0; tries < 200; tries++) {
      const std::string answer = get(fmt::format("studio/frame?after={}", number)), body = body_of(answer);
      if (status_of(answer) == 204) continue;
      EXPECT_EQ(status_of(answer), 200) << answer.substr(0, 300);
      if (status_of(answer) != 200) break;
      size_t size = 0;
      for (size_t i = 0; i < 4; i++) size |= static_cast<size_t>(static_cast<unsigned char>(body[i])) << (8 * i);
      StudioFrame frame{Json::parse(body.substr(4, size)), body.substr(4 + size)};
      number = std::max(number, frame.about["number"].get<int>());
      if (frame.about["revision"] == revision && frame.about["part"] == part && frame.about["width"] >= width) {
        return frame;
      }
    }
    ADD_FAILURE() << "no such frame";
    return {};
  }
};

}  // namespace ods
