// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/render_process.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "cli/console/spawn.h"

RenderProcess::~RenderProcess() {
  cancel();
  if (reader_.joinable()) reader_.join();
}

void RenderProcess::start(const std::vector<std::string>& words) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (status_.state == "running") throw UsageError("a picture is being rendered: wait for it, or cancel it");
  }
  if (reader_.joinable()) reader_.join();
  std::vector<std::string> all = {kThisProgram};
  all.insert(all.end(), words.begin(), words.end());
  const auto program = spawn(all, StreamUse::kHidden, StreamUse::kRead);
  if (!program) throw ods::Error(ods::ErrorKind::kOutput, "cannot start ods render");
  const std::lock_guard<std::mutex> lock(mutex_);
  status_ = Status();
  status_.state = "running";
  child_ = program->process;
  reader_ = std::thread([this, from = program->from] { read_lines(from); });
}

void RenderProcess::cancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (status_.state != "running") return;
  status_.state = "cancelled";
  kill(child_, SIGTERM);
}

RenderProcess::Status RenderProcess::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

// An object of --progress json (docs/console.md).
void RenderProcess::take_line(const std::string& line) {
  const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!json.is_object()) return;
  if (json.contains("progress") && json["progress"].is_number()) status_.done = json["progress"];
  if (json.contains("seconds_left") && json["seconds_left"].is_number()) status_.left = json["seconds_left"];
  for (const char* key : {"note", "warning", "error"}) {
    if (json.contains(key) && json[key].is_string()) status_.text = json[key];
  }
}

void RenderProcess::read_lines(int from) {
  std::string text;
  char piece[4096];
  for (ssize_t count = 0; (count = read(from, piece, sizeof(piece))) > 0;) {
    text.append(piece, static_cast<size_t>(count));
    for (size_t end = 0; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) {
      take_line(text.substr(0, end));
    }
  }
  close(from);
  siginfo_t ended;
  waitid(P_PID, static_cast<id_t>(child_), &ended, WEXITED | WNOWAIT);  // its number stays its own for cancel()
  const std::lock_guard<std::mutex> lock(mutex_);
  int result = 0;
  waitpid(child_, &result, 0);
  if (status_.state == "running") status_.state = WIFEXITED(result) && WEXITSTATUS(result) == 0 ? "done" : "failed";
  if (status_.state == "done") status_.done = 1.0, status_.left = 0.0;
}
