// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// TIFFs made byte by byte, with tags that no writer here has.
#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ods {

// A grey-blue picture of 8 bits, little endian, uncompressed.
struct MadeTiff {
  uint32_t width = 0, height = 0;
  std::vector<std::pair<uint16_t, double>> ratios{};     // RATIONAL
  std::vector<std::pair<uint16_t, uint32_t>> numbers{};  // LONG

  std::string bytes() const {
    const uint32_t pixels = 3 * width * height;
    std::string data;
    for (uint32_t i = 0; i < pixels; i++) data += static_cast<char>(i % 3 == 2 ? 200 : 90 + i / 3 % width);
    std::map<uint16_t, std::string> entries;
    std::string values = number(8, 2) + number(8, 2) + number(8, 2) + "\0\0";
    values.resize(8, '\0');
    const uint32_t values_at = 8 + pixels + pixels % 2;
    const std::pair<uint16_t, uint32_t> usual[] = {{256, width}, {257, height}, {259, 1},      {262, 2},
                                                   {273, 8},     {277, 3},      {278, height}, {279, pixels}};
    for (const auto& [tag, value] : usual) entries[tag] = number(4, 2) + number(1, 4) + number(value, 4);
    for (const auto& [tag, value] : numbers) entries[tag] = number(4, 2) + number(1, 4) + number(value, 4);
    entries[258] = number(3, 2) + number(3, 4) + number(values_at, 4);
    for (const auto& [tag, value] : ratios) {
      entries[tag] = number(5, 2) + number(1, 4) + number(values_at + static_cast<uint32_t>(values.size()), 4);
      values += number(static_cast<uint32_t>(std::lround(value * 1e6)), 4) + number(1000000, 4);
    }
    std::string file = "II" + number(42, 2) + number(values_at + static_cast<uint32_t>(values.size()), 4) + data;
    file.resize(values_at, '\0');
    file += values + number(static_cast<uint32_t>(entries.size()), 2);
    for (const auto& [tag, entry] : entries) file += number(tag, 2) + entry;
    return file + number(0, 4);
  }

 private:
  static std::string number(uint32_t value, int count) {
    std::string text;
    for (int i = 0; i < count; i++) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
  }
};

}  // namespace ods
