// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The disk space that a video's frames need.
#pragma once
#include <cstddef>
#include <string>

#include "ods/picture/save.h"
#include "ods/render/render_options.h"

// Upper limit of a frame's size: its uncompressed samples, or what a very noisy picture takes as JPEG or WebP.
// Precondition: the path names a format, options.height > 0.
double largest_frame(const std::string& path, const ods::RenderOptions& options, const ods::SaveOptions& save);

// Reports the space that the frames need at `path` at most and the free space; a warning if that is less.
void say_disk_room(const std::string& path, size_t frames, double bytes_of_frame);

// Likewise for frames that are about this large. Throws ods::Error(kOutput) if the disk cannot hold them, unless they
// are to be made anyway.
void check_disk_room(const std::string& path, size_t frames, double bytes_of_frame, bool anyway);
