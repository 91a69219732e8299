// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs ods render in a process of its own, reports its progress, and ends it when it is no longer wanted, or we end.
//
// It works in a folder of ours beside the picture, which gets its name when it is complete. Nothing else is left,
// whatever happens, and a file that has taken the name by then is neither replaced nor followed.
#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "cli/console/programs.h"
#include "ods/files/private_folder.h"

class RenderProcess {
 public:
  struct Status {
    std::string state = "none";  // none, running, done, failed, cancelled
    double done = 0.0;
    double left = 0.0;   // seconds, if known
    std::string text;    // its last line for people
    std::string output;  // done: the picture's name, which is another one if that exists by now
  };

  ~RenderProcess();

  // words: after "ods", without the output; output: a name in the current folder. Throws UsageError if one is running,
  // Error(kOutput) if that folder is not writable.
  void start(std::vector<std::string> words, const std::string& output);
  void cancel();
  Status status() const;

 private:
  void run(const std::string& output);
  void take_line(const std::string& line);
  void end(const std::string& output, bool is_well);

  mutable std::mutex mutex_;
  Status status_;
  std::unique_ptr<ods::PrivateFolder> folder_;
  std::unique_ptr<RunningProgram> program_;
  std::thread reader_;
};
