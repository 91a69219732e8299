// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles two eyes in the halves of a file with an odd side, from which a column or a row was cut. If the middle one is
// left out, both eyes begin at their own first column, whichever edge was cut.
#pragma once
#include "ods/camera/layout.h"

namespace ods {

// Removes the middle column or row of such a file. Other layouts, and even sides, are unchanged.
Extent without_middle(Layout layout, Extent packed);
Image without_middle(Layout layout, const Image& packed);

}  // namespace ods
