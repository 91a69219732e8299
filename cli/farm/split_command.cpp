// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/farm/split_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <numeric>

#include "cli/camera/stitch_frames.h"
#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/farm/command_words.h"
#include "cli/options/picture_options.h"
#include "cli/render/plan.h"
#include "cli/render/render_frames.h"
#include "cli/render/render_with_cycles.h"
#include "cli/video/video_job.h"
#include "ods/base/names.h"
#include "ods/base/suggest.h"
#include "ods/files/frames.h"
#include "ods/render/part_file.h"
#include "ods/render/render_target.h"
#include "ods/scene/builtin/builtin.h"
#include "ods/scene/gltf/gltf.h"
#include "ods/sequence/frame_renderer.h"
#include "ods/sequence/identity.h"
#include "ods/sequence/video_journal.h"

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

const Words kByFarm = {"--threads", "--progress", "--wait", "--only", "--skip-existing", "--restart", "--raw", "-q"};
const Words kByMachine = {"--threads", "--progress"};
const Words kLate = {"--wait", "120"};  // seconds until network disks show another machine's files

// The arguments of a command, without its name.
Options options_of(const Words& words) {
  return Options(words.front(), {words.begin() + 1, words.end()});
}

// The files of the scene beside it, which have to be there, too.
void add_scene_files(SplitCommand& split, const SceneSource& scene) {
  if (ods::find_builtin(scene.name) || scene.foreign) return;
  const fs::path folder = fs::absolute(scene.name).lexically_normal().parent_path();
  std::vector<ods::PlanPath> files;
  for (const std::string& file : ods::gltf_files(scene.name, confining_folder(scene))) {
    files.push_back({(folder / file).lexically_normal().native(), false, false});
    split.scene_files.push_back(files.back().path);
  }
  check_inputs(files);
  if (!files.empty()) split.paths.push_back({folder.native(), false, true});
}

size_t bytes_of_files(const SplitCommand& split) {
  size_t bytes = 0;
  std::error_code ignored;
  for (const ods::PlanPath& path : split.paths) {
    if (!path.is_output && !path.is_folder) bytes += static_cast<size_t>(fs::file_size(path.path, ignored));
  }
  for (const std::string& file : split.scene_files) bytes += static_cast<size_t>(fs::file_size(file, ignored));
  return bytes;
}

// The picture, the libraries, and a scene that is decoded and has its acceleration structure. A denoised frame of a
// video has two beside it.
size_t memory_of(const SplitCommand& split, const RenderJob& job) {
  const size_t picture = ods::picture_bytes(plan(job).sampled);
  const size_t pictures = job.time.is_video ? 3 : 1;
  return (size_t{512} << 20) + pictures * picture + picture / 2 + 8 * bytes_of_files(split);
}

SplitCommand begin(std::vector<GivenWord>& given) {
  refuse(given, {"--only", "--part", "--raw"}, "that is what ods submit adds to every task");
  SplitCommand split;
  for (const GivenWord& word : given) {
    if (word.name == "--threads") split.threads = std::stoi(word.value);
  }
  split.paths = find_paths(given);
  check_inputs(split.paths);
  const auto output = std::ranges::find(given, "-o", &GivenWord::name);
  if (output != given.end()) split.output = output->value;
  return split;
}

void count(SplitCommand& split, const std::string& noun, const std::vector<int>& numbers) {
  if (numbers.empty()) throw UsageError("there is nothing to make");
  split.noun = noun, split.count = numbers.size(), split.numbers = numbers;
}

// The group that is split; its tasks are not counted yet. files: the names of the files that it makes.
ods::TaskGroup split_group(const SplitCommand& split, const std::string& name, Words command, const std::string& option,
                           const std::string& files) {
  if (files.find("%V") != std::string::npos) return {name, std::move(command), option};  // two files each
  return {name, std::move(command), option, 1, 0, files, ods::frames_text(split.numbers)};
}

// --- the commands ---------------------------------------------------------------------------------------------------

