// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The image files that are read and written.
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

// By extension, in capitals or not.
std::optional<FileFormat> format_of_path(const std::string& path);

// By its first bytes, whatever the name says.
std::optional<FileFormat> format_of_bytes(std::span<const std::byte> file);

std::optional<FileFormat> format_of_file(const FileInput& file);

// `png, jpg, jpeg, tif, tiff, webp, hdr, exr`, for messages.
std::string known_extensions();

// Holds the light of the scene; the others hold what a display shows.
bool is_scene_referred(FileFormat format);

// The longest side a file of this format can have.
int longest_side(FileFormat format);

}  // namespace ods
