// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// How eyes share a picture or a video, by name.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/camera/layout.h"

// --layout LAYOUT, by the names and aliases of ods/camera/layout.h. `text` says what it is for.
void add_layout_option(Options& options, ods::Layout& layout, const std::string& text);
void add_layout_option(Options& options, std::optional<ods::Layout>& layout, const std::string& text,
                       const std::string& name = "--layout");

// By name or alias, as `option` was given it. Throws UsageError with a suggestion.
ods::Layout layout_by_name(const std::string& option, const std::string& word);
