// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sixteen scenes of the kinds that users have, for tests and for docs/images/kinds.jpg. None has a view point or an
// environment. The comments on the scenes mention their lamps.
#pragma once
#include <vector>

#include "ods/stage/survey.h"

namespace ods {

struct KindOfScene {
  const char* name;
  Scene (*make)();
  SceneKind kind;    // the expected kind
  const char* note;  // expected part of the note on its light or its unit; empty if no light is added
};

const std::vector<KindOfScene>& kinds_of_scene();

}  // namespace ods
