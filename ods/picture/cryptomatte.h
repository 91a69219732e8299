// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What each pixel of a picture shows, by name: layers of numbers in an EXR, and the names that they stand for in its
// header. Source: Friedman, Jones, "Cryptomatte Specification", version 1.2. Renderers and compositing programs know
// it; ods render --object-layer writes it.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ods/image/format/file_info.h"
#include "ods/picture/save.h"
#include "ods/picture/stored_picture.h"

namespace ods {

// MurmurHash3 for 32 bits, with the seed 0.
uint32_t murmur3(std::string_view text);

// The number of a name: its hash, as a float that is neither infinite nor NaN nor denormal.
float matte_number(std::string_view name);

struct Cryptomatte {
  std::string layer;                   // "CryptoObject"
  std::map<float, std::string> names;  // by their numbers; without those that nobody tells
};

// The layer that tells objects apart, else another; nothing if the header has none. The names are in the header, or in
// a file that it names: NAME.json in the picture's own folder, not a link and not hidden. A list of names that cannot be
// read is an empty one.
std::optional<Cryptomatte> find_cryptomatte(const FileInfo& info, const std::string& path);

// What a copy of the picture needs in its header: its attributes, and the names and numbers that such a file has in
// place of the file's name. If none can be read, the file's name stays.
std::vector<Attribute> matte_attributes(const FileInfo& info, const std::string& path);

// The channel with the numbers of what covers most of each pixel; empty: the picture has none.
std::string matte_channel(const StoredPicture& picture, const Cryptomatte& matte);

// What covers most of each pixel of an eye: its number, 0 for nothing. 1 channel; empty if the picture has no such
// layer. eye: index in StoredPicture::eyes.
Image matte_of_eye(const StoredPicture& picture, size_t eye, const Cryptomatte& matte);

// Adds a layer to what is saved as .exr: of each eye, numbers of these names, which go into the header.
void add_cryptomatte(PictureRows& rows, SaveOptions& save, std::vector<Image> numbers,
                     const std::vector<std::string>& names);

// A picture as rows, with all its layers or its colours alone. It must outlive them.
PictureRows rows_of(const Picture& picture, bool all_layers);

}  // namespace ods
