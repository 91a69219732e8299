// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders the views of a rig of slits (ods rig) into one file each.
#pragma once
#include "cli/console/progress.h"
#include "cli/render/render_job.h"

// Renders the views of the job's rig at the job's time, and prints the name of every file as soon as it exists. Throws
// UsageError and ods::Error.
void render_views(const RenderJob& job, ProgressLines& lines);
