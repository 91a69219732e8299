// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The choice between our renderer and Blender's Cycles, and what Cycles does not have of the options.
#pragma once
#include <string>
#include <string_view>

#include "cli/console/options.h"
#include "ods/base/names.h"
#include "ods/camera/stereo_camera.h"

enum class Renderer { kOds, kCycles };
inline constexpr ods::NameRow<Renderer> kRendererTable[] = {
    {Renderer::kOds, "ods"},
    {Renderer::kCycles, "cycles"},
};
static_assert(ods::has_every_member(kRendererTable));

// Adds --renderer.
void add_renderer_option(Options& options, Renderer& renderer);

// Checks that Cycles can honour all options that were given. Throws UsageError for the first that it cannot.
void check_cycles_options(const std::vector<GivenWord>& given);

// Throws Error(kInput) if the scene is not a .blend, Error(kUsage) if Cycles' eyes cannot be at the camera's.
void check_cycles_scene(const std::string& scene);
void check_cycles_camera(const ods::StereoCamera& camera);
