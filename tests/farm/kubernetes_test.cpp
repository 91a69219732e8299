// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "ods/base/error.h"
#include "tests/support/schedulers.h"

namespace ods {
namespace {

using nlohmann::json;

TEST_F(Schedulers, KubernetesIsAnIndexedJobThatStopsOnWrongCommands) {
  if (const std::string why = missing("python3-yaml", "python3 -c 'import yaml'"); !why.empty()) GTEST_SKIP() << why;
  plan.cpus = 3;
  const std::vector<FarmFile> files = write(Scheduler::kKubernetes);
  for (size_t group = 0; group < 2; group++) {
    const std::string file = group == 0 ? "frames.yaml" : "video.yaml";
    const json job = json::parse(by_python("import yaml, json\nprint(json.dumps(yaml.safe_load(text)))", file));
    EXPECT_EQ(job["apiVersion"], "batch/v1");
    EXPECT_EQ(job["metadata"]["name"], group == 0 ? "film-1-frames" : "film-1-video");
    const json& spec = job["spec"];
    EXPECT_EQ(spec["completionMode"], "Indexed");
    EXPECT_EQ(spec["completions"], group == 0 ? 12 : 1);
    EXPECT_EQ(spec["backoffLimitPerIndex"], 2);
    EXPECT_EQ(spec["podFailurePolicy"]["rules"][0], json::parse(R"({"action": "FailJob",
                "onExitCodes": {"containerName": "ods", "operator": "In", "values": [2]}})"));
    EXPECT_EQ(spec["podFailurePolicy"]["rules"][1], json::parse(R"({"action": "FailIndex",
                "onExitCodes": {"containerName": "ods", "operator": "In", "values": [5]}})"));
    EXPECT_EQ(spec["podFailurePolicy"]["rules"][2], json::parse(R"({"action": "Ignore",
                "onPodConditions": [{"type": "DisruptionTarget", "status": "True"}]})"));
    EXPECT_EQ(spec["template"]["spec"]["restartPolicy"], "Never");  // as podFailurePolicy wants
    const json& container = spec["template"]["spec"]["containers"][0];
    EXPECT_EQ(container["resources"]["limits"], json::parse(R"({"cpu": 3, "memory": "4Mi"})"));
    EXPECT_EQ(container["resources"]["requests"], container["resources"]["limits"]);
    EXPECT_EQ(container["command"][0], "/bin/sh");
    std::string line = container["command"][2];
    for (size_t at = 0; (at = line.find("$$", at)) != std::string::npos; at++) line.erase(at, 1);  // as Kubernetes does
    EXPECT_EQ(run_line("JOB_COMPLETION_INDEX=6 sh -c " + shell_word(line)).code, 0);
    EXPECT_EQ(said(), expected(group, 7, {"--threads", "3"}));
  }
  plan.paths = {{"/disk", false, true}};  // of frames in the mounted folder itself
  EXPECT_NO_THROW(write_kubernetes(plan, choices));
  for (const char* path : {"/", "/disks", "/dis", "/elsewhere/disk"}) {
    plan.paths = {{path, false, true}};
    EXPECT_THROW(write_kubernetes(plan, choices), Error) << path;
  }
  plan.paths.clear(), plan.cpus = 0;
  EXPECT_THROW(write_kubernetes(plan, choices), Error) << "a whole machine cannot be asked for";
}

// Its classes are made from the published OpenAPI schema.
TEST_F(Schedulers, KubernetesModelsTakeEveryJob) {
  const std::string models = "node -e \"require('kubernetes-models/batch/v1')\"";
  if (const std::string why = missing("kubernetes-models in NODE_PATH", models); !why.empty()) GTEST_SKIP() << why;
  plan.cpus = 3;
  plan.groups.insert(plan.groups.begin(), plan.groups.front());
  plan.groups.front().name = "raw";
  write(Scheduler::kKubernetes);
  folder.write("judge.js", R"js(
const { Job } = require('kubernetes-models/batch/v1');
const job = JSON.parse(require('fs').readFileSync(0, 'utf8'));
try { new Job(job).validate(); console.log('valid'); } catch (error) { console.log(error.message); }
)js");
  const auto judge = [&](const std::string& json_text) {
    folder.write("job.json", json_text);
    return run_line("node " + folder.path("judge.js") + " <" + folder.path("job.json")).out;
  };
  for (const char* group : {"raw", "frames", "video"}) {
    json job = json::parse(
        by_python("import yaml, json\nprint(json.dumps(yaml.safe_load(text)))", std::string(group) + ".yaml"));
    EXPECT_EQ(judge(job.dump()), "valid\n");
    job["spec"]["podFailurePolicy"]["rules"][2]["onPodConditions"][0].erase("status");
    EXPECT_NE(judge(job.dump()).find("must have required property"), std::string::npos);
  }
}

// A pod's host name is the job's name and its index, its own name has five more random characters; both have at most 63
// characters.
TEST_F(Schedulers, KubernetesNamesLeaveRoomForPods) {
  plan.cpus = 1;
  plan.groups[0].tasks = 100'000;
  plan.name = std::string(64, 'x');
  for (const FarmFile& file : write(Scheduler::kKubernetes)) {
    std::smatch name;
    if (!std::regex_search(file.text, name, std::regex("metadata:\n  name: ([a-z0-9-]+)\n"))) continue;
    EXPECT_LE((name[1].str() + "-99999-abcde").size(), 63u);
    EXPECT_TRUE(name[1].str().ends_with(file.name.substr(0, file.name.find('.')))) << name[1];
  }
}

// kubectl is ours: "get" answers with the next line of a list, and nothing after its end.
TEST_F(Schedulers, KubernetesWaitsForEachJobAndSaysWhatFails) {
  plan.cpus = 3;
  write(Scheduler::kKubernetes);
  folder.write("sleep", "#!/bin/sh\n");
  folder.write("kubectl", "#!/bin/sh\ncd " + shell_word(folder.path("")) + R"sh(
echo "$1 $2 $3" >>log
case $1 in
  get) [ "$2" != pods ] || { cat codes; exit; }
       answer=$(head -n 1 answers); sed -i 1d answers; [ "$answer" != error ] || exit 1; echo "$answer" ;;
  apply) [ ! -f refuse ] || { echo 'field is immutable' >&2; exit 1; } ;;
esac
)sh");
  const auto submit = [&](const std::string& answers) {
    folder.write("answers", answers), folder.write("log", "");
    const Ran ran = run_line(fmt::format("chmod +x {0}/kubectl {0}/sleep; PATH={0}:$PATH timeout 60 sh {1}",
                                         folder.path(""), in_folder("submit.sh")));
    return fmt::format("{}: {}", ran.code, ran.out.substr(0, ran.out.find(':')));
  };
  folder.write("codes", "0 1");
  const std::string get = "get job film-1-frames\n", apply = "apply -f frames.yaml\n",
                    get_video = "get job film-1-video\n";
  EXPECT_EQ(submit("\n\nSuccessCriteriaMet\nSuccessCriteriaMet Complete\n\n\nComplete\n"),
            "0: film-1-frames is complete\nfilm-1-video is complete\n");
  EXPECT_EQ(folder.read("log"),
            get + apply + get + get + get + get_video + "apply -f video.yaml\n" + get_video + get_video);
  EXPECT_EQ(submit("\n\nFailureTarget\nFailureTarget Failed\n"), "1: submit.sh");
  const std::string get_codes = "get pods --selector=job-name=film-1-frames\n";
  EXPECT_EQ(folder.read("log"), get + apply + get + get + get + get_codes) << "no video behind frames that failed";
  folder.write("codes", "0 5");
  EXPECT_EQ(submit("\n\nFailureTarget Failed\n"), "5: film-1-frames has found a fault");
  EXPECT_EQ(submit("FailureTarget Failed\nerror\nerror\nComplete\nComplete\nComplete\n"),
            "0: film-1-frames is complete\nfilm-1-video is complete\n");
  EXPECT_TRUE(folder.read("log").starts_with(get + "delete job film-1-frames\n" + apply)) << folder.read("log");
  std::string down = "\n";
  for (int i = 0; i < 20; i++) down += "error\n";
  EXPECT_EQ(submit(down), "1: submit.sh") << "of a cluster that is gone";
  EXPECT_EQ(submit("error\n"), "1: ");
  EXPECT_EQ(folder.read("log"), get);
  folder.write("refuse", "");
  EXPECT_EQ(submit("\n"), "1: field is immutable\nsubmit.sh");
}

}  // namespace
}  // namespace ods
