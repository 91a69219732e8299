// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods view among strangers: their links, their damaged pictures, their messages, their odd disks.
#include <nlohmann/json.hpp>

#include "ods/view/page.h"
#include "tests/outside/outside.h"

namespace ods::hostile_pages_test {

using nlohmann::json;

class HostilePages : public Outside {
 protected:
  // The files below a folder, with their bytes.
  std::map<std::string, std::string> files_in(const std::string& name) const {
    std::map<std::string, std::string> files;
    std::error_code absent;
    for (std::filesystem::recursive_directory_iterator each(folder.path(name), absent), end; each != end; ++each) {
      const std::string path = each->path().lexically_relative(folder.path(""));
      files[path] = each->is_regular_file() ? folder.read(path) : "";
    }
    return files;
  }
};

// Links of another user in the folder of temporary files, under the names that ods used for its own.
TEST_F(HostilePages, PlantedLinksAreNotWrittenThrough) {
  make_picture("a_360_TB.exr");
  folder.write("precious", "PRECIOUS\n");
  serve({folder.path("a_360_TB.exr")});
  for (int number = 0; number < 16; number++) {
    for (const char* ending : {".jpg", ".png"}) {
      std::filesystem::create_symlink(
          folder.path("precious"), folder.path(fmt::format("tmp/ods-view-{}-{}{}", server->process(), number, ending)));
    }
  }
  for (const char* name : {"thumbnail.jpg", "left.jpg", "right.jpg", "light.png"}) get(std::string("item/0/") + name);
  EXPECT_TRUE(folder.read("precious") == "PRECIOUS\n");
}

// All of a site or nothing: also over one that is there.
TEST_F(HostilePages, AnExportIsWholeOrNothing) {
  make_picture("good_360_TB.jpg"), make_picture("cut_360_TB.webp");
  const std::string whole = folder.read("cut_360_TB.webp");
  folder.write("cut_360_TB.webp", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(shell("ods view good_360_TB.jpg cut_360_TB.webp --export new -q").code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder.path("new")));
  ASSERT_EQ(shell("ods view good_360_TB.jpg --export site -q").code, 0);
  const auto before = files_in("site");
  EXPECT_GT(before.size(), 3u);
  EXPECT_EQ(shell("ods view good_360_TB.jpg cut_360_TB.webp --export site -q").code, 3);
  EXPECT_TRUE(files_in("site") == before);
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"bin", "cut_360_TB.webp", "good_360_TB.jpg", "home", "site", "tmp"}));
}

// A disk that supports neither RENAME_NOREPLACE nor hard links, like some shares.
TEST_F(HostilePages, AFinishedPictureStaysOnEveryDisk) {
  if (const std::string why = missing("cc", "command -v cc"); !why.empty()) GTEST_SKIP() << why;
  if (kSanitized) GTEST_SKIP() << "skipped: sanitizers want to be loaded first";
  folder.write("disk.c", R"(#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
int renameat2(int a, const char* b, int c, const char* d, unsigned f) {
  if (f) return errno = EINVAL, -1;
  return renameat(a, b, c, d);
}
int link(const char* a, const char* b) { return errno = EPERM, -1; }
int linkat(int a, const char* b, int c, const char* d, int f) { return errno = EPERM, -1; }
)");
  ASSERT_EQ(shell("cc -shared -fPIC -o disk.so disk.c").code, 0);
  std::filesystem::create_directory(folder.path("work"));
  std::filesystem::current_path(folder.path("work"));
  {
    Environment disk;
    disk.set("LD_PRELOAD", folder.path("disk.so"));
    serve({"spheres"});
  }
  std::filesystem::current_path("/");
  post("studio/set", R"({"width":64})");
  post("studio/render", R"({"output":"r.png","quality":"draft"})");
  json job;
  EXPECT_TRUE(soon([&] { return (job = json::parse(body_of(get("studio/job")))).value("state", "") != "running"; }));
  server->kill(SIGTERM), server->finish(), server.reset();
  size_t pictures = 0;
  for (const auto& [name, bytes] : files_in("work")) pictures += name.ends_with(".png") ? 1 : 0;
  EXPECT_EQ(pictures, 1u) << job.dump();
}

// Two pages, and a third that sends them a time far ahead of theirs.
TEST_F(HostilePages, AClockFarAheadStopsNoPage) {
  if (const std::string why = missing("node 20", "node -e 'fetch'"); !why.empty()) GTEST_SKIP() << why;
  make_picture("a_360_TB.jpg");
  serve({folder.path("a_360_TB.jpg")});
  std::filesystem::copy(source_folder() + "/web", folder.path("web"), std::filesystem::copy_options::recursive);
  for (const char* made : {"formats.js", "lookup.js", "player-style.js", "shader.js"}) {
    folder.write(std::string("web/") + made, std::string(find_page_file(made)->data));
  }
  folder.write("web/package.json", R"({"type": "module"})");
  const Ran ran = shell(fmt::format("node '{}/tests/outside/share_clock.mjs' '{}' http://127.0.0.1:{}/{}/",
                                    source_folder(), folder.path("web"), port, secret));
  EXPECT_EQ(ran.out, "4 of 4 changes reach the other page\n");
}

// A newcomer of many names does not push out those who are there.
TEST_F(HostilePages, AFloodOfNamesPushesNobodyOut) {
  make_picture("a_360_TB.jpg");
  serve({folder.path("a_360_TB.jpg")});
  for (const char* name : {"desk", "headset"}) post(std::string("share?id=") + name, R"({"fields":{}})");
  for (int i = 0; i < 30; i++) post(fmt::format("share?id=flood{}", i), "{}");
  const json heard = json::parse(body_of(get("share?id=listener&after=0")), nullptr, false);
  ASSERT_TRUE(heard.is_object() && heard.contains("messages"));
  EXPECT_TRUE(heard["messages"].contains("desk")) << heard;
  EXPECT_TRUE(heard["messages"].contains("headset")) << heard;
}

}  // namespace ods::hostile_pages_test
