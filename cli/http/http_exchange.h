// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// One request and its answer: access, the bytes read, and the bytes sent.
#pragma once
#include <atomic>
#include <mutex>
#include <string>

#include "cli/http/http_message.h"
#include "cli/http/http_server.h"
#include "cli/http/web_stream.h"

class HttpExchange {
 public:
  // port: the port on which the server listens.
  HttpExchange(const WebOptions& options, int port, WebHandler handler);

  // head: of the request, as received; bytes: received after it; the body is taken from there. Returns false if the
  // connection is to be closed.
  bool answer(WebStream& stream, std::string_view head, std::string& bytes);

  // Answers with a line that gives the reason.
  static bool refuse(WebStream& stream, int status, const std::string& why);

 private:
  using Take = std::function<bool(std::string_view piece)>;

  // The reason to refuse a request, in a line, and its status; empty if it is allowed.
  std::string refusal(const RequestHead& head, int& status) const;
  bool is_our_name(const std::string& host) const;
  bool opens(const WebStream& stream, const RequestHead& head);
  bool is_upload(const RequestHead& head) const;
  static bool read_body(WebStream& stream, std::string& bytes, uint64_t size, const Take& take);
  static int receive(WebStream& stream, std::string& bytes, uint64_t length, WebRequest& request);
  WebAnswer ask(const WebRequest& request) const;

  WebOptions options_;
  int port_;
  WebHandler handler_;
  std::atomic<bool> has_opened_{false};
  std::mutex uploads_;  // one at a time: each may be large
};
