// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods comfort: where a picture, or a scene before it is rendered, strains its viewer's eyes.
#include "ods/comfort/comfort.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

#include "cli/comfort/comfort_job.h"
#include "cli/comfort/comfort_report.h"
#include "cli/comfort/heat.h"
#include "cli/comfort/page_of.h"
#include "cli/comfort/video_report.h"
#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/projection_options.h"

namespace {

constexpr const char* kStrains = "it strains the viewer's eyes";

void save_html(const ComfortJob& job, const ComfortPage& page) {
  write_page(job.html, page);
  announce_file(job.html);
}

void judge_still(const ComfortJob& job) {
  const Looked looked = job.input == ComfortInput::kPicture ? look_at_picture(job) : look_at_scene(job);
  std::vector<ods::ComfortReport> reports;
  for (const Judged& each : looked.eyes) reports.push_back(ods::judge_comfort(each.seen, job.comfort));
  if (reports[0].unknown > 0.0 && !looked.match) {
    warn(fmt::format("'{}': {:.3g} % of the pixels have no depth, and are not judged", job.scene.name,
                     100.0 * reports[0].unknown));
  }
  job.json ? print_json(job, looked, reports[0]) : print_text(job, looked, reports[0]);
  if (!job.heat.empty()) save_heat(job.heat, looked, reports);
  if (!job.html.empty()) save_html(job, page_of(job, looked, reports[0]));
  for (const ods::ComfortReport& report : reports) {
    if (verdict(job, looked, report) == ods::ComfortLevel::kError) throw std::runtime_error(kStrains);
  }
}

void judge_film(const ComfortJob& job) {
  ods::VideoComfort video;
  const ods::FormatHint format = identified_input(job.scene.name, job.format);
  run_long_job(job.progress, 0, [&](ProgressLines& lines) {
    const auto start = std::chrono::steady_clock::now();
    ods::Progress progress;
    progress.report = [&](double done) { lines.report(done, seconds_since(start), {"comfort", 0, 0, job.scene.name}); };
    video = ods::judge_video(job.scene.name, {job.comfort, format}, progress);
  });
  job.json ? print_json(job, video) : print_text(job, video);
  if (!job.html.empty()) save_html(job, page_of(job, video));
  if (ods::worst_level(video) == ods::ComfortLevel::kError) throw std::runtime_error(kStrains);
}

void comfort(ComfortJob job) {
  settle_input(job);
  job.input == ComfortInput::kVideo ? judge_film(job) : judge_still(job);
}

}  // namespace

extern const Command kComfort = make_command<parse_comfort, comfort>("comfort", "find what strains a viewer's eyes");
