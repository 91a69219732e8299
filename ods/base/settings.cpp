// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "ods/base/checksum.h"
#include "ods/base/error.h"

namespace ods {

static std::string change(const std::string& name, const Setting* was, const Setting* is) {
  if (!was) return fmt::format("{} is new", name);
  if (!is) return fmt::format("{} is no longer given", name);
  if (!was->path.empty() && was->path == is->path) {
    return is->value == "missing" ? fmt::format("{} '{}' is missing", name, is->path)
                                  : fmt::format("{} '{}' has changed", name, is->path);
  }
  const auto said = [](const Setting& setting) { return setting.path.empty() ? setting.value : setting.path; };
  return fmt::format("{} was {}, now {}", name, said(*was), said(*is));
}

static std::string last_line(std::string_view lines) {
  return fmt::format("end\t{:08x}\n", crc32(lines));
}

std::string settings_text(const Settings& settings) {
  std::string text;
  for (const auto& [name, value, path] : settings) {
    text += fmt::format("{}\t{}{}{}\n", name, value, path.empty() ? "" : "\t", path);
  }
  return text + last_line(text);
}

std::optional<Settings> parse_settings(const std::string& text) {
  const size_t size = text.size() - std::min(text.size(), last_line("").size());
  const std::string listed = text.substr(0, size);
  if (text != listed + last_line(listed)) return std::nullopt;
  Settings settings;
  std::istringstream lines(listed);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, '\t');) fields.push_back(field);
    fields.resize(3);
    settings.push_back({fields[0], fields[1], fields[2]});
  }
  return settings;
}

std::string settings_difference(const Settings& then, const Settings& now) {
  const auto find = [](const Settings& settings, const std::string& name) -> const Setting* {
    const auto found = std::ranges::find(settings, name, &Setting::name);
    return found == settings.end() ? nullptr : &*found;
  };
  std::vector<std::string> changes;
  for (const Setting& is : now) {
    const Setting* was = find(then, is.name);
    if (!was || was->value != is.value) changes.push_back(change(is.name, was, &is));
  }
  for (const Setting& was : then) {
    if (!find(now, was.name)) changes.push_back(change(was.name, &was, nullptr));
  }
  constexpr size_t kMax = 3;
  const std::string more = changes.size() > kMax ? fmt::format("; and {} more", changes.size() - kMax) : "";
  changes.resize(std::min(changes.size(), kMax));
  return fmt::format("{}{}", fmt::join(changes, "; "), more);
}

void expect_same_settings(const std::string& path, const Settings& then, const Settings& now, std::string_view remedy) {
  const std::string difference = settings_difference(then, now);
  if (difference.empty()) return;
  throw Error(ErrorKind::kUsage, fmt::format("'{}' was made with other options: {}; {}", path, difference, remedy));
}

}  // namespace ods
