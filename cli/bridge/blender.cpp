// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/bridge/blender.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "cli/bridge/bridge_files.h"
#include "cli/bridge/scene_cache.h"
#include "cli/console/programs.h"
#include "ods/base/error.h"
#include "ods/base/text.h"
#include "ods/files/atomic_file.h"
#include "ods/files/md5.h"
#include "ods/files/private_folder.h"

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kOurs = "ods-bridge ";  // begins the lines that are for us
constexpr size_t kMaxError = 400;                  // bytes in a message

std::string exporter_hash() {
  std::string all;
  for (const BridgeFile& file : bridge_files()) all.append(file.name).append(file.text);
  return ods::md5(all);
}

void write_exporter(const std::string& folder) {
  for (const BridgeFile& file : bridge_files()) ods::write_file(fmt::format("{}/{}", folder, file.name), file.text);
}

// The reports of our scripts on stderr, where Blender prints other lines, too.
struct Report {
  std::function<void()> slow{};
  std::string error{};  // the first one
  bool is_done = false;

  void take(const std::string& line) {
    if (!line.starts_with(kOurs)) return;
    const std::string rest = line.substr(kOurs.size());
    is_done |= rest.starts_with("done ");
    if (rest.starts_with("slow ") && slow) slow();
    if (rest.starts_with("error ") && error.empty()) error = ods::one_line(rest.substr(6, kMaxError));
  }
};

[[noreturn]] void fail_in_blender(const std::string& scene, const std::string& why) {
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}': {}", scene, why));
}

}  // namespace

void fail_in_time(const char* program, const std::string& scene, float seconds) {
  fail_in_blender(
      scene, fmt::format("{} did not finish within {:g} seconds (--blender-limit gives it more)", program, seconds));
}

std::string find_blender(const BlenderOptions& options) {
  if (options.program.empty()) return program_path("blender");
  if (options.program.find('/') == std::string::npos) {
    if (const std::string found = program_path(options.program); !found.empty()) return found;
  } else if (is_program(options.program)) {
    return options.program;
  }
  throw ods::Error(ods::ErrorKind::kInput, fmt::format("--blender: there is no program '{}'", options.program));
}

std::string describe(const BlenderOptions& options) {
  return fmt::format("{} {} {} {}", find_blender(options), options.bake, exporter_hash(), options.scene);
}

// A distribution's Blender takes its Python from the first python3 of PATH, and needs the system's modules: a virtual
// environment's Python has no numpy.
static std::string system_first() {
  const char* path = std::getenv("PATH");
  return fmt::format("PATH=/usr/local/bin:/usr/bin:/bin:{}", path ? path : "");
}

Program blender_program(const BlenderOptions& options, const std::vector<std::string>& flags,
                        const std::string& scripts, const char* script, const std::vector<std::string>& arguments) {
  write_exporter(scripts);
  const fs::path path = fs::path(scripts) / "omnistereo" / "bridge" / script;
  Program blender = {.words = {find_blender(options), "--background", "--disable-autoexec"},
                     .limit = options.seconds,
                     .environment = {system_first(), "ODS_PYCACHE=" + python_cache_folder()}};
  blender.words.insert(blender.words.end(), flags.begin(), flags.end());
  blender.words.insert(blender.words.end(), {"--python-exit-code", "4", "--python", path.native(), "--"});
  blender.words.insert(blender.words.end(), arguments.begin(), arguments.end());
  return blender;
}

// Runs one of our scripts in Blender to its end. what: begins the message of an error. folder: of ours.
static void run_script(const BlenderOptions& options, const std::vector<std::string>& flags, const char* script,
                       const std::vector<std::string>& arguments, const std::string& folder, const std::string& what,
                       const ConversionWatch& watch = {}) {
  const ods::PrivateFolder scripts;
  Report report{.slow = watch.slow};
  Program blender = blender_program(options, flags, scripts.path(), script, arguments);
  blender.folder = folder;
  blender.take_error = [&](const std::string& line) { report.take(line); };
  if (blender.words.front().empty()) fail_in_blender(what, "Blender cannot be started");
  RunningProgram running(blender);
  const std::stop_callback ending(watch.stop, [&running] { running.end(); });
  const ProgramResult result = running.finish();
  if (result.code == 127) fail_in_blender(what, "Blender cannot be started");
  if (!result.in_time) fail_in_time("Blender", what, options.seconds);
  if (!report.error.empty()) fail_in_blender(what, report.error);
  if (report.is_done) return;
  const std::string how =
      result.code > 128 ? fmt::format("Blender crashed (signal {}); --blender PATH tries another", result.code - 128)
                        : "Blender ended before it was done";
  fail_in_blender(what, result.last_line.empty() ? how : fmt::format("{}; its output: {}", how, result.last_line));
}

void run_blender(const BlenderOptions& options, const std::string& scene, const std::string& folder,
                 const ConversionWatch& watch, const std::optional<FilmBeginning>& beginning) {
  std::vector<std::string> arguments = {fs::absolute(scene).native(), folder};
  const auto add = [&](const char* name, int value) {
    arguments.insert(arguments.end(), {name, std::to_string(value)});
  };
  if (options.bake > 0) add("--bake", options.bake);
  if (!options.scene.empty()) arguments.insert(arguments.end(), {"--scene", options.scene});
  if (beginning) add("--beginning", beginning->count);
  if (beginning && beginning->frames)
    add("--first", beginning->frames->first), add("--last", beginning->frames->second);
  run_script(options, {"--factory-startup"}, "run.py", arguments, folder, scene, watch);
  if (!fs::exists(fs::path(folder) / "bridge.json")) fail_in_blender(scene, "Blender ended before it was done");
}

void install_add_on(const BlenderOptions& options) {
  const ods::PrivateFolder folder;
  run_script(options, {}, "install.py", {own_program()}, folder.path(), "the add-on");
}
