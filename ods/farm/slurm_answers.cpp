// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/farm/slurm_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/files/frames.h"

namespace ods {

namespace {

using nlohmann::json;

constexpr std::string_view kAnswersMark = "ods:";

std::optional<int> number_of(std::string_view text) {
  int value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "CANCELLED by 1000" is a state of sacct, "COMPLETED+" of old versions.
TaskState state_of(std::string_view word) {
  constexpr std::array<std::string_view, 7> kWaiting = {"PENDING",     "CONFIGURING", "REQUEUED",     "REQUEUE_HOLD",
                                                        "REQUEUE_FED", "SUSPENDED",   "RESV_DEL_HOLD"};
  constexpr std::array<std::string_view, 6> kRunning = {"RUNNING",   "COMPLETING", "STAGE_OUT",
                                                        "SIGNALING", "STOPPED",    "RESIZING"};
  const std::string_view first = word.substr(0, std::min(word.find_first_of(" +"), word.size()));
  if (std::ranges::find(kWaiting, first) != kWaiting.end()) return TaskState::kWaiting;
  if (std::ranges::find(kRunning, first) != kRunning.end()) return TaskState::kRunning;
  return first == "COMPLETED" ? TaskState::kDone : TaskState::kFailed;
}

// "1-02:03:04", "02:03:04", "3:07"; 0 for "INVALID".
double seconds_of(std::string_view text) {
  double days = 0.0, seconds = 0.0;
  if (const size_t dash = text.find('-'); dash != std::string_view::npos) {
    days = number_of(text.substr(0, dash)).value_or(0);
    text.remove_prefix(dash + 1);
  }
  while (!text.empty()) {
    const size_t colon = std::min(text.find(':'), text.size());
    const std::optional<int> part = number_of(text.substr(0, colon));
    if (!part) return 0.0;
    seconds = 60.0 * seconds + *part;
    text.remove_prefix(std::min(colon + 1, text.size()));
  }
  return 86400.0 * days + seconds;
}

// Cuts the first field off.
std::string_view take_field(std::string_view& line, char mark) {
  const size_t end = std::min(line.find(mark), line.size());
  const std::string_view field = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return field;
}

template <class Use>
void for_each_line(std::string_view text, const Use& use) {
  while (!text.empty()) use(take_field(text, '\n'));
}

SlurmTask task_of(std::string_view job, const SlurmArray& array, int index, std::string_view word, double seconds,
                  std::string_view node = "") {
  const TaskState state = state_of(word);
  return {std::string(job),
          array.folder,
          array.group,
          array.before + index,
          state,
          std::string(word),
          seconds,
          state == TaskState::kRunning ? std::string(node) : ""};
}

// A job has a hundred keys, and there are many jobs.
bool keep_what_is_read(int depth, json::parse_event_t event, json& parsed) {
  constexpr int kDepthOfJob = 3;
  constexpr std::array<std::string_view, 9> kKeys = {"array_job_id", "array_task_id", "array_task_string",
                                                     "comment",      "job_id",        "job_state",
                                                     "start_time",   "end_time",      "nodes"};
  if (event != json::parse_event_t::key || depth != kDepthOfJob) return true;
  return std::ranges::find(kKeys, parsed.get_ref<const std::string&>()) != kKeys.end();
}

// A number stood alone until version 23, since then in {"set": true, "number": 5}.
std::optional<double> number_in(const json& job, const char* key) {
  const auto found = job.find(key);
  if (found == job.end()) return std::nullopt;
  if (found->is_number()) return found->get<double>();
  if (!found->is_object() || !found->value("set", false)) return std::nullopt;
  return number_in(*found, "number");
}

// A state was a string until version 23, since then it is a list of strings.
std::string word_in(const json& job, const char* key) {
  const auto found = job.find(key);
  if (found == job.end()) return "";
  if (found->is_array() && !found->empty() && found->front().is_string()) return found->front();
  return found->is_string() ? found->get<std::string>() : "";
}

// The waiting tasks of an array are one entry: "7-40,60%8".
std::vector<int> indices_of(const json& job) {
  const std::string list = word_in(job, "array_task_string");
  if (const auto index = number_in(job, "array_task_id"); index && list.empty()) {
    return {number_in(job, "array_job_id").value_or(0) == 0 ? 1 : static_cast<int>(*index)};
  }
  if (list.empty()) return {1};
  try {
    return parse_frames(list.substr(0, list.find('%')));
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

std::optional<SlurmArray> array_of_comment(std::string_view comment) {
  if (!comment.starts_with(kAnswersMark)) return std::nullopt;
  comment.remove_prefix(kAnswersMark.size());
  SlurmArray array;
  array.group = take_field(comment, ':');
  const std::optional<int> before = number_of(take_field(comment, ':'));
  array.folder = comment;
  if (!before || array.group.empty() || array.folder.empty()) return std::nullopt;
  array.before = *before;
  return array;
}

std::string slurm_comment(const std::string& group, int before) {
  return fmt::format("{}{}:{}", kAnswersMark, group, before);
}

std::vector<SlurmTask> read_queue(std::string_view text) {
  std::vector<SlurmTask> tasks;
  for_each_line(text, [&](std::string_view line) {
    const std::string_view job = take_field(line, '|'), index = take_field(line, '|'), word = take_field(line, '|');
    const double seconds = seconds_of(take_field(line, '|'));
    const std::string_view node = take_field(line, '|');
    const std::optional<SlurmArray> array = array_of_comment(line);
    if (array && !word.empty())
      tasks.push_back(task_of(job, *array, number_of(index).value_or(1), word, seconds, node));
  });
  return tasks;
}

std::optional<std::vector<SlurmTask>> read_queue_json(std::string_view text, double now) {
  const json answer = json::parse(text, keep_what_is_read, false);
  if (!answer.is_object() || !answer.contains("jobs") || !answer["jobs"].is_array()) return std::nullopt;
  std::vector<SlurmTask> tasks;
  for (const json& job : answer["jobs"]) {
    if (!job.is_object()) continue;
    const std::optional<SlurmArray> array = array_of_comment(word_in(job, "comment"));
    const std::string word = word_in(job, "job_state");
    if (!array || word.empty()) continue;
    const double start = number_in(job, "start_time").value_or(0.0), end = number_in(job, "end_time").value_or(now);
    const bool started = start > 0.0 && state_of(word) != TaskState::kWaiting;
    const double seconds = started ? std::max(0.0, std::min(end > 0.0 ? end : now, now) - start) : 0.0;
    const double id = number_in(job, "array_job_id").value_or(0.0);
    const std::string name = fmt::format("{:.0f}", id > 0.0 ? id : number_in(job, "job_id").value_or(0.0));
    for (const int index : indices_of(job))
      tasks.push_back(task_of(name, *array, index, word, seconds, word_in(job, "nodes")));
  }
  return tasks;
}

std::vector<SlurmTask> read_account(std::string_view text, const std::map<std::string, SlurmArray>& arrays) {
  std::vector<SlurmTask> tasks;
  for_each_line(text, [&](std::string_view line) {
    std::string_view id = take_field(line, '|');
    const std::string_view word = take_field(line, '|');
    const int seconds = number_of(take_field(line, '|')).value_or(0);
    const auto array = arrays.find(std::string(take_field(id, '_')));          // "812_7"; "812" if it is not an array
    if (array == arrays.end() || word.empty() || id.starts_with('[')) return;  // waiting tasks: squeue reports them
    tasks.push_back(task_of(array->first, array->second, number_of(id).value_or(1), word, seconds));
  });
  return tasks;
}

std::optional<int> slurm_setting(std::string_view text, std::string_view name) {
  std::optional<int> value;
  for_each_line(text, [&](std::string_view line) {
    std::string_view key = take_field(line, '=');
    key = key.substr(0, std::min(key.find(' '), key.size()));
    if (key == name) value = number_of(line.substr(std::min(line.find_first_not_of(' '), line.size())));
  });
  return value;
}

}  // namespace ods
