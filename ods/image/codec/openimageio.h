// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Image files through OpenImageIO, which only image_reader.cpp and image_writer.cpp know.
#pragma once
#include <string>

#include "ods/image/format/file_format.h"
#include "ods/image/format/sample_type.h"
#include "ods/image/image_file.h"

namespace ods::openimageio {

// What an ImageCodec holds: see image_file.h.
Image read_image(const std::string& path, std::string* color_fault);
FileInfo read_info(const std::string& path);
std::unique_ptr<RowReader> open_rows(const std::string& path);
Image read_channels(const std::string& path, const std::vector<std::string>& names);
CodeImage decode_image(std::span<const std::byte> file, const std::string& name, bool keep_depth);
void write_image(AtomicFile& file, const FileHeader& header, const RowSource& rows,
                 const std::function<void()>& band_done);

// OpenImageIO's names of its plugin and of a number type.
const char* plugin_name(FileFormat format);
const char* type_name(SampleType sample);

// Before anything else of it is called. Debian builds OpenImageIO so that it comments on broken files on stderr; that
// is not a library's place. It and OpenEXR have threads of their own: as many as TBB may have, so that one limit
// (tbb::global_control) holds for all.
void set_up_openimageio();

// Why there is no reader or writer of that name: this build has none. Throws std::bad_alloc where it has, and memory
// was lacking to make it.
std::string no_plugin(const char* plugin, const char* kind);

}  // namespace ods::openimageio
