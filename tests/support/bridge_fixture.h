// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The bridge with programs of ours in place of Blender and Assimp.
#pragma once
#include <gtest/gtest.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "cli/console/user_folder.h"
#include "ods/picture/metadata/sidecar.h"
#include "tests/support/cli_runner.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/places.h"
#include "tests/support/processes.h"
#include "tests/support/temporary_folder.h"

namespace ods::bridge_test {

namespace fs = std::filesystem;

inline void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Bridge : public ::testing::Test {
 protected:
  Bridge() {
    setenv("XDG_CACHE_HOME", (folder_ + "/cache").c_str(), 1);
    const Binary glb = make_triangle().glb();
    write(folder_ + "/made.glb", {glb.begin(), glb.end()});
    write(scene_, "BLENDER-v304 and so on");
    answer(R"({"omnistereo_bridge": 1})");
  }

  // The commands of the script for $folder.
  void program(const std::string& text) {
    const fs::path path = folder_ + "/blender";
    write(path, "#!/bin/sh\necho x >>" + folder_ + "/runs\nwhile [ \"$1\" != -- ]; do shift; done\nfolder=$3\n" + text);
    fs::permissions(path, fs::perms::owner_all);
  }

  // The script converts well, with this in bridge.json.
  void answer(const std::string& json, const std::string& before = "") {
    write(folder_ + "/made.json", json);
    program(before + "\ncp " + folder_ + "/made.glb \"$folder/scene.glb\"\ncp " + folder_ +
            "/made.json \"$folder/bridge.json\"\necho 'ods-bridge done 1' >&2\n");
  }

  size_t runs() const { return read(folder_ + "/runs").size() / 2; }

  std::vector<std::string> info() const { return {"info", scene_, "--blender", folder_ + "/blender"}; }

  // The contents of the cache, hidden files too.
  size_t kept() const {
    std::error_code error;
    const fs::directory_iterator all(folder_ + "/cache/ods/scenes", error);
    return error ? 0 : static_cast<size_t>(std::distance(begin(all), end(all)));
  }

  // A script that never ends, as its children do not; their numbers are in "process".
  std::string hanging() const {
    const std::string list = folder_ + "/process";
    return "trap '' TERM\necho $$ >" + list + "\nsleep 1000 &\necho $! >>" + list + "\nsetsid sh -c 'echo $$ >>" +
           list + "; sleep 1000' &\nsh -c 'sleep 1000 & echo $! >>" + list + "'\nwhile [ $(wc -l <" + list +
           ") -lt 4 ]; do sleep 0.01; done\ntouch " + folder_ + "/started\nwhile true; do sleep 1; done\n";
  }

  void expect_ended() const {
    std::ifstream processes(folder_ + "/process");
    int count = 0;
    for (int process = 0; processes >> process; count++) EXPECT_TRUE(has_ended(process)) << process;
    EXPECT_GT(count, 0);
  }

  // A conversion, finished or not.
  bool has_folder() const {
    std::error_code error;
    const fs::directory_iterator all(folder_ + "/cache/ods/scenes", error);
    return std::any_of(begin(all), end(all), [](const fs::directory_entry& entry) { return entry.is_directory(); });
  }

  void expect_failure(const std::string& says, std::vector<std::string> more = {}) {
    std::vector<std::string> words = info();
    words.insert(words.end(), more.begin(), more.end());
    Ods ods(words);
    EXPECT_EQ(ods.finish(), 3) << says;
    EXPECT_NE(ods.err.find("ods: error: '" + scene_ + "': " + says), std::string::npos) << ods.err;
    EXPECT_EQ(ods.out, "");
    EXPECT_EQ(kept(), 0u) << says;
  }

  const TemporaryFolder holder_;
  const std::string folder_ = holder_.path(".");
  const std::string scene_ = folder_ + "/house.blend";
};

}  // namespace ods::bridge_test
