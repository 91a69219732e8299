// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames whose rows or columns belong to the left and to the right eye in turn.
#pragma once
#include "ods/video/decode.h"

namespace ods {

// The frame with its even rows above its odd rows (Views::kRows), or its even columns beside its odd columns
// (Views::kColumns). The chroma planes are divided in the same way. size: of the frame.
DecodedFrame take_apart(const DecodedFrame& frame, Extent size, Views views);

}  // namespace ods
