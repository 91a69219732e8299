// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of a film, each a file.
#pragma once
#include "cli/progress.h"
#include "cli/render_job.h"

// Renders what the job asks for, a picture or a film, and says every file on stdout once it is there. A frame's file
// exists only when it is complete, so that a run that was killed is resumed with --skip-existing.
void render_job(const RenderJob& job, ProgressLines& lines);
