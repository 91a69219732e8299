// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Stitches the views of a rig: one picture, or the frames of a video.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cli/camera/stitch_job.h"
#include "cli/console/progress.h"

// Warns about unknown keys.
ods::SlitRig open_rig(const std::string& path);

// Passes the first few faults to `say`.
void report_faults(const std::vector<ods::ViewFault>& faults, const std::function<void(const std::string&)>& say);

// Stitches the views into the output, and prints the file names if the job wants that. Throws UsageError and
// ods::Error, which lists all views that cannot be used.
void stitch_picture(const StitchJob& job, const ods::SlitRig& rig, const ods::ViewFiles& views,
                    const std::string& output, const StepReport& report);

// Returns whether the views of the first frame are scene-linear; others are display-referred. Goes by the name if they
// are no longer there.
bool are_scene_linear(const StitchJob& job, const ods::SlitRig& rig);

// Checks the views of every frame of a video, with a folder of views per frame. Returns the frame numbers.
std::vector<int> stitch_frames(const StitchJob& job, const ods::SlitRig& rig, const StepReport& report);
