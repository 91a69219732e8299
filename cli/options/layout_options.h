// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Options for how eyes share a picture or a video, by name.
#pragma once
#include <optional>
#include <string>

#include "cli/console/options.h"
#include "ods/camera/layout.h"

// Adds --layout LAYOUT, with the names and aliases of ods/camera/layout.h. `text` describes the option.
// fallback: the default, for help; empty: none is shown.
void add_layout_option(Options& options, std::optional<ods::Layout>& layout, const std::string& text,
                       const std::string& name = "--layout", const std::string& fallback = "");

// Adds --layout for an input file: also takes mono, as ods probe prints it, which is Layout::kSeparate.
void add_input_layout_option(Options& options, std::optional<ods::Layout>& layout, const std::string& text);

// The layout with the name or alias that `option` was given. Throws UsageError with a suggestion.
ods::Layout layout_by_name(const std::string& option, const std::string& word);
