// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods comfort: where a picture, or a scene before it is rendered, strains its viewer's eyes.
#include "ods/comfort/comfort.h"

#include <fmt/format.h>

#include <stdexcept>

#include "cli/comfort/comfort_job.h"
#include "cli/comfort/comfort_report.h"
#include "cli/comfort/judged.h"
#include "cli/console/console.h"

namespace {

void comfort(int argc, char** argv) {
  ComfortJob job;
  if (!read_comfort_job(job, argc, argv)) return;
  ods::StereoCamera camera;
  const std::vector<Judged> judged = is_picture(job) ? look_at_picture(job, camera) : look_at_scene(job, camera);
  std::vector<ods::ComfortReport> reports;
  for (const Judged& each : judged) reports.push_back(ods::judge_comfort(each.seen, job.comfort));
  if (reports[0].unknown > 0.0) {
    warn(fmt::format("{:.3g} % of the pixels have no depth, and are not judged", 100.0 * reports[0].unknown));
  }
  const auto print = job.json ? print_json : print_text;
  print(job.scene.name, camera, job.comfort, reports[0]);
  if (!job.heat.empty()) save_heat(job.heat, camera, judged, reports);
  for (const ods::ComfortReport& report : reports) {
    if (ods::worst_level(report) == ods::ComfortLevel::kError) throw std::runtime_error("it strains the viewer's eyes");
  }
}

}  // namespace

int ods_comfort(int argc, char** argv) {
  return run_command([=] { comfort(argc, argv); });
}
