// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The light around a scene as a file that Blender reads, instead of the file's own world.
#pragma once
#include <string>

#include "ods/scene/scene.h"

// Writes an environment as a lat-long .exr, with -Z of our world in its middle. Throws Error(kOutput).
void write_surround(const ods::Environment& environment, const std::string& path);
