// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that say which projection a picture has. Shared by the commands that make or read one.
#pragma once
#include <string>

#include "cli/console/options.h"
#include "ods/camera/projection.h"

// name: of the option that names it, beside --projection; empty: no other.
void add_projection_options(Options& options, ods::ProjectionSetting& projection, const std::string& name = "");

// Throws UsageError, in which `option` was given the name.
ods::ProjectionSetting projection_by_name(const std::string& option, const std::string& name);

// Finds the height of one eye's picture where it is 0, and a window's aspect where it is not. Throws UsageError where
// the numbers do not fit together.
void finish_projection(ods::ProjectionSetting& projection, int width, int& height);
