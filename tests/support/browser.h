// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Browsers without a screen, if this machine has them.
#pragma once
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ods/files/atomic_file.h"

// At the start of a test, or of a fixture's SetUp().
#define NEEDS_CHROMIUM() \
  if (ods::chromium("").empty()) GTEST_SKIP() << "skipped: there is no chromium"
#define NEEDS_IWER() \
  if (!std::getenv("ODS_IWER")) GTEST_SKIP() << "skipped: ODS_IWER does not name iwer.module.js (npm install iwer)"

namespace ods {

inline std::string find_program(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::istringstream path(std::getenv("PATH"));
    for (std::string folder; std::getline(path, folder, ':');) {
      if (access((folder + "/" + name).c_str(), X_OK) == 0) return folder + "/" + name;
    }
  }
  return "";
}

// The command line that starts it, with a software GPU. Empty if it is missing.
inline std::vector<std::string> chromium(const std::string& profile) {
  const std::string program =
      find_program({"chromium", "chromium-browser", "google-chrome", "chromium-headless-shell"});
  if (program.empty()) return {};
  return {program,
          "--headless",
          "--no-sandbox",
          "--use-angle=swiftshader",
          "--enable-unsafe-swiftshader",
          "--ignore-gpu-blocklist",
          "--no-first-run",
          "--disable-extensions",
          "--user-data-dir=" + profile};
}

inline std::vector<std::string> firefox(const std::string& profile) {
  const std::string program = find_program({"firefox-esr", "firefox"});
  if (program.empty()) return {};
  std::filesystem::create_directories(profile);
  write_file(profile + "/user.js", "user_pref(\"webgl.force-enabled\", true);\n");  // on a software GPU
  std::vector<std::string> words = {program, "--headless", "--no-remote", "--profile", profile};
  // It finds a GPU, even a software one, only through a display.
  const std::string display = std::getenv("DISPLAY") ? "" : find_program({"xvfb-run"});
  if (!display.empty()) words.insert(words.begin(), {display, "-a"});
  return words;
}

// A browser and its children, until the end of its lifetime.
class Browser {
 public:
  Browser(std::vector<std::string> words, const std::string& home, const std::string& address) {
    words.push_back(address);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    setpgid(0, 0);
    setenv("HOME", home.c_str(), 1);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  // Waits until it exits.
  void finish() { waitpid(pid_, nullptr, 0), pid_ = -1; }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser() {
    if (pid_ < 0) return;
    kill(-pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
};

// A process and all its descendants, with the CPU seconds that each has used so far.
inline std::map<pid_t, double> processes_of(pid_t root) {
  struct Process {
    pid_t parent;
    double seconds;
  };
  std::map<pid_t, Process> all;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const pid_t pid = std::atoi(entry.path().filename().c_str());
    std::ifstream stat(entry.path() / "stat");
    std::string line;
    if (pid == 0 || !std::getline(stat, line)) continue;
    std::istringstream words(line.substr(line.rfind(')') + 2));  // names may have spaces
    std::string word;
    Process process{};
    double user = 0.0, system = 0.0;
    words >> word >> process.parent;
    for (int i = 0; i < 9; i++) words >> word;
    words >> user >> system;
    process.seconds = (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
    all[pid] = process;
  }
  std::map<pid_t, double> found;
  for (const auto& [pid, process] : all) {
    pid_t above = pid;
    while (above != root && all.contains(above)) above = all[above].parent;
    if (above == root) found[pid] = process.seconds;
  }
  return found;
}

inline double cpu_seconds_of(pid_t root) {
  double sum = 0.0;
  for (const auto& [pid, seconds] : processes_of(root)) sum += seconds;
  return sum;
}

// Their memory, with shared memory counted once.
inline double megabytes_of(pid_t root) {
  double kilobytes = 0.0;
  for (const auto& [pid, seconds] : processes_of(root)) {
    std::ifstream parts("/proc/" + std::to_string(pid) + "/smaps_rollup");
    for (std::string line; std::getline(parts, line);) {
      if (line.starts_with("Pss:")) kilobytes += std::stod(line.substr(4));
    }
  }
  return kilobytes / 1024.0;
}

}  // namespace ods
