// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/builtin/stroke_font.h"

#include <cmath>
#include <sstream>

namespace ods {

// Polylines of points (x 0..4, y 0..6), two digits a point, polylines parted by spaces.
struct Glyph {
  char letter;
  const char* strokes;
};
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
};

static const char* glyph(char letter) {
  for (const Glyph& g : kGlyphs) {
    if (g.letter == letter) return g.strokes;
  }
  return "";
}

static vec2 point(const std::string& line, size_t i) {
  return {float(line[i] - '0'), float(line[i + 1] - '0')};
}

Shape make_text(const std::string& text, float height, float stroke) {
  const float unit = (height - stroke) / 6.0f, advance = 6.0f * unit;
  const float left = -0.5f * (advance * float(text.size()) - 2.0f * unit);
  Shape shape;
  for (size_t c = 0; c < text.size(); c++) {
    std::istringstream lines(glyph(text[c]));
    std::string line;
    while (lines >> line) {
      for (size_t i = 0; i + 3 < line.size(); i += 2) {
        const vec2 from = unit * point(line, i), to = unit * point(line, i + 2);
        const vec2 along = normalize(to - from), middle = 0.5f * (from + to);
        const vec2 at = middle + vec2(left + advance * float(c), -3.0f * unit);
        glm::mat4 turn(1.0f);
        turn[0] = vec4(along, 0.0f, 0.0f);
        turn[1] = vec4(-along.y, along.x, 0.0f, 0.0f);
        turn[3] = vec4(at, 0.0f, 1.0f);
        append(shape, transformed(make_box(vec3(glm::distance(from, to) + stroke, stroke, stroke)), turn));
      }
    }
  }
  return shape;
}

}  // namespace ods
