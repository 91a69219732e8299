// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ods/picture/stored_picture.h"

namespace ods {

// Gives each eye of a checkerboard pixels of its own. What the file leaves out of an eye is filled from its neighbours
// (layout.h): colours get their mean in linear light, layers of LayerRule::kNearest the one with the lowest first
// channel, others the mean. Precondition: both eyes are views of the whole file. Throws as Scratch does.
void take_checkerboard_apart(StoredPicture& picture, const OpenOptions& options);

}  // namespace ods
