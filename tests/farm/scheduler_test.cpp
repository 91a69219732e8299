// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What is written for a scheduler is read by the parsers of its language, and each task is run as the scheduler would,
// with a program in the place of ods that says how it was called.
#include "ods/farm/scheduler.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "ods/base/error.h"
#include "ods/base/quote.h"
#include "tests/support/programs.h"
#include "tests/support/temporary_folder.h"

namespace ods {
namespace {

using nlohmann::json;

// Names that break what is quoted badly. Deadline's command line cannot hold all of them.
const std::vector<std::string> kNames = {"it's a \"scene\".glb", "$HOME `id` $(id).glb", "naïve 日本 & <b> #IFRAME.glb",
                                         "back\\slash;|*?.glb"};

class Schedulers : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.write("ods", "#!/bin/sh\nprintf '%s\\n' \"$@\" >\"" + folder.path("said") + "\"\n");
    run_line("chmod +x " + folder.path("ods"));
    set_names(kNames);
  }

  void set_names(const std::vector<std::string>& names) {
    plan = FarmPlan();
    plan.name = "film_1";
    plan.folder = folder.path("film's.farm");
    plan.program = folder.path("ods");
    plan.memory = 3 << 20;
    std::vector<std::string> words = {"video"};
    for (const std::string& name : names) words.push_back("/disk/" + name), plan.paths.push_back({words.back()});
    words.insert(words.end(), {"-o", "/disk/out put.mp4"});
    plan.paths.push_back({"/disk/out put.mp4", true});
    plan.groups = {{"frames", words, "--only", 12}, {"video", words, "", 1}};
    std::filesystem::create_directories(plan.folder);
  }

  std::vector<FarmFile> write(Scheduler scheduler) {
    wishes.mount = "/disk";
    std::vector<FarmFile> files = row_in(kSchedulerTable, scheduler).write(plan, wishes);
    for (const FarmFile& file : files) folder.write("film's.farm/" + file.name, file.text);
    return files;
  }

  std::string text_of(const std::vector<FarmFile>& files, const std::string& name) {
    for (const FarmFile& file : files) {
      if (file.name == name) return file.text;
    }
    ADD_FAILURE() << "there is no " << name;
    return "";
  }

  std::string in_folder(const std::string& name) const { return shell_word(plan.folder + "/" + name); }

  // How a task has to be called, a word per line; more: what the scheduler's own words are, behind the command.
  std::string expected(size_t group, int number, const std::vector<std::string>& more = {}) const {
    const TaskGroup& tasks = plan.groups[group];
    std::string lines;
    for (const std::string& word : tasks.command) lines += word + "\n";
    for (const std::string& word : more) lines += word + "\n";
    if (!tasks.option.empty()) lines += fmt::format("{}\n{}/{}\n", tasks.option, number, tasks.tasks);
    return lines;
  }

  std::string said() const { return folder.read("said"); }

  // What a script of Python makes of a file of the folder.
  std::string by_python(const std::string& script, const std::string& file) const {
    folder.write("script.py", "import sys\ntext = open(sys.argv[1], encoding='utf-8').read()\n" + script);
    return run_line("PYTHONIOENCODING=utf-8 python3 " + folder.path("script.py") + " " + in_folder(file)).out;
  }

  TemporaryFolder folder;
  FarmPlan plan;
  SchedulerWishes wishes;
};

TEST_F(Schedulers, SlurmRunsEveryTaskOnce) {
  wishes.largest_array = 6;
  wishes.extras = {"--partition=render", "--time=2:00:00"};
  plan.cpus = 4;
  const std::vector<FarmFile> files = write(Scheduler::kSlurm);
  ASSERT_EQ(files.size(), 5u);  // 12 tasks in arrays of five
  std::set<std::string> calls;
  for (int array = 1; array <= 3; array++) {
    const std::string name = fmt::format("frames-{}.sbatch", array), text = text_of(files, name);
    EXPECT_NE(text.find("#SBATCH --partition=render\n#SBATCH --time=2:00:00\n"), std::string::npos);
    EXPECT_NE(text.find("#SBATCH --cpus-per-task=4\n"), std::string::npos);
    EXPECT_NE(text.find(fmt::format("#SBATCH --array=1-{}\n", array == 3 ? 2 : 5)), std::string::npos) << text;
    for (int index = 1; index <= (array == 3 ? 2 : 5); index++) {
      const std::string line =
          fmt::format("SLURM_JOB_ID=9 SLURM_CPUS_PER_TASK=4 SLURM_ARRAY_TASK_ID={} sh {}", index, in_folder(name));
      EXPECT_EQ(run_line(line).code, 0);
      EXPECT_EQ(said(), expected(0, 5 * (array - 1) + index, {"--threads", "4"}));
      calls.insert(said());
    }
  }
  EXPECT_EQ(calls.size(), 12u);
  EXPECT_EQ(run_line("SLURM_JOB_ID=9 SLURM_CPUS_ON_NODE=2 sh " + in_folder("video-1.sbatch")).code, 0);
  EXPECT_EQ(said(), expected(1, 1, {"--threads", "2"}));
  EXPECT_EQ(folder.read("film's.farm/ended/frames.12"), "0\n");
}

