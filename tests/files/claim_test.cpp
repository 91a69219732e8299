// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/files/claim.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <vector>

#include "ods/base/error.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr const char* kForeign =
    "omnistereo claim\nhost render7\nboot none-of-ours\nprocess 812\nsince 2026-11-22 08:45:44 UTC\n";
constexpr ClaimTimes kQuick{milliseconds(5), milliseconds(60'000), milliseconds(10)};

void make_old(const std::string& path, int seconds) {
  fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::seconds(seconds));
}

void expect_refused(const std::function<void()>& call, const std::string& why) {
  try {
    call();
    ADD_FAILURE() << "should not work: " << why;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kOutput);
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

// A process of its own that claims the file and stays; -1: it did not get the claim.
pid_t claim_elsewhere(const std::string& path) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t process = fork();
  if (process == 0) {
    std::string holder;
    const std::unique_ptr<Claim> own = try_claim(path, holder);
    const char got = own ? 'y' : 'n';
    const ssize_t written = write(ends[1], &got, 1);
    while (own && written == 1) pause();
    _exit(0);
  }
  char got = 0;
  EXPECT_EQ(read(ends[0], &got, 1), 1);
  close(ends[0]), close(ends[1]);
  return got == 'y' ? process : -1;
}

TEST(Claim, OneProcessHoldsItAndOthersAreToldWho) {
  const TemporaryFolder folder;
  const std::string path = folder.path("new/video.mp4");
  const pid_t other = claim_elsewhere(path);
  ASSERT_GT(other, 0);
  std::string holder;
  EXPECT_EQ(try_claim(path, holder), nullptr);
  EXPECT_TRUE(holder.starts_with("process " + std::to_string(other) + " on '")) << holder;
  EXPECT_TRUE(holder.ends_with(" UTC")) << holder;
  expect_refused([&] { claim(path); }, "another ods is at work on '" + path + "': process " + std::to_string(other));
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
  EXPECT_TRUE(fs::exists(claim_path(path))) << "it had no time to clean up";
  EXPECT_NE(try_claim(path, holder), nullptr) << "the dead hold nothing";
  EXPECT_FALSE(fs::exists(claim_path(path))) << "and nothing is left";
}

TEST(Claim, EveryFileHasItsOwn) {
  const TemporaryFolder folder;
  const std::string start(235, 'x');
  std::vector<std::unique_ptr<Claim>> claims;
  for (const std::string name : {"a", "b", "frame_%V.0001.exr"}) claims.push_back(claim(folder.path(name)));
  for (const std::string name : {".0001.exr", ".0002.exr"}) claims.push_back(claim(folder.path(start + name)));
  EXPECT_EQ(folder.names().size(), 5u);
  EXPECT_TRUE(fs::exists(folder.path(".a.claim")));
  claims.clear();
  EXPECT_TRUE(folder.names().empty());
}

TEST(Claim, OfManyThreadsOneGetsIt) {
  const TemporaryFolder folder;
  folder.write(".x.claim", kForeign);
  make_old(folder.path(".x.claim"), 1000);  // a dead one: all want to take it over
  for (int round = 0; round < 10; round++) {
    std::atomic<int> got{0};
    std::vector<std::unique_ptr<Claim>> claims(8);
    std::vector<std::thread> threads;
    for (auto& own : claims) {
      threads.emplace_back([&] {
        std::string holder;
        own = try_claim(folder.path("x"), holder, kQuick);
        if (own) got++;
      });
    }
    for (std::thread& each : threads) each.join();
    EXPECT_EQ(got, 1);
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(Claim, AnotherMachinesIsKeptWhileItIsRenewed) {
  const TemporaryFolder folder;
  std::string holder;
  folder.write(".x.claim", kForeign);
  make_old(folder.path(".x.claim"), 30);
  EXPECT_EQ(try_claim(folder.path("x"), holder, kQuick), nullptr);
  EXPECT_EQ(holder, "process 812 on 'render7', since 2026-11-22 08:45:44 UTC (if that machine died, wait 60 s)");
  make_old(folder.path(".x.claim"), 90);
  const std::unique_ptr<Claim> own = try_claim(folder.path("x"), holder, kQuick);
  ASSERT_NE(own, nullptr);
  EXPECT_EQ(folder.read(".x.claim").find("render7"), std::string::npos);
  own->check();
}

TEST(Claim, ItsHolderRenewsItAndLearnsOfItsLoss) {
  const TemporaryFolder folder;
  std::string holder;
  const std::unique_ptr<Claim> own = try_claim(folder.path("x"), holder, kQuick);
  ASSERT_NE(own, nullptr);
  const std::string file = folder.path(".x.claim");
  make_old(file, 1000);
  const auto old = fs::file_time_type::clock::now() - std::chrono::seconds(500);
  for (int i = 0; i < 2000 && fs::last_write_time(file) < old; i++) std::this_thread::sleep_for(milliseconds(5));
  EXPECT_GT(fs::last_write_time(file), old);
  fs::remove(file);
  folder.write(".x.claim", kForeign);
  const auto is_lost = [&] {
    try {
      own->check();
      return false;
    } catch (const Error&) {
      return true;
    }
  };
  for (int i = 0; i < 2000 && !is_lost(); i++) std::this_thread::sleep_for(milliseconds(5));
  expect_refused([&] { own->check(); }, "was taken over by another ods");
}

TEST(Claim, AnotherOnesFileIsLeftAlone) {
  const TemporaryFolder folder;
  std::string holder;
  folder.write(".x.claim", kForeign);
  make_old(folder.path(".x.claim"), 1000);
  {
    const std::unique_ptr<Claim> own = try_claim(folder.path("x"), holder, kQuick);
    fs::remove(folder.path(".x.claim"));
    folder.write(".x.claim", kForeign);
  }
  EXPECT_EQ(folder.read(".x.claim"), kForeign) << "not ours to give back";
  folder.write(".y.claim", "a diary\n");
  expect_refused([&] { claim(folder.path("y")); }, "another kind of file has that name; remove it");
  fs::create_symlink(folder.path(".y.claim"), folder.path(".z.claim"));
  expect_refused([&] { claim(folder.path("z")); }, "it is a link");
  fs::create_directory(folder.path(".w.claim"));
  expect_refused([&] { claim(folder.path("w")); }, "cannot claim");
  EXPECT_EQ(folder.read(".y.claim"), "a diary\n");
}

TEST(Claim, AnEmptyOneIsOfAProcessThatDiedBeforeItWrote) {
  const TemporaryFolder folder;
  folder.write(".x.claim", "");
  std::string holder;
  EXPECT_NE(try_claim(folder.path("x"), holder, kQuick), nullptr) << holder;
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace ods
