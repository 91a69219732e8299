// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the studio's server says of comfort. (Of a picture file: comfort_layer.h.)
#pragma once
#include <string>

#include "cli/http/http_server.h"
#include "ods/base/json_reader.h"
#include "ods/studio/live_render.h"

// What the page lays over the studio's picture, of an eye: heat_png() of cli/comfort/heat.h; 204 while there is none.
WebAnswer heat_answer(const ods::LiveSeen& seen, int eye);

// verdict_json() on the studio's picture, its share of each level, and the merge that its depth allows: 180 shares of
// the eye distance, from the zenith down. Null while there is no picture.
ods::Json comfort_json(const ods::LiveSeen& seen);

// What a click meets: adds `comfort` to the answer.
void add_comfort(ods::Json& pick, const ods::StereoCamera& camera, const ods::LivePick& found, int eye);
