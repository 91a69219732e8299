// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The command as strangers meet it: with a home, a folder for momentary files and a PATH of the test's own.
#pragma once
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <thread>

#include "tests/support/programs.h"
#include "tests/support/served.h"

namespace ods {

// Sets variables of the environment, and sets them back.
class Environment {
 public:
  Environment() = default;
  Environment(const Environment&) = delete;
  ~Environment() {
    for (const auto& [name, value] : before_) value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
  }
  void set(const std::string& name, const std::string& value) {
    const char* const before = getenv(name.c_str());
    before_.emplace(name, before ? std::optional<std::string>(before) : std::nullopt);
    setenv(name.c_str(), value.c_str(), 1);
  }

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

class Outside : public Served {
 protected:
  void SetUp() override {
    for (const char* name : {"tmp", "home", "bin"}) std::filesystem::create_directory(folder.path(name));
    environment.set("TMPDIR", folder.path("tmp"));
    environment.set("HOME", folder.path("home"));
    environment.set("XDG_CACHE_HOME", folder.path("home/cache"));
    environment.set("XDG_STATE_HOME", folder.path("home/state"));
  }

  // A line for the shell in the folder, where "ods" is the command.
  Ran shell(const std::string& line) const {
    return run_line("ods() { '" + ods_command() + "' \"$@\"; }; cd '" + folder.path("") + "' && { " + line + "\n}");
  }

  // A small picture of two eyes, top-bottom.
  void make_picture(const std::string& name, const std::string& more = "") const {
    const Ran ran = shell("ods render spheres -q --width 64 --samples 1 " + more + " -o '" + name + "'");
    ASSERT_EQ(ran.code, 0) << ran.out;
  }

  void program(const std::string& name, const std::string& script) const {
    folder.write(name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder.path(name), std::filesystem::perms::owner_all);
  }

  // Makes this the only program on PATH. Returns why it cannot, as missing().
  std::string only(const std::string& name) {
    const Ran found = run_line("command -v " + name);
    if (found.code != 0) return "skipped: " + name + " is not installed";
    std::filesystem::create_symlink(found.out.substr(0, found.out.find('\n')), folder.path("bin/" + name));
    environment.set("PATH", folder.path("bin"));
    return "";
  }

  void write_triangle(const std::string& name) const { folder.write(name, "v -1 0 -2\nv 1 0 -2\nv 1 2 -2\nf 1 2 3\n"); }

  // Waits until it holds, up to a minute; returns whether it does.
  template <class Condition>
  bool soon(const Condition& holds) const {
    for (int i = 0; i < 1200 && !holds(); i++) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return holds();
  }

  Environment environment;
};

}  // namespace ods
