// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What `ods comfort` says of a picture, for the page to lay over it.
#pragma once
#include <string>

#include "ods/view/view_item.h"

struct ComfortLayer {
  std::string json;         // { camera: of the heat's pictures, level, text: of the worst }
  std::string left, right;  // JPEGs: what is ok in grey, the rest in yellow, orange and red
};

// By the picture's depth, or by matching its eyes. Takes seconds. Throws ods::Error: as `ods comfort` where nothing can
// be judged.
ComfortLayer comfort_layer(const ods::ViewItem& item);
