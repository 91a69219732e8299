// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of the views of a rig: one, or the frames of a video.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cli/console/progress.h"
#include "cli/slits/stitch_job.h"

// Says what in it is not known.
ods::SlitRig open_rig(const std::string& path);

// Says what is wrong with the first few.
void tell_faults(const std::vector<ods::ViewFault>& faults, const std::function<void(const std::string&)>& say);

// Stitches the views into the output, and says its files on stdout where the job wants that. Throws UsageError and
// ods::Error, which says all views that cannot be used.
void stitch_picture(const StitchJob& job, const ods::SlitRig& rig, const ods::ViewFiles& views,
                    const std::string& output, const StepReport& report);

// The same of every frame of a video, whose views lie in a folder each. Returns their numbers.
std::vector<int> stitch_frames(const StitchJob& job, const ods::SlitRig& rig, const StepReport& report);
