// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ods/image/image.h"

namespace ods {

// Returns the means of whole blocks of `by` x `by` pixels of an image with 1 channel, so that positions do not move.
// Pixels beyond the last whole block are left out.
Image block_means(const Image& image, int by);

}  // namespace ods
