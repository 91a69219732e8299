// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "ods/base/quote.h"
#include "ods/farm/scheduler.h"

namespace ods {

namespace {

// Cuebot requires at least three characters.
std::string job_name(const std::string& plan) {
  return plan.size() < 3 ? "job_" + plan : plan;
}

// Cuebot replaces #IFRAME#, #FRAME#, #LAYER#, #JOB# and more everywhere, and has no way to escape one. Shell quotes are
// placed so that "#" and a name are never adjacent.
std::string cue_word(const std::string& word) {
  std::string parted;
  for (const char c : shell_word(word)) parted += c == '#' ? "#''" : std::string(1, c);
  return parted;
}

// OpenCue fills in #IFRAME#, the task's number. Its own jobs of frames in chunks run over the end. No layer is of type
// Post: Cuebot moves those into a job of their own, where no dependency of this one finds them. Cores without a point
// are hundredths of one.
std::string layer_of(const FarmPlan& plan, const TaskGroup& group) {
  std::vector<std::string> words = {plan.program};
  words.insert(words.end(), group.command.begin(), group.command.end());
  if (plan.cpus > 0) words.insert(words.end(), {"--threads", fmt::format("{}", plan.cpus)});
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + cue_word(word);
  if (!group.option.empty()) line += fmt::format(" {} #IFRAME#/{}", group.option, group.tasks);
  const std::string range = group.tasks == 1 ? "1" : fmt::format("1-{}", group.tasks);
  return fmt::format(R"(      <layer name="{}" type="{}">
        <cmd>{}</cmd>
        <range>{}</range>
        <chunk>1</chunk>
        <cores>{}.0</cores>
        <threadable>true</threadable>
        <memory>{}m</memory>
        <services><service>shell</service></services>
      </layer>
)",
                     group.name, group.option.empty() ? "Util" : "Render", xml_text(line), range, plan.cpus,
                     (memory_of(plan, group) >> 20) + 1);
}

std::string depend_of(const FarmPlan& plan, const TaskGroup& group, const TaskGroup& before) {
  return fmt::format(R"(    <depend type="LAYER_ON_LAYER">
      <depjob>{0}</depjob>
      <deplayer>{1}</deplayer>
      <onjob>{0}</onjob>
      <onlayer>{2}</onlayer>
    </depend>
)",
                     job_name(plan.name), group.name, before.name);
}

}  // namespace

std::vector<FarmFile> write_opencue(const FarmPlan& plan, const SchedulerChoices&) {
  std::string layers, depends;
  for (const TaskGroup& group : plan.groups) {
    layers += layer_of(plan, group);
    if (&group != &plan.groups.front()) depends += depend_of(plan, group, *(&group - 1));
  }
  const std::string text = fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE spec PUBLIC "SPI Cue Specification Language" "http://localhost:8080/spcue/dtd/cjsl-1.15.dtd">
<!-- show, shot, user and uid are yours: sed 's/>SHOW</>ours</; s/>SHOT</>sh010</; s/>USER</>me</; s/>UID</>1000</' -->
<spec>
  <show>SHOW</show>
  <shot>SHOT</shot>
  <user>USER</user>
  <uid>UID</uid>
  <job name="{}">
    <paused>false</paused>
    <maxretries>2</maxretries>
    <layers>
{}    </layers>
  </job>
  <depends>
{}  </depends>
</spec>
)",
                                       job_name(plan.name), layers, depends);
  return {{"job.xml", text}};
}

}  // namespace ods
