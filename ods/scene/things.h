// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The things of a scene by name, for messages and object layers.
#pragma once
#include <string>
#include <vector>

#include "ods/scene/scene.h"

namespace ods {

struct Things {
  std::vector<std::string> names;
  std::vector<int> of_instance;  // index in `names`
};

// Each named object is a thing. An instance that belongs to none has the name of its material, which may be empty.
Things things_of(const Scene& scene);

}  // namespace ods
