// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The path tracer on the CPU: the kernel on Embree.
#pragma once
#include "ods/base/progress.h"
#include "ods/image/camera_rig.h"
#include "ods/image/picture.h"
#include "ods/scene/render_options.h"
#include "ods/scene/scene.h"

namespace ods {

// Renders every eye asked for. The same arguments give the same bits, whatever the number of threads.
// Throws Error: kCancelled when progress says so, kMemory before anything else when the machine has too little for the
// picture (picture_bytes).
// Precondition: width a positive number, samples and bounces not negative (samples > 0), threads >= 0.
Picture render_cpu(const Scene& scene, const CameraRig& rig, const RenderOptions& options,
                   const Progress& progress = {});

}  // namespace ods
