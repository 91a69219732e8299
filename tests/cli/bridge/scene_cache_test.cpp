// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The cache of converted scenes, and which programs convert.
#include "tests/support/bridge_fixture.h"

namespace ods::bridge_test {

TEST_F(Bridge, ConvertsAgainWhatWasCutShortOrChanged) {
  EXPECT_EQ(Ods(info()).finish(), 0);
  fs::path kept_folder;
  for (const fs::directory_entry& each : fs::directory_iterator(folder_ + "/cache/ods/scenes"))
    kept_folder = each.path();
  const std::string glb = read(kept_folder / "scene.glb"), mark = read(kept_folder / "bridge.json");
  std::string changed = glb;
  changed[changed.size() - 1] ^= 1;
  size_t expected = 1;
  for (const std::string& damaged : {glb.substr(0, glb.size() / 2), std::string(), changed}) {
    write(kept_folder / "scene.glb", damaged);
    Ods again(info());
    EXPECT_EQ(again.finish(), 0) << again.err;
    EXPECT_EQ(runs(), ++expected);
    EXPECT_EQ(read(kept_folder / "scene.glb"), glb);
  }
  write(kept_folder / "bridge.json", mark.substr(0, mark.size() / 2));
  EXPECT_EQ(Ods(info()).finish(), 0);
  EXPECT_EQ(runs(), ++expected);
  fs::remove(kept_folder / "scene.glb");
  EXPECT_EQ(Ods(info()).finish(), 0);
  EXPECT_EQ(runs(), ++expected);
}

TEST_F(Bridge, KeepsNothingWhereOthersCouldHaveBeen) {
  const std::string cache = folder_ + "/cache/ods";
  fs::create_directories(cache);
  fs::permissions(cache, fs::perms::all);
  Ods open(info());
  EXPECT_EQ(open.finish(), 4) << open.err;
  EXPECT_NE(open.err.find("other users could have put files there"), std::string::npos) << open.err;
  EXPECT_EQ(runs(), 0u);
  fs::permissions(cache, fs::perms::owner_all);
  EXPECT_EQ(Ods(info()).finish(), 0);
  if (geteuid() != 0) GTEST_SKIP() << "skipped: only root can give a folder to another user";
  ASSERT_EQ(chown(cache.c_str(), 65534, 65534), 0);
  Ods foreign(info());
  EXPECT_EQ(foreign.finish(), 4) << foreign.err;
  EXPECT_NE(foreign.err.find("it belongs to another user"), std::string::npos) << foreign.err;
}

// It is written again for each run, into a folder of that run.
TEST_F(Bridge, TheExporterIsInNoFolderThatStays) {
  answer(R"({"omnistereo_bridge": 1})", "for word in $all; do case $word in */run.py) echo \"$word\" >" + folder_ +
                                            "/exporter; cat \"$word\" >" + folder_ + "/run.py;; esac; done");
  std::string text = read(folder_ + "/blender");
  text.insert(text.find("while"), "all=$*\n");
  write(folder_ + "/blender", text);
  EXPECT_EQ(Ods(info()).finish(), 0);
  const std::string exporter = read(folder_ + "/exporter");
  ASSERT_NE(exporter.find("/run.py"), std::string::npos);
  EXPECT_FALSE(fs::exists(exporter.substr(0, exporter.find('\n')))) << exporter;
  EXPECT_EQ(read(folder_ + "/run.py"), read(source_folder() + "/blender/omnistereo/bridge/run.py"));
  for (const fs::directory_entry& each : fs::directory_iterator(folder_ + "/cache/ods")) {
    const std::string name = each.path().filename().native();  // Python's compiled modules are not scripts
    EXPECT_TRUE(name == "scenes" || name == "python") << name;
  }
}

TEST_F(Bridge, AFolderNamedLikeTheProgramIsSkipped) {
  fs::create_directories(folder_ + "/apps/blender");
  const std::string path = getenv("PATH");
  setenv("PATH", (folder_ + "/apps:" + folder_ + ":/usr/bin:/bin").c_str(), 1);
  Ods found({"info", scene_});
  EXPECT_EQ(found.finish(), 0) << found.err;
  EXPECT_EQ(runs(), 1u);
  Ods named({"info", scene_, "--bake", "64", "--blender", folder_ + "/apps/blender"});
  EXPECT_EQ(named.finish(), 3);
  setenv("PATH", path.c_str(), 1);
}

// Files that one gets may have a program of that name among them.
TEST_F(Bridge, NoProgramInTheCurrentFolderIsRun) {
  const std::string path = getenv("PATH");
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  fs::create_directories(folder_ + "/bin");
  fs::copy_file(folder_ + "/blender", folder_ + "/bin/blender");
  for (const char* folders :
       {":/nowhere", ".:/nowhere", "/nowhere:", "/nowhere::/nowhere", "bin:/nowhere", "./bin:/nowhere"}) {
    setenv("PATH", folders, 1);
    Ods ods({"info", scene_});
    ods.finish();
    EXPECT_EQ(runs(), 0u) << folders;
  }
  fs::current_path(before);
  setenv("PATH", path.c_str(), 1);
}

TEST_F(Bridge, WithoutHomeTheAccountsHomeHasTheCache) {
  const std::string home = getenv("HOME") ? getenv("HOME") : "";
  unsetenv("HOME");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(user_folder("XDG_CACHE_HOME", ".cache"), getpwuid(geteuid())->pw_dir + std::string("/.cache/ods"));
  setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_EQ(user_folder("XDG_CACHE_HOME", ".cache"), getpwuid(geteuid())->pw_dir + std::string("/.cache/ods"));
  setenv("HOME", home.c_str(), 1);
}

TEST_F(Bridge, KeepsFortyScenesAtMost) {
  umask(022);
  const fs::path cache = folder_ + "/cache/ods/scenes";
  for (int i = 0; i < 45; i++) {
    const fs::path old = cache / std::to_string(i);
    fs::create_directories(old);
    write(old / "bridge.json", "{}");
    fs::last_write_time(old / "bridge.json", fs::file_time_type::clock::now() - std::chrono::hours(100 - i));
  }
  EXPECT_EQ(Ods(info()).finish(), 0);
  EXPECT_EQ(kept(), 40u);
  EXPECT_FALSE(fs::exists(cache / "5")) << "the oldest go first";
  EXPECT_TRUE(fs::exists(cache / "6"));
}

}  // namespace ods::bridge_test
