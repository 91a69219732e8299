// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The files of blender/, which the build puts into the command: Python that runs inside Blender.
#pragma once
#include <span>
#include <string_view>

struct BridgeFile {
  std::string_view name;  // in blender/: "omnistereo/bridge/export.py"
  std::string_view text;
};

std::span<const BridgeFile> bridge_files();