// sleep is none, or this test would wait.
TEST_F(Schedulers, SlurmTriesAgainWhatMayGetBetter) {
  write(Scheduler::kSlurm);
  for (const auto& [code, tries] : std::map<int, int>{{0, 1}, {1, 3}, {2, 1}, {3, 3}, {4, 3}, {139, 3}}) {
    folder.write("ods", fmt::format("#!/bin/sh\necho x >>{}\nexit {}\n", folder.path("tries"), code));
    folder.write("tries", "");
    folder.write("sleep", "#!/bin/sh\n");
    const std::string line =
        fmt::format("chmod +x {0}/sleep; PATH={0}:$PATH SLURM_JOB_ID=9 SLURM_ARRAY_TASK_ID=2 sh {1}", folder.path(""),
                    in_folder("frames-1.sbatch"));
    EXPECT_EQ(run_line(line).code, code);
    EXPECT_EQ(folder.read("tries").size(), 2u * static_cast<size_t>(tries)) << code;
    EXPECT_EQ(folder.read("film's.farm/ended/frames.2"), fmt::format("{}\n", code));
  }
}

TEST_F(Schedulers, SlurmSendsGroupsInOrderAndCancelsWhatIsAlone) {
  wishes.largest_array = 9;
  write(Scheduler::kSlurm);
  folder.write("sbatch", "#!/bin/sh\nn=$(cat " + folder.path("n") + ")\n[ $n != \"$FAIL\" ] || exit 1\nn=$((n + 1))\n" +
                             "echo $n >" + folder.path("n") + "\nprintf '%s\\n' \"$@\" >>" + folder.path("log") +
                             "\necho \"$n;farm\"\n");
  folder.write("scancel", "#!/bin/sh\necho \"$@\" >" + folder.path("cancelled") + "\n");
  const std::string line =
      fmt::format("chmod +x {0}/sbatch {0}/scancel; PATH={0}:$PATH sh {1}", folder.path(""), in_folder("submit.sh"));
  folder.write("n", "70");
  const Ran all = run_line(line);
  EXPECT_EQ(all.code, 0);
  EXPECT_EQ(all.out,
            "71 frames-1.sbatch ods:frames:0\n72 frames-2.sbatch ods:frames:8\n73 video-1.sbatch ods:video:0\n");
  const std::string log = folder.read("log");
  EXPECT_NE(log.find("--comment=ods:frames:8:" + plan.folder + "\n"), std::string::npos) << log;
  EXPECT_NE(log.find("--dependency=afterok:71:72\n"), std::string::npos) << log;
  folder.write("n", "70");
  EXPECT_NE(run_line("export FAIL=72; " + line).code, 0);
  EXPECT_EQ(folder.read("cancelled"), "71 72\n");
}

