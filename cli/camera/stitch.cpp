// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods stitch: combines the views of a rig into its picture, or the views of every frame into a video's frames.
#include <chrono>

#include "cli/camera/stitch_frames.h"
#include "cli/console/command.h"
#include "cli/console/console.h"
#include "cli/console/long_job.h"
#include "cli/console/print.h"
#include "cli/options/picture_options.h"
#include "ods/files/claim.h"

namespace {

void run(const StitchJob& job, ProgressLines& lines) {
  const auto start = std::chrono::steady_clock::now();
  const ods::SlitRig rig = open_rig(job.rig_file);
  if (job.merge_limit && rig.options.depth == ods::ViewDepth::kNone) {
    throw UsageError(
        "--merge auto follows the views' depth, and this rig's views have none: plan it by ods rig --depth "
        "plane, or from the scene by ods rig --scene SCENE --merge auto");
  }
  const std::string fault = names_fault(rig, job.views);
  if (!fault.empty()) throw UsageError(fault);
  if (job.list_missing) {
    has_rig_marks(rig, job.views);
    const std::vector<ods::ViewFault> faults = missing_views(rig, job.views, true);
    report_faults(faults, note);
    if (!faults.empty()) put_out(view_ranges(rig, job.views, faults) + "\n");
    return;
  }
  const bool is_video = !job.frames.empty();
  ods::check_output(is_video ? video_names(job.output).path(0) : job.output, job.save, rig.eyes, rig.eye);
  const auto report = [&](double part, const ProgressStep& step) { lines.report(part, seconds_since(start), step); };
  if (is_video) {
    stitch_frames(job, rig, report);
  } else {
    const std::unique_ptr<ods::Claim> own = ods::claim(job.output);
    stitch_picture(job, rig, job.views, job.output, report);
  }
  report(1.0, {"stitch", 0, 0, job.output});
  lines.clear();
}

void stitch(const StitchJob& job) {
  run_long_job(job.progress, job.threads, [&](ProgressLines& lines) { run(job, lines); });
}

}  // namespace

extern const Command kStitch =
    make_command<parse_stitch, stitch>("stitch", "combine the views of those cameras into a picture");
