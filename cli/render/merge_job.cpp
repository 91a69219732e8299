// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/render/merge_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <thread>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/picture_options.h"
#include "cli/render/plan.h"
#include "ods/denoise/oidn.h"
#include "ods/files/frames.h"
#include "ods/picture/metadata/sidecar.h"
#include "ods/picture/save.h"
#include "ods/render/part_file.h"
#include "ods/sequence/identity.h"
#include "ods/stage/exposure.h"

namespace {

constexpr const char* kMergeExamples =
    "  ods merge 'part_#.exr' -o picture.exr\n"
    "  ods merge part_1.exr part_2.exr -o picture_360_TB.png --denoise own\n"
    "  ods merge picture.png.unfinished -o so_far.png";

constexpr const char* kMergeSummary =
    "Merges the parts of a picture that ods render --part made, on any machines: the result has the same bits as one\n"
    "rendering of all samples. It also makes a picture of what an interrupted rendering left.";

// Returns the files that the arguments name; a pattern matches existing files.
std::vector<std::string> files_of(const std::vector<std::string>& words) {
  std::vector<std::string> files;
  for (const std::string& word : words) {
    const auto names = word.find('#') == std::string::npos ? std::nullopt : ods::frame_names(word);
    if (!names) {
      files.push_back(word);
      continue;
    }
    const std::vector<int> numbers = ods::frames_on_disk(*names);
    if (numbers.empty()) throw ods::Error(ods::ErrorKind::kInput, fmt::format("no file is called '{}'", word));
    for (const int number : numbers) files.push_back(names->path(number));
  }
  return files;
}

ods::Settings settings_of(const ods::SampledPicture& part) {
  ods::Settings settings = part.settings;
  std::erase_if(settings, [](const ods::Setting& setting) { return setting.name == ods::kPartSetting; });
  return settings;
}

// Why a part belongs to another picture than the first one; empty: to the same.
std::string difference(const ods::SampledPicture& first, const ods::SampledPicture& part) {
  if (first.options.part.count != part.options.part.count) {
    return fmt::format("it is one of {} parts, not of {}", part.options.part.count, first.options.part.count);
  }
  return settings_difference(settings_of(first), settings_of(part));
}

std::string missing(const std::map<int, std::string>& parts, int count) {
  std::vector<int> numbers;
  for (int number = 1; number <= count; number++) {
    if (!parts.contains(number)) numbers.push_back(number);
  }
  return ods::frames_text(numbers);
}

// Finds the parts' numbers and the picture that they make.
void order_parts(MergeJob& job, bool incomplete) {
  std::map<int, std::string> parts;
  std::string first;
  for (const std::string& path : job.parts) {
    ods::SampledPicture part = ods::read_part_header(path);
    if (first.empty()) {
      first = path;
      job.picture = part;
    }
    if (const std::string why = difference(job.picture, part); !why.empty()) {
      throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}' does not belong to '{}': {}", path, first, why));
    }
    const auto [other, is_new] = parts.emplace(part.options.part.number, path);
    if (!is_new) {
      throw ods::Error(ods::ErrorKind::kInput, fmt::format("'{}' and '{}' are the same part, {}", other->second, path,
                                                           ods::part_text(part.options.part)));
    }
  }
  const int count = job.picture.options.part.count;
  if (parts.size() < static_cast<size_t>(count)) {
    const std::string without = fmt::format("of {} parts, these are missing: {}", count, missing(parts, count));
    if (!incomplete) {
      throw ods::Error(ods::ErrorKind::kInput, without + "; --incomplete makes the picture without them");
    }
    warn(without);
  }
  job.parts.clear();
  for (const auto& [number, path] : parts) job.parts.push_back(path);
  job.picture.options.part = {};
}

void open_pictures(MergeJob& job, bool incomplete) {
  std::vector<std::string> ignored;
  const std::string first = job.parts[0];
  if (job.parts.size() == 1 && ods::is_unfinished(first)) {
    job.picture = ods::read_unfinished(first, job.samples);
    job.picture.options.statistics |= job.picture.options.noise > 0.0f;  // such samples have them, too
    job.parts.clear();
  } else {
    order_parts(job, incomplete);
  }
  const ods::Sidecar sidecar = ods::read_sidecar(job.picture.camera, first, ignored);
  job.camera = sidecar.camera;
  job.layout = sidecar.layout;
}

// Opens the files that the arguments name. Until the wait is over, missing files may be late.
void open_inputs(MergeJob& job, const std::vector<std::string>& words, bool incomplete) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<float>(job.render.wait);
  bool said = false;
  while (true) {
    try {
      job.parts = files_of(words);
      for (const std::string& part : job.parts) refuse_overwriting(job.render.output, part);
      return open_pictures(job, incomplete && std::chrono::steady_clock::now() >= end);
    } catch (const ods::Error& error) {
      if (error.kind() != ods::ErrorKind::kInput || std::chrono::steady_clock::now() >= end) throw;
      if (!said) note(fmt::format("waiting up to {:g} s: {}", job.render.wait, error.what()));
      said = true;
    }
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
}

