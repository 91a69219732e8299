// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods render in a process of its own, as people would start it: what it reports, and an end when it is no longer
// wanted.
#pragma once
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

class RenderProcess {
 public:
  struct Status {
    std::string state = "none";  // none, running, done, failed, cancelled
    double done = 0.0;
    double left = 0.0;  // seconds, as far as is known
    std::string text;   // its last line for people
  };

  ~RenderProcess();

  // words: after "ods". Throws UsageError if one is running.
  void start(const std::vector<std::string>& words);
  void cancel();
  Status status() const;

 private:
  void read_lines(int from);
  void take_line(const std::string& line);

  mutable std::mutex mutex_;
  Status status_;
  int child_ = 0;  // its process
  std::thread reader_;
};
