// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The device that renders: the option, its choice, and the messages about it.
#pragma once
#include "cli/console/options.h"
#include "cli/render/render_job.h"
#include "ods/base/error.h"
#include "ods/scene/scene.h"

// Adds --renderer, and --device cpu|gpu|auto|NAME|NUMBER.
void add_device_option(Options& options, RenderJob& job);

// Returns the job on the device that job.device names, and says which one renders, and why. A card's default is
// --indirect path. `auto` is the CPU where no card can render the scene. Throws ods::Error(kDevice) if there is no such
// device, ods::Error(kUsage) if a card that was named cannot render the scene.
RenderJob on_device(const RenderJob& job, const ods::Scene& scene);

// Returns whether the CPU continues a job of on_device() after this failure: that of a card that `auto` chose.
bool continues_on_cpu(const RenderJob& job, const ods::Error& failure);

// Returns the job on the CPU, where it resumes, and says why.
RenderJob on_cpu(RenderJob job, const ods::Error& failure);
