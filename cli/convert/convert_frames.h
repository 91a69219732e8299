// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// ods convert with frames or a video as input.
#pragma once
#include "cli/console/progress.h"
#include "cli/convert/convert_job.h"

// Writes a file per frame.
void convert_to_frames(ConvertJob& job, ProgressLines& lines);
// Writes a video.
void convert_to_video(ConvertJob& job, ProgressLines& lines);

// Notes how much of the pictures is empty: `share`, 0..1.
void note_empty_share(double share, bool sees_around);
// Notes how much of the pictures was hidden and is filled.
void note_filled_share(double share);
