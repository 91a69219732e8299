// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The disk space that a video's frames need.
#pragma once
#include <cstddef>
#include <string>

#include "ods/picture/save.h"
#include "ods/render/render_options.h"

// Upper limit of a frame's size: its uncompressed samples, or the size of a very noisy JPEG or WebP. Precondition: the
// path names a format, options.height > 0.
double largest_frame(const std::string& path, const ods::RenderOptions& options, const ods::SaveOptions& save);

// Reports the maximum space that the frames need at `path` and the free space; warns if that is less.
void note_disk_space(const std::string& path, size_t frames, double bytes_of_frame);

// Reports the space for frames of about this size. Throws ods::Error(kOutput) if the disk cannot hold them, unless
// `anyway`.
void check_disk_room(const std::string& path, size_t frames, double bytes_of_frame, bool anyway);
