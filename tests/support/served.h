// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A running ods view, and requests to it byte by byte.
#pragma once
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/cli_runner.h"

// A connection to the server, from this machine's address 127.0.0.N. Reading ends after ten seconds.
class Connection {
 public:
  explicit Connection(int port, uint32_t from = 1) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK - 1 + from);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{10, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  Connection(Connection&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Connection(const Connection&) = delete;
  ~Connection() {
    if (socket_ >= 0) close(socket_);
  }

  bool send_text(const std::string& text) const {
    return send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }

  // Returns whether the server has neither answered nor closed.
  bool is_open() const {
    char byte;
    return recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) < 0 && errno == EAGAIN;
  }

  // Reads to the end of the first line.
  std::string read_line() const {
    std::string text;
    for (char c = 0; c != '\n' && recv(socket_, &c, 1, 0) == 1;) text += c;
    return text;
  }

  // Reads until the server closes.
  std::string read_all() const {
    std::string text;
    char piece[65536];
    for (ssize_t count = 0; (count = recv(socket_, piece, sizeof(piece), 0)) > 0;) {
      text.append(piece, static_cast<size_t>(count));
    }
    return text;
  }

 private:
  int socket_;
};

inline int status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9)) : 0;
}

inline std::string body_of(const std::string& answer) {
  const size_t end = answer.find("\r\n\r\n");
  return end == std::string::npos ? "" : answer.substr(end + 4);
}

class Served : public Cli {
 protected:
  void serve(std::vector<std::string> words, bool opens_browser = false) {
    setenv("XDG_STATE_HOME", folder.path("state").c_str(), 1);
    words.insert(words.begin(), "view");
    if (!opens_browser) words.emplace_back("--no-browser");
    server.emplace(words);
    server->wait_for("Ctrl-C ends it");
    const std::string address = server->out.substr(0, server->out.find('\n'));
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(address, parts, std::regex("http://127\\.0\\.0\\.1:([0-9]+)/([0-9a-f]{32})/")))
        << address << server->err;
    port = std::stoi(parts[1]);
    secret = parts[2];
  }

  void TearDown() override {
    if (server) server->kill(SIGTERM), server->finish();
  }

  std::string head(const std::string& path, const std::string& method = "GET", const std::string& more = "") const {
    return fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n{}\r\n", method, path, port, more);
  }

  // The answer to a request, head and body.
  std::string ask(const std::string& request, uint32_t from = 1) const {
    const Connection connection(port, from);
    connection.send_text(request);
    return connection.read_all();
  }
  std::string get(const std::string& path) const { return ask(head(fmt::format("/{}/{}", secret, path))); }
  std::string post(const std::string& path, const std::string& body) const {
    return ask(head(fmt::format("/{}/{}", secret, path), "POST", fmt::format("Content-Length: {}\r\n", body.size())) +
               body);
  }

  // Resident memory of the server, kilobytes.
  long resident() const {
    const std::string name = "VmRSS:";
    std::ifstream status(fmt::format("/proc/{}/status", server->process()));
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with(name)) return std::stol(line.substr(name.size()));
    }
    return 0;
  }

  // Kilobytes that work() leaves in memory each time: the minimum growth of several rounds in the minimum
  // resident size. A leak raises that in every round; a frame in progress, which may take 100 MB, or memory that
  // the allocator keeps for a new thread does not.
  template <class Work>
  long leaked_by(const Work& work) const {
    constexpr int rounds = 4, times = 20;
    long minimum = std::numeric_limits<long>::max(), before = 0;
    for (int round = 0; round < rounds; round++) {
      long now = std::numeric_limits<long>::max();
      for (int i = 0; i < times; i++) {
        work(i);
        now = std::min(now, resident());
      }
      EXPECT_GT(now, 0);
      if (round > 0) minimum = std::min(minimum, now - before);
      before = now;
    }
    return minimum / times;
  }

  std::optional<Ods> server;
  int port = 0;
  std::string secret;
};
