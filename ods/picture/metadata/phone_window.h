// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The field of view of a phone's two lenses, for spatial photos and videos.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/projection.h"

namespace ods {

// A flat window with this horizontal field of view in degrees. If the file does not specify it, phones' usual one is
// assumed, with a note in `guesses`.
ProjectionSetting phone_window(std::optional<float> fov, Extent eye, std::vector<std::string>& guesses);

}  // namespace ods
