// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Runs the command like a user, for black-box tests.
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

// Sanitizers reserve the whole address space.
#ifdef ODS_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// For the processes that tests start: GCC 12's leak detection sometimes crashes with TBB's threads.
inline const int kNoSearchForLeaks = setenv("ASAN_OPTIONS", "detect_leaks=0", 0);

// A running ods, its stdout and stderr in pipes.
class Ods {
 public:
  explicit Ods(std::vector<std::string> arguments, rlim_t largest_file = RLIM_INFINITY,
               rlim_t address_space = RLIM_INFINITY) {
    arguments.insert(arguments.begin(), ods::ods_command());
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    EXPECT_EQ(pipe2(out_.data(), O_CLOEXEC), 0);
    EXPECT_EQ(pipe2(err_.data(), O_CLOEXEC), 0);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(out_[1], STDOUT_FILENO);
      dup2(err_[1], STDERR_FILENO);
      const rlimit file_limit{largest_file, largest_file}, memory_limit{address_space, address_space};
      setrlimit(RLIMIT_FSIZE, &file_limit);
      setrlimit(RLIMIT_AS, &memory_limit);
      // If the tests run as a shell's background job, SIGINT is ignored, and children inherit that; then nothing would
      // end them.
      for (const int number : {SIGHUP, SIGINT, SIGTERM}) signal(number, SIG_DFL);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(out_[1]);
    close(err_[1]);
  }
  Ods(const Ods&) = delete;
  Ods& operator=(const Ods&) = delete;

  // Reads until stderr contains the text or ends, then the stdout so far.
  void wait_for(const std::string& text) {
    while (err.find(text) == std::string::npos && read_some()) {
    }
    read_some(0);
  }

  // From now on the process waits as soon as a page of stderr is unread.
  void limit_unread() { EXPECT_GT(fcntl(err_[0], F_SETPIPE_SZ, 4096), 0); }

  void kill(int number) { ::kill(pid_, number); }

  pid_t process() const { return pid_; }

  // The present number of threads of its process.
  size_t threads() const {
    const auto tasks = std::filesystem::directory_iterator("/proc/" + std::to_string(pid_) + "/task");
    return static_cast<size_t>(std::distance(begin(tasks), end(tasks)));
  }

  // The exit code; 1000 + the signal that ended it.
  int finish() {
    while (read_some()) {
    }
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

  std::string out;
  std::string err;

 private:
  bool read_some(int patience = -1) {
    if (out_[0] < 0 && err_[0] < 0) return false;
    std::array<pollfd, 2> ends = {pollfd{out_[0], POLLIN, 0}, pollfd{err_[0], POLLIN, 0}};
    poll(ends.data(), ends.size(), patience);
    return read_end(ends[0], out_[0], out) | read_end(ends[1], err_[0], err);
  }

  static bool read_end(const pollfd& polled, int& end, std::string& text) {
    if (end < 0) return false;
    if (polled.revents == 0) return true;
    std::array<char, 1024> bytes{};
    const ssize_t size = read(end, bytes.data(), bytes.size());
    if (size > 0) {
      text.append(bytes.data(), static_cast<size_t>(size));
      return true;
    }
    close(end);
    end = -1;
    return false;
  }

  pid_t pid_ = -1;
  std::array<int, 2> out_{-1, -1};
  std::array<int, 2> err_{-1, -1};
};

class Cli : public ::testing::Test {
 protected:
  // Runs ods with these arguments until it exits.
  int run(const std::string& words, rlim_t largest_file = RLIM_INFINITY, rlim_t address_space = RLIM_INFINITY) {
    std::istringstream stream(words);
    std::vector<std::string> arguments;
    for (std::string word; stream >> word;) arguments.push_back(word);
    Ods command(arguments, largest_file, address_space);
    const int code = command.finish();
    out = command.out;
    err = command.err;
    return code;
  }

  // A command that renders a tiny picture into the folder.
  std::string render(const std::string& words = "") const {
    return "render furnace --width 16 --samples 1 -o " + folder.path("picture.png") + " " + words;
  }

  size_t files() const { return folder.names().size(); }

  // Expects a single line, which starts like every error.
  void expect_one_error() const {
    EXPECT_EQ(out, "");
    EXPECT_TRUE(err.starts_with("ods: error: ")) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_EQ(err.find_first_of("\r\x1b"), std::string::npos) << "colours and cursors are for terminals";
    EXPECT_EQ(files(), 0u);
  }

  ods::TemporaryFolder folder;
  std::string out;
  std::string err;
};
