// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// All settings that a picture or the frames of a video depend on, by option. Jobs with equal settings make equal
// frames. Settings of the video alone (codec, exposure, sound, ...) and the choice of frames are not included.
#pragma once
#include <string>
#include <vector>

#include "cli/render/render_job.h"

struct Setting {
  std::string option;  // as users write it: "--samples", "SCENE"
  std::string value;   // for a file: the MD5 of its contents
  std::string path;    // for a file; otherwise empty
};

// The settings of rendered frames. Reads the files that the job names. Throws ods::Error(kInput).
std::vector<Setting> frame_settings(const RenderJob& job);

// The settings of a still picture's samples: as above, but for those that only its file depends on, and with --part.
std::vector<Setting> sample_settings(const RenderJob& job);
inline constexpr const char* kPartSetting = "--part";

// The settings of frames stitched from the views of a rig, except the views themselves.
std::vector<Setting> stitch_settings(const std::string& rig_file, const std::string& views,
                                     const ods::SaveOptions& save);

// A line for each setting, with tabs between its fields; and back.
std::string settings_text(const std::vector<Setting>& settings);
std::vector<Setting> parse_settings(const std::string& text);

// The differences between `then` and `now`, for messages: "--samples was 64, now 128; SCENE 'a.glb' has changed". At
// most three. Empty if there are none.
std::string settings_difference(const std::vector<Setting>& then, const std::vector<Setting>& now);
