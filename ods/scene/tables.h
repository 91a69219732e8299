// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The kernel's tables, computed from their definitions (layout: ods/kernel/scene_view.h).
#pragma once
#include <vector>

namespace ods {

// All kTablesSize entries. Computed at the first call (some tens of milliseconds), then kept. Safe from any thread.
const std::vector<float>& kernel_tables();

}  // namespace ods
