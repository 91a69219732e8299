// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "ods/base/error.h"
#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"

namespace ods {

namespace {

constexpr size_t kLongest = 1024;  // characters of a string
constexpr size_t kLongestName = 64;

// A parameter for a file or a folder that the commands name.
struct PathParameter {
  std::string name;
  PlanPath path;
};

// Outputs are folders: the frames are beside the video, and each step's output is the next one's input.
std::vector<PathParameter> parameters_of(const FarmPlan& plan) {
  std::vector<PathParameter> parameters;
  for (PlanPath path : plan.paths) {
    if (path.is_output && !path.is_folder) path = {std::filesystem::path(path.path).parent_path().native(), true, true};
    const auto is_same = [&](const PathParameter& other) { return other.path.path == path.path; };
    const auto found = std::ranges::find_if(parameters, is_same);
    if (found != parameters.end()) {
      found->path.is_output |= path.is_output;
      continue;
    }
    const char* const kind = path.is_output ? "Output" : path.is_folder ? "InputFolder" : "InputFile";
    const auto number = std::ranges::count_if(parameters, [&](const auto& p) { return p.name.starts_with(kind); });
    parameters.push_back({fmt::format("{}{}", kind, number + 1), path});
  }
  return parameters;
}

Json definition_of(const PathParameter& parameter) {
  const auto& [path, is_output, is_folder] = parameter.path;
  return {{"name", parameter.name},
          {"type", "PATH"},
          {"objectType", is_folder ? "DIRECTORY" : "FILE"},
          {"dataFlow", is_output ? "OUT" : "IN"},
          {"userInterface",
           {{"control", is_folder ? "CHOOSE_DIRECTORY" : "CHOOSE_INPUT_FILE"}, {"label", parameter.name}}}};
}

// The argument with its path replaced by the parameter that a farm may map to another place.
std::string with_parameter(const std::string& word, const std::vector<PathParameter>& parameters) {
  if (word.find("{{") != std::string::npos) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}' has {{{{, where Open Job Description expects a name", word));
  }
  for (const PathParameter& parameter : parameters) {
    const std::string& path = parameter.path.path;
    if (word != path && !(parameter.path.is_folder && word.starts_with(path + "/"))) continue;
    return "{{Param." + parameter.name + "}}" + word.substr(path.size());
  }
  if (word.size() > kLongest) throw Error(ErrorKind::kUsage, "an argument has more than 1024 characters");
  return word;
}

Json step_of(const FarmPlan& plan, const TaskGroup& group, const std::vector<PathParameter>& parameters) {
  Json words = Json::array();
  for (const std::string& word : group.command) words.push_back(with_parameter(word, parameters));
  words.insert(words.end(), {"--progress", "openjd"});
  if (plan.cpus > 0) words.insert(words.end(), {"--threads", fmt::format("{}", plan.cpus)});
  Json step = {{"name", group.name.substr(0, kLongestName)}};
  if (!group.option.empty()) {
    words.insert(words.end(), {group.option, fmt::format("{{{{Task.Param.Task}}}}/{}", group.tasks)});
    const Json task = {
        {"name", "Task"}, {"type", "INT"}, {"range", group.tasks == 1 ? "1" : fmt::format("1-{}", group.tasks)}};
    step["parameterSpace"]["taskParameterDefinitions"] = Json::array({task});
  }
  Json amounts = Json::array();
  if (plan.cpus > 0) amounts.push_back({{"name", "amount.worker.vcpu"}, {"min", plan.cpus}});
  amounts.push_back({{"name", "amount.worker.memory"}, {"min", memory_of(plan, group) >> 20}});
  step["hostRequirements"]["amounts"] = amounts;
  step["script"]["actions"]["onRun"] = {
      {"command", "{{Param.Program}}"},
      {"args", words},
      {"cancelation", {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 30}}}};
  if (&group != &plan.groups.front()) {
    step["dependencies"] = Json::array({{{"dependsOn", (&group - 1)->name.substr(0, kLongestName)}}});
  }
  return step;
}

}  // namespace

std::vector<FarmFile> write_openjd(const FarmPlan& plan, const SchedulerChoices&) {
  const std::vector<PathParameter> parameters = parameters_of(plan);
  Json job = {{"specificationVersion", "jobtemplate-2023-09"},
              {"name", plan.name},
              {"parameterDefinitions", Json::array({{{"name", "Program"},
                                                     {"type", "STRING"},
                                                     {"description", "ods, as the workers call it"},
                                                     {"userInterface", {{"control", "LINE_EDIT"}}}}})},
              {"steps", Json::array()}};
  Json values = Json::array({{{"name", "Program"}, {"value", plan.program}}}), flat = {{"Program", plan.program}};
  for (const PathParameter& parameter : parameters) {
    job["parameterDefinitions"].push_back(definition_of(parameter));
    const std::string inside = plan.folder + "/";  // of the bundle: such paths are relative
    const std::string& path = parameter.path.path;
    values.push_back(
        {{"name", parameter.name}, {"value", path.starts_with(inside) ? path.substr(inside.size()) : path}});
    flat[parameter.name] = path;
  }
  for (const TaskGroup& group : plan.groups) job["steps"].push_back(step_of(plan, group, parameters));
  return {{"template.json", json_document(job, 2) + "\n"},
          {"parameter_values.json", json_document({{"parameterValues", values}}, 2) + "\n"},
          {"openjd_parameters.json", json_document(flat, 2) + "\n"}};
}

}  // namespace ods
