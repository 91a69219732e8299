// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The output of a decoder, as a whole and in bands.
#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "ods/image/codec/decoder.h"

namespace ods {

using Bytes = std::vector<std::byte>;

inline Bytes read_rows(Decoder& decoder, int begin, int end, size_t first, size_t count) {
  size_t pixel = 0;
  for (size_t c = first; c < first + count; c++) pixel += bytes_of(decoder.info.samples[c]);
  Bytes rows(pixel * static_cast<size_t>(decoder.info.width) * static_cast<size_t>(end - begin));
  decoder.read(begin, end, first, count, rows.data());
  return rows;
}

inline Bytes read_all(Decoder& decoder) {
  return read_rows(decoder, 0, decoder.info.height, 0, decoder.info.channels.size());
}

// Reads the same rows again, from the middle, and again from the top.
inline void expect_bands(Decoder& decoder) {
  const Bytes all = read_all(decoder);
  const int height = decoder.info.height;
  const size_t row = all.size() / static_cast<size_t>(height), channels = decoder.info.channels.size();
  for (const auto& [begin, end] : {std::pair(height / 2, height), std::pair(0, 1), std::pair(height / 3, height / 2)}) {
    const Bytes rows = read_rows(decoder, begin, end, 0, channels);
    EXPECT_EQ(std::memcmp(rows.data(), &all[row * static_cast<size_t>(begin)], rows.size()), 0) << begin;
  }
  const size_t last = channels - 1, size = bytes_of(decoder.info.samples[last]),
               pixel = row / static_cast<size_t>(decoder.info.width);
  const Bytes one = read_rows(decoder, 0, height, last, 1);
  for (size_t i = 0; i < one.size() / size; i++) {
    ASSERT_EQ(std::memcmp(&one[i * size], &all[i * pixel + pixel - size], size), 0) << i;
  }
}

// The reason why a file is rejected. Empty if it is not.
inline std::string refusal_of(std::unique_ptr<Decoder> (*open)(const PictureBytes&), const std::string& bytes) {
  try {
    read_all(*open(picture_in_memory(std::as_bytes(std::span(bytes)), "a file")));
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    const std::string why = error.what();
    EXPECT_TRUE(why.starts_with("cannot read 'a file': ") && why.find('\n') == std::string::npos) << why;
    return why;
  }
}

}  // namespace ods
