// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Capitals, digits and a few signs as straight strokes: lettering for scenes made in code.
#pragma once
#include <string>

#include "ods/scene/builtin/shapes.h"

namespace ods {

// One line of text made of bars, centred at the origin, read from +Z, `height` metres tall and `stroke` thick.
// Knows A-Z, 0-9, space, '+', '-' and '.'; any other character leaves a gap.
Shape make_text(const std::string& text, float height, float stroke);

}  // namespace ods