SplitCommand split_video(const Words& words) {
  Options options = options_of(words);
  const VideoJob job = settled(parse_video(options));
  std::vector<GivenWord> given = job.render.given;
  const bool has_rig = !job.rig.empty();
  SplitCommand split = begin(given);
  if (!has_rig) add_scene_files(split, job.render.scene);
  ods::Settings settings;
  std::vector<int> frames;
  if (has_rig) {
    const ods::SlitRig rig = open_rig(job.rig);
    const ods::VideoPlan plan = expect_video(job.render.save.layout, rig.eyes.size(), rig.eye, rig.camera.projection);
    encode_options(job.video, plan.size, 0);
    settings = stitch_identity(job.rig, given.front().value, job.render.save.layout);
    if (job.render.time.frames.empty()) throw UsageError("--rig needs --frames: the numbers of the views' folders");
    frames = ods::parse_frames(job.render.time.frames);
  } else {
    const ods::VideoPlan plan =
        expect_video(job.render.save.layout, ods::eye_list(job.render.render.eyes).size(),
                     {job.render.render.width, job.render.render.height}, job.render.camera.stereo.projection);
    encode_options(job.video, plan.size, 0);
    settings = job.render.cycles ? cycles_identity(job.render) : frame_identity(identified(job.render));
    frames = frames_of(job.render);
  }
  split.memory = memory_of(split, job.render);
  split.restart = job.restart;
  split.halo = !has_rig && plan(job.render).sequence.draws_on_neighbours ? 1 : 0;
  count(split, "frame", frames);
  split.prepare = [output = split.output, settings, frames, restart = job.restart] {
    ods::VideoJournal(output, settings, restart, ods::JournalUse::kShared).plan(frames, frames);
  };
  given = without(given, kByFarm);
  const std::string pattern = ods::frame_pattern(split.output);
  if (split.halo > 0) {
    split.raw = split_group(split, kRawGroup, command_words("video", given, {"--raw"}), "--only",
                            pattern + std::string(ods::kRawEnd));
    split.disk = frames.size() * ods::samples_bytes(plan(job.render).sampled);
  }
  split.groups = {split_group(split, "frames", command_words("video", given), "--only", pattern),
                  {"video", command_words("video", given, kLate), ""}};
  return split;
}

// Options for the use of the samples: the merge gets them.
const Words kOfMerge = {"--layout", "--sidecar", "--statistics", "--denoise", "--brighter", "--tone"};

void remove_parts(const ods::FrameNames& names, const std::vector<int>& parts) {
  std::error_code ignored;
  if (!fs::is_directory(fs::path(names.before).parent_path(), ignored)) return;
  for (const int number : ods::frames_on_disk(names)) fs::remove(names.path(number), ignored);
  for (const int number : parts) fs::remove(names.path(number) + ".unfinished", ignored);
}

// Parts of another picture would be taken for finished, and refused by the merge.
void check_parts(const RenderJob& first, const ods::FrameNames& names) {
  const fs::path folder = fs::path(names.before).parent_path();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return;
  RenderJob part = first;
  for (const int number : ods::frames_on_disk(names)) {
    const ods::Settings then = ods::read_part_header(names.path(number)).settings;
    part.render.part.number = number;
    const ods::Settings now = part.cycles ? cycles_part_identity(part)
                                          : sample_identity(identified(part), double{part.time.time.value_or(0.0f)});
    expect_same_settings(names.path(number), then, now, "`restart` discards the parts and starts over");
  }
}

// docs/farm.md has the sources of the numbers.
size_t merge_memory(const RenderJob& job) {
  const bool denoised = plan(job).sequence.finish.denoiser != ods::Denoiser::kNone;
  const size_t of_pixel = denoised ? 84 : ods::keeps_layers(job.output) ? 40 : 12;
  const size_t pixels = static_cast<size_t>(job.render.width) * static_cast<size_t>(job.render.height);
  const size_t parts = std::min(static_cast<size_t>(job.parts), size_t{200});
  return ods::eye_list(job.render.eyes).size() * pixels * of_pixel + ((parts + 50 + 512) << 20);
}

void split_parts(SplitCommand& split, const std::vector<GivenWord>& given, const RenderJob& job) {
  refuse(given, {"--noise", "--time-limit", "--save-unfinished"},
         "parts are exact shares of a fixed number of samples (--samples)");
  std::vector<int> parts(static_cast<size_t>(job.parts));
  std::iota(parts.begin(), parts.end(), 1);
  count(split, "part", parts);
  const std::string pattern = split.output + ".parts/part_####.exr";
  std::vector<GivenWord> of_part = without(
      without(given, kByFarm), {"-o", "--parts", "--layout", "--denoise", "--sidecar", "--brighter", "--keep-parts"});
  of_part.push_back({"-o", pattern});
  const Words render = command_words("render", of_part, {"--skip-existing"});
  Words first = render;
  first.insert(first.end(), {"--part", fmt::format("1/{}", job.parts)});
  Options options = options_of(first);
  const RenderJob checked = settled(parse_render(options));  // throws as the tasks would
  const ods::FrameNames names = *ods::frame_names(pattern);
  split.restart = job.restart;
  if (job.restart) {
    split.prepare = [names, parts] { remove_parts(names, parts); };
  } else {
    check_parts(checked, names);
  }
  std::vector<GivenWord> of_merge = {{"", pattern}, {"-o", split.output}};
  std::ranges::copy(only(given, kOfMerge), std::back_inserter(of_merge));
  if (job.exposure) of_merge.push_back({"--exposure", fmt::format("{}", *job.exposure)});
  Words merge = kLate;
  if (!job.keep_parts) merge.push_back("--remove-parts");
  split.memory = memory_of(split, checked);
  split.disk = static_cast<size_t>(job.parts) * ods::samples_bytes(plan(checked).sampled);
  split.groups = {split_group(split, "parts", render, "--part", pattern),
                  {"merge", command_words("merge", of_merge, merge), "", 1, merge_memory(job)}};
}

