// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The parts of ods layers that scenes and pictures share: its progress, and its files, which are the layered scene with
// its stereo picture, or a page.
#pragma once
#include "cli/console/interrupt.h"
#include "cli/console/progress.h"
#include "cli/layers/layers_job.h"
#include "ods/base/progress.h"
#include "ods/layers/layered_scene.h"

// Throws UsageError and ods::Error if the files cannot be written.
void check_layer_files(const LayersJob& job);

// The progress of the command, from now on, as lines; `stop` cancels it. Both must outlive the result.
ods::Progress layers_progress(const LayersJob& job, ProgressLines& lines, const GentleStop& stop);

// Writes the files and prints their names.
void write_layer_files(const LayersJob& job, const ods::LayeredScene& layers, const ods::Progress& progress,
                       ProgressLines& lines);
