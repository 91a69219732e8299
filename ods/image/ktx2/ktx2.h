// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures in KTX 2.0 files, as glTF has them (KHR_texture_basisu): ETC1S in BasisLZ and UASTC; also 8-bit texels as
// they are. Each but BasisLZ may be packed by Zstandard. Of the levels only the largest is read.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "ods/image/image_file.h"

namespace ods {

// Whether these are the first bytes of such a file.
bool is_ktx2(std::span<const std::byte> file);

// The code values of the file: whether they are sRGB is its user's to know. `name` identifies it in messages. Throws
// Error(kInput) if it is damaged, or has another format, several pictures or a video.
CodeImage decode_ktx2(std::span<const std::byte> file, const std::string& name);

}  // namespace ods
