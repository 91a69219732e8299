// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the plan of ods rig.
#pragma once
#include "ods/stitch/slit_rig.h"

// Prints to stdout the number and size of the views, and the error and sharpness of the stitched picture. `nearest`:
// metres to the nearest surface.
void print_plan(const ods::SlitRig& rig, float nearest);
