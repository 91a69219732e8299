// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Makes the video, or the frames of it that --only names, and prints notes for users.
#pragma once
#include "cli/console/progress.h"
#include "cli/video/video_job.h"

// Throws UsageError and ods::Error.
void make_video(const VideoJob& job, ProgressLines& lines);
