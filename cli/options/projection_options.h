// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that state a picture's projection, shared by the commands that make or read one.
#pragma once
#include <functional>
#include <string>

#include "cli/console/options.h"
#include "ods/camera/projection.h"
#include "ods/picture/metadata/stereo_format.h"

// option: the name of the one that names the projection. is_open: returns whether the projection is, without that
// option, a file's that is not read yet; then the numbers of its lens are not looked at.
void add_projection_options(Options& options, ods::ProjectionSetting& projection,
                            const std::string& option = "--projection", const std::function<bool()>& is_open = {});

// Throws UsageError, whose message says that `option` was given the name.
ods::ProjectionSetting projection_by_name(const std::string& option, const std::string& name);

// Finds the height of one eye's picture if it is 0, or else the aspect of a perspective view. Throws UsageError if the
// numbers do not fit together.
void finish_projection(ods::ProjectionSetting& projection, int width, int& height);

// Options for files that show a camera's own fisheyes: --front-and-back and --circle. Add them before the argument that
// opens the file.
void add_lens_options(Options& options, ods::FormatHint& known);

// What these options imply: a fisheye, and two halves if they look ahead and back.
void finish_lens_options(ods::FormatHint& known);

// What a picture, frames (the first that exists) or a video that a command reads shows: as ods::identified(), whose
// doubts become notes. `known` alone if there is nothing to look at; opening it says what is wrong.
ods::FormatHint identified_input(const std::string& path, const ods::FormatHint& known);
