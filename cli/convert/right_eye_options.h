// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options that make the right eye's picture agree with the left one's.
#pragma once
#include "cli/console/options.h"
#include "ods/camera/eye_correction.h"

void add_right_eye_options(Options& options, ods::EyeCorrection& right);
