// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The promises of ods/scene/gltf/gltf.h, checked: for the tests and the fuzzer.
#pragma once
#include <string>

#include "ods/scene/scene.h"

namespace ods {

// The first promise that a loaded Scene breaks; empty when it keeps them all.
std::string broken_promise(const Scene& scene);

}  // namespace ods
