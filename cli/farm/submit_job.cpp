// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/submit_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/console/programs.h"
#include "ods/base/quote.h"
#include "ods/files/atomic_file.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* kSubmitExamples =
    "  ods submit --to slurm -- video scene.glb -o scene_360_TB.mp4 --quality final\n"
    "  ods submit --to slurm -- render scene.glb -o huge.exr --width 16384 --samples 1024 --parts 64\n"
    "  ods submit --to slurm --chunk 25 -- stitch rig.json 'views/####/####.exr' --frames 1-500 -o 'out.####.exr'\n"
    "  ods submit --to slurm --chunk 25 -- convert 'shot_TB.####.exr' -o 'cubes.####.png' --to cube-3x2\n"
    "  ods submit --to openjd -o bundle --chunk 10 -- video scene.glb -o film_360_TB.mp4\n"
    "  ods submit --to slurm --dry-run --chunk 10 -- video scene.glb -o scene_360_TB.mp4";

constexpr const char* kSubmitSummary =
    "Sends a command to a render farm; the result has the same bits as on one machine. It splits video, render,\n"
    "stitch, convert and over into many tasks (frames in chunks, parts of a picture's samples, views of a rig) and a\n"
    "last one, such as the video or the merge; denoise, merge, encode, inject and lint are one task. It writes a\n"
    "plan and the scheduler's files into a folder, and for Slurm also submits the job.";

void check_line(const std::string& option, const std::string& value) {
  if (!ods::is_quotable(value))
    throw UsageError(fmt::format("{} has a line break or bytes that are not UTF-8", option));
}

void add_options(Options& options, SubmitJob& job) {
  options.choice("--to", job.to, ods::kSchedulerTable, "the scheduler");
  options.text("-o,--output", ValueKind::output_folder(), job.folder,
               "folder for the plan and the scheduler's files; by default NAME.farm beside the command's output");
  options.flag("--dry-run", job.dry, "write nothing, send nothing: print what would be sent");
  options.group("Tasks");
  options.number("--chunk", job.chunk, 0, 1000000,
                 "frames per task; 0: as many as take ten minutes, judged by the first one, which is made here");
  options.flag("--raw-first", job.raw_first,
               "for videos that are denoised: render every frame once, then denoise them all; by default if that is "
               "cheaper than rendering the neighbours of each task's frames twice");
  options.text("--name", "NAME", job.name, "name of the job; by default that of the command's output");
  options.number("--cpus", job.cpus, 0, 1024, "processors per task, like --threads of the command; 0: a whole machine");
  options.number("--memory", job.memory, 0.1f, 4096.0f, "memory per task in GB; by default an estimate");
  options.text("--program", "PATH", job.program,
               "the program ods on the farm's machines; by default this program's path for slurm, else ods");
  options.flag("--copy-scene", job.copies,
               "copy the scene and all other input into the folder, for machines that cannot read the originals");
  options.group("Schedulers");
  options.texts("--sbatch", "OPTION", job.choices.extras, "slurm: an option of sbatch, '--partition=render'");
  options.text("--image", "NAME", job.choices.image, "kubernetes: image of the containers");
  options.text("--volume", "CLAIM", job.choices.volume, "kubernetes: claim of the volume that has the files");
  options.text("--mount", ValueKind::input_folder(), job.choices.mount,
               "kubernetes: where that volume is mounted; by default the current folder's path");
  options.group("Console");
  add_console_options(options);
}

}  // namespace

SubmitJob parse_submit(Options& options) {
  SubmitJob job;
  job.command = options.take_rest();
  options.describe(kSubmitSummary, kSubmitExamples);
  std::vector<std::string> extras;
  options.arguments("COMMAND", extras, "after all options of ods submit and --: the command, without the word ods");
  add_options(options, job);
  options.parse();
  if (!extras.empty()) {
    throw UsageError(fmt::format("'{}' belongs after --, as in: ods submit --to slurm -- video ...", extras[0]));
  }
  if (!job.to) {
    throw UsageError(fmt::format("no scheduler: add --to {}", fmt::join(ods::names_of(ods::kSchedulerTable), "|")));
  }
  for (const std::string& extra : job.choices.extras) {
    check_line("--sbatch", extra);
    if (!extra.starts_with("-"))
      throw UsageError(fmt::format("--sbatch is an option, such as --time=2:00:00, not '{}'", extra));
  }
  check_line("--image", job.choices.image);
  check_line("--volume", job.choices.volume);
  if (!job.command.empty() && job.command.front() == "ods") job.command.erase(job.command.begin());
  if (job.program.empty()) job.program = job.to == ods::Scheduler::kSlurm ? own_program() : "ods";
  job.choices.mount = ods::absolute_folder(job.choices.mount.empty() ? "." : job.choices.mount);
  return job;
}

