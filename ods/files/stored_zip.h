// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes .zip archives whose files are stored as they are, so that programs can map them into memory. The date of every
// file is 1980-01-01: the same files make the same archive.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "ods/files/byte_sink.h"

namespace ods {

struct StoredFile {
  std::string name;  // in ASCII, with '/' between folders
  std::string bytes;
};

// alignment: each file's bytes start at a multiple of it, because an extra field (0x1986, as in USDZ) fills the space
// before them. The sink must be at position 0. Throws Error(kOutput) for more than 4 GB or 65,535 files.
void write_stored_zip(ByteSink& sink, std::span<const StoredFile> files, size_t alignment);

}  // namespace ods
