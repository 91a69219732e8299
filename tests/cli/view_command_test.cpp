// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods view as its user starts it, and as others attack it: by requests byte by byte.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "tests/support/served.h"

using namespace std::chrono_literals;

namespace {

class ViewCommand : public Served {
 protected:
  void SetUp() override {
    picture = folder.path("small_360_TB.png");
    ASSERT_EQ(run("testcard -q --width 256 -o " + picture), 0) << err;
    serve({picture});
  }

  std::string picture;
};

}  // namespace

TEST_F(ViewCommand, ServesThePageAndWhatItShows) {
  const std::string page = get("");
  EXPECT_EQ(status_of(page), 200);
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'self'"), std::string::npos);
  EXPECT_EQ(page.find("unsafe-inline"), std::string::npos);
  EXPECT_EQ(page.find("Access-Control"), std::string::npos);
  const std::string view = get("view.json");
  EXPECT_EQ(status_of(view), 200);
  EXPECT_NE(view.find("\"image\":\"item/0/picture.png\""), std::string::npos);
  EXPECT_NE(get("item/0/picture.png").find("\x89PNG"), std::string::npos);
  const std::string part = ask(head("/" + secret + "/item/0/picture.png", "GET", "Range: bytes=1-3\r\n"));
  EXPECT_EQ(status_of(part), 206);
  EXPECT_TRUE(part.ends_with("\r\n\r\nPNG"));
  EXPECT_NE(get("item/0/left.jpg?width=64").find("\xff\xd8\xff"), std::string::npos);
}

TEST_F(ViewCommand, AnswersNobodyElse) {
  EXPECT_EQ(status_of(ask(head("/"))), 404);
  EXPECT_EQ(status_of(ask(head("/view.json"))), 404);
  EXPECT_EQ(status_of(ask(head(fmt::format("/{}/", std::string(32, 'a'))))), 404);
  EXPECT_EQ(status_of(ask(head(fmt::format("/{}/", secret.substr(0, 31))))), 404);
  const std::string path = fmt::format("/{}/view.json", secret);
  // A site's own name that points here.
  for (const char* host : {"evil.example", "evil.example:8360", "127.0.0.1", "127.0.0.1.evil.example", ""}) {
    EXPECT_EQ(status_of(ask(fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n", path, host))), 403)
        << host;
  }
  EXPECT_EQ(status_of(ask(fmt::format("GET {} HTTP/1.1\r\nConnection: close\r\n\r\n", path))), 403);
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1", "http://127.0.0.1:1"}) {
    EXPECT_EQ(status_of(ask(head(path, "GET", fmt::format("Origin: {}\r\n", origin)))), 403) << origin;
  }
  EXPECT_EQ(status_of(ask(head(path, "GET", fmt::format("Origin: http://127.0.0.1:{}\r\n", port)))), 200);
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "PATCH"}) {
    EXPECT_EQ(status_of(ask(head(path, method))), 405) << method;
  }
}

TEST_F(ViewCommand, OpensNoPathThatABrowserSends) {
  for (const char* path : {"../../../../etc/passwd", "item/0/../../../../etc/passwd", "item/0/%2e%2e/%2e%2e/etc/passwd",
                           "item/0//etc/passwd", "item/1/picture.png", "item/-1/picture.png", "item/0", "item/0/",
                           "item/99999999999999999999/left.jpg", "item/0/picture.jpg", "item//left.jpg", "%00", "..%2f",
                           "item/0/left.jpg%00.png", "index.html/../../view-secret"}) {
    const std::string answer = get(path);
    EXPECT_TRUE(status_of(answer) == 404 || status_of(answer) == 400) << path << ": " << answer.substr(0, 60);
    EXPECT_EQ(answer.find("root:"), std::string::npos) << path;
  }
  for (const char* query :
       {"exposure=1e9", "exposure=x", "width=0", "width=1e10", "layout=none", "projection=%3Cb%3E"}) {
    EXPECT_EQ(status_of(get(std::string("item/0/left.jpg?") + query)), 400) << query;
  }
}