void add_options(Options& options, MergeOptions& given) {
  RenderJob& render = given.render;
  options.arguments(ValueKind::input_file("PART"), given.parts, "the parts; # in a name stands for any number");
  options.group("Output");
  options.text("-o,--output", ValueKind::output_file(), render.output,
               "output file: .png .jpg .tif .webp .hdr .exr; %V in the name writes one file per eye");
  options.flag("--remove-parts", given.remove_parts, "remove the parts when the picture is saved");
  options.flag("--incomplete", given.incomplete, "make the picture even if parts are missing; it is noisier");
  add_wait_option(options, render.wait, "parts");
  add_layout_option(options, given.layout, "how both eyes share the file; by default as rendered", "--layout");
  options.flag("--sidecar", render.save.sidecar, "also write the camera as JSON beside the picture");
  options.flag("--statistics", render.render.statistics,
               "also write each pixel's variance and number of samples (.exr)");
  options.choice("--denoise", render.denoise, ods::kDenoiserTable, "as in ods render");
  options.number("--exposure", given.display.exposure, -ods::kMaxStops, ods::kMaxStops,
                 "exposure in stops, by default as rendered; .hdr and .exr stay scene-linear and ignore it");
  options.number("--brighter", given.brighter, -ods::kMaxStops, ods::kMaxStops, "stops added to the exposure");
  options.choice("--tone", given.display.tone, ods::kToneCurveTable,
                 "tone curve, by default as rendered; .hdr and .exr ignore it");
  options.group("Console");
  options.number("--threads", render.render.threads, 0, 1024, "number of threads; 0: all processors");
  add_progress_options(options, render.progress);
}

// The parts' method for indirect light.
ods::Indirect indirect_of(const ods::SampledPicture& picture) {
  for (const ods::Setting& setting : picture.settings) {
    if (setting.name == "`indirect`") return ods::find_in(ods::kIndirectTable, setting.value).value_or(ods::Indirect{});
  }
  return {};
}

// The inputs of the picture's files, besides its samples.
void finish_options(MergeJob& job, std::optional<ods::Layout> layout) {
  RenderJob& render = job.render;
  const ods::RenderOptions requested = render.render;
  if (requested.statistics && !ods::keeps_layers(render.output)) throw UsageError("--statistics needs an .exr");
  if (render.denoise == ods::Denoiser::kOidn) ods::check_oidn();
  render.render = job.picture.options;
  render.render.indirect = indirect_of(job.picture);
  render.render.layers = ods::keeps_layers(render.output) && job.picture.options.layers;
  render.render.statistics = requested.statistics;
  render.render.threads = requested.threads;
  render.save.layout = layout.value_or(job.layout);
  if (job.picture.options.statistics) return;
  if (requested.statistics || render.denoise == ods::Denoiser::kOwn) {
    throw UsageError("the samples have no statistics: neither --statistics nor --denoise own is possible");
  }
  if (!render.denoise) render.denoise = ods::Denoiser::kNone;
}

// Sums that nothing is made of are left where they are.
void leave_out_layers(MergeJob& job) {
  ods::RenderOptions& options = job.picture.options;
  const ods::RenderOptions needed = plan(job.render).sampled;
  options.layers &= needed.layers;
  options.statistics &= needed.statistics;
}

}  // namespace

MergeOptions parse_merge(Options& options) {
  MergeOptions given;
  options.describe(kMergeSummary, kMergeExamples);
  add_options(options, given);
  options.parse();
  if (given.render.output.empty()) throw UsageError("no output file: add -o picture.exr");
  if (given.parts.empty()) throw UsageError("no parts: name the files that ods render --part has made");
  return given;
}

bool are_merged(const MergeOptions& given) {
  const auto is_gone = [](const std::string& word) {
    const auto names = ods::frame_names(word);
    std::error_code ignored;
    if (!names) return !std::filesystem::exists(word, ignored);
    return !std::filesystem::exists(std::filesystem::path(names->before).parent_path(), ignored) ||
           ods::frames_on_disk(*names).empty();
  };
  return given.remove_parts && ods::is_saved(given.render.output) && std::ranges::all_of(given.parts, is_gone);
}

MergeJob open_parts(const MergeOptions& given) {
  MergeJob job;
  job.render = given.render;
  open_inputs(job, given.parts, given.incomplete);
  if (given.remove_parts && job.parts.empty()) {
    throw UsageError("--remove-parts: there are no parts, but unfinished samples");
  }
  finish_options(job, given.layout);
  if (!job.parts.empty()) leave_out_layers(job);
  ods::SaveOptions& save = job.render.save;
  save.exposure = ods::brightened(given.display.exposure.value_or(job.picture.exposure), given.brighter);
  save.tone = given.display.tone.value_or(job.picture.tone);
  const ods::RenderOptions& picture = job.picture.options;
  const std::vector<int> eyes = ods::eye_list(picture.eyes);
  ods::check_output(job.render.output, save, eyes, {picture.width, picture.height}, &job.camera.projection);
  note_misleading_name(job.render.output, save, eyes.size(), job.camera.projection);
  return job;
}
