// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What pages of one server tell each other (web/share.js): where the wearer of a headset looks, what somebody at a desk
// points at, and what was chosen. The server hands on the parts of each page's latest message that have the right form.
//
// At most eight pages share: those that are there stay, and newcomers are refused. A page waits for messages once at a
// time, so that waiting pages leave connections for the rest of the site.
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
  // Error(kInput) for what makes no sense.
  WebAnswer answer(const WebRequest& request);

  // How many pages share at present.
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