TEST_F(Schedulers, OpenJdIsAJobTemplateOfTheBaseSpecification) {
  set_names({"it's a \"scene\".glb", "$HOME `id` 日本.glb"});
  plan.paths.push_back({"/disk/views", false, true});
  plan.groups[0].command.push_back("/disk/views/####.exr");
  const std::vector<FarmFile> files = write(Scheduler::kOpenJd);
  const json job = json::parse(text_of(files, "template.json"));
  const json values = json::parse(text_of(files, "parameter_values.json"));
  EXPECT_EQ(job["specificationVersion"], "jobtemplate-2023-09");
  EXPECT_FALSE(job.contains("extensions"));
  EXPECT_LE(job["name"].get<std::string>().size(), 128u);
  std::map<std::string, std::string> value;
  for (const json& each : values["parameterValues"]) value["Param." + each["name"].get<std::string>()] = each["value"];
  ASSERT_EQ(job["parameterDefinitions"].size(), value.size());
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

// What Cuebot asks for beyond the DTD when it launches a job: names of three characters, layers that a dependency finds
// within its job, where those of type Post are not.
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

// Flamenco runs the script in an engine of its own; node knows the same language.
TEST_F(Schedulers, FlamencoCompilesToTheSameTasks) {
  if (const std::string why = missing("node", "command -v node"); !why.empty()) GTEST_SKIP() << why;
  write(Scheduler::kFlamenco);
  folder.write("stubs.js",
               "const tasks = [];\n"
               "const author = {\n"
               "  Task: (name, type) => ({ name, type, commands: [], after: [],\n"
               "    addCommand(c) { this.commands.push(c); }, addDependency(t) { this.after.push(t.name); } }),\n"
               "  Command: (name, parameters) => ({ name, parameters }),\n"
               "};\n"
               "const job = { settings: {}, addTask: (task) => tasks.push(task) };\n");
  folder.write("run.js",
               "\nfor (const s of JOB_TYPE.settings) job.settings[s.key] = s.default;\ncompileJob(job);\n"
               "console.log(JSON.stringify(tasks));\n");
  const Ran ran = run_line("cd " + folder.path("") + " && cat stubs.js " + in_folder("film_1.js") +
                           " run.js >all.js && node all.js");
  ASSERT_EQ(ran.code, 0) << ran.out;
  const json tasks = json::parse(ran.out);
  ASSERT_EQ(tasks.size(), 13u);
  std::vector<std::string> names;
  for (size_t i = 0; i < tasks.size(); i++) {
    const json& command = tasks[i]["commands"].at(0);
    EXPECT_EQ(tasks[i]["type"], "misc");
    EXPECT_EQ(command["name"], "exec");
    std::vector<std::string> words = {command["parameters"]["exe"]};
    for (const std::string word : command["parameters"]["args"]) words.push_back(word);
    const bool last = i == 12;
    EXPECT_EQ(words, task_words(plan, plan.groups[last ? 1 : 0], last ? 1 : static_cast<int>(i) + 1));
    EXPECT_EQ(tasks[i]["after"], last ? json(names) : json::array());
    names.push_back(tasks[i]["name"]);
  }
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 13u);
}

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
    EXPECT_EQ(spec["podFailurePolicy"]["rules"][1], json::parse(R"({"action": "Ignore",
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
  wishes.mount = "/elsewhere";
  EXPECT_THROW(write_kubernetes(plan, wishes), Error);
  wishes.mount = "/disk", plan.cpus = 0;
  EXPECT_THROW(write_kubernetes(plan, wishes), Error) << "a whole machine cannot be asked for";
}

// A pod's host name is that of the job and its index, at most 63 characters.
TEST_F(Schedulers, KubernetesNamesLeaveRoomForPods) {
  plan.cpus = 1;
  plan.groups[0].tasks = 100'000;
  plan.name = std::string(64, 'x');
  for (const FarmFile& file : write(Scheduler::kKubernetes)) {
    std::smatch name;
    if (!std::regex_search(file.text, name, std::regex("metadata:\n  name: ([a-z0-9-]+)\n"))) continue;
    EXPECT_LE((name[1].str() + "-99999").size(), 63u);
    EXPECT_TRUE(name[1].str().ends_with(file.name.substr(0, file.name.find('.')))) << name[1];
  }
}

// kubectl is ours: "get" answers with the next line of a list, and says nothing behind its end.
TEST_F(Schedulers, KubernetesWaitsForEachJobAndSaysWhatFails) {
  plan.cpus = 3;
  write(Scheduler::kKubernetes);
  folder.write("sleep", "#!/bin/sh\n");
  folder.write("kubectl", "#!/bin/sh\ncd " + shell_word(folder.path("")) + R"sh(
echo "$1 $2 $3" >>log
case $1 in
  get) answer=$(head -n 1 answers); sed -i 1d answers; [ "$answer" != error ] || exit 1; echo "$answer" ;;
  apply) [ ! -f refuse ] || { echo 'field is immutable' >&2; exit 1; } ;;
esac
)sh");
  const auto submit = [&](const std::string& answers) {
    folder.write("answers", answers), folder.write("log", "");
    const Ran ran = run_line(fmt::format("chmod +x {0}/kubectl {0}/sleep; PATH={0}:$PATH timeout 60 sh {1}",
                                         folder.path(""), in_folder("submit.sh")));
    return fmt::format("{}: {}", ran.code, ran.out.substr(0, ran.out.find(':')));
  };
  const std::string get = "get job film-1-frames\n", apply = "apply -f frames.yaml\n",
                    get_video = "get job film-1-video\n";
  EXPECT_EQ(submit("\n\nSuccessCriteriaMet\nSuccessCriteriaMet Complete\n\n\nComplete\n"),
            "0: film-1-frames is complete\nfilm-1-video is complete\n");
  EXPECT_EQ(folder.read("log"),
            get + apply + get + get + get + get_video + "apply -f video.yaml\n" + get_video + get_video);
  EXPECT_EQ(submit("\n\nFailureTarget\nFailureTarget Failed\n"), "1: submit.sh");
  EXPECT_EQ(folder.read("log"), get + apply + get + get + get) << "no video behind frames that failed";
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

