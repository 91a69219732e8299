// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/http/web_stream.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <fstream>
#include <sstream>

#include "ods/base/error.h"

namespace {

constexpr std::chrono::seconds kFarewell{1};
constexpr int kMaxFarewells = 256;  // pieces of 4 KB that are still on their way

SSL* tls(void* pointer) {
  return static_cast<SSL*>(pointer);
}

// The most that one call takes.
int piece_of(size_t size) {
  return static_cast<int>(std::min(size, size_t{INT_MAX}));
}

bool wait_for(int socket, short event, WebDeadline until) {
  using std::chrono::milliseconds;
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0) return false;
    pollfd polled{socket, event, 0};
    const int ready = poll(&polled, 1, static_cast<int>(std::min<decltype(left)>(left, INT_MAX)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

}  // namespace

WebKeys::WebKeys(const std::string& certificate, const std::string& key) {
  SSL_CTX* const context = SSL_CTX_new(TLS_server_method());
  context_ = context;
  if (context && SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION) == 1 &&
      SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) == 1 &&
      SSL_CTX_use_PrivateKey_file(context, key.c_str(), SSL_FILETYPE_PEM) == 1) {
    return;
  }
  SSL_CTX_free(context);
  throw ods::Error(
      ods::ErrorKind::kInput,
      fmt::format("'{}' is not a certificate for its key; delete it, and ods makes a new one", certificate));
}

WebKeys::~WebKeys() {
  SSL_CTX_free(static_cast<SSL_CTX*>(context_));
}

WebStream::WebStream(int socket, const WebKeys* keys) : socket_(socket) {
  fcntl(socket, F_SETFL, O_NONBLOCK);
  if (!keys) return;
  tls_ = SSL_new(static_cast<SSL_CTX*>(keys->context_));
  SSL_set_fd(tls(tls_), socket);
  SSL_set_mode(tls(tls_), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
}

WebStream::~WebStream() {
  SSL_free(tls(tls_));
}

// Tries until the step gets on: its result, above 0; else 0.
template <class Step>
int WebStream::run(const Step& step, short plain_event, WebDeadline until) {
  for (;;) {
    ERR_clear_error();
    const int result = step();
    if (result > 0) return result;
    short event = plain_event;
    if (tls_) {
      const int fault = SSL_get_error(tls(tls_), result);
      if (fault != SSL_ERROR_WANT_READ && fault != SSL_ERROR_WANT_WRITE) return 0;
      event = fault == SSL_ERROR_WANT_READ ? POLLIN : POLLOUT;
    } else if (result == 0 || (errno != EAGAIN && errno != EINTR)) {
      return 0;
    }
    if (!wait_for(socket_, event, until)) return 0;
  }
}

bool WebStream::open(WebDeadline until) {
  return !tls_ || run([&] { return SSL_accept(tls(tls_)); }, POLLIN, until) > 0;
}

size_t WebStream::read(char* to, size_t maximum, WebDeadline until) {
  const auto step = [&] {
    return tls_ ? SSL_read(tls(tls_), to, piece_of(maximum))
                : static_cast<int>(recv(socket_, to, static_cast<size_t>(piece_of(maximum)), 0));
  };
  return static_cast<size_t>(run(step, POLLIN, until));
}

bool WebStream::write(std::string_view bytes, std::chrono::seconds patience) {
  while (!bytes.empty()) {
    const auto step = [&] {
      return tls_ ? SSL_write(tls(tls_), bytes.data(), piece_of(bytes.size()))
                  : static_cast<int>(
                        send(socket_, bytes.data(), static_cast<size_t>(piece_of(bytes.size())), MSG_NOSIGNAL));
    };
    const int written = run(step, POLLOUT, std::chrono::steady_clock::now() + patience);
    if (written == 0) return false;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

bool WebStream::is_our_users() const {
  sockaddr_in here{}, there{};
  socklen_t size = sizeof(here);
  if (getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size) != 0) return false;
  if (getpeername(socket_, reinterpret_cast<sockaddr*>(&there), &size) != 0) return false;
  const auto name = [](const sockaddr_in& end) {
    return fmt::format("{:08X}:{:04X}", end.sin_addr.s_addr, ntohs(end.sin_port));
  };
  const std::string from = name(there), to = name(here);
  std::ifstream sockets("/proc/net/tcp");  // of all of this machine, seen from their own side
  for (std::string line; std::getline(sockets, line);) {
    std::istringstream words(line);
    std::string number, local, remote, state, queues, timer, tries;
    uid_t user = 0;
    if (words >> number >> local >> remote >> state >> queues >> timer >> tries >> user && local == from &&
        remote == to) {
      return user == geteuid();
    }
  }
  return false;
}

void WebStream::end() {
  if (tls_) SSL_shutdown(tls(tls_));
  shutdown(socket_, SHUT_WR);
  const WebDeadline until = std::chrono::steady_clock::now() + kFarewell;
  char piece[4096];
  for (int i = 0; i < kMaxFarewells && wait_for(socket_, POLLIN, until); i++) {
    if (recv(socket_, piece, sizeof(piece), 0) <= 0) return;
  }
}
