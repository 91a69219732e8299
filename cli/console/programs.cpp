// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/programs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "cli/console/spawn.h"

static std::vector<std::string> program_folders() {
  const char* const path = std::getenv("PATH");
  std::istringstream all(path ? path : "");
  std::vector<std::string> folders;
  for (std::string folder; std::getline(all, folder, ':');) {
    if (folder.starts_with('/')) folders.push_back(folder);
  }
  return folders.empty() ? std::vector<std::string>{"/usr/bin", "/bin"} : folders;
}

void restrict_path() {
  setenv("PATH", fmt::format("{}", fmt::join(program_folders(), ":")).c_str(), 1);
}

bool is_program(const std::string& path) {
  struct stat found;
  return stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode) && access(path.c_str(), X_OK) == 0;
}

std::string program_path(const std::string& name) {
  for (const std::string& folder : program_folders()) {
    if (is_program(folder + "/" + name)) return folder + "/" + name;
  }
  return "";
}

bool has_program(const std::string& name) {
  return !program_path(name).empty();
}

std::optional<ProgramResult> run_program(const std::vector<std::string>& words, ProgramErrors errors) {
  if (words.front().find('/') == std::string::npos && !has_program(words.front())) return std::nullopt;
  const auto program =
      spawn(words, StreamUse::kRead, errors == ProgramErrors::kShown ? StreamUse::kShown : StreamUse::kHidden);
  if (!program) return std::nullopt;
  ProgramResult result;
  std::array<char, 65536> piece{};
  for (ssize_t size = 0; (size = read(program->from, piece.data(), piece.size())) > 0;) {
    result.out.append(piece.data(), static_cast<size_t>(size));
  }
  close(program->from);
  int status = 0;
  waitpid(program->process, &status, 0);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::string own_program() {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink(kThisProgram, error);
  return error ? "ods" : path.native();
}
