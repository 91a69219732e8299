// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The views of a rig of slits (ods rig), each a file.
#pragma once
#include "cli/console/progress.h"
#include "cli/render/render_job.h"

// Renders the views of the job's rig, at the job's time, and says every file on stdout once it is there. Throws
// UsageError and ods::Error.
void render_views(const RenderJob& job, ProgressLines& lines);
