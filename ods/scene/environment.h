// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
// stand-in
#pragma once
#include <string>

#include "ods/scene/scene.h"
namespace ods {
Environment load_environment(const std::string& path);
}  // namespace ods
