// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens ods_images.so when a program meets its first TIFF, WebP or HDR (ods/image/codec/other_formats.h says why): for
// the command and for the tests. An object of its own, because a program that links it leaves ods/image/openimageio
// out.
#include <dlfcn.h>

#include <string>

#include "ods/base/error.h"
#include "ods/image/codec/other_formats.h"

namespace ods {

// Found beside the program, or where `make install` puts it.
const OtherFormats& other_formats() {
  static const OtherFormats* const formats = [] {
    void* library = dlopen("ods_images.so", RTLD_NOW | RTLD_LOCAL);
    void* symbol = library ? dlsym(library, "ods_other_formats") : nullptr;
    if (!symbol) throw Error(ErrorKind::kInput, std::string("the image library cannot be loaded: ") + dlerror());
    return reinterpret_cast<const OtherFormats* (*)()>(symbol)();
  }();
  return *formats;
}

}  // namespace ods
