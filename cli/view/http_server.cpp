// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/http_server.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cli/console/console.h"

namespace {

constexpr int kThreads = 256;           // a connection holds one while it lives
constexpr int kWaiting = 256;           // connections for which there is no thread yet
constexpr int kReadSeconds = 5;         // for the next bytes of a request
constexpr int kIdleSeconds = 2;         // between requests of a connection
constexpr size_t kMostRequests = 1000;  // of a connection

// The page loads what we serve, and shows pictures that it made itself.
constexpr const char* kPolicy =
    "default-src 'self'; img-src 'self' blob: data:; media-src 'self' blob:; object-src 'none'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

// In a time that does not tell how much of it is right.
bool same_secret(const std::string& a, const std::string& b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (size_t i = 0; i < std::min(a.size(), b.size()); i++) {
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  }
  return difference == 0;
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain; charset=utf-8");
}

}  // namespace

struct HttpServer::State {
  WebOptions options;
  WebHandler handler;
  std::unique_ptr<httplib::Server> server;
  int port = 0;
  socket_t listener = INVALID_SOCKET;

  std::string scheme() const { return options.certificate.empty() ? "http" : "https"; }

  bool is_our_name(const std::string& host) const {
    return std::ranges::any_of(options.hosts,
                               [&](const std::string& name) { return host == fmt::format("{}:{}", name, port); });
  }

  // False, with the answer, for whoever is not our page's user.
  bool is_welcome(const httplib::Request& request, httplib::Response& response) const {
    const std::string host = request.get_header_value("Host");
    if (!is_our_name(host)) return refuse(response, 403, "this server does not go by that name"), false;
    const std::string origin = request.get_header_value("Origin");
    if (!origin.empty() && origin != fmt::format("{}://{}", scheme(), host)) {
      return refuse(response, 403, "this server answers no other site"), false;
    }
    const size_t slash = request.path.find('/', 1);
    if (slash == std::string::npos || !same_secret(request.path.substr(1, slash - 1), options.secret)) {
      return refuse(response, 404, "open the address that ods view printed, all of it"), false;
    }
    return true;
  }

  static std::string path_of(const httplib::Request& request) {
    return request.path.substr(request.path.find('/', 1) + 1);
  }

  WebAnswer ask(const WebRequest& request) const {
    try {
      return handler(request);
    } catch (const ods::Error& error) {
      const bool by_user = error.kind() == ods::ErrorKind::kInput || error.kind() == ods::ErrorKind::kUsage;
      return {.status = by_user ? 400 : 500, .body = std::string(error.what()) + "\n"};
    } catch (const std::exception& error) {
      return {.status = 500, .body = std::string(error.what()) + "\n"};
    }
  }

  void answer(const httplib::Request& from, httplib::Response& response, std::string body) const {
    WebRequest request;
    request.is_post = from.method == "POST";
    request.path = path_of(from);
    for (const auto& [name, value] : from.params) request.query[name] = value;
    request.body = std::move(body);
    const WebAnswer answer = ask(request);
    if (answer.status != 200) response.status = answer.status;  // else the library's: 206 for a part of a file
    response.set_header("Cache-Control", "no-store");
    answer.file.empty() ? response.set_content(answer.body, answer.type) : send_file(response, answer);
  }

  static void send_file(httplib::Response& response, const WebAnswer& answer) {
    const auto file = std::make_shared<std::ifstream>(answer.file, std::ios::binary);
    std::error_code fault;
    const auto size = std::filesystem::file_size(answer.file, fault);
    if (!*file || fault) return refuse(response, 404, "that file is gone");
    response.set_content_provider(size, answer.type, [file](size_t offset, size_t length, httplib::DataSink& sink) {
      char piece[64 << 10];
      file->clear();
      file->seekg(static_cast<std::streamoff>(offset));
      file->read(piece, static_cast<std::streamsize>(std::min(length, sizeof(piece))));
      return file->gcount() > 0 && sink.write(piece, static_cast<size_t>(file->gcount()));
    });
  }

  void set_up() {
    server->new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // The library's own choice would let several programs listen at one port, each for some of the connections.
    server->set_socket_options([this](socket_t socket) {
      listener = socket;
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    server->set_tcp_nodelay(true);
    server->set_keep_alive_max_count(kMostRequests);
    server->set_keep_alive_timeout(kIdleSeconds);
    server->set_read_timeout(kReadSeconds);
    server->set_payload_max_length(std::max(options.most_body, options.upload.empty() ? 0 : options.most_upload));
    server->set_default_headers({{"Content-Security-Policy", kPolicy},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"Cross-Origin-Opener-Policy", "same-origin"},
                                 {"Cross-Origin-Resource-Policy", "same-origin"}});
    server->set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (request.method != "GET" && request.method != "HEAD" && request.method != "POST") {
        refuse(response, 405, "this server knows GET and POST");
        return httplib::Server::HandlerResponse::Handled;
      }
      return is_welcome(request, response) ? httplib::Server::HandlerResponse::Unhandled
                                           : httplib::Server::HandlerResponse::Handled;
    });
    server->Get(
        ".*", [this](const httplib::Request& request, httplib::Response& response) { answer(request, response, ""); });
    server->Post(
        ".*", [this](const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& read) {
          const size_t most = path_of(request) == options.upload ? options.most_upload : options.most_body;
          std::string body;
          const bool whole = read([&](const char* bytes, size_t size) {
            if (body.size() + size > most) return false;
            body.append(bytes, size);
            return true;
          });
          whole ? answer(request, response, std::move(body)) : refuse(response, 413, "that is too large");
        });
  }
};

WebAnswer nothing_there() {
  return {.status = 404, .body = "there is nothing of that name\n"};
}

std::string value_of(const WebRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

HttpServer::HttpServer(const WebOptions& options, WebHandler handler) : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->handler = std::move(handler);
  if (options.certificate.empty()) {
    state_->server = std::make_unique<httplib::Server>();
  } else {
    state_->server = std::make_unique<httplib::SSLServer>(options.certificate.c_str(), options.key.c_str());
  }
  if (!state_->server->is_valid()) {
    throw ods::Error(
        ods::ErrorKind::kInput,
        fmt::format("'{}' is no certificate for its key; delete it, and a new one is made", options.certificate));
  }
  state_->set_up();
  if (options.port == 0) {
    state_->port = state_->server->bind_to_any_port(options.address);
  } else if (state_->server->bind_to_port(options.address, options.port)) {
    state_->port = options.port;
  }
  if (state_->port <= 0) throw UsageError(fmt::format("--port {}: another program has this port", options.port));
  listen(state_->listener, kWaiting);  // the library lets five wait
}

HttpServer::~HttpServer() {
  stop();
}

int HttpServer::port() const {
  return state_->port;
}

void HttpServer::run() {
  state_->server->listen_after_bind();
}

void HttpServer::stop() {
  state_->server->stop();
}