TEST_F(Schedulers, DeadlineGetsAPairOfFilesPerJob) {
  if (const std::string why = missing("python3", "command -v python3"); !why.empty()) GTEST_SKIP() << why;
  EXPECT_THROW(write_deadline(plan, wishes), Error) << "it cannot be told of quotes";
  set_names({"a scene's $HOME.glb", "日本 & co.glb"});
  const std::vector<FarmFile> files = write(Scheduler::kDeadline);
  EXPECT_NE(text_of(files, "frames.job_info")
                .find("Plugin=CommandLine\nName=film_1 frames\nBatchName=film_1\n"
                      "Frames=1-12\nChunkSize=1\n"),
            std::string::npos);
  for (size_t group = 0; group < 2; group++) {
    const std::string words = by_python(
        "import shlex\n"
        "line = [l for l in text.split('\\n') if l.startswith('Arguments=')][0][10:].replace('<STARTFRAME>', '5')\n"
        "lexer = shlex.shlex(line, posix=True, punctuation_chars=False)\n"
        "lexer.quotes, lexer.escape, lexer.whitespace_split, lexer.commenters = '\"', '', True, ''\n"
        "for word in lexer: print(word)",
        group == 0 ? "frames.plugin_info" : "video.plugin_info");
    EXPECT_EQ(words, expected(group, 5, {"--progress", "deadline"}));
  }
  folder.write("deadlinecommand", "#!/bin/sh\ncat \"$1\" >>" + folder.path("sent") + "\necho JobID=abc123\n");
  const Ran ran = run_line(
      fmt::format("chmod +x {0}/deadlinecommand; PATH={0}:$PATH sh {1}", folder.path(""), in_folder("submit.sh")));
  EXPECT_EQ(ran.out, "abc123 frames\nabc123 video\n");
  const std::string sent = folder.read("sent");
  EXPECT_GT(sent.find("JobDependencies=abc123\n"), sent.find("Name=film_1 video"));
  EXPECT_NE(sent.find("JobDependencies=abc123\n"), std::string::npos);
}

// It may fail by its exit code, by what it prints, or with the second job only.
TEST_F(Schedulers, DeadlineStopsAtAJobThatIsNotTaken) {
  set_names({"scene.glb"});
  write(Scheduler::kDeadline);
  struct Failure {
    std::string command;
    std::string out;
    size_t asked;
  };
  const std::string why = "submit.sh: deadlinecommand has not taken ";
  const std::vector<Failure> failures = {
      {"echo JobID=abc123; exit 3", "JobID=abc123\n" + why + "frames (exit code 3); nothing behind it was sent\n", 1},
      {"echo 'Error: no plug-in'", "Error: no plug-in\n" + why + "frames (exit code 0); nothing behind it was sent\n",
       1},
      {"case $1 in video*) exit 1 ;; esac; echo JobID=abc-123",
       "abc-123 frames\n\n" + why + "video (exit code 1); nothing behind it was sent\n", 2}};
  for (const Failure& failure : failures) {
    folder.write("asked", "");
    folder.write("deadlinecommand", "#!/bin/sh\necho x >>" + folder.path("asked") + "\n" + failure.command + "\n");
    const Ran ran = run_line(
        fmt::format("chmod +x {0}/deadlinecommand; PATH={0}:$PATH sh {1}", folder.path(""), in_folder("submit.sh")));
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.out, failure.out);
    EXPECT_EQ(folder.read("asked").size(), 2 * failure.asked);
  }
}

// Of a hundred thousand tasks: as long as one of ten, but for Slurm's arrays.
TEST_F(Schedulers, ManyTasksAreFewFiles) {
  plan.groups[0].tasks = 100'000;
  for (const SchedulerRow& row : kSchedulerTable) {
    if (row.member == Scheduler::kDeadline) set_names({"a.glb"}), plan.groups[0].tasks = 100'000;
    wishes.mount = "/disk", plan.cpus = 4;
    const std::vector<FarmFile> files = row.write(plan, wishes);
    EXPECT_TRUE(files.size() <= 5 || row.member == Scheduler::kSlurm) << row.name;
    EXPECT_EQ(files.size() == 102, row.member == Scheduler::kSlurm) << row.name;
    for (const FarmFile& file : files) EXPECT_LT(file.text.size(), 20'000u) << row.name;
  }
}

}  // namespace
}  // namespace ods
