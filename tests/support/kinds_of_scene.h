// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sixteen scenes of the kinds that users bring, for tests and for docs/images/kinds.jpg. None has a view point or an
// environment; those that have lamps say so.
#pragma once
#include <vector>

#include "ods/stage/survey.h"

namespace ods {

struct KindOfScene {
  const char* name;
  Scene (*make)();
  SceneKind kind;    // what it is to be taken for
  const char* note;  // part of what is to be said of its light or its unit; empty: nothing is supplied
};

const std::vector<KindOfScene>& kinds_of_scene();

}  // namespace ods
