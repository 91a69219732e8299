// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Comfort's verdicts as pictures.
#pragma once
#include <string>
#include <vector>

#include "cli/comfort/judged.h"
#include "ods/picture/picture.h"

// What is ok in grey; the rest in yellow, orange and red. 3 channels, linear.
ods::Image heat_of(const Judged& judged, const ods::ComfortReport& report);

// reports: of each of the eyes.
ods::Picture heat_picture(const Looked& looked, const std::vector<ods::ComfortReport>& reports);
void save_heat(const std::string& path, const Looked& looked, const std::vector<ods::ComfortReport>& reports);

// heat_of() as a PNG.
std::string heat_png(const Judged& judged, const ods::ComfortReport& report);
