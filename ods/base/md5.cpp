// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/md5.h"

#include <fmt/format.h>

extern "C" {
#include <libavutil/md5.h>
}

#include <array>
#include <cstdint>

namespace ods {

std::string md5(std::string_view bytes) {
  std::array<uint8_t, 16> sum;
  av_md5_sum(sum.data(), reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  std::string text;
  for (const uint8_t byte : sum) text += fmt::format("{:02X}", byte);
  return text;
}

}  // namespace ods
