// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A handle of a file for libtiff: its input and output, and its messages.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

struct tiff;  // libtiff's TIFF

namespace ods {

// The bytes of a file for libtiff.
struct TiffStream {
  virtual ~TiffStream() = default;
  // At the position `at`, which they advance. read() returns the number of bytes read.
  virtual size_t read(void* to, size_t count) = 0;
  virtual void write(const void* from, size_t count) = 0;
  virtual uint64_t size() = 0;

  uint64_t at = 0;
  char words[500] = "";  // libtiff's first error
};

struct TiffCloser {
  void operator()(tiff* handle) const;
};
using TiffHandle = std::unique_ptr<tiff, TiffCloser>;

// Opens a handle. `mode`: as for TIFFOpen(). `most`: bytes that libtiff may allocate at once; 0 for no limit. Returns
// nullptr on failure. The stream must outlive the handle.
TiffHandle open_tiff_handle(TiffStream& stream, const std::string& name, const char* mode, uint64_t maximum);

}  // namespace ods
