// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The supported image file formats.
#pragma once
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string>

#include "ods/base/names.h"
#include "ods/files/file_input.h"

namespace ods {

enum class FileFormat { kPng, kJpeg, kTiff, kWebp, kHdr, kExr, kHeif };

// The formats in which any picture can be written. kHeif (HEIC, AVIF) is written only as a spatial photo.
inline constexpr FileFormat kFileFormats[] = {FileFormat::kPng,  FileFormat::kJpeg, FileFormat::kTiff,
                                              FileFormat::kWebp, FileFormat::kHdr,  FileFormat::kExr};
static_assert(std::size(kFileFormats) + 1 == enumerator_count<FileFormat>());

// The format by file extension, in upper or lower case. Only formats that can be written: of HEIF, `.heic`.
std::optional<FileFormat> format_of_path(const std::string& path);

// Returns whether a file with this extension is a readable picture.
bool names_picture(const std::string& path);

// The format by the file's first bytes, regardless of its name.
std::optional<FileFormat> format_of_bytes(std::span<const std::byte> file);

std::optional<FileFormat> format_of_file(const FileInput& file);

// `png, jpg, jpeg, mpo, jps, tif, tiff, webp, heic, hdr, exr`, for messages; the second function adds those that can only be
// read.
std::string known_extensions();
std::string readable_extensions();

// Returns whether the format stores scene-referred light; the others are display-referred.
bool is_scene_referred(FileFormat format);

// The maximum width or height in this format.
int longest_side(FileFormat format);

}  // namespace ods
