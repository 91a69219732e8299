// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/camera/stitch_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>

#include "cli/camera/merged_picture.h"
#include "cli/console/console.h"
#include "cli/options/disk_room.h"
#include "cli/options/picture_options.h"
#include "cli/options/time_options.h"
#include "cli/options/waiting.h"
#include "ods/base/error.h"
#include "ods/files/claim.h"
#include "ods/stitch/rig_mark.h"
#include "ods/stitch/seams.h"
#include "ods/stitch/slit_file.h"

using ods::Error, ods::ErrorKind, ods::FrameNames, ods::ViewFault, ods::ViewFiles;

ods::SlitRig open_rig(const std::string& path) {
  std::vector<std::string> warnings;
  ods::SlitRig rig = ods::load_slit_rig(path, warnings);
  for (const std::string& warning : warnings) warn(warning);
  return rig;
}

// --- views that are missing -----------------------------------------------------------------------------------------

void report_faults(const std::vector<ViewFault>& faults, const std::function<void(const std::string&)>& say) {
  constexpr size_t kMaxReported = 5;
  for (size_t i = 0; i < std::min(faults.size(), kMaxReported); i++) say(faults[i].what);
  if (faults.size() > kMaxReported) say(fmt::format("and {} more views", faults.size() - kMaxReported));
}

[[noreturn]] static void refuse(const ods::SlitRig& rig, const ViewFiles& views, const std::vector<ViewFault>& faults) {
  report_faults(faults, warn);
  throw Error(ErrorKind::kInput, fmt::format("{} of {} views cannot be used: render {} again, or use --partial",
                                             faults.size(), rig.views.size(), view_ranges(rig, views, faults)));
}

// --- a picture ------------------------------------------------------------------------------------------------------

void stitch_picture(const StitchJob& job, const ods::SlitRig& rig, const ViewFiles& views, const std::string& output,
                    const StepReport& report) {
  const bool has_marks = has_rig_marks(rig, views);
  if (!job.partial) {
    const std::vector<ViewFault> missing = missing_views(rig, views, false);
    if (!missing.empty()) refuse(rig, views, missing);
  }
  ods::StitchOptions options;
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  std::error_code ignored;  // making the journal reports it
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  options.journal = output + ".stitching";
  options.journal_key = views_key(rig, views);
  std::atomic<bool> shows_codes{false}, unmarked{false};
  std::mutex mutex;
  std::string color_fault;
  const ods::OpenView open_file = open_view_files(rig, views);
  const ods::OpenView open = [&](size_t view) {
    ods::StoredPicture picture = open_file(view);
    if (!picture.is_float) shows_codes = true;
    if (!has_marks && picture.rig_mark.empty()) unmarked = true;
    const std::lock_guard lock(mutex);
    if (color_fault.empty()) color_fault = picture.color_fault;
    return picture;
  };
  const ods::Stitched stitched = stitch(rig, open, options, [&](double part) {
    report(0.9 * part, {"stitch", 0, 0, output});
  });
  if (!stitched.faults.empty() && !job.partial) {
    std::filesystem::remove(options.journal);
    refuse(rig, views, stitched.faults);
  }
  if (!stitched.faults.empty()) {
    report_faults(stitched.faults, note);
    note(fmt::format("{} of {} views are missing and stay black", stitched.faults.size(), rig.views.size()));
  }
  if (unmarked && job.notes_unmarked) {
    note(fmt::format("cannot check which rig the views belong to: no {} in their folder", ods::kRigMarkFile));
  }
  if (!color_fault.empty()) warn("the views: " + color_fault);
  ods::SaveOptions save = job.save;
  save.layout = job.layout.value_or(rig.layout);
  save.exposure = job.display.exposure.value_or(save.exposure);
  save.tone = job.display.tone.value_or(shows_codes ? ods::ToneCurve::kLinear : save.tone);
  std::optional<MergedPicture> merged;
  if (job.merge_limit && rig.eyes.size() == 2) merged.emplace(stitched.rows, rig.camera, *job.merge_limit, output);
  const std::vector<std::string> files = merged ? save_picture(merged->conversion.rows, &merged->camera, save, output)
                                                : save_picture(stitched.rows, &rig.camera, save, output);
  if (stitched.unseen > 0) {
    note(fmt::format("{} pixels show the far background: what belongs there is hidden in every view", stitched.unseen));
  }
  std::filesystem::remove(options.journal);
  if (!job.notes_files) return;
  for (const std::string& file : files) announce_file(file);
  if (job.report.empty()) return;
  const ods::SeamReport seams = measure_seams(rig, stitched.rows);
  note(fmt::format("seam visibility {:.3f}; at 1, slit borders are no more visible than the rest", seams.ratio));
  for (const std::string& file : save_picture(seams.picture, {}, job.report)) announce_file(file);
}

