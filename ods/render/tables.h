// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The kernel's tables, computed from their definitions (layout: ods/kernel/scene_view.h).
#pragma once
#include <vector>

namespace ods {

// The tables that only some scenes need. Each takes a few tens of milliseconds of CPU time, and is 0 until requested.
struct TableNeeds {
  bool glass = false;  // volumes of rough glass
  bool sheen = false;
  bool anisotropy = false;
};

// All kTablesSize entries, computed at the first call that needs them and kept. That takes a few tens of milliseconds
// of CPU time. Safe from any thread.
const std::vector<float>& kernel_tables(const TableNeeds& needs);

}  // namespace ods
