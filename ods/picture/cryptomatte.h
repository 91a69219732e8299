// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The objects in each pixel of a picture, by name: layers of numbers in an EXR, and the names of these numbers in its
// header. Source: Friedman, Jones, "Cryptomatte Specification", version 1.2. Renderers and compositing programs support
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
  std::map<float, std::string> names;  // by their numbers; numbers without a name are missing
};

// Finds the layer that distinguishes objects, or else another one. Returns nullopt if the header has none. The names
// are in the header, or in a file whose name is in the header: NAME.json in the picture's own folder, not a link and
// not hidden. If the names cannot be read, the list is empty.
std::optional<Cryptomatte> find_cryptomatte(const FileInfo& info, const std::string& path);

// The header attributes for a copy of the picture: its own, with the names and numbers of such a file instead of the
// file's name. If none can be read, the file's name is kept.
std::vector<Attribute> matte_attributes(const FileInfo& info, const std::string& path);

// The channel with the numbers of the objects that cover most of each pixel. Empty if the picture has none.
std::string matte_channel(const StoredPicture& picture, const Cryptomatte& matte);

// The number of the object that covers most of each pixel of an eye, 0 for none. 1 channel; empty if the picture has no
// such layer. eye: index in StoredPicture::eyes.
Image matte_of_eye(const StoredPicture& picture, size_t eye, const Cryptomatte& matte);

// Adds a layer to a picture that is saved as .exr: the numbers of these names for each eye. The names go into the
// header.
void add_cryptomatte(PictureRows& rows, SaveOptions& save, std::vector<Image> numbers,
                     const std::vector<std::string>& names);

// A picture as rows, with all its layers or only its colours. The picture must outlive the rows.
PictureRows rows_of(const Picture& picture, bool all_layers);

}  // namespace ods
