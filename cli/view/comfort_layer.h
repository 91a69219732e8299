// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What `ods comfort` says of a picture, for the page to lay over it.
#pragma once
#include <string>

#include "ods/base/json_reader.h"
#include "ods/comfort/comfort.h"
#include "ods/view/view_item.h"

struct ComfortLayer {
  std::string json;         // verdict_json()
  std::string left, right;  // JPEGs: what is ok in grey, the rest in yellow, orange and red
};

// What the page reads of a verdict: { camera: of the heat's pictures, level, text: of the worst, worst: where, if
// anything strains }.
ods::Json verdict_json(const ods::StereoCamera& camera, const ods::ComfortReport& report, ods::ComfortLevel level);

// By the picture's depth, or by matching its eyes. Takes seconds. Throws ods::Error: as `ods comfort` where nothing can
// be judged.
ComfortLayer comfort_layer(const ods::ViewItem& item);
