// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/spawn.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <unistd.h>

static void direct(posix_spawn_file_actions_t& files, int stream, StreamUse use, int pipe) {
  if (use == StreamUse::kRead) posix_spawn_file_actions_adddup2(&files, pipe, stream);
  if (use == StreamUse::kHidden) posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
}

// For execv(); valid while the words are.
static std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return arguments;
}

std::optional<Spawned> spawn(const std::vector<std::string>& words, StreamUse out, StreamUse errors) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  std::vector<std::string> copies(words);
  const std::vector<char*> arguments = pointers(copies);
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

std::optional<Spawned> spawn_for_this_thread(const std::vector<std::string>& words) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  std::vector<std::string> copies(words);
  const std::vector<char*> arguments = pointers(copies);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {  // a copy of one thread: system calls only
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // it was too late for that
    setpgid(0, 0);
    dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  if (child > 0) return Spawned{child, ends[0]};
  close(ends[0]);
  return std::nullopt;
}
