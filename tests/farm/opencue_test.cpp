// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/support/schedulers.h"

namespace ods {
namespace {

using nlohmann::json;

// The elements of the published cjsl-1.15, by what they hold; all others hold text.
const std::map<std::string, std::string> kElements = {
    {"spec", "facility?, dept?, show, shot, user, email?, uid?, job*, depends*"},
    {"job", "paused?, priority?, maxretries?, maxcores?, maxgpus?, autoeat?, localbook?, os?, env*, layers?"},
    {"layers", "layer+"},
    {"layer",
     "cmd, range, chunk, cores?, threadable?, memory?, gpus?, gpu?, gpu_memory?, timeout?, timeout_llu?, tags?, "
     "limits?, env*, services?, outputs*"},
    {"limits", "limit+"},
    {"services", "service+"},
    {"outputs", "output*"},
    {"env", "key*"},
    {"depends", "depend*"},
    {"depend", "depjob, deplayer?, depframe?, onjob, onlayer?, onframe?"}};
const std::map<std::string, std::string> kAttributes = {
    {"job", "name NMTOKEN #REQUIRED"},
    {"localbook",
     "host NMTOKEN #REQUIRED cores NMTOKEN #REQUIRED memory NMTOKEN #REQUIRED threads NMTOKEN #REQUIRED "
     "gpu NMTOKEN #REQUIRED"},
    {"layer", "name NMTOKEN #REQUIRED type (Render | Util | Post) #REQUIRED"},
    {"output", "name NMTOKEN #REQUIRED"},
    {"key", "name NMTOKEN #REQUIRED"},
    {"depend",
     "anyframe NMTOKEN #IMPLIED type (LAYER_ON_SIM_FRAME | PREVIOUS_FRAME | JOB_ON_JOB | JOB_ON_LAYER | JOB_ON_FRAME | "
     "LAYER_ON_JOB | LAYER_ON_FRAME | LAYER_ON_LAYER | FRAME_ON_JOB | FRAME_ON_LAYER | FRAME_ON_FRAME | "
     "FRAME_BY_FRAME) #REQUIRED"}};

std::string dtd_of_opencue() {
  std::set<std::string> leaves;
  std::string dtd;
  for (const auto& [name, content] : kElements) {
    dtd += fmt::format("<!ELEMENT {} ({})>\n", name, content);
    const std::regex word("\\w+");
    for (auto it = std::sregex_iterator(content.begin(), content.end(), word); it != std::sregex_iterator(); ++it) {
      if (!kElements.contains(it->str())) leaves.insert(it->str());
    }
  }
  for (const std::string& leaf : leaves) dtd += fmt::format("<!ELEMENT {} (#PCDATA)*>\n", leaf);
  for (const auto& [name, attributes] : kAttributes) dtd += fmt::format("<!ATTLIST {} {}>\n", name, attributes);
  return dtd;
}

// Cuebot's requirements beyond the DTD when it launches a job: names of three characters, dependencies on layers of the
// same job, except layers of type Post.
constexpr const char* kCuebot = R"py(import re, xml.etree.ElementTree as E
spec = E.fromstring(text)
def name_of(name):
    name = name.lower().replace('-', '_')
    if not re.fullmatch(r'[\w.]{3,}', name): print('bad name', name)
    return name
found = set()
for job in spec.iter('job'):
    layers = [l for l in job.iter('layer') if l.get('type') != 'Post']
    if not layers: print('no layers')
    found |= {(name_of(job.get('name')), name_of(l.get('name'))) for l in layers}
for d in spec.iter('depend'):
    for side in ('dep', 'on'):
        key = (name_of(d.find(side + 'job').text), name_of(d.find(side + 'layer').text))
        if key not in found: print('no such layer', key)
for cores in spec.iter('cores'):
    print('points', round(100 * float(cores.text)) if '.' in cores.text else int(cores.text))
)py";

TEST_F(Schedulers, OpenCueIsValidAndCuebotLaunchesIt) {
  for (const char* program : {"xmllint", "python3"}) {
    const std::string why = missing(program, std::string("command -v ") + program);
    if (!why.empty()) GTEST_SKIP() << why;
  }
  folder.write("cue.dtd", dtd_of_opencue());
  const FarmPlan film = plan;
  for (const bool lone : {false, true}) {
    plan = film;
    plan.cpus = 8;
    if (lone) plan.name = "a", plan.groups.erase(plan.groups.begin());  // a command that is one task
    const std::string text = text_of(write(Scheduler::kOpenCue), "job.xml");
    EXPECT_NE(text.find("\"http://localhost:8080/spcue/dtd/cjsl-1.15.dtd\""), std::string::npos) << text;
    const Ran valid =
        run_line("xmllint --nonet --noout --dtdvalid " + folder.path("cue.dtd") + " " + in_folder("job.xml"));
    EXPECT_EQ(valid.code, 0) << valid.out;
    EXPECT_EQ(by_python(kCuebot, "job.xml"), lone ? "points 800\n" : "points 800\npoints 800\n") << text;
  }
}

// Cuebot replaces its tokens in the text, before the shell sees it.
TEST_F(Schedulers, OpenCueFillsInNothingOfANameOfOurs) {
  set_names({"#IFRAME#.glb", "a #ZFRAME# b", "#LAYER#", "#JOB#", "it's#FRAME#", "##FRAME_START##"});
  const std::string text = text_of(write(Scheduler::kOpenCue), "job.xml");
  const size_t begin = text.find("<cmd>"), end = text.find("</cmd>");
  const std::string command = text.substr(begin + 5, end - begin - 5);
  static const std::regex token("#[A-Z_]+#");
  const auto count = std::distance(std::sregex_iterator(command.begin(), command.end(), token), std::sregex_iterator());
  EXPECT_EQ(count, 1) << command << ": the task's number";
  std::string line = std::regex_replace(command, token, "11");
  line = std::regex_replace(std::regex_replace(line, std::regex("&gt;"), ">"), std::regex("&quot;"), "\"");
  EXPECT_EQ(run_line(line).code, 0) << line;
  EXPECT_EQ(said(), expected(0, 11));
}

TEST_F(Schedulers, OpenCuesCommandsAreOurs) {
  if (const std::string why = missing("python3", "command -v python3"); !why.empty()) GTEST_SKIP() << why;
  write(Scheduler::kOpenCue);
  const std::string commands = by_python(
      "import xml.etree.ElementTree as E, json\n"
      "print(json.dumps([[l.get('name'), l.find('cmd').text, l.find('range').text] for l in "
      "E.fromstring(text).iter('layer')]))",
      "job.xml");
  const json layers = json::parse(commands);
  ASSERT_EQ(layers.size(), 2u) << commands;
  EXPECT_EQ(layers[0][2], "1-12");
  for (size_t group = 0; group < 2; group++) {
    std::string line = layers[group][1];
    const size_t at = line.find("#IFRAME#");
    if (group == 0) line.replace(at, 8, "11");
    EXPECT_EQ(run_line(line).code, 0);
    EXPECT_EQ(said(), expected(group, 11));
  }
}

}  // namespace
}  // namespace ods