void split_views(SplitCommand& split, const std::vector<GivenWord>& given, const RenderJob& job) {
  const ods::SlitRig rig = open_rig(job.rig);
  std::vector<int> views(rig.views.size());
  std::iota(views.begin(), views.end(), 1);
  count(split, "view", views);
  split.groups = {split_group(split, "views", command_words("render", without(given, kByFarm), {"--skip-existing"}),
                              "--only", split.output)};
}

SplitCommand split_render(const Words& words) {
  Options options = options_of(words);
  const RenderJob job = settled(parse_render(options));
  std::vector<GivenWord> given = job.given;
  SplitCommand split = begin(given);
  add_scene_files(split, job.scene);
  const bool frames = job.rig.empty() && makes_video(job.time);
  if (job.rig.empty()) {
    const std::string path = frames ? video_names(split.output).path(0) : split.output;
    ods::check_output(path, job.save, ods::eye_list(job.render.eyes), {job.render.width, job.render.height},
                      &job.camera.stereo.projection);
  }
  split.memory = memory_of(split, job);
  if (!job.rig.empty()) {
    split_views(split, given, job);
  } else if (frames) {
    count(split, "frame", frames_of(job));
    split.groups = {split_group(split, "frames", command_words("render", without(given, kByFarm), {"--skip-existing"}),
                                "--only", split.output)};
  } else if (job.parts > 0) {
    split_parts(split, given, job);
  } else {
    throw UsageError("one picture has nothing to split: --parts N renders N parts of its samples and merges them");
  }
  return split;
}

SplitCommand split_stitch(const Words& words) {
  Options options = options_of(words);
  const StitchJob job = parse_stitch(options);
  if (job.frames.empty()) throw UsageError("one picture has nothing to split: --frames stitches many");
  std::vector<GivenWord> given = job.given;
  SplitCommand split = begin(given);
  const ods::SlitRig rig = open_rig(job.rig_file);
  const std::string fault = names_fault(rig, job.views);
  if (!fault.empty()) throw UsageError(fault);
  ods::check_output(video_names(job.output).path(0), job.save, rig.eyes, rig.eye);
  count(split, "frame", ods::parse_frames(job.frames));
  const size_t samples = static_cast<size_t>(rig.eye.width) * static_cast<size_t>(rig.eye.height) * rig.eyes.size();
  split.memory = (size_t{1} << 30) + 64 * samples;
  split.groups = {split_group(split, "frames", command_words("stitch", without(given, kByFarm), {"--skip-existing"}),
                              "--only", split.output)};
  return split;
}

struct Splitter {
  std::string_view name;
  SplitCommand (*split)(const Words& words);
};

constexpr Splitter kSplitters[] = {{"video", split_video}, {"render", split_render}, {"stitch", split_stitch}};

// --- the others -----------------------------------------------------------------------------------------------------

struct OtherCommand {
  std::string_view name;
  std::optional<size_t> frames = std::nullopt;  // the argument whose frames become the frames of the output, one by one
  bool in_place = false;                        // without -o it changes its input
};

constexpr OtherCommand kOthers[] = {
    {"convert", 0}, {"over", 1}, {"denoise"}, {"merge"}, {"encode"}, {"inject", {}, true}, {"lint"},
};

std::vector<int> frames_of(const std::string& pattern, const std::vector<GivenWord>& given) {
  const auto range = std::ranges::find(given, "--frames", &GivenWord::name);
  return range == given.end() ? ods::frames_on_disk(*ods::frame_names(pattern)) : ods::parse_frames(range->value);
}

SplitCommand split_other(const OtherCommand& command, const Words& words) {
  Options options = options_of(words);
  std::vector<GivenWord> given = find_command(command.name)->parse(options).given;
  SplitCommand split = begin(given);
  split.memory = (size_t{2} << 30) + 8 * bytes_of_files(split);
  const std::string name(command.name);
  const std::string from = command.frames ? given.at(*command.frames).value : "";
  if (ods::frame_names(from) && ods::frame_names(split.output)) {
    count(split, "frame", frames_of(from, given));
    split.groups = {split_group(split, "frames", command_words(name, without(given, kByFarm), {"--skip-existing"}),
                                "--only", split.output)};
    return split;
  }
  if (split.output.empty() && command.in_place) {
    throw UsageError("a farm's task does not change its input: name the tagged file with -o");
  }
  if (split.output.empty()) split.output = given.front().value;
  split.count = 1;
  split.groups = {{name, command_words(name, without(given, kByMachine)), ""}};
  return split;
}

}  // namespace

SplitCommand split_command(const Words& words) {
  if (words.empty()) throw UsageError("no command: write it after --, as in: ods submit --to slurm -- video ...");
  for (const Splitter& each : kSplitters) {
    if (words.front() == each.name) return each.split(words);
  }
  for (const OtherCommand& each : kOthers) {
    if (words.front() == each.name) return split_other(each, words);
  }
  std::vector<std::string> names = ods::names_of(kSplitters);
  std::ranges::copy(ods::names_of(kOthers), std::back_inserter(names));
  throw UsageError(fmt::format("'{}' cannot run on a farm; choose one of {}{}", words.front(), fmt::join(names, ", "),
                               ods::did_you_mean(words.front(), names)));
}
