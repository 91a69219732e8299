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

enum class FileFormat { kPng, kJpeg, kTiff, kWebp, kHdr, kExr };

inline constexpr FileFormat kFileFormats[] = {FileFormat::kPng,  FileFormat::kJpeg, FileFormat::kTiff,
                                              FileFormat::kWebp, FileFormat::kHdr,  FileFormat::kExr};
static_assert(std::size(kFileFormats) == enumerator_count<FileFormat>());

// By file extension; case does not matter.
std::optional<FileFormat> format_of_path(const std::string& path);

// By the file's first bytes; ignores the name.
std::optional<FileFormat> format_of_bytes(std::span<const std::byte> file);

std::optional<FileFormat> format_of_file(const FileInput& file);

// `png, jpg, jpeg, tif, tiff, webp, hdr, exr`, for messages.
std::string known_extensions();

// Whether the format holds scene-referred light; the others are display-referred.
bool is_scene_referred(FileFormat format);

// The maximum width or height in this format.
int longest_side(FileFormat format);

}  // namespace ods
