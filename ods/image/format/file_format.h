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

// Those that are written; kHeif (HEIC, AVIF) is only read.
inline constexpr FileFormat kFileFormats[] = {FileFormat::kPng,  FileFormat::kJpeg, FileFormat::kTiff,
                                              FileFormat::kWebp, FileFormat::kHdr,  FileFormat::kExr};
static_assert(std::size(kFileFormats) + 1 == enumerator_count<FileFormat>());

// By file extension; case does not matter. Only formats that are written.
std::optional<FileFormat> format_of_path(const std::string& path);

// Whether a file with this extension is a picture that is read.
bool names_picture(const std::string& path);

// By the file's first bytes; ignores the name.
std::optional<FileFormat> format_of_bytes(std::span<const std::byte> file);

std::optional<FileFormat> format_of_file(const FileInput& file);

// `png, jpg, jpeg, tif, tiff, webp, hdr, exr`, for messages; the second one also has those that are only read.
std::string known_extensions();
std::string readable_extensions();

// Whether the format holds scene-referred light; the others are display-referred.
bool is_scene_referred(FileFormat format);

// The maximum width or height in this format.
int longest_side(FileFormat format);

}  // namespace ods
