// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The kernel's tables, computed from their definitions (layout: ods/kernel/scene_view.h).
#pragma once
#include <vector>

namespace ods {

// All kTablesSize entries, computed at the first call that needs them and kept. That takes some tens of milliseconds of
// CPU time, three times as much with those for volumes of rough glass, which are 0 until requested.
// Safe from any thread.
const std::vector<float>& kernel_tables(bool glass);

}  // namespace ods
