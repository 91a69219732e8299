// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What ods rig prints about a plan.
#pragma once
#include "ods/stitch/slit_rig.h"

// To stdout: the number and size of the views, how far off and how sharp the stitched picture is. `nearest`: metres to
// the nearest thing.
void print_plan(const ods::SlitRig& rig, float nearest);
