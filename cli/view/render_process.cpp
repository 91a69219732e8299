// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/render_process.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "cli/console/programs.h"
#include "ods/files/atomic_file.h"

RenderProcess::~RenderProcess() {
  cancel();
  if (reader_.joinable()) reader_.join();
}

void RenderProcess::start(std::vector<std::string> words, const std::string& output) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (status_.state == "running") throw UsageError("a picture is being rendered: wait for it, or cancel it");
  }
  if (reader_.joinable()) reader_.join();
  folder_ = std::make_unique<ods::PrivateFolder>(".ods-view-");
  words.insert(words.begin(), kThisProgram);
  words.insert(words.end(), {"--progress", "json", "-o", folder_->path() + "/" + output});
  program_ = std::make_unique<RunningProgram>(
      Program{.words = words, .folder = folder_->path(), .take_error = [this](const std::string& l) { take_line(l); }});
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_ = Status();
    status_.state = "running";
  }
  reader_ = std::thread([this, output] { run(output); });
}

void RenderProcess::cancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (status_.state != "running") return;
  status_.state = "cancelled";
  program_->end();  // its files so far are in our folder
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
  const std::string ours = folder_->path() + "/";
  for (size_t at = 0; (at = status_.text.find(ours)) != std::string::npos;) status_.text.erase(at, ours.size());
}

void RenderProcess::run(const std::string& output) {
  const ProgramResult result = program_->finish();
  end(output, result.code == 0);
}

// Moves the picture to its final name. If that is taken or cannot be written by now, keeps the picture elsewhere: it
// may have taken hours.
void RenderProcess::end(const std::string& output, bool is_well) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool is_wanted = status_.state == "running";
  if (is_wanted) status_.state = "failed";
  try {
    const std::filesystem::path name = output;
    std::string free = output;
    for (int i = 2; is_wanted && is_well && !ods::rename_as_new(folder_->path() + "/" + output, free); i++) {
      free = fmt::format("{}-{}{}", name.stem().native(), i, name.extension().native());
    }
    if (is_wanted && is_well) status_.state = "done", status_.done = 1.0, status_.left = 0.0, status_.output = free;
  } catch (const ods::Error& error) {
    status_.text = fmt::format("{}; the picture is '{}/{}'", with_options(error.what()), folder_->keep(), output);
  }
  folder_.reset();
}
