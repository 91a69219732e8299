// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// EXR files in all variants, written and read by OpenEXR itself.
#pragma once
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>

#include <functional>
#include <string>
#include <vector>

#include "ods/image/format/sample_type.h"

namespace ods {

struct ExrForm {
  int width = 53;
  int height = 67;
  std::vector<std::string> channels = {"R", "G", "B"};
  std::vector<Imf::PixelType> types;  // types of the channels; empty for halves
  std::string packing = "zip";        // a name in names_of_packings()
  Imf::LineOrder order = Imf::INCREASING_Y;
  int tile = 0;  // the side of its tiles; 0 for none
  int left = 0;  // left edge of the data window
  int top = 0;
  std::function<void(Imf::Header&)> prepare;
};

// "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab".
const std::vector<std::string>& names_of_packings();

size_t bytes_of_pixels(const ExrForm& form);

// A part for each form. `pixels`: interleaved, in the types of the channels.
void write_exr(const std::string& path, const std::vector<ExrForm>& parts,
               const std::vector<std::vector<std::byte>>& pixels);
inline void write_exr(const std::string& path, const ExrForm& form, const std::vector<std::byte>& pixels) {
  write_exr(path, std::vector<ExrForm>{form}, std::vector<std::vector<std::byte>>{pixels});
}

// Writes floats, which become halves if the form requires it.
void write_exr_of(const std::string& path, const ExrForm& form, const std::vector<float>& values);

Imf::Header exr_header(const std::string& path);
// The first part's pixels, in the channels and types of the form.
std::vector<std::byte> read_exr(const std::string& path, const ExrForm& form);
// An attribute that a test expects.
template <class Attribute>
auto exr_value(const Imf::Header& header, const char* name) {
  return header.typedAttribute<Attribute>(name).value();
}

}  // namespace ods
