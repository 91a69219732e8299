// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Everything that a video's frames depend on, option by option. Two jobs whose settings are equal make the same frames.
// What only the video depends on (codec, exposure, sound, ...) and which frames there are is no part of it.
#pragma once
#include <string>
#include <vector>

#include "cli/render/render_job.h"

struct Setting {
  std::string option;  // as users know it: "--samples", "SCENE"
  std::string value;   // of a file: the MD5 of its contents
  std::string path;    // of a file; empty for others
};

// Of frames that are rendered. Reads the files that the job names. Throws ods::Error(kInput).
std::vector<Setting> frame_settings(const RenderJob& job);

// Of frames that are stitched of the views of a rig. The views themselves are not among them.
std::vector<Setting> stitch_settings(const std::string& rig_file, const std::string& views,
                                     const ods::SaveOptions& save);

// In what `now` differs from `then`, in words for a message: "--samples was 64, now 128; SCENE 'a.glb' has changed".
// At most three differences. Empty: in nothing.
std::string settings_difference(const std::vector<Setting>& then, const std::vector<Setting>& now);
