// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What each of a phone's two lenses sees, of spatial photos and videos.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ods/camera/layout.h"
#include "ods/camera/projection.h"

namespace ods {

// A flat window, so many degrees across. Where the file does not say, it is as wide as phones' usual ones, and
// `guesses` say so.
ProjectionSetting phone_window(std::optional<float> fov, Extent eye, std::vector<std::string>& guesses);

}  // namespace ods
