// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/image/stroke_font.h"

namespace ods {

namespace {

// Polylines of points (x 0..4, y 0..6): two digits per point, polylines separated by spaces.
struct Glyph {
  char letter;
  const char* strokes;
};

}  // namespace
static const Glyph kGlyphs[] = {
    {'A', "002640 1232"},
    {'B', "00063645443303 3342413000"},
    {'C', "4536160501103041"},
    {'D', "00062645412000"},
    {'E', "40000646 0333"},
    {'F', "000646 0333"},
    {'G', "45361605011030414323"},
    {'H', "0006 4046 0343"},
    {'I', "1030 2026 1636"},
    {'J', "0110304146 2646"},
    {'K', "0006 0246 1340"},
    {'L', "060040"},
    {'M', "0006234640"},
    {'N', "00064046"},
    {'O', "103041453616050110"},
    {'P', "00063645443303"},
    {'Q', "103041453616050110 2240"},
    {'R', "00063645443303 2340"},
    {'S', "453616050413334241301001"},
    {'T', "2026 0646"},
    {'U', "060110304146"},
    {'V', "062046"},
    {'W', "0610233046"},
    {'X', "0046 0640"},
    {'Y', "062346 2023"},
    {'Z', "06460040"},
    {'0', "103041453616050110 1135"},
    {'1', "152620 1030"},
    {'2', "05163645440040"},
    {'3', "05163645443313 334241301001"},
    {'4', "30360242"},
    {'5', "460603334241301001"},
    {'6', "4536160501103041423303"},
    {'7', "064610"},
    {'8', "13334445361605041302011030414233"},
    {'9', "43130405163645413010"},
    {'+', "0343 2125"},
    {'-', "0343"},
    {'.', "2021"},
    {':', "2122 2425"},
    {'/', "0046"},
};

static const char* glyph(char letter) {
  for (const Glyph& g : kGlyphs) {
    if (g.letter == letter) return g.strokes;
  }
  return "";
}

static vec2 point(std::string_view line, size_t i) {
  return {static_cast<float>(line[i] - '0'), static_cast<float>(line[i + 1] - '0')};
}

std::vector<Stroke> text_strokes(std::string_view text) {
  const float left = -0.5f * (6.0f * static_cast<float>(text.size()) - 2.0f);
  std::vector<Stroke> strokes;
  for (size_t c = 0; c < text.size(); c++) {
    const vec2 corner(left + 6.0f * static_cast<float>(c), -3.0f);
    const std::string_view line = glyph(text[c]);
    for (size_t i = 0; i + 3 < line.size(); i += 2) {
      if (line[i + 2] == ' ') i += 3;  // the next polyline
      strokes.push_back({corner + point(line, i), corner + point(line, i + 2)});
    }
  }
  return strokes;
}

}  // namespace ods
