// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/queue.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "cli/console/programs.h"
#include "ods/base/error.h"
#include "ods/files/read_file.h"

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

SlurmQueue read_queue() {
  const auto json = run_program({.words = {"squeue", "--json"}, .limit = kSlurmLimit});
  if (json && json->code == 0) {
    if (const auto tasks = ods::read_queue_json(json->out, now())) return {*tasks, ""};
  }
  Program squeue = {.words = {"squeue"}, .limit = kSlurmLimit};
  if (json && !json->in_time) return {{}, program_fault(squeue, json)};  // it would not answer the second time either
  squeue.words.insert(squeue.words.end(), std::begin(ods::kQueueWords), std::end(ods::kQueueWords));
  const auto text = run_program(squeue);
  const std::string fault = program_fault(squeue, text);
  if (!fault.empty()) return {{}, fault};
  return {ods::read_queue(text->out), ""};
}

// jobs.txt has lines of submit.sh, "812 frames-2.sbatch ods:frames:1000".
std::map<std::string, ods::SlurmArray> sent_arrays(const std::string& folder) {
  std::map<std::string, ods::SlurmArray> arrays;
  const std::string path = folder + "/jobs.txt";
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return arrays;
  const std::string text = ods::read_text(path, size_t{64} << 20);
  if (!text.ends_with('\n')) {
    throw ods::Error(
        ods::ErrorKind::kInput,
        fmt::format("'{}' is damaged: remove it, and the job is read from its folder and the queue", path));
  }
  std::istringstream file(text);
  for (std::string id, script, comment; file >> id >> script >> comment;) {
    if (const auto array = ods::array_of_comment(comment + ":" + folder)) arrays[id] = *array;
  }
  return arrays;
}

std::vector<ods::SlurmTask> accounted_tasks(const std::map<std::string, ods::SlurmArray>& arrays) {
  std::vector<std::string> ids;
  for (const auto& [id, array] : arrays) ids.push_back(id);
  if (ids.empty()) return {};
  std::vector<std::string> words = {"sacct", fmt::format("--jobs={}", fmt::join(ids, ","))};
  words.insert(words.end(), std::begin(ods::kAccountWords), std::end(ods::kAccountWords));
  const auto text = run_program({.words = words, .limit = kSlurmLimit});
  return text && text->code == 0 ? ods::read_account(text->out, arrays) : std::vector<ods::SlurmTask>();
}
