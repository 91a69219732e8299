// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on tagging pictures and on Cardboard photos: any bytes are tagged or give an error; a tagged picture can be
// tagged again, and untagged.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_picture_tagger
//   build/fuzz/fuzz_picture_tagger -max_len=16384 folder/of/small/pictures
#include <cstdlib>

#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/image/format/xmp_file.h"
#include "ods/picture/metadata/tag_picture.h"
#include "ods/picture/metadata/vr_photo.h"

static void read_photo(const std::string& path) {
  try {
    std::vector<std::string> warnings;
    if (ods::is_photo(path)) ods::read_right_eye(path, warnings);
  } catch (const ods::Error&) {
  }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  const std::string tagged = "/dev/shm/ods-fuzz/picture";
  read_photo(file.path());
  ods::PictureTag tag;
  tag.camera.yaw = 90.0f;
  try {
    std::vector<std::string> guesses;
    ods::complete_tag({}, file.path(), guesses);
    ods::tag_picture(file.path(), tagged, tag);
  } catch (const ods::Error&) {
    return 0;
  }
  ods::tag_picture(tagged, tagged, tag);  // must not throw
  ods::read_xmp(tagged);
  ods::tag_picture(tagged, tagged, std::nullopt);
  return 0;
}
