// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// libFuzzer on what pictures record of their eyes and their place: MPF and the stereo descriptor of JPEG, pixel shapes,
// positions in a TIFF. Any bytes give numbers in their ranges, or an error.
//   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_stereo_reader
//   build/fuzz/fuzz_stereo_reader -max_len=16384 folder/of/small/pictures
#include <cmath>
#include <cstdlib>

#include "ods/base/bytes.h"
#include "ods/base/error.h"
#include "ods/files/memory_file.h"
#include "ods/image/format/pixel_place.h"
#include "ods/picture/metadata/stereo_format.h"

static void check(const ods::FileInfo& info, const std::string& path) {
  const double aspect = ods::pixel_aspect(info);
  if (!(aspect > 0.0 && std::isfinite(aspect))) std::abort();
  const ods::StereoFormat format = ods::find_format(info, path, {});
  const glm::vec2 latitude = format.camera.projection.latitude, longitude = format.camera.projection.longitude;
  if (!(latitude.x < latitude.y && longitude.x < longitude.y)) std::abort();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const ods::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    check(ods::read_info(file.path()), file.path());
  } catch (const ods::MalformedFile&) {
    std::abort();  // it is for one file's own readers, and becomes an Error
  } catch (const ods::Error&) {
  }
  return 0;
}
