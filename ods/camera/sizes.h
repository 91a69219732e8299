// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Named sizes: those of the page "Omnidirectional stereo (ODS) with POV-Ray" that are in use today, and those that
// headsets, players and sites accept. A row states no more than its source does.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "ods/camera/layout.h"

namespace ods {

struct NamedSize {
  std::string_view name;   // as the command line spells it
  std::string_view title;  // what its source calls it
  Extent eye;
  std::optional<Layout> layout;  // none: the picture serves both eyes
  int fps = 0;                   // pictures per second; 0: the source names none
  std::string_view antialias;    // what the source recommends: "off", "on, threshold 0.3"; empty: nothing
  std::string_view source;
};

std::span<const NamedSize> named_sizes();

// The size of the file that contains the eyes.
Extent file_size(const NamedSize& size);

}  // namespace ods
