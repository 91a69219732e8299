// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Other processes of this machine, as /proc shows them.
#pragma once
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace ods {

// PID (NAME) STATE PARENT ...; from the state on. Empty: there is no such process.
inline std::string state_of_process(const std::filesystem::path& folder) {
  std::ifstream file(folder / "stat");
  std::string stat;
  std::getline(file, stat);
  const size_t after_name = stat.rfind(") ");
  return after_name == std::string::npos ? "" : stat.substr(after_name + 2);
}

// It exists, and has not ended.
inline bool is_running(int process) {
  const std::string state = state_of_process("/proc/" + std::to_string(process));
  return !state.empty() && state[0] != 'Z';
}

// Waits up to ten seconds for its end.
inline bool has_ended(int process) {
  for (int i = 0; i < 500 && is_running(process); i++) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return !is_running(process);
}

// The processes that a process has started.
inline std::vector<int> children_of(int process) {
  std::vector<int> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const int number = std::atoi(entry.path().filename().c_str());
    const std::string state = number > 0 ? state_of_process(entry.path()) : "";
    if (state.size() > 2 && std::atoi(state.c_str() + 2) == process) children.push_back(number);
  }
  return children;
}

}  // namespace ods
