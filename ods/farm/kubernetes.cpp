// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"

namespace ods {

namespace {

// Of an object: small letters, digits and "-", at most 63, with an end that is no "-".
std::string object_name(const std::string& plan, const std::string& group) {
  std::string name = plan.substr(0, 62 - group.size()) + "-" + group;
  for (char& c : name) {
    c = std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                                                    : '-';
  }
  return name;
}

// Kubernetes replaces $(NAME) in arguments, and $$ is a $.
std::string argument(const std::string& text) {
  std::string doubled;
  for (const char c : text) doubled += c == '$' ? "$$" : std::string(1, c);
  return json_text(doubled);
}

std::string resources(const FarmPlan& plan) {
  const size_t memory = (plan.memory >> 20) + 1;
  const std::string cpus = plan.cpus > 0 ? fmt::format("cpu: {}, ", plan.cpus) : "";
  return fmt::format("requests: {{{0}memory: {1}Mi}}\n            limits: {{{0}memory: {1}Mi}}", cpus, memory);
}

// An exit code of 2 is a command line that is wrong on every machine; an evicted pod is no failure of its task.
std::string job_of(const FarmPlan& plan, const TaskGroup& group, const SchedulerWishes& wishes) {
  std::vector<std::string> words = {"exec", plan.program};
  words.insert(words.end(), group.command.begin(), group.command.end());
  if (plan.cpus > 0) words.insert(words.end(), {"--threads", fmt::format("{}", plan.cpus)});
  std::string line = shell_line(words);
  if (!group.option.empty()) {
    line += fmt::format(" {} \"$((JOB_COMPLETION_INDEX + 1))/{}\"", group.option, group.tasks);
  }
  return fmt::format(R"(apiVersion: batch/v1
kind: Job
metadata:
  name: {}
spec:
  completionMode: Indexed
  completions: {}
  parallelism: {}
  backoffLimitPerIndex: 2
  podFailurePolicy:
    rules:
      - action: FailJob
        onExitCodes: {{containerName: ods, operator: In, values: [2]}}
      - action: Ignore
        onPodConditions: [{{type: DisruptionTarget}}]
  template:
    spec:
      restartPolicy: Never
      containers:
        - name: ods
          image: {}
          command: ["/bin/sh", "-c", {}]
          resources:
            {}
          volumeMounts: [{{name: files, mountPath: {}}}]
      volumes:
        - name: files
          persistentVolumeClaim: {{claimName: {}}}
)",
                     object_name(plan.name, group.name), group.tasks, std::min(group.tasks, 100),
                     json_text(wishes.image), argument(line), resources(plan), json_text(wishes.mount),
                     json_text(wishes.volume));
}

void check_mount(const FarmPlan& plan, const SchedulerWishes& wishes) {
  for (const PlanPath& path : plan.paths) {
    if (path.path.starts_with(wishes.mount + "/") || wishes.mount == "/") continue;
    throw Error(ErrorKind::kUsage, fmt::format("'{}' is outside '{}', where the pods see the volume: --mount DIR names "
                                               "a folder that has all files, --copy-scene copies the scene",
                                               path.path, wishes.mount));
  }
}

}  // namespace

std::vector<FarmFile> write_kubernetes(const FarmPlan& plan, const SchedulerWishes& wishes) {
  check_mount(plan, wishes);
  std::vector<FarmFile> files;
  std::string submit =
      "#!/bin/sh\n# Applies the jobs, one after the other; kubectl has to know the cluster.\nset -eu\ncd \"$(dirname "
      "\"$0\")\"\n";
  for (const TaskGroup& group : plan.groups) {
    const std::string file = group.name + ".yaml", name = object_name(plan.name, group.name);
    files.push_back({file, job_of(plan, group, wishes)});
    submit += fmt::format("kubectl apply -f {}\n", file);
    if (&group != &plan.groups.back()) {
      submit += fmt::format("kubectl wait --for=condition=complete --timeout=-1s job/{}\n", name);
    }
  }
  files.push_back({"submit.sh", submit});
  return files;
}

}  // namespace ods
