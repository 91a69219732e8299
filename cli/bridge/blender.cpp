// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/blender.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "cli/bridge/bridge_files.h"
#include "cli/bridge/scene_cache.h"
#include "cli/console/programs.h"
#include "cli/console/spawn.h"
#include "ods/base/error.h"
#include "ods/files/atomic_file.h"
#include "ods/files/md5.h"

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kOurs = "ods-bridge ";  // begins the lines that are for us
constexpr size_t kLongestLine = 400;

std::string exporter_number() {
  std::string all;
  for (const BridgeFile& file : bridge_files()) all.append(file.name).append(file.text);
  return ods::md5(all);
}

// Where the exporter lies as files, for Blender to read.
std::string install_exporter() {
  const fs::path folder = fs::path(cache_folder()).parent_path() / ("blender-" + exporter_number());
  for (const BridgeFile& file : bridge_files()) {
    const fs::path path = folder / file.name;
    std::error_code error;
    if (fs::file_size(path, error) != file.text.size() || error) ods::write_file(path.native(), file.text);
  }
  return folder.native();
}

std::string printable(const std::string& text) {
  std::string line = text.substr(0, kLongestLine);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return line;
}

// What Blender writes on stderr, line by line.
class Listener {
 public:
  void take(const char* piece, size_t size) {
    text_.append(piece, size);
    for (size_t end = 0; (end = text_.find('\n')) != std::string::npos; text_.erase(0, end + 1)) {
      line(text_.substr(0, end));
    }
    if (text_.size() > 4 * kLongestLine) text_.clear();
  }
  bool is_done() const { return done_; }
  const std::string& error() const { return error_; }
  const std::string& last() const { return last_; }

 private:
  void line(const std::string& line) {
    if (!line.starts_with(kOurs)) {
      if (line.find_first_not_of(" \t\r") != std::string::npos) last_ = printable(line);
      return;
    }
    const std::string rest = line.substr(kOurs.size());
    done_ |= rest.starts_with("done ");
    if (rest.starts_with("error ") && error_.empty()) error_ = printable(rest.substr(6));
  }

  std::string text_, error_, last_;
  bool done_ = false;
};

// False if it takes longer than that.
bool listen(int from, float seconds, Listener& listener) {
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(static_cast<int64_t>(seconds * 1e3f));
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd waiting{from, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(std::min<int64_t>(left, 1000))) <= 0) continue;
    char piece[4096];
    const ssize_t size = read(from, piece, sizeof(piece));
    if (size <= 0) return true;
    listener.take(piece, static_cast<size_t>(size));
  }
}

[[noreturn]] void fail_in_blender(const std::string& scene, const std::string& why) {
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}': {}", scene, why));
}

}  // namespace

std::string find_blender(const BlenderOptions& options) {
  if (options.program.empty()) return program_path("blender");
  if (options.program.find('/') == std::string::npos) {
    if (const std::string found = program_path(options.program); !found.empty()) return found;
  } else if (access(options.program.c_str(), X_OK) == 0 && !fs::is_directory(options.program)) {
    return options.program;
  }
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("--blender: there is no program '{}'", options.program));
}

std::string describe(const BlenderOptions& options) {
  return fmt::format("{} {} {} {}", find_blender(options), options.bake, exporter_number(), options.scene);
}

// A distribution's Blender takes its Python from the first python3 of PATH, and its own needs the system's modules: a
// virtual environment's Python has no numpy.
static std::string system_first() {
  const char* path = std::getenv("PATH");
  return fmt::format("PATH=/usr/local/bin:/usr/bin:/bin:{}", path ? path : "");
}

// Runs one of our scripts in Blender to its end. what: begins the message of an error.
static void run_script(const BlenderOptions& options, const std::vector<std::string>& flags, const char* script,
                       const std::vector<std::string>& arguments, const std::string& what) {
  const fs::path path = fs::path(install_exporter()) / "omnistereo" / "bridge" / script;
  std::vector<std::string> words = {"env", system_first(), find_blender(options), "--background", "--disable-autoexec"};
  words.insert(words.end(), flags.begin(), flags.end());
  words.insert(words.end(), {"--python-exit-code", "4", "--python", path.native(), "--"});
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::optional<Spawned> program = spawn_for_this_thread(words);
  if (!program) fail_in_blender(what, "Blender cannot be started");
  Listener listener;
  const bool in_time = listen(program->from, options.seconds, listener);
  close(program->from);
  kill(-program->process, SIGKILL);  // itself, if it hangs, and whatever it has left
  int status = 0;
  waitpid(program->process, &status, 0);
  if (!in_time) {
    fail_in_blender(what, fmt::format("Blender did not finish within {:g} seconds (--blender-limit gives it more)",
                                      options.seconds));
  }
  if (!listener.error().empty()) fail_in_blender(what, listener.error());
  if (listener.is_done()) return;
  const std::string how =
      WIFSIGNALED(status) && WTERMSIG(status) != SIGKILL
          ? fmt::format("Blender crashed (signal {}); --blender PATH tries another", WTERMSIG(status))
      : WIFEXITED(status) && WEXITSTATUS(status) == 127 ? "Blender cannot be started"
                                                        : "Blender ended before it was done";
  fail_in_blender(what, listener.last().empty() ? how : fmt::format("{}; it said: {}", how, listener.last()));
}

void run_blender(const BlenderOptions& options, const std::string& scene, const std::string& folder) {
  std::vector<std::string> arguments = {fs::absolute(scene).native(), folder};
  if (options.bake > 0) arguments.insert(arguments.end(), {"--bake", std::to_string(options.bake)});
  if (!options.scene.empty()) arguments.insert(arguments.end(), {"--scene", options.scene});
  run_script(options, {"--factory-startup"}, "run.py", arguments, scene);
  if (!fs::exists(fs::path(folder) / "bridge.json")) fail_in_blender(scene, "Blender ended before it was done");
}

void install_add_on(const BlenderOptions& options) {
  run_script(options, {}, "install.py", {own_program()}, "the add-on");
}
