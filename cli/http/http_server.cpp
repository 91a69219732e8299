// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/http/http_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/tcp.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <thread>

#include "cli/console/console.h"
#include "cli/http/http_connections.h"
#include "cli/http/http_exchange.h"

namespace {

constexpr int kBacklog = 256;       // connections that the system keeps until we take them
constexpr int kMaxRequests = 1000;  // of a connection
constexpr size_t kMaxHead = 16 << 10;
constexpr std::chrono::seconds kHead{5};  // for a request's head, from the connection or its first byte on
constexpr std::chrono::seconds kIdle{2};  // between requests of a connection

int listen_at(const WebOptions& options) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(options.port));
  inet_pton(AF_INET, options.address.c_str(), &address.sin_addr);
  if (bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
      listen(listener, kBacklog) == 0) {
    return listener;
  }
  close(listener);
  throw UsageError(fmt::format("--port {}: another program has this port", options.port));
}

int port_of(int listener) {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

}  // namespace

struct HttpServer::State {
  State(const WebOptions& options, WebHandler handler)
      : listener(listen_at(options)), port(port_of(listener)), exchange(options, port, std::move(handler)) {
    if (!options.certificate.empty()) keys = std::make_unique<WebKeys>(options.certificate, options.key);
  }
  ~State() { close(listener); }

  void take(int socket, uint32_t address);
  void serve(int socket);

  int listener;
  int port;
  std::unique_ptr<WebKeys> keys;
  HttpExchange exchange;
  HttpConnections connections;
};

// Reads until the text has the end of a head, and returns the head's size. Returns 0 if the end does not come, after
// answering the client.
static size_t read_head(WebStream& stream, std::string& text, WebDeadline until) {
  for (;;) {
    const size_t end = text.find("\r\n\r\n");
    if (end != std::string::npos && end + 4 <= kMaxHead) return end + 4;
    if (text.size() >= kMaxHead) return HttpExchange::refuse(stream, 431, "that is too long"), 0;
    char piece[4096];
    const size_t count = stream.read(piece, std::min(sizeof(piece), kMaxHead - text.size()), until);
    if (count == 0 && !text.empty()) HttpExchange::refuse(stream, 408, "the request took too long");
    if (count == 0) return 0;
    text.append(piece, count);
  }
}

// All requests of a connection.
void HttpServer::State::serve(int socket) {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  WebStream stream(socket, keys.get());
  std::string bytes;  // received, but not read yet
  WebDeadline until = now() + kHead;
  bool stays = stream.open(until);
  for (int i = 0; stays && i < kMaxRequests; i++) {
    if (i > 0 && bytes.empty()) {
      bytes.resize(1);
      if (stream.read(bytes.data(), 1, now() + kIdle) == 0) break;
    }
    if (i > 0) until = now() + kHead;
    const size_t size = read_head(stream, bytes, until);
    if (size == 0 || !connections.begin(socket)) break;
    const std::string head = bytes.substr(0, size);
    bytes.erase(0, size);
    stays = exchange.answer(stream, head, bytes);
    connections.wait(socket);
  }
  stream.end();
}

void HttpServer::State::take(int socket, uint32_t address) {
  const int yes = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
  if (!connections.add(socket, address)) {
    WebStream stream(socket, nullptr);
    HttpExchange::refuse(stream, 503, "too many connections at once: try again");
    close(socket);
    return;
  }
  const auto serve_to_its_end = [this, socket] {
    try {
      serve(socket);
    } catch (const std::exception&) {  // out of memory: other connections continue
    }
    connections.remove(socket);
    close(socket);
  };
  try {
    std::thread(serve_to_its_end).detach();
  } catch (const std::system_error&) {  // no more threads
    connections.remove(socket);
    close(socket);
  }
}

WebAnswer nothing_there() {
  return {.status = 404, .body = "there is nothing with that name\n"};
}

std::string value_of(const WebRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

HttpServer::HttpServer(const WebOptions& options, WebHandler handler)
    : state_(std::make_unique<State>(options, std::move(handler))) {
  signal(SIGPIPE, SIG_IGN);  // a browser that disconnects must not end us
}

HttpServer::~HttpServer() {
  stop();
}

int HttpServer::port() const {
  return state_->port;
}

void HttpServer::run() {
  for (;;) {
    sockaddr_in from{};
    socklen_t size = sizeof(from);
    const int socket = accept4(state_->listener, reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC);
    if (socket >= 0) {
      state_->take(socket, from.sin_addr.s_addr);
    } else if (errno == EINVAL) {  // stop() was called
      break;
    } else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until others have ended
    }
  }
  state_->connections.end();
}

void HttpServer::stop() {
  shutdown(state_->listener, SHUT_RDWR);
}
