// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A claim on a file: while one process makes FILE, other processes leave it alone. The claim is a small text file
// beside it, `.FILE.claim`, which names its holder and the time.
//
// Guarantees:
//   - On one machine (one running kernel, including its containers) only one process holds a claim. The claim of a dead
//     process is free at once, because the claim file is locked with flock().
//   - Between machines that share a disk nothing relies on flock(). The claim file is created with O_EXCL, and its
//     holder updates its time every ten seconds. A claim not updated for a minute, by the disk's own clock, is free.
//     Until then the claim of a machine that died blocks the others. Two machines that find the same dead claim wait a
//     second to see which of them got it; if the disk takes longer than that to show one machine's changes to the
//     other, both may hold the claim.
//   - A process suspended for more than a minute may lose its claim to another machine. check() detects this.
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
  std::chrono::milliseconds beat{10'000};     // interval between the holder's updates
  std::chrono::milliseconds silence{60'000};  // after this, another machine's claim is free
  std::chrono::milliseconds settle{1'000};    // waiting time of two machines that took over the same claim
};

class Claim {
 public:
  // Adopts an open, locked claim file. Only try_claim() calls this.
  Claim(int file, std::string path, ClaimTimes times);
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  // Releases the claim. So does a signal handler that calls remove_unfinished_files().
  ~Claim();

  // Returns whether another machine has taken over the claim.
  bool is_lost() const { return lost_; }
  // Throws Error(kOutput) if the claim is lost.
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

// The claim file of `path`.
std::string claim_path(const std::string& path);

// Returns null if another process holds the claim; `holder` then names it: "process 812 on 'render7', since 2026-11-22
// 08:45:44 UTC". Creates the parent folders. Throws Error(kOutput): the claim file cannot be created, or another kind
// of file has its name.
std::unique_ptr<Claim> try_claim(const std::string& path, std::string& holder, ClaimTimes times = {});

// Claims as try_claim() does, but throws an Error(kOutput) that names the other holder, if it keeps the claim that
// long.
std::unique_ptr<Claim> claim(const std::string& path, std::chrono::seconds patience = std::chrono::seconds(0));

}  // namespace ods
