// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Picture files for previews.
#pragma once
#include "ods/image/image_file.h"

namespace ods {

// As open_rows(), but a JPEG comes at an eighth, a quarter or half of its size, where that is at least `least_wide`
// pixels wide: libjpeg leaves nearly all of its work out. Throws as open_rows().
std::unique_ptr<RowReader> open_small_rows(const std::string& path, int least_wide);

}  // namespace ods
