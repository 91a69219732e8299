// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Real-time objects in the layered scenes, and in the pictures with depth, that ods view shows.
#pragma once
#include <vector>

#include "cli/convert/depth_input.h"
#include "cli/options/scene_source.h"
#include "ods/view/view_item.h"

// Opens the objects of the options and puts them into the only layered scene among the items, or, without one, into the
// only picture, which then gets its stage (ods/view/picture_stage.h); depth is the picture's. Without options, every
// layered scene and picture gets the objects that the file beside it lists (ods/view/placements.h); one of them that
// cannot be opened is left out, with a warning, and so are all of a picture without depth. Throws UsageError if there
// is not exactly one such item, or depth for none, and as open_object(), give_depth() and make_stage().
void add_objects(const ObjectOptions& options, const DepthInput& depth, std::vector<ods::ViewItem>& items);
