// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Fills a light cache (ods/kernel/light_cache.h) before a picture is rendered.
#pragma once
#include "ods/base/progress.h"
#include "ods/render/cpu/job.h"
#include "ods/render/cpu/light_cells.h"

namespace ods {

// Traces whole paths from all over the picture and stores their light at each surface, until the cells' error is small
// enough or the paths take a tenth of the picture's time. Small pictures get no cache. The result depends on the scene,
// the camera and the options only, and not on options.part or the number of threads. Errors: ErrorKind::kCancelled.
LightCells fill_light_cache(const Job& job, const Progress& progress);

// Makes the job's paths end in these cells, which must outlive it. Without cells, paths do not end early.
void show_light_cache(Job& job, const LightCells& cells);

}  // namespace ods
