// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The report of ods comfort as one page that needs nothing else: pictures are within, no address is outside.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "ods/comfort/strain.h"
#include "ods/image/image.h"

struct PagePicture {
  std::string caption;
  ods::Image light;  // 3 channels, linear
};

struct PageThing {
  ods::ComfortLevel level = ods::ComfortLevel::kOk;
  std::string title;        // "'Lamp', 0.41 m away"
  std::string where, what;  // "23 degrees right, 12 down"; what strains, and how much
  std::string cure;
  ods::Image crop;  // likewise; empty: none
};

struct PageCurve {
  std::string title, unit;
  std::vector<std::pair<double, double>> points;  // seconds, value
  ods::StrainLimits limits{};                     // 0 or infinite: none; as values
};

struct ComfortPage {
  std::string title;
  ods::ComfortLevel level = ods::ComfortLevel::kOk;
  std::vector<std::string> lines;
  std::vector<std::pair<ods::ComfortLevel, double>> shares;  // of the picture
  std::vector<PagePicture> pictures;
  std::vector<PageThing> things;
  std::vector<PageCurve> curves;
  std::vector<std::string> cures;
  std::vector<std::pair<std::string, std::string>> sources;  // of the limits: what strains, who says so
};

// Throws ods::Error(kOutput).
void write_page(const std::string& path, const ComfortPage& page);
