// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What a picture file's header says, without the pixels.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "ods/image/format/sample_type.h"

namespace ods {

struct FileInfo {
  int width = 0;
  int height = 0;
  int unread_parts = 0;                               // of an EXR: those beside the first, unless they show two eyes
  bool is_pair = false;                               // it has a second picture of this size, of the right eye (HEIC)
  bool is_float = false;                              // scene-linear; else display-encoded
  std::vector<std::string> channels;                  // R, G, B, A first
  std::vector<SampleType> samples;                    // the type of each channel, as RowReader returns them
  std::map<std::string, std::string> text;            // attributes that are text, by their names
  std::map<std::string, std::vector<float>> numbers;  // attributes that are numbers
  std::string color;                                  // the name of its colour space; empty: unspecified
  std::string color_fault;                            // why that colour space is ignored; empty: it is honoured
};

}  // namespace ods
