// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods view as its user starts it, and as others attack it: by requests byte by byte.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "ods/image/image_file.h"
#include "tests/support/exr_files.h"
#include "tests/support/programs.h"
#include "tests/support/served.h"

using namespace std::chrono_literals;

namespace ods::view_command_test {

class ViewCommand : public Served {
 protected:
  void SetUp() override {
    picture = folder.path("small_360_TB.png");
    ASSERT_EQ(run("testcard -q --width 256 -o " + picture), 0) << err;
    serve({picture});
  }

  std::string picture;
};

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
  EXPECT_NE(view.find("\"thumbnail\":\"item/0/thumbnail.jpg\""), std::string::npos);
  EXPECT_NE(get("item/0/thumbnail.jpg").find("\xff\xd8\xff"), std::string::npos);
  EXPECT_EQ(status_of(get("item/0/preview.jpg")), 404) << "the picture is small";
}

// A small copy of a large JPEG is available at once.
TEST_F(ViewCommand, ServesSmallCopies) {
  const std::string large = folder.path("large_360_TB.jpg"), light = folder.path("light.exr");
  ASSERT_EQ(run("testcard -q --width 2048 -o " + large), 0) << err;
  ASSERT_EQ(run("convert " + picture + " -q -o " + light), 0) << err;
  Served::TearDown();
  setenv("TMPDIR", folder.path("none").c_str(), 1);  // small copies need no file
  serve({large, light, picture});
  unsetenv("TMPDIR");
  const std::string view = get("view.json");
  EXPECT_NE(view.find("\"preview\":\"item/0/preview.jpg\""), std::string::npos);
  EXPECT_EQ(view.find("\"preview\":\"item/1/"), std::string::npos);
  EXPECT_NE(view.find("\"light\":\"item/1/light.png\""), std::string::npos);
  const auto size_of = [this](const std::string& path) {
    folder.write("copy", body_of(get(path)));
    const ods::FileInfo info = ods::read_info(folder.path("copy"));
    return std::pair(info.width, info.height);
  };
  EXPECT_EQ(size_of("item/0/preview.jpg"), std::pair(1024, 1024));
  EXPECT_EQ(size_of("item/0/thumbnail.jpg"), std::pair(256, 128));
  EXPECT_EQ(size_of("item/1/thumbnail.jpg"), std::pair(256, 128));
  EXPECT_EQ(size_of("item/1/light.png"), std::pair(512, 256));
  EXPECT_EQ(status_of(get("item/0/light.png")), 404);
  EXPECT_EQ(size_of("item/2/thumbnail.jpg"), std::pair(256, 128));
  ASSERT_EQ(run("testcard -q --width 128 -o " + picture), 0) << err;
  EXPECT_EQ(size_of("item/2/thumbnail.jpg"), std::pair(128, 64)) << "the file was written anew";
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

TEST_F(ViewCommand, SendsThePartOfAFileThatIsAskedFor) {
  const auto size = std::filesystem::file_size(picture);
  const std::string path = "/" + secret + "/item/0/picture.png", whole = body_of(ask(head(path)));
  ASSERT_EQ(whole.size(), size);
  const auto part = [&](const std::string& range) { return ask(head(path, "GET", "Range: " + range + "\r\n")); };
  struct Case {
    std::string range;
    size_t first, count;
  };
  for (const Case& wanted :
       {Case{"bytes=0-0", 0, 1}, Case{fmt::format("bytes={}-{}", size - 1, size + 100), size - 1, 1},
        Case{"bytes=5-", 5, size - 5}, Case{"bytes=-7", size - 7, 7}, Case{"bytes=0-9223372036854775807", 0, size},
        Case{"bytes=-99999999999999999999", 0, size}, Case{"bytes=3-99999999999999999999", 3, size - 3}}) {
    const std::string answer = part(wanted.range);
    EXPECT_EQ(status_of(answer), 206) << wanted.range;
    EXPECT_EQ(body_of(answer), whole.substr(wanted.first, wanted.count)) << wanted.range;
    EXPECT_NE(answer.find(fmt::format("Content-Length: {}\r\n", wanted.count)), std::string::npos) << wanted.range;
    EXPECT_NE(answer.find(fmt::format("Content-Range: bytes {}-{}/{}\r\n", wanted.first,
                                      wanted.first + wanted.count - 1, size)),
              std::string::npos)
        << wanted.range;
  }
  for (const std::string& none : {fmt::format("bytes={}-", size), fmt::format("bytes={}-{}", size, size + 1),
                                  std::string("bytes=99999999999999999999-"), std::string("bytes=-0")}) {
    const std::string answer = part(none);
    EXPECT_EQ(status_of(answer), 416) << none;
    EXPECT_NE(answer.find(fmt::format("Content-Range: bytes */{}\r\n", size)), std::string::npos) << none;
  }
  for (const char* no_range :
       {"bytes=5-2", "bytes=x-2", "bytes=1-2,4-5", "bytes=", "bytes=-", "lines=1-2", "bytes=1-x"}) {
    const std::string answer = part(no_range);
    EXPECT_EQ(status_of(answer), 200) << no_range;
    EXPECT_EQ(body_of(answer).size(), size) << no_range;
  }
  const std::string only_head = ask(head(path, "HEAD"));
  EXPECT_EQ(status_of(only_head), 200);
  EXPECT_EQ(body_of(only_head), "");
}

// An EXR or HDR comes eye by eye; another layout divides it otherwise.
TEST_F(ViewCommand, DividesLightAsItIsAskedTo) {
  const std::string light = folder.path("light_360_TB.exr");
  ASSERT_EQ(run("convert " + picture + " -q --to-layout top-bottom -o " + light), 0) << err;
  Served::TearDown();
  serve({light});
  const std::string own = body_of(get("item/0/left.jpg")), as_found = body_of(get("item/0/left.jpg?layout=top-bottom"));
  EXPECT_EQ(own, as_found);
  EXPECT_EQ(own, body_of(get("item/0/right.jpg?layout=bottom-top")));
  for (const char* other : {"left.jpg?layout=side-by-side", "mono.jpg?layout=mono"}) {
    const std::string answer = get(std::string("item/0/") + other);
    EXPECT_EQ(status_of(answer), 200) << other;
    EXPECT_NE(body_of(answer), own) << other;
  }
}

// The verdict of ods comfort. By matching the eyes: the card has things from 0.4 m on. By depth: the right eye alone
// sees a wall 0.3 m away.
TEST_F(ViewCommand, JudgesThePicturesComfort) {
  const std::string near = folder.path("near_360_TB.png"), one_eye = folder.path("one_360.png");
  for (const auto& [eye, depth] : {std::pair{"left", 20.0f}, {"right", 0.3f}}) {
    ods::ExrForm form;
    form.width = 64, form.height = 32;
    form.channels = {"B", "G", "R", "Z"};
    form.types = {Imf::FLOAT, Imf::FLOAT, Imf::FLOAT, Imf::FLOAT};
    write_exr_of(folder.path(std::string("pair_") + eye + ".exr"), form, std::vector<float>(64 * 32 * 4, depth));
  }
  ASSERT_EQ(run("testcard -q --width 1024 -o " + near), 0) << err;
  ASSERT_EQ(run("convert " + near + " -q --mono -o " + one_eye), 0) << err;
  Served::TearDown();
  serve({near, one_eye, folder.path("pair_%V.exr")});
  const std::string said = get("item/0/comfort.json");
  EXPECT_EQ(status_of(said), 200) << said;
  EXPECT_NE(said.find("\"level\":"), std::string::npos) << said;
  EXPECT_NE(said.find("\"projection\":"), std::string::npos) << "the camera of the heat's pictures";
  const std::string left = get("item/0/comfort-left.jpg"), right = get("item/0/comfort-right.jpg");
  EXPECT_NE(body_of(left).find("\xff\xd8\xff"), std::string::npos);
  EXPECT_NE(body_of(left), body_of(right));
  const std::string none = get("item/1/comfort.json");
  EXPECT_EQ(status_of(none), 400);
  EXPECT_NE(none.find("has one eye and no depth"), std::string::npos) << none;
  const std::string pair = get("item/2/comfort.json");
  EXPECT_NE(pair.find("\"level\":\"error\""), std::string::npos) << pair;
  EXPECT_NE(pair.find("\"text\":\"Most: "), std::string::npos) << pair;
}

// A path that was a link when ods view started means the link's target.
TEST_F(ViewCommand, ServesNoFileThatBecomesALink) {
  namespace fs = std::filesystem;
  const std::string private_file = folder.path("private.png"), link = folder.path("link_360_TB.png"),
                    light = folder.path("light.exr");
  fs::copy(picture, private_file);
  fs::create_symlink(picture, link);
  ASSERT_EQ(run("convert " + picture + " -q -o " + light), 0) << err;
  Served::TearDown();
  serve({picture, link, light});
  for (const char* path : {"item/0/picture.png", "item/1/picture.png", "item/2/left.jpg"}) {
    EXPECT_EQ(status_of(get(path)), 200) << path;
  }
  for (const std::string& path : {picture, light}) {
    fs::remove(path);
    fs::create_symlink(private_file, path);
  }
  for (const char* path : {"item/0/picture.png", "item/0/left.jpg", "item/1/picture.png", "item/2/left.jpg"}) {
    EXPECT_EQ(status_of(get(path)), 404) << path;
  }
  fs::remove(picture);
  fs::copy(private_file, picture);
  EXPECT_EQ(status_of(get("item/0/picture.png")), 200) << "a file that was made again";
}

TEST_F(ViewCommand, LimitsTheSizeOfRequests) {
  EXPECT_EQ(status_of(ask("GET /" + std::string(1 << 20, 'a'))), 431) << "an endless first line";
  std::string many;
  for (int i = 0; i < 20'000; i++) many += fmt::format("X-{}: y\r\n", i);
  EXPECT_EQ(status_of(ask(head("/", "GET", many))), 431) << "fields, each of them short";
  EXPECT_EQ(status_of(ask(head("/" + std::string(16'000, 'a')))), 404) << "a head of 16 KB is none too long";
  for (const char* wrong : {"\r\n\r\n", "GET\r\n\r\n", "GET / HTTP/2\r\n\r\n", "GET  / HTTP/1.1\r\n\r\n",
                            "GET / HTTP/1.1\r\nA b: c\r\n\r\n", "GET / HTTP/1.1\r\n: c\r\n\r\n",
                            "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", "G\xff / HTTP/1.1\r\n\r\n",
                            "GET / HTTP/1.1\nHost: a\r\n\r\n", "GET a HTTP/1.1\r\n\r\n"}) {
    EXPECT_EQ(status_of(ask(wrong)), 400) << wrong;
  }
  ask(std::string(1 << 20, '\xff'));
  EXPECT_EQ(status_of(get("alive")), 200);
}

// The answer comes before the body, which is then not read.
TEST_F(ViewCommand, ReadsNothingFromWhomItRefuses) {
  struct Case {
    std::string path, fields;
    int status;
  };
  const std::string here = fmt::format("/{}/studio/set", secret);
  for (const Case& wanted :
       {Case{"/studio/set", "Content-Length: 1000\r\n", 404}, Case{here, "Content-Length: 1000000000\r\n", 413},
        Case{here, "Content-Length: 99999999999999999999\r\n", 411}, Case{here, "", 411},
        Case{here, "Transfer-Encoding: chunked\r\n", 411},
        Case{here, "Content-Length: 1000\r\nOrigin: http://evil.example\r\n", 403}}) {
    const Connection connection(port);
    std::string request = head(wanted.path, "POST", wanted.fields);
    request.erase(request.find("Connection: close\r\n"), 19);
    connection.send_text(request);
    const std::string answer = connection.read_all();
    EXPECT_EQ(status_of(answer), wanted.status) << wanted.path << wanted.fields;
    EXPECT_NE(answer.find("Connection: close\r\n"), std::string::npos) << answer;
  }
}

TEST_F(ViewCommand, SlowRequestsHoldNobodyUp) {
  std::vector<Connection> slow;
  for (int i = 0; i < 300; i++) {
    slow.emplace_back(port);
    slow.back().send_text("GET / HTTP/1.1\r\nHost: ");
  }
  EXPECT_EQ(status_of(get("alive")), 200);
  EXPECT_TRUE(slow.back().is_open()) << "it waited until the others were given up";
  EXPECT_LE(std::ranges::count_if(slow, &Connection::is_open), 32);
  EXPECT_EQ(status_of(ask(head(fmt::format("/{}/alive", secret)), 2)), 200);
  EXPECT_EQ(status_of(slow.back().read_all()), 408);  // they are ended
}

// A head of which a line comes now and then.
TEST_F(ViewCommand, EndsAHeadThatGoesOnAndOn) {
  const Connection slow(port);
  slow.send_text("GET / HTTP/1.1\r\n");
  bool is_open = true;
  for (int i = 0; i < 300 && is_open; i++) {
    std::this_thread::sleep_for(100ms);
    is_open = slow.send_text("X: y\r\n") && slow.is_open();
  }
  EXPECT_FALSE(is_open);
  EXPECT_EQ(status_of(slow.read_all()), 408);
}

// Requests that are being answered are not ended for new ones.
TEST_F(ViewCommand, AnAddressHasThirtyTwoConnections) {
  std::vector<Connection> busy;
  const std::string request =
      head(fmt::format("/{}/studio/set", secret), "POST", "Content-Length: 2\r\nExpect: 100-continue\r\n");
  for (int i = 0; i < 32; i++) {
    busy.emplace_back(port);
    busy.back().send_text(request);
    EXPECT_TRUE(busy.back().read_line().starts_with("HTTP/1.1 100 "));
  }
  EXPECT_EQ(status_of(get("alive")), 503);
  EXPECT_EQ(status_of(ask(head(fmt::format("/{}/alive", secret)), 2)), 200);
  for (const Connection& each : busy) each.send_text("{}");
  for (const Connection& each : busy) EXPECT_NE(each.read_all().find("HTTP/1.1 404 "), std::string::npos);
  EXPECT_EQ(status_of(get("alive")), 200);
}

TEST_F(ViewCommand, AnswersRequestAfterRequest) {
  const Connection connection(port);
  const std::string last = head(fmt::format("/{}/alive", secret));
  std::string next = last;
  next.erase(next.find("Connection: close\r\n"), 19);
  connection.send_text(next + next + next + last);
  const std::string answers = connection.read_all();
  size_t count = 0;
  for (size_t at = 0; (at = answers.find("HTTP/1.1 200 OK", at)) != std::string::npos; at++) count++;
  EXPECT_EQ(count, 4u);
}

TEST_F(ViewCommand, ServesTwoHundredAtOnce) {
  std::vector<std::thread> threads;
  std::atomic<int> served{0};
  const std::string request = head(fmt::format("/{}/item/0/picture.png", secret));
  for (uint32_t i = 0; i < 200; i++) {
    threads.emplace_back([&, i] { served += status_of(ask(request, 1 + i % 8)) == 200 ? 1 : 0; });
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
  // Meanwhile a connection of another test may have the port.
  bool is_there = false;
  for (int i = 0; i < 300 && !is_there; i++) {
    Ods again({"view", picture, "--no-browser", "--port", std::to_string(port)});
    again.wait_for("Ctrl-C ends it");
    again.kill(SIGINT);
    const int code = again.finish();
    ASSERT_TRUE(code == 130 || again.err.find(std::to_string(port)) != std::string::npos) << code << again.err;
    is_there = again.out.find(secret) != std::string::npos;
    EXPECT_TRUE(is_there || again.out.empty()) << again.out;
    if (!is_there) std::this_thread::sleep_for(100ms);
  }
  EXPECT_TRUE(is_there);
}

class ViewOptions : public Served {};

// On a network that other users can listen to, an old address is useless.
TEST_F(ViewOptions, TheNetworksAddressIsNewEachTime) {
  const std::string picture = folder.path("small_360_TB.png");
  ASSERT_EQ(run("testcard -q --width 256 -o " + picture), 0) << err;
  setenv("XDG_STATE_HOME", folder.path("state").c_str(), 1);
  std::vector<std::string> secrets;
  for (const bool is_kept : {false, false, true, true}) {
    std::vector<std::string> words = {"view", picture, "--lan", "--no-browser"};
    if (is_kept) words.emplace_back("--keep-secret");
    Ods command(words);
    command.wait_for("Ctrl-C ends it");
    if (command.err.find("not on a network") != std::string::npos) GTEST_SKIP() << "skipped: there is no network";
    std::smatch parts;
    EXPECT_TRUE(std::regex_match(command.out, parts, std::regex("https://[0-9.]+:([0-9]+)/([0-9a-f]{32})/\n")))
        << command.out << command.err;
    secrets.push_back(parts[2]);
    if (ods::missing("openssl", "command -v openssl").empty()) {
      const std::string answer =
          ods::run_line(fmt::format("printf 'GET /{}/item/0/picture.png HTTP/1.1\\r\\nHost: "
                                    "127.0.0.1:{}\\r\\nConnection: close\\r\\n\\r\\n' |"
                                    "openssl s_client -quiet -connect 127.0.0.1:{} 2>/dev/null",
                                    secrets.back(), std::string(parts[1]), std::string(parts[1])))
              .out;
      EXPECT_EQ(status_of(answer), 200) << answer.substr(0, 300);
      EXPECT_EQ(body_of(answer), folder.read("small_360_TB.png"));
    }
    command.kill(SIGINT);
    EXPECT_EQ(command.finish(), 130);
  }
  EXPECT_NE(secrets[0], secrets[1]);
  EXPECT_NE(secrets[1], secrets[2]);
  EXPECT_EQ(secrets[2], secrets[3]);
  EXPECT_EQ(run("view " + picture + " --keep-secret"), 2);
}

// Everybody on this machine can read what programs are started with.
TEST_F(ViewOptions, TheBrowserIsStartedWithAnAddressThatWorksOnce) {
  const std::string picture = folder.path("small_360_TB.png"), said = folder.path("said"), path = std::getenv("PATH");
  ASSERT_EQ(run("testcard -q --width 256 -o " + picture), 0) << err;
  folder.write("xdg-open",
               "#!/bin/sh\nprintf %s \"$1\" > '" + said + ".part'; mv '" + said + ".part' '" + said + "'\n");
  std::filesystem::permissions(folder.path("xdg-open"), std::filesystem::perms::owner_all);
  setenv("PATH", (folder.path("") + ":" + path).c_str(), 1);
  setenv("DISPLAY", ":0", 1);
  serve({picture}, true);
  for (int i = 0; i < 100 && !std::filesystem::exists(said); i++) std::this_thread::sleep_for(100ms);
  setenv("PATH", path.c_str(), 1);
  unsetenv("DISPLAY");
  const std::string address = folder.read("said");
  EXPECT_EQ(address.find(secret), std::string::npos);
  std::smatch parts;
  ASSERT_TRUE(std::regex_match(address, parts, std::regex("http://127.0.0.1:[0-9]+(/[0-9a-f]{32})"))) << address;
  const std::string opener = head(parts[1]);
  if (geteuid() == 0) {
    const pid_t other = fork();  // another user, who is faster
    if (other == 0) _exit(setuid(65534) == 0 && status_of(ask(opener)) == 404 ? 0 : 1);
    int status = 0;
    waitpid(other, &status, 0);
    EXPECT_EQ(status, 0);
  }
  const std::string answer = ask(opener);
  EXPECT_EQ(status_of(answer), 303);
  EXPECT_NE(answer.find("Location: /" + secret + "/\r\n"), std::string::npos) << answer;
  EXPECT_EQ(status_of(ask(opener)), 404);
}

TEST_F(ViewOptions, ExportIsAFolderOfItsOwn) {
  const std::string picture = folder.path("a_360_TB.png"), light = folder.path("b.exr"), site = folder.path("site");
  ASSERT_EQ(run("testcard -q --width 128 -o " + picture), 0) << err;
  ASSERT_EQ(run("convert " + picture + " -q -o " + light), 0) << err;
  EXPECT_EQ(run("view " + picture + " " + light + " --export " + site), 0) << err;
  EXPECT_EQ(out, site + "/view.json\n");
  for (const char* file :
       {"index.html", "main.js", "stereo-360.js", "example.html", "view.json", "item/0/picture.png",
        "item/0/picture.png.js", "item/0/poster.jpg", "item/0/thumbnail.jpg", "item/1/left.jpg", "item/1/right.jpg",
        "item/1/right.jpg.js", "item/1/poster.jpg", "item/1/light.png", "item/1/light.png.js"}) {
    EXPECT_TRUE(std::filesystem::exists(site + "/" + file)) << file;
  }
}

// A page for those who have never heard of ods.
TEST_F(ViewOptions, AnExportHasATitleAndALanguage) {
  const std::string picture = folder.path("a_360_TB.png"), site = folder.path("site");
  ASSERT_EQ(run("testcard -q --width 128 -o " + picture), 0) << err;
  ASSERT_EQ(run("view -q " + picture + " --export " + site + " --title A\"<b>\"&B --lang de"), 0) << err;
  const std::string page = folder.read("site/index.html");
  for (const char* part : {"<html lang=\"de\">", "<title>A&quot;&lt;b&gt;&quot;&amp;B</title>",
                           "<meta property=\"og:image\" content=\"item/0/poster.jpg\">",
                           "<noscript><a href=\"item/0/picture.png\"><img src=\"item/0/poster.jpg\""}) {
    EXPECT_NE(page.find(part), std::string::npos) << part << page;
  }
  EXPECT_NE(folder.read("site/view.json").find(R"("A\"<b>\"&B")"), std::string::npos) << "visitors see a file's name";
  ASSERT_EQ(run("view -q " + picture + " --export " + site), 0) << err;
  EXPECT_NE(folder.read("site/index.html").find("<title>a_360_TB</title>"), std::string::npos);
  EXPECT_EQ(run("view -q " + picture + " --export " + site + " --lang tlh"), 2);
  EXPECT_NE(err.find("--lang must be one of de, en, fr"), std::string::npos) << err;
  EXPECT_EQ(run("view -q " + picture + " --title T"), 2);
}

// A picture that opens, and turns out to be damaged when it is decoded.
TEST_F(ViewOptions, AFailedExportChangesNothing) {
  const std::string picture = folder.path("a_360_TB.png"), broken = folder.path("b_360_TB.exr"),
                    site = folder.path("site");
  ASSERT_EQ(run("testcard -q --width 128 -o " + picture), 0) << err;
  ASSERT_EQ(run("convert " + picture + " -q -o " + broken), 0) << err;
  std::filesystem::resize_file(broken, std::filesystem::file_size(broken) * 3 / 4);
  const std::vector<std::string> before = folder.names();
  EXPECT_EQ(run("view -q " + picture + " " + broken + " --export " + site), 3);
  EXPECT_NE(err.find(broken), std::string::npos) << err;
  EXPECT_EQ(folder.names(), before);
  ASSERT_EQ(run("view -q " + picture + " --export " + site), 0) << err;
  const std::string main = folder.read("site/main.js"), view = folder.read("site/view.json");
  EXPECT_EQ(run("view -q " + picture + " " + broken + " --export " + site), 3);
  EXPECT_EQ(folder.read("site/main.js"), main);
  EXPECT_EQ(folder.read("site/view.json"), view);
  EXPECT_FALSE(std::filesystem::exists(site + "/item/1"));
}

TEST_F(ViewOptions, SaysWhatItCannotShow) {
  EXPECT_EQ(run("view " + folder.path("none.png")), 3);
  EXPECT_EQ(run("view " + folder.path("")), 3);
  EXPECT_NE(err.find("has no picture and no video"), std::string::npos) << err;
  EXPECT_EQ(run("view room --export " + folder.path("site")), 2);
  EXPECT_EQ(run("view"), 2);
}

}  // namespace ods::view_command_test
