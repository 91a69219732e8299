// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/queue.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "cli/console/programs.h"

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

std::optional<std::vector<ods::SlurmTask>> queued_tasks() {
  if (const auto json = run_program({"squeue", "--json"}); json && json->code == 0) {
    if (const auto tasks = ods::read_queue_json(json->out, now())) return tasks;
  }
  std::vector<std::string> words = {"squeue"};
  words.insert(words.end(), std::begin(ods::kQueueWords), std::end(ods::kQueueWords));
  const auto text = run_program(words);
  if (!text || text->code != 0) return std::nullopt;
  return ods::read_queue(text->out);
}

// jobs.txt has lines of submit.sh, "812 frames-2.sbatch ods:frames:1000".
std::map<std::string, ods::SlurmArray> sent_arrays(const std::string& folder) {
  std::map<std::string, ods::SlurmArray> arrays;
  std::ifstream file(folder + "/jobs.txt");
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
  const auto text = run_program(words);
  return text && text->code == 0 ? ods::read_account(text->out, arrays) : std::vector<ods::SlurmTask>();
}
