// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Plans a conversion: from the options that are given, and the input's form for everything else.
#pragma once
#include <string>
#include <vector>

#include "cli/convert/convert_options.h"
#include "ods/picture/save.h"

struct ConversionPlan {
  ods::ConvertTarget target;  // its camera without maps
  ods::SaveOptions save;
  std::vector<std::string> notes;
};

// A spatial photo records the distance of its cameras. If the input records none and has no depth, --ipd does not move
// the eyes of a spatial photo, but states how far apart they were.
void take_stated_distance(const ConvertOptions& options, ods::StoredPicture& picture);

// header: of the input, or of its first frame. Opens no file. Throws UsageError if the options do not fit together.
ConversionPlan plan_conversion(const ods::StoredPicture& header, const ConvertOptions& options);
