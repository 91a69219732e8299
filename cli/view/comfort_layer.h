// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The verdict of `ods comfort` on a picture, for the page to lay over it.
#pragma once
#include <string>

#include "ods/base/json_reader.h"
#include "ods/comfort/verdict.h"
#include "ods/view/view_item.h"

struct ComfortLayer {
  std::string json;         // verdict_json()
  std::string left, right;  // JPEGs of ods::heat_of()
};

// The part of a verdict that the page reads: { camera: of the heat's pictures, level, text: the worst place, worst: its
// direction, if anything strains }.
ods::Json verdict_json(const ods::StereoCamera& camera, const ods::ComfortVerdict& verdict);

// Judges a picture by its depth, or by matching its eyes. Takes seconds. Throws as judge_picture().
ComfortLayer comfort_layer(const ods::ViewItem& item);
