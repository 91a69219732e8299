// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "cli/console/progress.h"
#include "cli/farm/job_report.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"

namespace {

using ods::Json;

// "one (3), two (1) and 4 more"
std::string nodes_text(const std::map<std::string, int>& nodes) {
  constexpr size_t kShown = 8;
  std::vector<std::string> words;
  for (const auto& [node, tasks] : nodes) {
    if (words.size() < kShown) words.push_back(fmt::format("{} ({})", node, tasks));
  }
  const size_t more = nodes.size() - words.size();
  return fmt::format("{}{}", fmt::join(words, ", "), more == 0 ? "" : fmt::format(" and {} more", more));
}

std::string row_text(const JobReport& job, const GroupReport& group) {
  const std::string name = &group == &job.groups.front() ? job.name : "";
  const std::string made = group.made ? fmt::format("{}/{}", group.made->first, group.made->second) : "";
  if (!job.is_known()) {
    return fmt::format("{:24} {:8} {:>7} {:>8} {:>8} {:>7} {:>9} {:>13}  {}\n", name, group.name, "?", "?", "?", "?",
                       "?", made, "");
  }
  const std::string left = group.seconds_left ? duration_text(*group.seconds_left) : "";
  return fmt::format("{:24} {:8} {:>7} {:>8} {:>8} {:>7} {:>9} {:>13}  {}\n", name, group.name, group.done,
                     group.running, group.waiting, group.failed.size(), group.restarts, made, left);
}

std::string notes_text(const JobReport& job) {
  if (!job.is_known()) {
    return fmt::format(
        "{}: the state of its tasks is available only from {}; the frames and parts in the folder were counted\n",
        job.name, job.scheduler);
  }
  std::string text;
  for (const GroupReport& group : job.groups) {
    if (!group.nodes.empty()) text += fmt::format("{} {}: on {}\n", job.name, group.name, nodes_text(group.nodes));
  }
  for (const GroupReport& group : job.groups) {
    if (group.lost > 0) {
      text +=
          fmt::format("{} {}: {} neither ended nor in the queue; submit it again\n", job.name, group.name, group.lost);
    }
    for (const int task : group.faults) {
      text +=
          fmt::format("{0} {1} {2}: found a fault, see {3}/logs/{1}.{2}.log\n", job.name, group.name, task, job.folder);
    }
    for (const FailedTask& task : group.failed) {
      text += fmt::format("{} {} {}: {}{}{}{}\n", job.name, group.name, task.number,
                          task.nodes.empty() ? "" : "on " + task.nodes + ", ", task.why, task.last.empty() ? "" : ": ",
                          task.last);
    }
  }
  return text;
}

Json json_of(const JobReport& job, const GroupReport& group) {
  Json json = {{"name", group.name}};
  if (group.made) json["made"] = group.made->first, json["of"] = group.made->second;
  if (!job.is_known()) return json;
  json.update({{"done", group.done},
               {"running", group.running},
               {"waiting", group.waiting},
               {"lost", group.lost},
               {"restarts", group.restarts},
               {"nodes", group.nodes},
               {"faults", group.faults},
               {"failed", Json::array()}});
  for (const FailedTask& task : group.failed) {
    json["failed"].push_back(
        {{"task", task.number}, {"why", task.why}, {"last_line", task.last}, {"nodes", task.nodes}});
  }
  if (group.seconds_left) json["seconds_left"] = *group.seconds_left;
  return json;
}

}  // namespace

std::string report_text(const std::vector<JobReport>& jobs) {
  std::string text = fmt::format("{:24} {:8} {:>7} {:>8} {:>8} {:>7} {:>9} {:>13}  {}\n", "job", "tasks", "done",
                                 "running", "waiting", "failed", "restarts", "made", "left");
  for (const JobReport& job : jobs) {
    for (const GroupReport& group : job.groups) text += row_text(job, group);
  }
  for (const JobReport& job : jobs) text += notes_text(job);
  return text;
}

std::string report_json(const std::vector<JobReport>& jobs) {
  Json all = Json::array();
  for (const JobReport& job : jobs) {
    Json json = {{"job", job.name}, {"folder", job.folder}, {"scheduler", job.scheduler}, {"groups", Json::array()}};
    for (const GroupReport& group : job.groups) json["groups"].push_back(json_of(job, group));
    all.push_back(json);
  }
  return ods::json_document(all, 2) + "\n";
}
