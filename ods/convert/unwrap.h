// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Converts a picture that is described by its camera's lenses or meshes to a lat-long picture of the same directions,
// for code that needs a projection.
#pragma once
#include "ods/picture/stored_picture.h"

namespace ods {

// Converts only the colours, as linear light, each eye at its original size. Precondition: the picture has maps.
StoredPicture unwrapped(const StoredPicture& picture);

}  // namespace ods
