// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a picture file says of itself, without its pixels.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "ods/image/format/sample_type.h"

namespace ods {

// What a file says of itself, without its pixels.
struct FileInfo {
  int width = 0;
  int height = 0;
  bool is_float = false;                              // light as it is; else code values of a display
  std::vector<std::string> channels;                  // R, G, B, A first
  std::vector<SampleType> samples;                    // of every channel, as RowReader gives them
  std::map<std::string, std::string> text;            // attributes that are words, by OpenImageIO's names
  std::map<std::string, std::vector<float>> numbers;  // and those that are numbers
  std::string color;                                  // the name of its colour space; empty: it does not say
  std::string color_fault;                            // why that is ignored; empty: it is honoured
};

}  // namespace ods
