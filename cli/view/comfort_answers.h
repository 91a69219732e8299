// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the studio's server says of comfort. (Of a picture file: comfort_layer.h.)
#pragma once
#include <string>

#include "cli/http/http_server.h"
#include "ods/base/json_reader.h"
#include "ods/studio/live_render.h"

// A PNG of an eye of the studio's picture (heat_png() of cli/comfort/heat.h); 204 while there is none.
WebAnswer heat_answer(const ods::LiveSeen& seen, int eye);

// The verdict on the studio's picture, and the merge that its depth allows: 180 shares of the eye distance, from the
// zenith down. Null while there is none.
ods::Json comfort_json(const ods::LiveSeen& seen);

// What a click meets: adds `comfort` to the answer.
void add_comfort(ods::Json& pick, const ods::StereoCamera& camera, const ods::LivePick& found, int eye);
