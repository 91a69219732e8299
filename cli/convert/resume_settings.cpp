// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/resume_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>

#include "ods/base/text.h"
#include "ods/files/frames.h"
#include "ods/files/read_file.h"
#include "ods/picture/metadata/sidecar.h"

namespace {

void add_file(const std::string& path, ods::Settings& settings) {
  const std::string identity = ods::file_identity(path);
  if (identity.empty()) return;
  settings.push_back({fmt::format("'{}'", ods::one_line(std::filesystem::absolute(path).native())), identity, ""});
}

}  // namespace

ods::Settings resume_settings(const ConvertJob& job) {
  std::vector<std::string> arguments = job.given.words;
  std::erase(arguments, "--restart");
  ods::Settings settings = {{"version of ods", ODS_VERSION, ""},
                            {"arguments", ods::one_line(fmt::format("{}", fmt::join(arguments, " "))), ""}};
  std::set<std::string> files(job.given.words.begin(), job.given.words.end());
  for (size_t i = 0; i < job.files.frames.size(); i++) {
    for (const int eye : {ods::kLeft, ods::kRight}) files.insert(ods::path_for_eye(job.files.path(i), eye));
  }
  if (const auto depth = ods::frame_names(job.given.depth.path)) {
    for (const int frame : ods::frames_on_disk(*depth)) files.insert(depth->path(frame));
  }
  for (const std::string& file : files) {
    if (file == job.given.output) continue;
    add_file(file, settings);
    add_file(ods::sidecar_path(file), settings);
  }
  return settings;
}
