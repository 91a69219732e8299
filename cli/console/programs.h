// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Other programs. Each runs under a supervisor (cli/console/supervisor.h): it ends within its time limit or when we
// end, whatever ends us, and so do all programs that it has started.
#pragma once
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

// The path of this program, for Program::words.
inline constexpr const char* kThisProgram = "/proc/self/exe";

struct Program {
  std::vector<std::string> words;          // its path, or its name as PATH finds it, and its arguments
  std::optional<float> limit{};            // seconds; then it is ended
  std::vector<std::string> environment{};  // NAME=VALUE, added to ours
  std::string folder{};       // of ours, for its temporary files; removed if it is ended early; empty: none
  bool shows_errors = false;  // its stderr is ours
  std::function<void(const std::string& line)> take_error{};  // a line of its stderr, as it comes
};

struct ProgramResult {
  int code = 0;           // its exit code; 128 + the signal that ended it; 127: it cannot be started
  bool in_time = true;    // false: it was ended at its limit
  std::string out;        // stdout
  std::string last_line;  // the last line of its stderr, for messages
};

class RunningProgram {
 public:
  explicit RunningProgram(const Program& program);
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();  // ends it

  // Waits for its end. Call it once.
  ProgramResult finish();
  // Has it ended early: finish() returns soon. Thread-safe.
  void end();

 private:
  void start();
  bool read_streams(ProgramResult& result, int patience);
  void take_errors(std::string_view piece, ProgramResult& result);

  Program program_;
  int supervisor_ = 0;  // 0: none
  int out_ = -1, errors_ = -1;
  std::string line_;  // of stderr, the part that has come
  std::mutex mutex_;
  int lifeline_ = -1;  // the supervisor's stdin; closing it ends the program
};

// Returns nullopt if there is no such program.
std::optional<ProgramResult> run_program(const Program& program);

// The reason why a program's result is unusable, for messages: "squeue is not installed", "squeue did not finish within
// 60 seconds", "squeue failed: LAST LINE". Empty if it succeeded.
std::string program_fault(const Program& program, const std::optional<ProgramResult>& result);

// Starts a program of the user's desktop, which continues when we end, without our terminal. Does nothing if there is
// no such program.
void start_for_desktop(const std::vector<std::string>& words);

// Leaves only absolute folders in PATH, for us and for the programs that we start, so that no program in the current
// folder is run: it may have come with the files there.
void restrict_path();

// Returns the path of a program of that name by PATH; empty if there is none. Ignores relative folders.
std::string program_path(const std::string& name);
// Returns whether that is an executable file, not a folder.
bool is_program(const std::string& path);
bool has_program(const std::string& name);

// The path of this program.
std::string own_program();
