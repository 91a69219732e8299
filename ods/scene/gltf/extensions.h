// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Every glTF extension that ods knows, and what becomes of it. The reader, its warnings, `ods info` and the table in
// docs/scenes.md all follow this list.
#pragma once
#include <span>
#include <string_view>

#include "ods/base/names.h"

namespace ods {

enum class ExtensionState {
  kRendered,      // as the extension defines it
  kApproximated,  // read; `how` says what differs
  kNoEffect,      // it changes no picture: not read, and not mentioned when rendering
  kFallback,      // not read; what the file holds for readers without the extension is rendered
  kNotRendered,   // not read, and the picture lacks it: a warning
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
  std::string_view how;  // what it is, or how it is rendered
};

// Sorted by name.
std::span<const Extension> gltf_extensions();

// The row of an extension; one that ods does not know gets kNotRendered.
Extension find_extension(std::string_view name);

// Whether the reader looks at an extension's objects.
bool is_read(std::string_view name);

// Whether a file that requires the extension can be rendered.
bool is_supported(ExtensionState state);

}  // namespace ods
