// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture that its camera's lenses or meshes describe, as the lat-long that shows as much: for those who look at
// pixels by a projection.
#pragma once
#include "ods/picture/stored_picture.h"

namespace ods {

// The colours alone, as linear light, each eye of the size that it had. Precondition: the picture has maps.
StoredPicture unwrapped(const StoredPicture& picture);

}  // namespace ods
