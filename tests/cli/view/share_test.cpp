// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The messages that the pages of ods view exchange through the server, and those that it withholds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "tests/support/served.h"

using namespace std::chrono_literals;

namespace ods::share_test {

class ViewShared : public Served {
 protected:
  void SetUp() override {
    const std::string picture = folder.path("small_360_TB.png");
    ASSERT_EQ(run("testcard -q --width 64 -o " + picture), 0) << err;
    serve({picture});
  }
};

// A page's message goes to the other pages, until the page has been silent for ten seconds.
TEST_F(ViewShared, HandsOnWhatPagesShare) {
  EXPECT_EQ(body_of(get("alive")), R"({"pages":0})");
  EXPECT_EQ(status_of(post("share?id=a", R"({"look": {"yaw": 1}})")), 200);
  EXPECT_EQ(status_of(post("share?id=b", "{}")), 200);
  EXPECT_EQ(body_of(get("share?id=b&after=0")), R"({"number":2,"messages":{"a":{"look":{"yaw":1}}}})");
  EXPECT_EQ(body_of(get("share?id=c&after=1")), R"({"number":2,"messages":{"b":{}}})");
  EXPECT_EQ(body_of(get("alive")), R"({"pages":2})");
  std::string waited;
  std::thread waiting([&] { waited = body_of(get("share?id=b&after=2")); });
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(status_of(post("share?id=a", R"({"look":null})")), 200);
  waiting.join();
  EXPECT_EQ(waited, R"({"number":3,"messages":{"a":{}}})");
  for (int page = 0; page < 20; page++) {
    EXPECT_EQ(status_of(post(fmt::format("share?id=page{}", page), "{}")), page < 6 ? 200 : 429);
  }
  EXPECT_EQ(body_of(get("alive")), R"({"pages":8})");
  EXPECT_NE(body_of(get("share?id=c&after=0")).find(R"("a":{},"b":{})"), std::string::npos) << "who is there stays";
  std::this_thread::sleep_for(10500ms);
  EXPECT_EQ(body_of(get("alive")), R"({"pages":0})");
  EXPECT_EQ(body_of(get("share?id=b&after=0")), R"({"number":9,"messages":{}})") << "after five seconds";
}

// Messages without the form of web/share.js do not reach other pages.
TEST_F(ViewShared, HandsOnOnlyWhatHasItsForm) {
  const auto heard = [&](const std::string& message) {
    EXPECT_EQ(status_of(post("share?id=a", message)), 200) << message;
    const std::string body = body_of(get("share?id=b&after=0"));
    const size_t start = body.find("\"a\":") + 4;
    return body.substr(start, body.size() - 2 - start);
  };
  const std::string good =
      R"({"fields":{"swap":{"value":true,"clock":4294967295,"by":"a1"}},"look":{"yaw":1.5},"time":2})";
  EXPECT_EQ(heard(good), good);
  for (const char* clock : {"1e300", "-1", "0.5", "4294967296", "18446744073709551616", "null", "\"1\"", "[]", "{}"}) {
    EXPECT_EQ(heard(fmt::format(R"({{"fields":{{"swap":{{"value":true,"clock":{},"by":"a"}}}}}})", clock)),
              R"({"fields":{}})")
        << clock;
  }
  for (const char* other :
       {R"({"fields":null})", R"({"fields":[1]})", R"({"look":null})", R"({"look":{"yaw":1e300}})", R"({"point":5})",
        R"({"look":{"yaw":null}})", R"({"time":"now"})", R"({"time":1e300})", R"({"more":1})"}) {
    EXPECT_EQ(heard(other), "{}") << other;
  }
  for (const char* field : {"null", "1", "[]", R"({"clock":1,"by":"a"})", R"({"value":1,"clock":1,"by":"A!"})"}) {
    EXPECT_EQ(heard(fmt::format(R"({{"fields":{{"swap":{}}}}})", field)), R"({"fields":{}})") << field;
  }
}

// An address has 32 connections.
TEST_F(ViewShared, ThoseWhoWaitLeaveRoomForThePage) {
  post("share?id=a", "{}");
  std::vector<std::unique_ptr<Connection>> waiting;
  for (int i = 0; i < 40; i++) {
    waiting.push_back(std::make_unique<Connection>(port));
    waiting.back()->send_text(head(fmt::format("/{}/share?id=flood{}&after=9", secret, i)));
  }
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(status_of(get("view.json")), 200);
  EXPECT_EQ(status_of(get("share?id=more&after=9")), 429);
  EXPECT_EQ(status_of(get("share?id=a&after=0")), 200) << "a page that shares may wait";
}

TEST_F(ViewShared, SharesNothingThatIsNoMessage) {
  for (const char* id : {"", "A", "a b", "%22", "01234567890123456", "%C3%A4"}) {
    EXPECT_EQ(status_of(post(fmt::format("share?id={}", id), "{}")), 400) << id;
    EXPECT_EQ(status_of(get(fmt::format("share?id={}", id))), 400) << id;
  }
  const std::string deep = std::string(8000, '[') + std::string(8000, ']');
  for (const std::string& wrong :
       {std::string(), std::string("[]"), std::string("{"), std::string("{}{}"), std::string("1"),
        "{\"a\":" + deep + "}", std::string("{\"a\":1e999}"), "{\"a\":\"" + std::string(20'000, 'a') + "\"}"}) {
    EXPECT_EQ(status_of(post("share?id=a", wrong)), 400) << wrong.substr(0, 40);
  }
  EXPECT_EQ(status_of(post("share?id=a", std::string(1 << 20, 'a'))), 413);
  EXPECT_EQ(body_of(get("alive")), R"({"pages":0})");
}

}  // namespace ods::share_test
