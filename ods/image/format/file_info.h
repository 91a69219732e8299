// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The data in a picture file's header, without the pixels.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "ods/image/format/sample_type.h"

namespace ods {

struct FileInfo {
  int width = 0;
  int height = 0;
  int unread_parts = 0;                               // EXR: the parts after the first, unless they are two eyes
  bool is_pair = false;                               // has a second picture of this size, for the right eye (HEIC)
  bool is_float = false;                              // scene-linear; else display-encoded
  std::vector<std::string> channels;                  // R, G, B, A first
  std::vector<SampleType> samples;                    // the type of each channel, as RowReader returns them
  std::map<std::string, std::string> text;            // text attributes by name
  std::map<std::string, std::vector<float>> numbers;  // number attributes by name
  std::string color;                                  // the name of its colour space; empty if unspecified
  std::string color_fault;                            // why that colour space is ignored; empty if it is used
};

}  // namespace ods
