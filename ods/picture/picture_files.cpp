// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/picture_files.h"

#include <fmt/format.h>

#include "ods/base/error.h"
#include "ods/camera/layout.h"
#include "ods/files/memory_file.h"
#include "ods/files/read_file.h"
#include "ods/picture/face_files.h"
#include "ods/picture/metadata/vr_photo.h"

namespace ods {

static void check_pair(Readers& readers, const std::string& path) {
  const FileInfo &one = readers[0]->info(), &other = readers[1]->info();
  if (one.width != other.width || one.height != other.height) {
    throw cannot_read(
        path, fmt::format("its eyes have {}x{} and {}x{} pixels", one.width, one.height, other.width, other.height));
  }
  if (one.is_float != other.is_float) throw cannot_read(path, "one eye is scene-linear, the other display-encoded");
  const auto is_ours = [&](const RowReader& reader) { return is_our_own(reader.color_space(), one.is_float); };
  if (!is_ours(*readers[0]) || !is_ours(*readers[1])) {  // both become 16 bits if one has been converted to them
    for (const auto& reader : readers) reader->widen();
  }
}

Readers open_files(const std::string& path) {
  Readers readers;
  const auto open = [](const std::string& name) { return names_faces(name) ? open_faces(name) : open_rows(name); };
  if (!names_eye(path)) {
    readers.push_back(open(path));
    return readers;
  }
  for (int eye : {kLeft, kRight}) readers.push_back(open(path_for_eye(path, eye)));
  check_pair(readers, path);
  return readers;
}

static void open_right_eye(Readers& readers, const MemoryFile& file, const std::string& path) {
  try {
    readers.push_back(open_rows(file.path()));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    throw cannot_read(path, "the JPEG of its right eye is damaged");
  }
  check_pair(readers, path);
}

void open_second_eye(Readers& readers, const std::string& path, std::vector<std::string>& warnings) {
  if (readers[0]->info().is_pair) {
    readers.push_back(open_rows(path, 1));
    check_pair(readers, path);
  } else {
    open_right_eye(readers, MemoryFile(read_right_eye(path, warnings)), path);
  }
}

}  // namespace ods
