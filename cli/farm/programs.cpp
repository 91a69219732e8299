// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/programs.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "ods/base/error.h"

bool has_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::optional<ProgramResult> run_program(const std::vector<std::string>& words, ProgramErrors errors) {
  if (words.front().find('/') == std::string::npos && !has_program(words.front())) return std::nullopt;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw ods::Error(ods::ErrorKind::kOutput, "cannot start '" + words.front() + "'");
  std::vector<std::string> copies(words);
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  if (errors == ProgramErrors::kHidden) {
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  pid_t child = 0;
  const int fault = posix_spawnp(&child, copies.front().c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  ProgramResult result;
  std::array<char, 65536> piece{};
  for (ssize_t size = 0; fault == 0 && (size = read(ends[0], piece.data(), piece.size())) > 0;) {
    result.out.append(piece.data(), static_cast<size_t>(size));
  }
  close(ends[0]);
  if (fault != 0) return std::nullopt;
  int status = 0;
  waitpid(child, &status, 0);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::string own_program() {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "ods" : path.native();
}
