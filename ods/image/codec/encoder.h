// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A picture file of any format that is being encoded. A format's encoder is in the .cpp with its name.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "ods/base/error.h"
#include "ods/files/byte_sink.h"
#include "ods/image/image_file.h"

namespace ods {

class Encoder {
 public:
  virtual ~Encoder() = default;

  // Rows [begin, end), from the top and each once: interleaved by pixel, in the header's types of samples. Throws
  // Error(kOutput).
  virtual void write(int begin, int end, const std::byte* rows) = 0;
  // Call after the last row. Throws Error(kOutput).
  virtual void finish() = 0;
};

// The sink and the header must outlive what they return. Throw Error(kOutput).
std::unique_ptr<Encoder> create_png(ByteSink& sink, const FileHeader& header);
std::unique_ptr<Encoder> create_jpeg(ByteSink& sink, const FileHeader& header);
std::unique_ptr<Encoder> create_tiff(ByteSink& sink, const FileHeader& header);
std::unique_ptr<Encoder> create_webp(ByteSink& sink, const FileHeader& header);
std::unique_ptr<Encoder> create_heif(ByteSink& sink, const FileHeader& header);
std::unique_ptr<Encoder> create_hdr(ByteSink& sink, const FileHeader& header);
std::unique_ptr<Encoder> create_exr(ByteSink& sink, const FileHeader& header);

size_t bytes_of_pixel(const FileHeader& header);

Error cannot_write(const ByteSink& sink, const std::string& why);

}  // namespace ods
