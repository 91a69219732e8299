// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/programs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <spawn.h>
#include <sys/poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <utility>

#include "cli/console/supervisor.h"
#include "ods/base/text.h"

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kMaxOut = size_t{256} << 20;     // of stdout; more is not kept
constexpr size_t kMaxLine = size_t{64} << 10;     // of stderr
constexpr size_t kMaxLastLine = 400;              // bytes in a message
constexpr std::chrono::seconds kLastPatience{5};  // with a supervisor that should have ended

// For posix_spawn(); valid while the texts are.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> environment_with(std::vector<std::string> changes) {
  const auto name_of = [](std::string_view entry) { return entry.substr(0, entry.find('=')); };
  for (char** entry = environ; *entry; entry++) {
    const auto is_same = [&](const std::string& change) { return name_of(change) == name_of(*entry); };
    if (std::ranges::none_of(changes, is_same)) changes.emplace_back(*entry);
  }
  return changes;
}

struct Pipe {
  int from = -1, to = -1;
  bool open() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return false;
    from = ends[0], to = ends[1];
    return true;
  }
};

void close_end(int& end) {
  if (end >= 0) close(end);
  end = -1;
}

}  // namespace

RunningProgram::RunningProgram(const Program& program) : program_(program) {
  for (const char* name : {"TMPDIR", "TMP", "TEMP"}) {  // Blender looks at TMP first
    if (!program.folder.empty()) program_.environment.push_back(fmt::format("{}={}", name, program.folder));
  }
  start();
}

void RunningProgram::start() {
  Pipe life, out, errors;
  const bool has_pipes = life.open() && out.open() && (program_.shows_errors || errors.open());
  lifeline_ = life.to, out_ = out.from, errors_ = errors.from;
  if (has_pipes) {
    std::vector<std::string> words = {kSupervisor, program_.folder};
    words.insert(words.end(), program_.words.begin(), program_.words.end());
    std::vector<std::string> environment = environment_with(program_.environment);
    posix_spawnattr_t group;  // its own: the terminal's Ctrl-C is for us, and we end the program
    posix_spawnattr_init(&group);
    posix_spawnattr_setflags(&group, POSIX_SPAWN_SETPGROUP);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, life.from, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, out.to, STDOUT_FILENO);
    if (!program_.shows_errors) posix_spawn_file_actions_adddup2(&files, errors.to, STDERR_FILENO);
    pid_t child = 0;
    if (posix_spawn(&child, kThisProgram, &files, &group, pointers(words).data(), pointers(environment).data()) == 0) {
      supervisor_ = child;
    }
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&group);
  }
  close_end(life.from), close_end(out.to), close_end(errors.to);
}

RunningProgram::~RunningProgram() {
  end();
  if (supervisor_ != 0) finish();
  close_end(out_), close_end(errors_);
}

void RunningProgram::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  close_end(lifeline_);
}

void RunningProgram::take_errors(std::string_view piece, ProgramResult& result) {
  line_.append(piece);
  for (size_t end = 0; (end = line_.find('\n')) != std::string::npos; line_.erase(0, end + 1)) {
    const std::string line = line_.substr(0, end);
    if (program_.take_error) program_.take_error(line);
    const std::string words = ods::one_line(line.substr(0, kMaxLastLine));
    if (!words.empty()) result.last_line = words;
  }
  if (line_.size() > kMaxLine) line_.clear();
}

// Reads the output that arrives within that many milliseconds. Returns false at its end.
bool RunningProgram::read_streams(ProgramResult& result, int patience) {
  pollfd ends[] = {{out_, POLLIN, 0}, {errors_, POLLIN, 0}};  // poll() passes over -1
  if (poll(ends, 2, patience) <= 0) return out_ >= 0 || errors_ >= 0;
  std::array<char, 65536> piece{};
  for (int* const from : {&out_, &errors_}) {
    if (ends[from == &errors_].revents == 0) continue;
    const ssize_t size = read(*from, piece.data(), piece.size());
    if (size <= 0) {
      close_end(*from);
      continue;
    }
    const std::string_view text(piece.data(), static_cast<size_t>(size));
    if (from == &errors_) {
      take_errors(text, result);
    } else {
      result.out.append(text.substr(0, kMaxOut - result.out.size()));
    }
  }
  return out_ >= 0 || errors_ >= 0;
}

// The supervisor has the other ends of our pipes until all has ended.
ProgramResult RunningProgram::finish() {
  ProgramResult result;
  if (supervisor_ == 0) {
    result.code = 127;
    return result;
  }
  const auto after = [](float seconds) { return Clock::now() + std::chrono::milliseconds(int64_t(seconds * 1e3f)); };
  Clock::time_point end_at = program_.limit ? after(*program_.limit) : Clock::time_point::max();
  bool is_over = false;
  while (!is_over) {
    const auto now = Clock::now();
    if (now >= end_at && !result.in_time) break;
    if (now >= end_at) {
      result.in_time = false;
      end();
      end_at = now + kLastPatience;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_at - now).count();
    is_over = !read_streams(result, static_cast<int>(std::clamp<int64_t>(left, 0, 1000)));
  }
  if (!line_.empty()) take_errors("\n", result);
  if (!is_over) kill(supervisor_, SIGKILL);
  int status = 0;
  while (waitpid(supervisor_, &status, 0) < 0 && errno == EINTR) {
  }
  supervisor_ = 0;
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

std::optional<ProgramResult> run_program(const Program& program) {
  const std::string& name = program.words.front();
  Program found = program;
  if (name.find('/') == std::string::npos) found.words.front() = program_path(name);
  if (found.words.front().empty()) return std::nullopt;
  return RunningProgram(found).finish();
}

std::string program_fault(const Program& program, const std::optional<ProgramResult>& result) {
  const std::string& name = program.words.front();
  if (!result || result->code == 127) return fmt::format("{} is not installed", name);
  if (!result->in_time) return fmt::format("{} did not finish within {:g} seconds", name, *program.limit);
  if (result->code == 0) return "";
  if (!result->last_line.empty()) return fmt::format("{} failed: {}", name, result->last_line);
  return fmt::format("{} failed with exit code {}", name, result->code);
}

void start_for_desktop(const std::vector<std::string>& words) {
  const std::string path = program_path(words.front());
  if (path.empty()) return;
  std::vector<std::string> copies(words);
  const std::vector<char*> arguments = pointers(copies);
  const pid_t child = fork();
  if (child == 0) {  // a copy of one thread: system calls only
    setsid();
    if (fork() != 0) _exit(0);  // init waits for the program
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
    execv(path.c_str(), arguments.data());
    _exit(127);
  }
  if (child > 0) waitpid(child, nullptr, 0);
}

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

std::string own_program() {
  std::error_code error;
  const fs::path path = fs::read_symlink(kThisProgram, error);
  return error ? "ods" : path.native();
}
