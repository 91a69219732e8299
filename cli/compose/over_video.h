// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods over with a video as background and output.
#pragma once
#include "cli/compose/over_job.h"
#include "cli/console/progress.h"
#include "ods/video/footage.h"

void lay_over_video(const OverJob& job, ods::Footage& back, ods::Footage& front, ProgressLines& lines);

// Throws UsageError if frames of a video are not ascending from 0.
void check_rising(const std::vector<int>& frames);
