// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/farm/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/files/read_file.h"

namespace ods {

namespace {

constexpr const char* kPlanMark = "omnistereo_farm_plan";
constexpr int kVersion = 1;

Json json_of(const TaskGroup& group) {
  Json json = {{"name", group.name}, {"command", group.command}};
  if (group.memory > 0) json["memory"] = group.memory;
  if (group.option.empty()) return json;
  json["option"] = group.option;
  json["tasks"] = group.tasks;
  if (group.files.empty()) return json;
  json["files"] = group.files;
  json["numbers"] = group.numbers;
  return json;
}

TaskGroup group_of(const Json& json) {
  return {json.at("name"),
          json.at("command"),
          json.value("option", ""),
          json.value("tasks", 1),
          json.value("memory", size_t{0}),
          json.value("files", ""),
          json.value("numbers", "")};
}

Json json_of(const PlanPath& path) {
  return {
      {"path", path.path}, {"use", path.is_output ? "output" : "input"}, {"kind", path.is_folder ? "folder" : "file"}};
}

PlanPath path_of(const Json& json) {
  return {json.at("path"), json.at("use") == "output", json.at("kind") == "folder"};
}

}  // namespace

size_t memory_of(const FarmPlan& plan, const TaskGroup& group) {
  return group.memory > 0 ? group.memory : plan.memory;
}

std::vector<std::string> task_arguments(const FarmPlan& plan, const TaskGroup& group, int number) {
  assert(number >= 1 && number <= group.tasks);
  std::vector<std::string> words = {plan.program};
  words.insert(words.end(), group.command.begin(), group.command.end());
  if (group.option.empty()) return words;
  words.insert(words.end(), {group.option, fmt::format("{}/{}", number, group.tasks)});
  return words;
}

std::string write_plan(const FarmPlan& plan) {
  Json json = {{kPlanMark, kVersion},   {"name", plan.name},       {"scheduler", plan.scheduler},
               {"folder", plan.folder}, {"program", plan.program}, {"cpus", plan.cpus},
               {"memory", plan.memory}, {"paths", Json::array()},  {"groups", Json::array()}};
  for (const PlanPath& path : plan.paths) json["paths"].push_back(json_of(path));
  for (const TaskGroup& group : plan.groups) json["groups"].push_back(json_of(group));
  return json_document(json, 2) + "\n";
}

FarmPlan read_plan(std::string_view text, const std::string& path) {
  const Json json = parse_json(text, path, "plan of a farm's job");
  const auto bad = [&](const std::string& why) {
    return Error(ErrorKind::kInput, fmt::format("'{}' is not the plan of a farm's job: {}", path, one_line(why)));
  };
  try {
    if (json.at(kPlanMark) != kVersion) throw bad("it was made by another version of ods");
    FarmPlan plan{json.at("name"), json.at("folder"), json.at("program"), json.at("cpus"), json.at("memory"), {}, {}};
    for (const Json& each : json.at("paths")) plan.paths.push_back(path_of(each));
    for (const Json& each : json.at("groups")) plan.groups.push_back(group_of(each));
    plan.scheduler = json.value("scheduler", "");
    return plan;
  } catch (const nlohmann::json::exception& error) {
    throw bad(error.what());
  }
}

FarmPlan open_plan(const std::string& folder) {
  const std::string path = folder + "/plan.json";
  const std::vector<unsigned char> bytes = read_file(path, size_t{64} << 20);
  return read_plan({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

std::string absolute_folder(const std::string& path) {
  std::string folder = std::filesystem::absolute(path).lexically_normal().native();
  while (folder.size() > 1 && folder.ends_with("/")) folder.pop_back();
  return folder;
}

std::string plan_name(const std::string& text) {
  std::string name = text.substr(0, 64);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  }
  return name.empty() || !std::isalnum(static_cast<unsigned char>(name.front())) ? "job" + name : name;
}

void check_quotable(const FarmPlan& plan) {
  const auto check = [](const std::string& word) {
    if (is_quotable(word)) return;
    throw Error(ErrorKind::kUsage,
                fmt::format("'{}' has a line break, another control character or bytes that are not UTF-8: schedulers "
                            "cannot take such an argument; rename the file",
                            one_line(word)));
  };
  for (const std::string& word : {plan.folder, plan.program}) check(word);
  for (const PlanPath& path : plan.paths) check(path.path);
  for (const TaskGroup& group : plan.groups) std::ranges::for_each(group.command, check);
}

double halo_cost(int halo, int tasks, size_t frames) {
  return 2.0 * halo * (tasks - 1) / static_cast<double>(frames);  // the ends of the video have no neighbours
}

static constexpr double kTaskSeconds = 600.0;

int min_chunk(int halo) {
  return std::max(1, static_cast<int>(std::ceil(2.0 * halo / kMaxHaloCost)));
}

int suitable_chunk(double seconds_per_frame, size_t frames, int halo) {
  assert(seconds_per_frame > 0.0 && frames > 0);
  const auto by_time = std::clamp(kTaskSeconds / seconds_per_frame, 1.0, 1e6);
  const auto by_machines = std::max(1.0, std::ceil(static_cast<double>(frames) / 16.0));
  return std::max(static_cast<int>(std::min(by_time, by_machines)), min_chunk(halo));
}

bool raw_first_is_cheaper(double seconds_per_frame, size_t frames, int halo, size_t raw_bytes) {
  if (seconds_per_frame * min_chunk(halo) < kTaskSeconds) return false;
  const double kDiskSpeed = 1e8;
  const double twice = halo_cost(halo, tasks_for(frames, suitable_chunk(seconds_per_frame, frames, halo)), frames);
  const double written_and_read = 2.0 + kMaxHaloCost;  // tasks that denoise read those beside theirs, too
  return seconds_per_frame * twice > written_and_read * static_cast<double>(raw_bytes) / kDiskSpeed;
}

int tasks_for(size_t frames, int chunk) {
  return static_cast<int>((frames + static_cast<size_t>(chunk) - 1) / static_cast<size_t>(chunk));
}

}  // namespace ods
