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

// Names an object: small letters, digits and "-", with an end that is not "-". A pod's host name appends the task's
// number, its own name five random characters more; both are at most 63 long.
std::string object_name(const std::string& plan, const std::string& group) {
  const size_t kLongest = 63 - std::string("-1000000-abcde").size();
  std::string name = plan.substr(0, kLongest - 1 - group.size()) + "-" + group;
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

std::string resources(const FarmPlan& plan, const TaskGroup& group) {
  const std::string both = fmt::format("{{cpu: {}, memory: {}Mi}}", plan.cpus, (memory_of(plan, group) >> 20) + 1);
  return fmt::format("requests: {0}\n            limits: {0}", both);
}

// An exit code of 2 is a command line that is wrong on every machine, 5 a verdict, which is the same on all; an evicted
// pod is not a failure of its task.
std::string job_of(const FarmPlan& plan, const TaskGroup& group, const SchedulerChoices& choices) {
  std::vector<std::string> words = {"exec", plan.program};
  words.insert(words.end(), group.command.begin(), group.command.end());
  words.insert(words.end(), {"--threads", fmt::format("{}", plan.cpus)});
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
      - action: FailIndex
        onExitCodes: {{containerName: ods, operator: In, values: [5]}}
      - action: Ignore
        onPodConditions: [{{type: DisruptionTarget, status: "True"}}]
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
                     json_text(choices.image), argument(line), resources(plan, group), json_text(choices.mount),
                     json_text(choices.volume));
}

void check_mount(const FarmPlan& plan, const SchedulerChoices& choices) {
  for (const PlanPath& path : plan.paths) {
    if (path.path == choices.mount || path.path.starts_with(choices.mount + "/") || choices.mount == "/") continue;
    throw Error(ErrorKind::kUsage, fmt::format("'{}' is outside '{}', where the pods see the volume: --mount DIR names "
                                               "a folder that has all files, --copy-scene copies the scene",
                                               path.path, choices.mount));
  }
}

constexpr const char* kKubernetesSubmit = R"sh(#!/bin/sh
# Sends the jobs to the cluster that kubectl knows, each when the one before is complete, and waits for the last; ends
# with 1 when one fails, with 5 when one has judged its input and found a fault. Started again it resumes: it waits for
# a job that runs, and sends one that has ended again, whose tasks skip what is there.
set -eu
cd "$(dirname "$0")"
die() {
  echo "submit.sh: $*" >&2
  exit 1
}
look() {  # JOB OPTION...: sets ended
  conditions=$(kubectl get job "$@" --output='jsonpath={.status.conditions[?(@.status=="True")].type}') || return 1
  case " $conditions " in
    *" Complete "*) ended=complete ;;
    *" Failed "*) ended=failed ;;
    *) ended=no ;;
  esac
}
found_fault() {  # JOB
  codes=$(kubectl get pods --selector="job-name=$1" \
    --output='jsonpath={.items[*].status.containerStatuses[*].state.terminated.exitCode}')
  case " $codes " in *" 5 "*) ;; *) return 1 ;; esac
}
run() {  # JOB FILE
  look "$1" --ignore-not-found
  [ $ended = no ] || kubectl delete job "$1"
  kubectl apply -f "$2" ||
    die "kubectl has not taken $2; if $1 runs with other numbers or is another's: kubectl delete job $1, or another --name"
  misses=0
  while :; do
    if look "$1"; then misses=0; else misses=$((misses + 1)); fi
    [ $misses -lt 12 ] || die "kubectl get job $1 has failed for a minute"
    [ $misses != 0 ] || [ $ended = no ] || break
    sleep 5
  done
  if [ $ended = failed ] && found_fault "$1"; then
    echo "$1 has found a fault: kubectl logs --selector=job-name=$1"
    exit 5
  fi
  [ $ended = complete ] || die "$1 has failed: kubectl describe job $1; kubectl logs --selector=job-name=$1"
  echo "$1 is complete"
}
)sh";

}  // namespace

std::vector<FarmFile> write_kubernetes(const FarmPlan& plan, const SchedulerChoices& choices) {
  check_mount(plan, choices);
  if (plan.cpus == 0) {
    throw Error(ErrorKind::kUsage,
                "Kubernetes cannot request a whole machine: --cpus N sets how many of its processors");
  }
  std::vector<FarmFile> files;
  std::string submit = kKubernetesSubmit;
  for (const TaskGroup& group : plan.groups) {
    const std::string file = group.name + ".yaml";
    files.push_back({file, job_of(plan, group, choices)});
    submit += fmt::format("run {} {}\n", object_name(plan.name, group.name), file);
  }
  files.push_back({"submit.sh", submit});
  return files;
}

}  // namespace ods