TEST_F(ViewCommand, LimitsTheSizeOfRequests) {
  const std::string path = fmt::format("/{}/studio/set", secret);
  const size_t most = size_t{1} << 30;
  EXPECT_EQ(status_of(ask(head(path, "POST", fmt::format("Content-Length: {}\r\n", most)) + std::string(1 << 20, 'x'))),
            413);
  EXPECT_GE(status_of(ask(head("/" + std::string(100'000, 'a')))), 400);
  std::string many;
  for (int i = 0; i < 20'000; i++) many += fmt::format("X-{}: y\r\n", i);
  ask(head("/", "GET", many));
  ask("\r\n\r\n\r\n");
  ask("GET\r\n\r\n");
  ask(std::string(1 << 20, '\xff'));
  EXPECT_EQ(status_of(get("alive")), 200);
}

TEST_F(ViewCommand, SlowRequestsHoldNobodyUp) {
  std::vector<Connection> slow;
  for (int i = 0; i < 100; i++) {
    slow.emplace_back(port);
    slow.back().send_text("GET / HTTP/1.1\r\nHost: ");
  }
  EXPECT_EQ(status_of(get("alive")), 200);
  EXPECT_TRUE(slow.back().is_open()) << "it waited until the others were given up";
  for (const Connection& connection : slow) connection.read_all();  // they are ended
}

TEST_F(ViewCommand, ServesTwoHundredAtOnce) {
  std::vector<std::thread> threads;
  std::atomic<int> served{0};
  for (int i = 0; i < 200; i++) {
    threads.emplace_back([&] { served += status_of(get("item/0/picture.png")) == 200 ? 1 : 0; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(served, 200);
}

TEST_F(ViewCommand, ReloadsTakeNoMemory) {
  if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer keeps what is freed";
  const auto reload = [&](int) {
    for (const char* path : {"", "view.json", "item/0/left.jpg", "item/0/right.jpg"}) {
      EXPECT_EQ(status_of(get(path)), 200) << path;
    }
  };
  EXPECT_LT(leaked_by(reload), 200);
}

TEST_F(ViewCommand, EndsWithoutWaitingForAnybodyAndKeepsItsAddress) {
  std::atomic<bool> has_ended{false}, was_waited_for{false};
  const Connection slow(port);
  slow.send_text("GET / HTTP/1.1\r\n");
  std::thread visitor([&] {
    for (int i = 0; i < 300 && !has_ended; i++) {
      std::this_thread::sleep_for(100ms);
      slow.send_text("X: y\r\n");
    }
    was_waited_for = !has_ended;
  });
  server->kill(SIGINT);
  EXPECT_EQ(server->finish(), 130);
  has_ended = true;
  visitor.join();
  EXPECT_FALSE(was_waited_for);
  Ods again({"view", picture, "--no-browser", "--port", std::to_string(port)});
  again.wait_for("Ctrl-C ends it");
  EXPECT_NE(again.out.find(secret), std::string::npos);
  again.kill(SIGINT);
  again.finish();
}

class View : public Cli {};

TEST_F(View, ExportIsAFolderOfItsOwn) {
  const std::string picture = folder.path("a_360_TB.png"), light = folder.path("b.exr"), site = folder.path("site");
  ASSERT_EQ(run("testcard -q --width 128 -o " + picture), 0) << err;
  ASSERT_EQ(run("convert " + picture + " -q -o " + light), 0) << err;
  EXPECT_EQ(run("view " + picture + " " + light + " --export " + site), 0) << err;
  EXPECT_EQ(out, site + "/view.json\n");
  for (const char* file : {"index.html", "view.json", "item/0/picture.png", "item/1/left.jpg", "item/1/right.jpg"}) {
    EXPECT_TRUE(std::filesystem::exists(site + "/" + file)) << file;
  }
}

TEST_F(View, SaysWhatItCannotShow) {
  EXPECT_EQ(run("view " + folder.path("none.png")), 3);
  EXPECT_EQ(run("view " + folder.path("")), 3);
  EXPECT_NE(err.find("has no picture and no video"), std::string::npos) << err;
  EXPECT_EQ(run("view room --export " + folder.path("site")), 2);
  EXPECT_EQ(run("view"), 2);
}
