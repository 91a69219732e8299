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

void merge_parts(MergeJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  for (size_t i = 0; i < job.parts.size(); i++) {
    const double done = 0.8 * static_cast<double>(i) / static_cast<double>(job.parts.size());
    lines.report(done, seconds_since(start), {"merge", 0, 0, job.parts[i]});
    ods::add_part(job.parts[i], job.picture.options, job.samples);
  }
  ods::Picture picture = ods::develop(std::move(job.samples), job.picture.options);
  const auto files = finish_picture(job.render, job.camera, std::move(picture), job.render.output);
  lines.report(1.0, seconds_since(start), {"merge", 0, 0, job.render.output});
  lines.clear();
  for (const std::string& file : files) announce_file(file);
}

void merge(int argc, char** argv) {
  MergeJob job;
  if (!read_merge_job(job, argc, argv)) return;
  run_long_job(job.render.progress, job.render.render.threads, [&](ProgressLines& lines) { merge_parts(job, lines); });
}

}  // namespace

int ods_merge(int argc, char** argv) {
  return run_command([=] { merge(argc, argv); });
}
