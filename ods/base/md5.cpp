// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/md5.h"

#include <fmt/format.h>

extern "C" {
#include <libavutil/md5.h>
#include <libavutil/mem.h>
}

#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <new>
#include <vector>

#include "ods/base/error.h"
#include "ods/base/read_file.h"

namespace ods {

static std::string in_digits(const std::array<uint8_t, 16>& sum) {
  std::string text;
  for (const uint8_t byte : sum) text += fmt::format("{:02X}", byte);
  return text;
}

std::string md5(std::string_view bytes) {
  std::array<uint8_t, 16> sum;
  av_md5_sum(sum.data(), reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  return in_digits(sum);
}

std::string md5_of_file(const std::string& path) {
  size_t left = file_size(path);  // which says why not
  std::ifstream stream(path, std::ios::binary);
  const std::unique_ptr<AVMD5, void (*)(void*)> state(av_md5_alloc(), av_free);
  if (!state) throw std::bad_alloc();
  av_md5_init(state.get());
  std::vector<char> part(size_t{1} << 20);
  while (left > 0 && stream) {
    stream.read(part.data(), static_cast<std::streamsize>(std::min(left, part.size())));
    const auto count = static_cast<size_t>(stream.gcount());
    av_md5_update(state.get(), reinterpret_cast<const uint8_t*>(part.data()), count);
    left -= count;
  }
  if (left > 0) throw Error(ErrorKind::kInput, fmt::format("cannot read '{}': reading stopped halfway", path));
  std::array<uint8_t, 16> sum;
  av_md5_final(state.get(), sum.data());
  return in_digits(sum);
}

}  // namespace ods
