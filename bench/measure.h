// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Measurements for benchmarks: wall clock, CPU seconds for machines with other work, memory.
#pragma once
#include <benchmark/benchmark.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

// A folder beside the program, removed with the process; temporary folders may be in memory.
class Folder {
 public:
  Folder() { path_ = mkdtemp(path_.data()); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string path(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = std::filesystem::canonical("/proc/self/exe").replace_filename("ods-bench-XXXXXX").native();
};

struct Seconds {
  double wall = 0.0;
  double cpu = 0.0;
};

// CPU seconds of this process and its finished children.
inline double cpu_seconds() {
  const auto seconds = [](timeval t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  double sum = 0.0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage;
    getrusage(who, &usage);
    sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

inline Seconds seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), cpu_seconds() - cpu};
}

inline void say(benchmark::State& state, const Seconds& ours, const Seconds& theirs) {
  state.counters["ours_s"] = ours.wall;
  state.counters["theirs_s"] = theirs.wall;
  state.counters["ratio"] = ours.wall / theirs.wall;
  state.counters["cpu_ratio"] = ours.cpu / theirs.cpu;
}

inline void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

inline double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string word;
    double kilobytes = 0.0;
    if (words >> word >> kilobytes && word == "VmHWM:") return kilobytes / 1024.0;
  }
  return 0.0;
}
