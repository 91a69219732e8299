// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods merge: puts the parts of a picture together.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/render/merge_job.h"
#include "cli/render/plan.h"
#include "ods/render/part_file.h"

namespace fs = std::filesystem;

namespace {

ods::Picture picture_of(MergeJob& job, const ods::Progress& progress) {
  if (job.parts.empty()) return ods::develop(std::move(job.samples), job.picture.options);
  return ods::merge_parts(job.parts, job.picture.options, progress);
}

// The folder that ods submit makes for them gets another name first, so that a run that is killed here leaves all or
// none of them under their own.
void remove_parts(const MergeJob& job) {
  const fs::path folder = job.render.output + ".parts", merged = job.render.output + ".merged-parts";
  const auto lies_there = [&](const std::string& part) { return fs::path(part).parent_path() == folder; };
  std::error_code error;
  const bool together = std::ranges::all_of(job.parts, lies_there);
  if (together) fs::rename(folder, merged, error);
  for (const std::string& part : job.parts) {
    fs::remove(together && !error ? merged / fs::path(part).filename() : fs::path(part), error);
    if (error) warn(fmt::format("'{}' cannot be removed: {}", part, error.message()));
  }
  if (together) fs::remove(merged, error);  // if nothing else is in it
}

void merge_and_save(const MergeOptions& given, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  MergeJob job = open_parts(given);
  const auto report = [&](double done) {
    lines.report(0.9 * done, seconds_since(start), {"merge", 0, 0, job.render.output});
  };
  const auto files = ods::finish_picture(plan(job.render).sequence.finish, job.render.render, job.camera,
                                         picture_of(job, {report, {}}), job.render.output);
  lines.report(1.0, seconds_since(start), {"merge", 0, 0, job.render.output});
  lines.clear();
  for (const std::string& file : files) announce_file(file);
  if (given.remove_parts) remove_parts(job);
}

void merge(const MergeOptions& given) {
  if (are_merged(given)) return note(fmt::format("'{}' exists already, and its parts are gone", given.render.output));
  run_long_job(given.render.progress, given.render.render.threads,
               [&](ProgressLines& lines) { merge_and_save(given, lines); });
}

}  // namespace

extern const Command kMerge =
    make_command<parse_merge, merge>("merge", "merge the parts of a picture that several machines rendered");
