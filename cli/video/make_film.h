// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The video of a .blend that Blender takes long to convert: its first frames are rendered meanwhile.
#pragma once
#include "cli/video/video_job.h"

// Makes the video of a job that is not settled yet. Frames, exposure and the file are the same whether or not the scene
// had been converted before. Throws UsageError and ods::Error.
void make_film(const VideoJob& job);
