// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The words by which players of 360 videos recognise a file from its name, beside the names of layouts and projections
// that ods itself has. docs/foreign.md has this table for users; tests/cli/docs_test.cpp compares the two. Sources: the
// pages of Skybox, DeoVR, HereSphere, 4XVR, Pigasus and Jellyfin about file names.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "ods/camera/layout.h"
#include "ods/camera/projection.h"

namespace ods {

struct NameWordRow {
  std::string_view word;                        // in lower case; letter case does not matter
  std::string_view text;                        // for users
  std::optional<Layout> layout{};               // or:
  std::optional<NamedProjection> projection{};  // with the field of view of the lens
};
std::span<const NameWordRow> name_words();

// Returns whether the layout packs both eyes into one picture, so that they can be separated.
bool is_packing(Layout layout);

// Returns whether a word between or after these says nothing about the format: a number, a size (1920x1080, 8k, 2160p),
// a rate (60fps), a codec, `injected`, `alpha` and a few more.
bool is_neutral_token(std::string_view word);

}  // namespace ods
