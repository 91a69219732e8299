// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of ods video.
#pragma once
#include <string>
#include <vector>

#include "cli/options/video_options.h"
#include "cli/render/render_job.h"

struct VideoJob {
  RenderJob render;
  VideoChoices video;
  std::string rig;  // a slit rig: stitch its views instead of rendering
  bool keep_frames = false, restart = false;
  std::vector<int> early;  // frames to render now, as the rest of the scene is not there yet: no video; empty: all
};

VideoJob parse_video(Options& options);

// Returns the job with the settings that depend on files, as settled() of RenderJob does.
VideoJob settled(VideoJob job);
