// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The glTF extensions known to ods, and their handling. The reader, its warnings, `ods info` and the table in
// docs/scenes.md all use this list.
#pragma once
#include <span>
#include <string_view>

#include "ods/base/names.h"

namespace ods {

enum class ExtensionState {
  kRendered,      // as the extension defines it
  kApproximated,  // read; `how` describes the differences
  kNoEffect,      // it affects no picture: not read, and not mentioned when rendering
  kFallback,      // not read; the fallback in the file for readers without the extension is rendered
  kNotRendered,   // not read, and missing in the picture, with a warning
};

inline constexpr NameRow<ExtensionState> kExtensionStateTable[] = {
    {ExtensionState::kRendered, "rendered"},        {ExtensionState::kApproximated, "approximated"},
    {ExtensionState::kNoEffect, "no effect"},       {ExtensionState::kFallback, "fallback"},
    {ExtensionState::kNotRendered, "not rendered"},
};
static_assert(has_every_member(kExtensionStateTable));

struct Extension {
  std::string_view name;
  ExtensionState state;
  std::string_view how;  // its effect, or its treatment by the renderer
};

// Sorted by name.
std::span<const Extension> gltf_extensions();

// The row of an extension; unknown ones get kNotRendered.
Extension find_extension(std::string_view name);

// Returns whether the reader reads an extension's objects.
bool is_read(std::string_view name);

// Returns whether a file that requires the extension can be rendered.
bool is_supported(ExtensionState state);

}  // namespace ods
