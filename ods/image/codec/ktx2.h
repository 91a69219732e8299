// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes textures in KTX 2.0 files, as used by glTF (KHR_texture_basisu): ETC1S in BasisLZ and UASTC, and uncompressed
// 8-bit texels. All except BasisLZ may be compressed by Zstandard. Only the largest level is read.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "ods/image/image_file.h"

namespace ods {

// Returns whether these are the first bytes of a KTX 2.0 file.
bool is_ktx2(std::span<const std::byte> file);

// Returns the code values of the file; the caller has to know whether they are sRGB. `name` identifies it in messages.
// Throws Error(kInput) if it is damaged, or has another format, several pictures or a video.
CodeImage decode_ktx2(std::span<const std::byte> file, const std::string& name);

}  // namespace ods
