// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A claim on a file: while one process makes FILE, others that would make it too leave it alone. The claim is a small
// text file beside it, `.FILE.claim`, which says who made it and since when.
//
// What is promised:
//   - Of processes on one machine (one running kernel, containers too) only one holds a claim, and the claim of a
//     process that died, however it died, is free at once: the claim file is locked with flock().
//   - Between machines that share a disk nothing relies on flock(). The claim file is made with O_EXCL, and its holder
//     renews its time every ten seconds. A claim that was silent for a minute, by the disk's own clock, is free. Until
//     then the claim of a machine that died blocks the others. Two machines that find the same dead claim wait a second
//     to see which of them got it; a disk that takes longer than that to show one machine what another did may let both
//     have it.
//   - A process that was suspended for more than a minute may lose its claim to another machine. check() finds out.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace ods {

struct ClaimTimes {
  std::chrono::milliseconds beat{10'000};     // how often the holder renews it
  std::chrono::milliseconds silence{60'000};  // after which another machine's claim is free
  std::chrono::milliseconds settle{1'000};    // how long two machines wait that took over the same one
};

class Claim {
 public:
  // Takes over an open and locked claim file: for try_claim() alone.
  Claim(int file, std::string path, ClaimTimes times);
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  // Gives the claim back. A signal handler that calls remove_unfinished_files() does so, too.
  ~Claim();

  // Whether another machine took the claim over.
  bool is_lost() const { return lost_; }
  // Throws Error(kOutput) where that is so.
  void check() const;

 private:
  void renew_until_released(ClaimTimes times);

  int file_;
  std::string path_;  // of the claim file
  std::atomic<bool> lost_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool released_ = false;
  std::thread beat_;
};

// The claim file of a file.
std::string claim_path(const std::string& path);

// Null where another process holds the claim; `holder` then says who: "process 812 on 'render7', since 2026-11-22
// 08:45:44 UTC". Makes the folders above the file. Throws Error(kOutput): the claim file cannot be made, or something
// else has its name.
std::unique_ptr<Claim> try_claim(const std::string& path, std::string& holder, ClaimTimes times = {});

// The same, but another holder is an Error(kOutput) that names it.
std::unique_ptr<Claim> claim(const std::string& path);

}  // namespace ods
