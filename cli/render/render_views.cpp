// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <numeric>

#include "cli/camera/stitch_frames.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/options/waiting.h"
#include "cli/render/first_look.h"
#include "cli/render/render_still.h"
#include "ods/kernel/random.h"
#include "ods/render/cpu/render.h"
#include "ods/scene/motion.h"
#include "ods/stage/exposure.h"
#include "ods/stitch/rig_mark.h"
#include "ods/stitch/view_files.h"

void render_views(const RenderJob& job, ProgressLines& lines) {
  const ods::SlitRig rig = open_rig(job.rig);
  ods::ViewFiles files;
  files.names = job.output;
  const std::string fault = names_fault(rig, files);
  if (!fault.empty()) throw UsageError(fault);
  ods::check_output(view_path(rig, files, 0), job.save, {ods::kMono}, rig.view);
  ods::mark_folders(rig, files);
  ods::SaveOptions save = job.save;
  save.exposure = unmeasured_exposure(job);
  note_unmeasured_light(job);
  save.attributes.push_back({ods::kRigMarkAttribute, ods::rig_mark(rig)});
  ods::Scene scene = open_lit_scene(job.scene, job.render.transparent);
  save.tone = job.tone.value_or(ods::usual_tone(scene));
  TimeOptions time = job.time;
  start_clock(time, job.camera, scene);
  ods::set_time(scene, static_cast<double>(time.time.value_or(0.0f)));
  ods::RenderOptions options = job.render;
  options.width = rig.view.width, options.height = rig.view.height, options.eyes = ods::Eyes::kMonoEye;
  const auto start = std::chrono::steady_clock::now();
  ods::CpuRenderer renderer(scene, options.threads);
  const auto render_view = [&](size_t i) {
    const std::string path = view_path(rig, files, i);
    options.seed = ods::hash_pair(job.render.seed, static_cast<ods::uint>(i));  // else every slit has the same noise
    ods::Progress progress;
    const int number = static_cast<int>(i) + 1, count = static_cast<int>(rig.views.size());
    const ProgressStep step{"render", number, count, path};
    progress.report = [&](double part) {
      lines.report((static_cast<double>(i) + part) / count, seconds_since(start), step);
    };
    const ods::Picture picture = renderer.render({rig.views[i]}, options, progress);
    save_picture(picture, rig.views[i], save, path);
    lines.clear();
    announce_file(path);
  };
  std::vector<int> all(rig.views.size());
  std::iota(all.begin(), all.end(), 1);
  std::vector<ods::SharedFrame> views;
  for (const int number : own_frames(time.only, all)) {
    views.push_back({number, view_path(rig, files, static_cast<size_t>(number - 1))});
  }
  const auto render_own = [&](size_t i) { render_view(static_cast<size_t>(views[i].number - 1)); };
  if (time.skip_existing) {
    ods::make_shared_frames(views, render_own, note_waiting("view"));
  } else {
    for (size_t i = 0; i < views.size(); i++) render_own(i);
  }
  note(fmt::format("{} views in {}", views.size(), duration_text(seconds_since(start))));
}
