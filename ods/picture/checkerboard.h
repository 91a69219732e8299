// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ods/picture/stored_picture.h"

namespace ods {

// Gives each eye of a checkerboard its own pixels. Pixels of an eye that are missing in the file are filled from the
// adjacent ones (layout.h): colours with the mean in linear light, layers of LayerRule::kNearest with the pixel whose
// first channel is lowest, others with the mean. Precondition: both eyes are views of the whole file. Throws like
// Scratch.
void take_checkerboard_apart(StoredPicture& picture, const OpenOptions& options);

}  // namespace ods
