// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs other programs for verification.
#pragma once
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace ods {

struct Ran {
  int code = 0;
  std::string out;  // stdout and stderr
};

// Runs a shell command.
inline Ran run_line(const std::string& line) {
  Ran ran;
  std::FILE* const pipe = popen(("{ " + line + "\n} 2>&1").c_str(), "r");
  std::array<char, 4096> piece{};
  for (size_t size = 0; (size = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;)
    ran.out.append(piece.data(), size);
  const int status = pclose(pipe);
  ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ran;
}

// The reason why a test that needs this cannot run here. Empty if it can. try_it: a shell command that succeeds if it
// can.
inline std::string missing(const std::string& what, const std::string& try_it) {
  return run_line(try_it).code == 0 ? "" : "skipped: " + what + " is not installed";
}

}  // namespace ods
