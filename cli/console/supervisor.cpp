// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/supervisor.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "ods/files/private_folder.h"

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds kTick{10};
constexpr int kGentleTicks = 50;  // between SIGTERM and SIGKILL
constexpr int kAllTicks = 150;    // a process that the kernel cannot end, on a lost disk, is left to itself

struct Process {
  pid_t number = 0, parent = 0;
};

std::vector<Process> all_processes() {
  std::vector<Process> processes;
  std::error_code error;
  for (fs::directory_iterator at("/proc", error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().native();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream file(at->path() / "stat");
    std::string stat;
    std::getline(file, stat);
    const size_t after_name = stat.rfind(") ");  // PID (NAME) STATE PARENT ...
    if (after_name == std::string::npos || stat.size() < after_name + 4) continue;
    processes.push_back({std::stoi(name), std::atoi(stat.c_str() + after_name + 4)});
  }
  return processes;
}

// Orphans are descendants, too: the kernel makes them children of the nearest PR_SET_CHILD_SUBREAPER.
void signal_descendants(pid_t of, int number, const std::vector<Process>& processes) {
  for (const Process& process : processes) {
    if (process.parent != of) continue;
    signal_descendants(process.number, number, processes);
    kill(process.number, number);
  }
}

class Supervised {
 public:
  explicit Supervised(char** words);
  void wait();
  void end_all();
  bool is_running() const { return is_running_; }
  int code() const { return code_; }

 private:
  bool reap();

  int ended_ = -1;  // readable when a child has ended
  pid_t program_ = 0;
  bool is_running_ = true;
  int code_ = 127;
};

[[noreturn]] void become(char** words, pid_t supervisor) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != supervisor) _exit(127);  // it was too late for that
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  for (const int number : {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execvp(words[0], words);
  _exit(127);
}

Supervised::Supervised(char** words) {
  for (const int number : {SIGHUP, SIGINT, SIGTERM}) signal(number, SIG_IGN);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  sigset_t child;
  sigemptyset(&child);
  sigaddset(&child, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child, nullptr);
  ended_ = signalfd(-1, &child, SFD_CLOEXEC | SFD_NONBLOCK);
  const pid_t self = getpid();
  program_ = fork();
  if (program_ == 0) become(words, self);
  setpgid(program_, program_);  // whichever of us is first
}

// Returns whether any children are left.
bool Supervised::reap() {
  int status = 0;
  pid_t process = 0;
  while ((process = waitpid(-1, &status, WNOHANG)) > 0) {
    if (process != program_) continue;
    is_running_ = false;
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  return process == 0;
}

void Supervised::wait() {
  pollfd events[] = {{STDIN_FILENO, POLLIN, 0}, {ended_, POLLIN, 0}};
  while (program_ > 0 && reap() && is_running_ && events[0].revents == 0) {
    poll(events, 2, -1);
    signalfd_siginfo ignored;
    while (read(ended_, &ignored, sizeof(ignored)) > 0) {
    }
  }
}

void Supervised::end_all() {
  for (int tick = 0; tick < kAllTicks && reap(); tick++) {
    const int number = tick < kGentleTicks ? SIGTERM : SIGKILL;
    if (tick == 0 || number == SIGKILL) {
      const std::vector<Process> processes = all_processes();
      if (is_running_ || processes.empty()) kill(-program_, number);
      signal_descendants(getpid(), number, processes);
    }
    std::this_thread::sleep_for(kTick);
  }
}

}  // namespace

int supervise(int argc, char** argv) {
  if (argc < 3) return 127;
  Supervised program(argv + 2);
  program.wait();
  const bool is_early = program.is_running();
  program.end_all();
  if (is_early && argv[1][0] != '\0') ods::remove_folder(argv[1]);
  return program.code();
}
