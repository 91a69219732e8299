// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods merge: puts the parts of a picture together.
#include <chrono>

#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/render/finish_picture.h"
#include "cli/render/merge_job.h"
#include "ods/render/part_file.h"

namespace {

ods::Picture picture_of(MergeJob& job, const ods::Progress& progress) {
  if (job.parts.empty()) return ods::develop(std::move(job.samples), job.picture.options);
  return ods::merge_parts(job.parts, job.picture.options, progress);
}

void merge_and_save(MergeJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  const auto report = [&](double done) {
    lines.report(0.9 * done, seconds_since(start), {"merge", 0, 0, job.render.output});
  };
  const auto files = finish_picture(job.render, job.camera, picture_of(job, {report, {}}), job.render.output);
  lines.report(1.0, seconds_since(start), {"merge", 0, 0, job.render.output});
  lines.clear();
  for (const std::string& file : files) announce_file(file);
}

void merge(int argc, char** argv) {
  MergeJob job;
  if (!read_merge_job(job, argc, argv)) return;
  run_long_job(job.render.progress, job.render.render.threads,
               [&](ProgressLines& lines) { merge_and_save(job, lines); });
}

}  // namespace

int ods_merge(int argc, char** argv) {
  return run_command([=] { merge(argc, argv); });
}
