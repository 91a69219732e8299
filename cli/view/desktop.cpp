// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/desktop.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "cli/console/console.h"
#include "cli/console/programs.h"
#include "cli/console/user_folder.h"
#include "cli/http/certificate.h"
#include "ods/files/atomic_file.h"
#include "ods/files/file_input.h"
#include "ods/files/private_folder.h"

std::vector<std::string> network_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return addresses;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, &freeifaddrs);
  for (const ifaddrs* each = list; each; each = each->ifa_next) {
    if (!each->ifa_addr || each->ifa_addr->sa_family != AF_INET) continue;
    if ((each->ifa_flags & IFF_LOOPBACK) || !(each->ifa_flags & IFF_UP)) continue;
    char text[INET_ADDRSTRLEN] = {};
    const auto* const address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text, sizeof(text))) addresses.emplace_back(text);
  }
  return addresses;
}

void open_in_browser(const std::string& address) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  start_for_desktop({"xdg-open", address});
}

std::string state_folder() {
  const std::string folder = user_folder("XDG_STATE_HOME", ".local/state");
  if (folder.empty()) return "";
  try {
    ods::make_own_folder(folder);
  } catch (const ods::Error& error) {
    warn(error.what());
    return "";
  }
  return folder;
}

std::string kept_secret(const std::string& folder) {
  const std::string path = folder + "/view-secret";
  if (folder.empty()) return random_secret();
  if (std::filesystem::exists(path)) {
    const ods::FileInput file(path);
    const std::string secret = file.read(0, std::min<uint64_t>(file.size(), 64));
    const auto is_hex = [](unsigned char c) { return std::isxdigit(c) != 0; };
    if (secret.size() == 32 && std::ranges::all_of(secret, is_hex)) return secret;
  }
  const std::string secret = random_secret();
  ods::write_file(path, secret);
  return secret;
}
