// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/spawn.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

static void direct(posix_spawn_file_actions_t& files, int stream, StreamUse use, int pipe) {
  if (use == StreamUse::kRead) posix_spawn_file_actions_adddup2(&files, pipe, stream);
  if (use == StreamUse::kHidden) posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
}

std::optional<Spawned> spawn(const std::vector<std::string>& words, StreamUse out, StreamUse errors) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  std::vector<std::string> copies(words);
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  direct(files, STDOUT_FILENO, out, ends[1]);
  direct(files, STDERR_FILENO, errors, ends[1]);
  pid_t child = 0;
  const int fault = posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  if (fault == 0) return Spawned{child, ends[0]};
  close(ends[0]);
  return std::nullopt;
}
