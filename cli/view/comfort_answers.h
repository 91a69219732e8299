// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Verdicts on the studio's picture, for its page. comfort_layer.h has those on picture files.
#pragma once
#include <string>

#include "cli/http/http_server.h"
#include "ods/base/json_reader.h"
#include "ods/studio/live_render.h"

// The layer over an eye of the studio's picture, a PNG of heat_of() (ods/comfort/heat.h); 204 until there is a picture.
WebAnswer heat_answer(const ods::LiveSeen& seen, int eye);

// Returns verdict_json() of the studio's picture, its share of each level, and the merge that its depth allows: 180
// shares of the eye distance, from the zenith down. Null until there is a picture.
ods::Json comfort_json(const ods::LiveSeen& seen);

// Returns the shares of the eye distance that a merge by depth leaves, from the zenith down.
ods::Json merge_json(const ods::Image& map);

// Adds `comfort`, the verdict on the point that a click met, to the answer.
void add_comfort(ods::Json& pick, const ods::StereoCamera& camera, const ods::LivePick& found, int eye);
