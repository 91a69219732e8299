// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Serves a web page to its own user, over HTTP or HTTPS.
//
// Other users are refused: every address begins with a secret, the Host header must be one of our names (otherwise a
// web site could reach us by a name of its own that points to this machine), and a request with an Origin must come
// from our page. Nothing is shared with other sites, and the page can load nothing from elsewhere.
//
// Limits: a request's head has 5 seconds and 16 KB, an address 32 connections, all addresses 256. If there are too
// many, the one that has waited longest for a request is closed. A refused connection is not read any further.
//
// Why it is our own: a library would have to keep these limits. libmicrohttpd 0.9.75 (tried; 1.0 has the same options)
// has a timeout of inactivity, which a header line a second renews for ever, and refuses the connections of an address
// beyond 32: 32 of them that send a byte now and then kept the page of the same machine out for as long as they liked.
// Both need a table of connections and a deadline for each, which end sockets that the library owns. Ranges, the
// secret, hosts, origins and uploads to disk would be ours as well. cpp-httplib has no limit per address, none for the
// size of a head, and reads refused bodies.
#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

struct WebRequest {
  bool is_post = false;
  std::string path;  // after the secret: item/0/left.jpg
  std::map<std::string, std::string> query;
  std::string body;
  std::string file;  // in place of the body: an upload; removed after the answer, if the handler has not moved it
};

struct WebAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body{};
  std::string file{};  // is sent in place of the body, or the part of it that the browser asks for; a link is not
};

// Answer 404 with a line of text.
WebAnswer nothing_there();

// Returns the value of a name in the query; empty if it is absent.
std::string value_of(const WebRequest& request, const std::string& name);

// Called from several threads at once. An exception becomes an answer with a line of text: 400 for ods::Error of kind
// kInput or kUsage, otherwise 500.
using WebHandler = std::function<WebAnswer(const WebRequest& request)>;

struct WebOptions {
  std::string address = "127.0.0.1";  // to listen at; 0.0.0.0: all of this machine's
  int port = 0;                       // 0: any that is free
  std::string secret;                 // the first part of every path
  std::string opener{};  // a path that leads to the page, once, and only our own user's programs; empty: none
  std::vector<std::string> hosts{"127.0.0.1", "localhost"};  // accepted host names
  std::string certificate;                                   // PEM files, for https; empty: http
  std::string key;
  size_t max_body = size_t{64} << 10;  // bytes of a request's body
  std::string upload;                  // the path whose bodies are files, one at a time; empty: none
  std::string upload_folder;           // for uploads; other users cannot enter it
  size_t max_upload = size_t{512} << 20;
};

class HttpServer {
 public:
  // Listens, but answers nothing before run(). Throws UsageError if the port is taken, Error(kInput) for a certificate
  // that cannot be used.
  HttpServer(const WebOptions& options, WebHandler handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  // Answers until stop(), which another thread calls; then all connections have ended.
  void run();
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};
