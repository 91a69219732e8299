// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Named sizes: the sizes of the page "Omnidirectional stereo (ODS) with POV-Ray" that are in use today, and the sizes
// that headsets, players and sites accept. A row specifies no more than its source does.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "ods/camera/layout.h"

namespace ods {

struct NamedSize {
  std::string_view name;   // as the command line spells it
  std::string_view title;  // its name in the source
  Extent eye;
  std::optional<Layout> layout;  // not set if the picture serves both eyes
  int fps = 0;                   // pictures per second; 0 if the source specifies none
  std::string_view antialias;    // the source's recommendation: "off", "on, threshold 0.3"; empty if it has none
  std::string_view source;
};

std::span<const NamedSize> named_sizes();

// The size of the file that contains the eyes.
Extent file_size(const NamedSize& size);

}  // namespace ods
