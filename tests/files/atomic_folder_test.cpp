// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/atomic_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "tests/support/poor_disk.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

namespace fs = std::filesystem;

class AtomicFolders : public ::testing::TestWithParam<bool> {
 protected:
  AtomicFolders() { poor_disk = GetParam(); }
  ~AtomicFolders() override { poor_disk = false; }

  // A site with a picture, and a file of the user's.
  void make_old() const {
    fs::create_directories(site + "/item/0");
    folder.write("site/main.js", "old");
    folder.write("site/item/0/left.jpg", "old");
    folder.write("site/item/0/notes.txt", "mine");
    fs::create_directory(site + "/css");
    folder.write("site/css/mine.css", "mine");
    fs::create_symlink("main.js", site + "/link.js");
    fs::permissions(site, fs::perms::owner_all);
  }

  static void write_new(const AtomicFolder& made) {
    write_file(made.draft() + "/main.js", "new");
    write_file(made.draft() + "/item/0/left.jpg", "new");
    write_file(made.draft() + "/item/1/left.jpg", "more");
  }

  std::string all_of(const std::string& name) const {
    std::vector<std::string> lines;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.path(name))) {
      const std::string path = entry.path().lexically_relative(folder.path(name)).native();
      if (entry.is_regular_file()) lines.push_back(path + "=" + folder.read(name + "/" + path));
    }
    std::ranges::sort(lines);
    std::string all;
    for (const std::string& line : lines) all += line + " ";
    return all;
  }

  const TemporaryFolder folder;
  const std::string site = folder.path("site");
  const std::string whole_old = "css/mine.css=mine item/0/left.jpg=old item/0/notes.txt=mine link.js=old main.js=old ";
  const std::string whole_new =
      "css/mine.css=mine item/0/left.jpg=new item/0/notes.txt=mine item/1/left.jpg=more link.js=new main.js=new ";
};

TEST_P(AtomicFolders, ReplacesAsAWholeAndKeepsTheUsersFiles) {
  make_old();
  AtomicFolder made(site + "/");
  write_new(made);
  EXPECT_EQ(all_of("site"), whole_old);
  made.commit();
  EXPECT_EQ(all_of("site"), whole_new);
  EXPECT_TRUE(fs::is_symlink(site + "/link.js"));
  EXPECT_EQ(fs::status(site).permissions(), fs::perms::owner_all);
}

TEST_P(AtomicFolders, LeavesNothingBehind) {
  make_old();
  {
    AtomicFolder made(site);
    write_new(made);
    made.commit();
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"site"});
}

TEST_P(AtomicFolders, WithoutCommitTheOldOneStays) {
  make_old();
  {
    const AtomicFolder made(site), other(folder.path("none/deeper"));
    write_new(made);
    write_new(other);
  }
  EXPECT_EQ(all_of("site"), whole_old);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"site"});
}

TEST_P(AtomicFolders, MakesWhatIsNotThere) {
  {
    AtomicFolder made(folder.path("a/b"));
    write_new(made);
    made.commit();
  }
  EXPECT_EQ(all_of("a/b"), "item/0/left.jpg=new item/1/left.jpg=more main.js=new ");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

TEST_P(AtomicFolders, FollowsALinkAndRefusesAFile) {
  make_old();
  fs::create_directory_symlink("site", folder.path("www"));
  AtomicFolder made(folder.path("www"));
  write_new(made);
  made.commit();
  EXPECT_EQ(all_of("site"), whole_new);
  EXPECT_TRUE(fs::is_symlink(folder.path("www")));
  folder.write("file", "x");
  EXPECT_THROW(AtomicFolder(folder.path("file")), Error);
}

// A shell that stands in the folder would be left in the old one.
TEST_P(AtomicFolders, TheCurrentFolderStaysTheSame) {
  make_old();
  const fs::path before = fs::current_path();
  fs::current_path(site);
  {
    AtomicFolder made(".");
    write_new(made);
    made.commit();
  }
  EXPECT_EQ(folder.read("site/main.js"), "new");
  EXPECT_TRUE(fs::equivalent(".", site));
  fs::current_path(before);
  EXPECT_EQ(all_of("site"), whole_new);
}

INSTANTIATE_TEST_SUITE_P(OnDisks, AtomicFolders, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "WithoutExchange" : "WithExchange"; });

}  // namespace
}  // namespace ods
