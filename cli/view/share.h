// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The messages between the pages of one server (web/share.js): the direction in which the wearer of a headset looks,
// the point of a mouse at a desk, and the settings chosen. The server passes on the valid parts of each page's latest
// message.
//
// At most eight pages share; further ones are refused. A page waits for messages once at a time, so that waiting pages
// leave connections for the rest of the site.
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "cli/http/http_server.h"

class Share {
 public:
  // A POST with a page's message, a JSON object, or a GET that waits a few seconds for messages of other pages than
  // `id` that came `after` a number. Status 429: too many share, or wait. Thread-safe. Throws UsageError and
  // Error(kInput) for invalid requests.
  WebAnswer answer(const WebRequest& request);

  // The number of pages that share at present.
  size_t pages() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Message {
    uint64_t number = 0;
    Clock::time_point came;
    std::string text;
  };

  WebAnswer take(const std::string& id, const std::string& body);
  WebAnswer wait(const std::string& id, uint64_t after);
  void forget_the_silent() const;

  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable came_;
  mutable std::map<std::string, Message> latest_;
  std::map<std::string, uint64_t> waiting_;  // the latest GET of each page that waits
  uint64_t number_ = 0, gets_ = 0;
};
