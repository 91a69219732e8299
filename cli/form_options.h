// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of a picture's form: how its eyes share a file, its size by name.
#pragma once
#include <optional>
#include <string>

#include "cli/options.h"
#include "ods/image/sizes.h"
#include "ods/scene/render_options.h"

// --layout LAYOUT, by the names and aliases of ods/image/layout.h. `text` says what it is for.
void add_layout_option(Options& options, ods::Layout& layout, const std::string& text);
void add_layout_option(Options& options, std::optional<ods::Layout>& layout, const std::string& text,
                       const std::string& name = "--layout");

// --size NAME sets the width of an eye and the layout, and mono for sizes of one eye. Options take effect in the order
// in which they were added, so that those added after it go before it.
void add_size_option(Options& options, ods::RenderOptions& render, ods::Layout& layout);

// Throws UsageError with a suggestion.
const ods::NamedSize& size_by_name(const std::string& name);
