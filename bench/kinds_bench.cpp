// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Classification of public files as object or place, compared with their actual kind: bench/kinds_of_files.txt lists
// them and their sources. It downloads nothing: --files DIR is the folder with the files; missing ones, or other files
// of the same name, are counted and left out. -v prints all files, not only misclassified ones.
//   kinds_bench --files DIR [-v], in the folder of the repository
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "ods/base/checksum.h"
#include "ods/base/error.h"
#include "ods/files/read_file.h"
#include "ods/scene/gltf/gltf.h"
#include "ods/stage/place.h"

namespace {

using namespace ods;

struct KnownFile {
  std::string name;
  size_t bytes = 0;
  uint32_t checksum = 0;
  std::string what;
};

std::vector<KnownFile> known_files(const std::filesystem::path& list) {
  std::vector<KnownFile> files;
  std::ifstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    KnownFile file;
    words >> file.name >> file.bytes >> std::hex >> file.checksum >> file.what;
    files.push_back(file);
  }
  return files;
}

// Empty if the folder does not have this file.
std::vector<unsigned char> bytes_of(const std::filesystem::path& path, const KnownFile& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::vector<unsigned char> bytes = read_file(path.string(), size_t(1) << 30);
  const bool is_it = bytes.size() == file.bytes && crc32(std::as_bytes(std::span(bytes))) == file.checksum;
  return is_it ? bytes : std::vector<unsigned char>();
}

const char* kind_word(SceneKind kind) {
  return kind == SceneKind::kObject ? "object" : kind == SceneKind::kNothing ? "nothing" : "place";
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  bool verbose = false;
  for (int i = 1; i < argc; i++) {
    const std::string word = argv[i];
    if (word == "-v") verbose = true;
    if (word == "--files" && i + 1 < argc) folder = argv[++i];
  }
  if (folder.empty()) {
    std::puts("kinds_bench: --files DIR names the folder of the public files; skipped");
    return 0;
  }
  int right = 0, judged = 0, absent = 0;
  for (const KnownFile& file : known_files("bench/kinds_of_files.txt")) {
    const std::vector<unsigned char> bytes = bytes_of(std::filesystem::path(folder) / file.name, file);
    if (bytes.empty()) {
      absent++;
      continue;
    }
    judged++;
    std::string taken = "refused", unit;
    try {
      Scene scene = load_gltf_bytes(bytes, folder + "/" + file.name);
      const Settled settled = settle(scene);
      taken = kind_word(settled.kind);
      unit = fmt::format("{:g} m per unit{}", settled.metres_per_unit, settled.doubted ? ", doubted" : "");
    } catch (const Error& error) {
      unit = error.what();
    }
    if (taken == file.what) right++;
    if (verbose || taken != file.what) {
      fmt::print("{:<40} {:<6} taken for {:<7} {}\n", file.name, file.what, taken, unit);
      std::fflush(stdout);
    }
  }
  fmt::print("{} of {} right ({:.1f} %), {} not in {}\n", right, judged, 100.0 * right / std::max(judged, 1), absent,
             folder);
  return 0;
}
