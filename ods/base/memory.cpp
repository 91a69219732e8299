// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>

#include "ods/base/error.h"

namespace ods {

// The number in a file. Returns nullopt if it has none ("max" means no limit).
static std::optional<size_t> read_number(const std::string& path) {
  size_t number = 0;
  std::ifstream stream(path);
  return stream >> number ? std::optional(number) : std::nullopt;
}

// The sum of the numbers that follow these words at the start of a line.
static size_t read_numbers(const std::string& path, std::initializer_list<std::string> words) {
  std::ifstream stream(path);
  size_t sum = 0;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream parts(line);
    std::string word;
    size_t number = 0;
    if (parts >> word >> number && std::find(words.begin(), words.end(), word) != words.end()) sum += number;
  }
  return sum;
}

static size_t left_of(size_t limit, size_t used) {
  return limit > used ? limit - used : 0;
}

// The bytes that one control group still allows. Page cache counts as free, because the kernel reclaims it.
static size_t left_in_group(const std::string& folder, bool version_2) {
  const auto limit = read_number(folder + (version_2 ? "/memory.max" : "/memory.limit_in_bytes"));
  const auto used = read_number(folder + (version_2 ? "/memory.current" : "/memory.usage_in_bytes"));
  if (!limit || !used) return SIZE_MAX;
  const std::string stat = folder + "/memory.stat";
  const size_t cached = version_2 ? read_numbers(stat, {"inactive_file", "active_file"})
                                  : read_numbers(stat, {"total_inactive_file", "total_active_file"});
  return left_of(*limit, left_of(*used, cached));
}

// The process's own group and all its ancestors may have limits. In a container, the process's own group may be mounted
// at the root.
static size_t left_in_groups(const std::string& root) {
  std::ifstream stream(root + "/proc/self/cgroup");
  size_t left = SIZE_MAX;
  for (std::string line; std::getline(stream, line);) {  // hierarchy:controllers:path
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && controllers != "memory") continue;
    const std::string top = root + (controllers.empty() ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory");
    for (std::string path = line.substr(second + 1);; path.resize(path.rfind('/'))) {
      left = std::min(left, left_in_group(top + path, controllers.empty()));
      if (path.find('/') == std::string::npos) break;
    }
  }
  return left;
}

static size_t left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return SIZE_MAX;
  const size_t pages = read_number("/proc/self/statm").value_or(0);
  return left_of(limit.rlim_cur, pages * static_cast<size_t>(sysconf(_SC_PAGESIZE)));
}

size_t available_memory(const std::string& root) {
  const size_t kilobytes = read_numbers(root + "/proc/meminfo", {"MemAvailable:"});
  const size_t machine = kilobytes > 0 ? kilobytes * 1024 : SIZE_MAX;
  return std::min({machine, left_in_groups(root), left_of_address_space()});
}

void check_memory(size_t bytes, const std::string& what, const std::string& advice) {
  if (bytes <= kSmallMemory) return;
  const size_t available = available_memory();
  if (bytes <= available) return;
  throw Error(ErrorKind::kMemory, fmt::format("{} needs {} of memory, and {} are free; {}", what, bytes_text(bytes),
                                              bytes_text(available), advice));
}

std::string bytes_text(size_t bytes) {
  const double size = static_cast<double>(bytes);
  return size < 1e9 ? fmt::format("{:.0f} MB", size * 1e-6) : fmt::format("{:.1f} GB", size * 1e-9);
}

}  // namespace ods
