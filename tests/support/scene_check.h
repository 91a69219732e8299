// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Checks the guarantees of ods/scene/gltf/gltf.h, for the tests and the fuzzer.
#pragma once
#include <string>

#include "ods/scene/scene.h"

namespace ods {

// The first guarantee that a loaded Scene violates. Empty if there is none.
std::string broken_promise(const Scene& scene);

}  // namespace ods
