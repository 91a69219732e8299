// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on the names of files: braces, words for eyes and faces, players' words. Any bytes give a name's words or
// none. The name that stands for several files gives those files back.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_name_reader
//   build/fuzz/fuzz_name_reader -max_len=256 build/corpus
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "ods/camera/file_names.h"
#include "ods/picture/metadata/stereo_format.h"

static void read_one(const std::string& name) {
  const std::vector<std::string> files = ods::files_of(name);
  if (files.size() != 1 && files.size() != 2 && files.size() != 6 && files.size() != 12) std::abort();
  if (ods::without_words(name).size() > name.size()) std::abort();
  ods::eye_of_words(name);
  ods::read_name(name);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<std::string> names{""};
  for (size_t i = 0; i < size; i++) {
    if (data[i] == '\n') {
      names.emplace_back();
    } else {
      names.back() += static_cast<char>(data[i]);
    }
  }
  for (const std::string& name : names) read_one(name);
  if (names.size() < 2) return 0;
  names.resize(names.size() < 6 ? 2 : 6);
  for (const std::string& name : names) {
    if (name.find_first_of("{|}%") != std::string::npos) return 0;  // it stands for several files itself
  }
  if (ods::files_of(ods::joined_name(names).value()) != names) std::abort();
  return 0;
}
