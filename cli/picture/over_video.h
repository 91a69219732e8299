// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods over where a video is laid over and a video is made.
#pragma once
#include "cli/console/progress.h"
#include "cli/picture/over_job.h"
#include "ods/video/footage.h"

void lay_over_video(const OverJob& job, ods::Footage& back, ods::Footage& front, ProgressLines& lines);

// Throws UsageError: frames of a video that do not rise from 0 on.
void check_rising(const std::vector<int>& frames);
