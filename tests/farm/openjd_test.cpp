// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/schedulers.h"

namespace ods {
namespace {

using nlohmann::json;

// The keys of jobtemplate-2023-09 by the object that has them, "KEY!" for those that must be there; other keys are
// refused.
const std::map<std::string, std::string> kOpenJdKeys = {
    {"template",
     "specificationVersion! name! steps! $schema description parameterDefinitions jobEnvironments extensions"},
    {"STRING", "name! type! description default allowedValues minLength maxLength userInterface"},
    {"PATH", "name! type! description default allowedValues minLength maxLength objectType dataFlow userInterface"},
    {"userInterface", "control! label groupLabel fileFilters fileFilterDefault"},
    {"step", "name! script! description dependencies stepEnvironments hostRequirements parameterSpace"},
    {"dependency", "dependsOn!"},
    {"hostRequirements", "amounts attributes"},
    {"amount", "name! min max"},
    {"parameterSpace", "taskParameterDefinitions! combination"},
    {"task", "name! type! range!"},
    {"script", "actions! embeddedFiles"},
    {"actions", "onRun!"},
    {"action", "command! args timeout cancelation"},
    {"cancelation", "mode! notifyPeriodInSeconds"}};

void expect_keys(const json& object, const std::string& kind) {
  std::set<std::string> allowed;
  std::istringstream words(kOpenJdKeys.at(kind));
  for (std::string word; words >> word;) {
    const bool needed = word.ends_with("!");
    if (needed) word.pop_back();
    allowed.insert(word);
    EXPECT_TRUE(!needed || object.contains(word)) << kind << " needs " << word;
  }
  for (const auto& [key, value] : object.items()) EXPECT_TRUE(allowed.contains(key)) << kind << " has no " << key;
}

void expect_open_jd(const json& job) {
  const std::regex identifier("[A-Za-z_][A-Za-z0-9_]{0,63}");
  const auto expect_identifier = [&](const std::string& name) {
    EXPECT_TRUE(std::regex_match(name, identifier)) << name;
  };
  expect_keys(job, "template");
  EXPECT_LE(job["parameterDefinitions"].size(), 50u);
  for (const json& parameter : job["parameterDefinitions"]) {
    expect_keys(parameter, parameter["type"]);
    expect_keys(parameter["userInterface"], "userInterface");
    expect_identifier(parameter["name"]);
    const bool is_folder = parameter.value("objectType", "") == "DIRECTORY";
    const json control = parameter["type"] == "STRING" ? "LINE_EDIT"
                         : is_folder                   ? "CHOOSE_DIRECTORY"
                                                       : "CHOOSE_INPUT_FILE";
    EXPECT_EQ(parameter["userInterface"]["control"], control);
  }
  for (const json& step : job["steps"]) {
    expect_keys(step, "step");
    EXPECT_LE(step["name"].get<std::string>().size(), 64u);
    for (const json& each : step.value("dependencies", json::array())) expect_keys(each, "dependency");
    expect_keys(step["hostRequirements"], "hostRequirements");
    for (const json& each : step["hostRequirements"]["amounts"]) expect_keys(each, "amount");
    if (step.contains("parameterSpace")) {
      expect_keys(step["parameterSpace"], "parameterSpace");
      for (const json& each : step["parameterSpace"]["taskParameterDefinitions"]) {
        expect_keys(each, "task");
        expect_identifier(each["name"]);
      }
    }
    expect_keys(step["script"], "script");
    expect_keys(step["script"]["actions"], "actions");
    expect_keys(step["script"]["actions"]["onRun"], "action");
    expect_keys(step["script"]["actions"]["onRun"]["cancelation"], "cancelation");
  }
}

TEST_F(Schedulers, OpenJdIsAJobTemplateOfTheBaseSpecification) {
  set_names({"it's a \"scene\".glb", "$HOME `id` 日本.glb"});
  plan.paths.push_back({"/disk/views", false, true});
  plan.groups[0].command.push_back("/disk/views/####.exr");
  const std::vector<FarmFile> files = write(Scheduler::kOpenJd);
  const json job = json::parse(text_of(files, "template.json"));
  const json values = json::parse(text_of(files, "parameter_values.json"));
  const json flat = json::parse(text_of(files, "openjd_parameters.json"));
  expect_open_jd(job);
  EXPECT_EQ(job["specificationVersion"], "jobtemplate-2023-09");
  EXPECT_FALSE(job.contains("extensions"));
  EXPECT_LE(job["name"].get<std::string>().size(), 128u);
  std::map<std::string, std::string> value;
  for (const json& each : values["parameterValues"]) value["Param." + each["name"].get<std::string>()] = each["value"];
  ASSERT_EQ(job["parameterDefinitions"].size(), value.size());
  ASSERT_EQ(flat.size(), value.size());  // the command openjd takes one dictionary of strings
  for (const auto& [name, word] : flat.items()) EXPECT_EQ(word, value.at("Param." + name));
  for (const json& each : job["parameterDefinitions"]) {
    EXPECT_TRUE(value.contains("Param." + each["name"].get<std::string>()));
    EXPECT_TRUE(each["type"] == "PATH" || each["type"] == "STRING");
    const json flow = each["name"] == "Output1" ? "OUT" : "IN";
    EXPECT_TRUE(each["type"] != "PATH" || each["dataFlow"] == flow) << each;
  }
  ASSERT_EQ(job["steps"].size(), 2u);
  EXPECT_EQ(job["steps"][0]["parameterSpace"]["taskParameterDefinitions"],
            json::parse(R"([{"name": "Task", "type": "INT", "range": "1-12"}])"));
  EXPECT_EQ(job["steps"][1]["dependencies"], json::parse(R"([{"dependsOn": "frames"}])"));
  value["Task.Param.Task"] = "7";
  for (size_t step = 0; step < 2; step++) {
    const json& action = job["steps"][step]["script"]["actions"]["onRun"];
    EXPECT_EQ(action["cancelation"]["mode"], "NOTIFY_THEN_TERMINATE");
    EXPECT_LE(action["cancelation"]["notifyPeriodInSeconds"], 600);
    std::string lines;
    for (std::string word : action["args"]) {
      EXPECT_LE(word.size(), 1024u);
      for (const auto& [name, to] : value) {
        const size_t at = word.find("{{" + name + "}}");
        if (at != std::string::npos) word.replace(at, name.size() + 4, to);
      }
      EXPECT_EQ(word.find("{{"), std::string::npos) << word;
      lines += word + "\n";
    }
    EXPECT_EQ(lines, expected(step, 7, {"--progress", "openjd"}));
  }
}

}  // namespace
}  // namespace ods