// --- pictures of a video ---------------------------------------------------------------------------------------------

static FrameNames folder_names(const std::string& views) {
  const std::filesystem::path path(views);
  if (const auto names = ods::frame_names(path.parent_path().string())) return *names;
  throw UsageError("--frames: the views' folder has no mark for the frame: 'views/####/####.exr'");
}

static void note_space(const StitchJob& job, const ods::SlitRig& rig, const std::vector<ods::SharedFrame>& files) {
  const auto is_left = [&](const ods::SharedFrame& file) { return !job.skip_existing || !ods::is_saved(file.path); };
  const auto left = std::count_if(files.begin(), files.end(), is_left);
  ods::RenderOptions picture;
  picture.width = rig.eye.width, picture.height = rig.eye.height;
  picture.eyes = rig.eyes.size() == 2 ? ods::Eyes::kBothEyes : ods::Eyes::kMonoEye;
  if (left > 0) note_disk_space(job.output, static_cast<size_t>(left), largest_frame(job.output, picture, job.save));
}

static ViewFiles views_of(const StitchJob& job, const FrameNames& folders, int frame) {
  ViewFiles views = job.views;
  views.names = folders.path(frame) + "/" + std::filesystem::path(job.views.names).filename().string();
  return views;
}

bool are_scene_linear(const StitchJob& job, const ods::SlitRig& rig) {
  const ViewFiles views = views_of(job, folder_names(job.views.names), ods::parse_frames(job.frames).front());
  const std::string first = view_path(rig, views, 0);
  std::error_code ignored;
  if (!std::filesystem::exists(first, ignored)) return keeps_light(first);
  return ods::PictureReader(first).header().is_float;
}

std::vector<int> stitch_frames(const StitchJob& job, const ods::SlitRig& rig, const StepReport& report) {
  const FrameNames folders = folder_names(job.views.names), outputs = video_names(job.output);
  const std::vector<int> frames = own_frames(job.only, ods::parse_frames(job.frames));
  StitchJob each = job;
  const auto stitch_frame = [&](size_t i) {
    const std::string output = outputs.path(frames[i]);
    const int number = static_cast<int>(i) + 1, count = static_cast<int>(frames.size());
    const ProgressStep step{"stitch", number, count, output};
    stitch_picture(each, rig, views_of(job, folders, frames[i]), output,
                   [&](double part, const ProgressStep&) { report((static_cast<double>(i) + part) / count, step); });
    each.notes_unmarked = false;  // one note is enough
  };
  std::vector<ods::SharedFrame> files;
  for (const int frame : frames) files.push_back({frame, outputs.path(frame)});
  note_space(job, rig, files);
  if (job.skip_existing && job.claims) {
    ods::make_shared_frames(files, stitch_frame, note_waiting("frame"));
    return frames;
  }
  for (size_t i = 0; i < frames.size(); i++) {
    if (job.skip_existing && ods::is_saved(files[i].path)) continue;
    const std::unique_ptr<ods::Claim> own = job.claims ? ods::claim(files[i].path) : nullptr;
    stitch_frame(i);
  }
  return frames;
}
