// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Sizes that people ask for by name: those of the page "Omnidirectional stereo (ODS) with POV-Ray" that are in use
// today, and what headsets, players and sites take. A row says no more than its source does.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "ods/camera/layout.h"

namespace ods {

struct NamedSize {
  std::string_view name;   // of the command line
  std::string_view title;  // what its source calls it
  Extent eye;
  std::optional<Layout> layout;  // none: a picture for both eyes
  int fps = 0;                   // pictures a second; 0: the source names none
  std::string_view antialias;    // what the source asks for: "off", "on, threshold 0.3"; empty: nothing
  std::string_view source;
};

std::span<const NamedSize> named_sizes();

// The size of the file that holds the eyes.
Extent file_size(const NamedSize& size);

}  // namespace ods
