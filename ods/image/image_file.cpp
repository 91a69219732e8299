// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/image_file.h"

#include "ods/image/image_codec.h"

namespace ods {

Image read_image(const std::string& path, std::string* color_fault) {
  return image_codec().read_image(path, color_fault);
}

FileInfo read_info(const std::string& path) {
  return image_codec().read_info(path);
}

std::unique_ptr<RowReader> open_rows(const std::string& path) {
  return image_codec().open_rows(path);
}

Image read_channels(const std::string& path, const std::vector<std::string>& names) {
  return image_codec().read_channels(path, names);
}

CodeImage decode_image(std::span<const std::byte> file, const std::string& name, bool keep_depth) {
  return image_codec().decode_image(file, name, keep_depth);
}

void write_image(AtomicFile& file, const FileHeader& header, const RowSource& rows,
                 const std::function<void()>& band_done) {
  image_codec().write_image(file, header, rows, band_done);
}

}  // namespace ods
