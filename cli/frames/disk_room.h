// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How much room the frames of a video need on the disk.
#pragma once
#include <cstddef>
#include <string>

#include "ods/picture/save.h"
#include "ods/render/render_options.h"

// The most that one frame takes: its samples without compression, or what a finely noisy picture takes as JPEG or WebP.
// Precondition: the path names a format, options.height > 0.
double largest_frame(const std::string& path, const ods::RenderOptions& options, const ods::SaveOptions& save);

// Says how much room so many frames need where `path` will lie, and how much is free: a warning where that is less.
void say_disk_room(const std::string& path, size_t frames, double bytes_of_frame);
