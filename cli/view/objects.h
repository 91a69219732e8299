// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in the layered scenes that ods view shows.
#pragma once
#include <vector>

#include "cli/options/scene_source.h"
#include "ods/view/view_item.h"

// Opens the objects of the options and puts them into the only layered scene among the items. Without options, every
// layered scene gets the objects that the file beside it lists (ods/view/placements.h); one of them that cannot be
// opened is left out, with a note. Throws UsageError if there is not exactly one layered scene, and as open_object().
void add_objects(const ObjectOptions& options, std::vector<ods::ViewItem>& items);
