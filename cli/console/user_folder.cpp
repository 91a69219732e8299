// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/user_folder.h"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

static std::string absolute_variable(const char* name) {
  const char* const value = std::getenv(name);
  return value && *value == '/' ? value : "";
}

static std::string home_folder() {
  const std::string home = absolute_variable("HOME");
  if (!home.empty()) return home;
  const passwd* const account = getpwuid(geteuid());
  return account && account->pw_dir && *account->pw_dir == '/' ? account->pw_dir : "";
}

std::string user_folder(const char* variable, const char* in_home) {
  const std::string own = absolute_variable(variable), home = home_folder();
  if (!own.empty()) return own + "/ods";
  return home.empty() ? "" : (std::filesystem::path(home) / in_home / "ods").native();
}