std::string usual_folder(const std::string& output) {
  const fs::path path(output);
  std::string name = path.filename().native();
  name = name.substr(0, name.find_first_of("#@%${"));
  if (name.size() == path.filename().native().size()) name = path.stem().native();
  while (!name.empty() && (name.back() == '.' || name.back() == '_' || name.back() == '-')) name.pop_back();
  return (path.parent_path() / ((name.empty() ? "frames" : name) + ".farm")).native();
}

ods::FarmPlan make_plan(const SubmitJob& job, const SplitCommand& split) {
  ods::FarmPlan plan;
  const std::string usual = usual_folder(split.output);
  plan.folder = ods::absolute_folder(job.folder.empty() ? usual : job.folder);
  plan.name = ods::plan_name(job.name.empty() ? fs::path(usual).stem().native() : job.name);
  plan.program = job.program;
  plan.scheduler = ods::name_in(ods::kSchedulerTable, *job.to);
  plan.cpus = job.cpus > 0 ? job.cpus : split.threads.value_or(0);
  plan.memory = job.memory ? static_cast<size_t>(static_cast<double>(*job.memory) * 1e9) : split.memory;
  plan.paths = split.paths;
  plan.groups = split.groups;
  if (!job.memory) return plan;
  for (ods::TaskGroup& group : plan.groups) group.memory = 0;
  return plan;
}

// Seconds that a frame takes: the first one is made here.
static double time_first(const SplitCommand& split) {
  std::vector<std::string> words = {kThisProgram};
  const ods::TaskGroup& group = split.groups.front();
  words.insert(words.end(), group.command.begin(), group.command.end());
  words.insert(words.end(), {group.option, fmt::format("{}", split.numbers.front()), "-q"});
  note(fmt::format("making {} {} here to measure its time; --chunk N does without", split.noun, split.numbers.front()));
  const auto start = std::chrono::steady_clock::now();
  const auto result = run_program({.words = words, .shows_errors = true});
  if (!result || result->code != 0) {
    throw ods::Error(ods::ErrorKind::kInput, fmt::format("{} {} cannot be made: {}", split.noun, split.numbers.front(),
                                                         ods::shell_line({words.begin() + 1, words.end()})));
  }
  const int rendered = split.count > 1 ? 1 + split.halo : 1;
  const double seconds = std::max(seconds_since(start), 1e-3);
  note(fmt::format("it took {}", duration_text(seconds)));
  return seconds / rendered;
}

static bool has_room_for_raw(const SplitCommand& split) {
  std::error_code error;
  const fs::space_info space = fs::space(ods::existing_folder_of(split.output), error);
  return !error && split.disk <= space.available;
}

// A task that denoises reads the frames beside its own, too: it has as many as keep that cheap.
static void put_raw_first(const SplitCommand& split, int chunk, ods::FarmPlan& plan) {
  ods::TaskGroup raw = *split.raw;
  raw.tasks = ods::tasks_for(split.count, chunk);
  plan.groups.front().tasks = ods::tasks_for(split.count, std::max(chunk, ods::min_chunk(split.halo)));
  plan.groups.insert(plan.groups.begin(), raw);
}

void count_tasks(const SubmitJob& job, const SplitCommand& split, ods::FarmPlan& plan) {
  int& tasks = plan.groups.front().tasks;
  if (job.raw_first && !split.raw) throw UsageError("--raw-first is for videos that ods denoises over time");
  if (split.noun == "part" || split.groups.front().option.empty()) {
    tasks = static_cast<int>(split.count);
    return;
  }
  int chunk = job.chunk > 0 ? job.chunk : 10;
  bool raw_first = job.raw_first;
  if (job.chunk == 0 && job.dry) note("--dry-run measures no first frame, and assumes tasks of ten (--chunk N)");
  if (job.chunk == 0 && !job.dry) {
    const double seconds = time_first(split);
    raw_first |= split.raw && has_room_for_raw(split) &&
                 ods::raw_first_is_cheaper(seconds, split.count, split.halo, split.disk / split.count);
    chunk = ods::suitable_chunk(seconds, split.count, raw_first ? 0 : split.halo);
    note(fmt::format("tasks of {} (--chunk {})", chunk, chunk));
  }
  if (raw_first) return put_raw_first(split, chunk, plan);
  tasks = ods::tasks_for(split.count, chunk);
}
