// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// All settings that a picture or the frames of a video depend on, by option. Jobs with equal settings make equal
// frames. Settings of the video alone (codec, exposure, sound, ...) and the choice of frames are not included.
#pragma once
#include <string>

#include "cli/render/render_job.h"
#include "ods/base/settings.h"

// The settings of rendered frames. Reads the files that the job names. Throws ods::Error(kInput).
ods::Settings frame_settings(const RenderJob& job);

// The settings of a still picture's samples: as above, but for those that only its file depends on, and with --part.
ods::Settings sample_settings(const RenderJob& job);
inline constexpr const char* kPartSetting = "--part";

// The settings of frames stitched from the views of a rig, except the views themselves.
ods::Settings stitch_settings(const std::string& rig_file, const std::string& views, const ods::SaveOptions& save);
