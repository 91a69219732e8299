// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/scene/stroke_font.h"

#include <cmath>
#include <sstream>

namespace ods {

// Polylines of points (x 0..4, y 0..6), two digits a point, polylines parted by spaces.
static const char* glyph(char letter) {
  switch (letter) {
    case 'A':
      return "002640 1232";
    case 'B':
      return "0006364534330333424130 00003041423303";
    case 'C':
      return "4536160501103041";
    case 'D':
      return "000626454126 0020414526";
    case 'E':
      return "40000646 0333";
    case 'F':
      return "000646 0333";
    case 'G':
      return "45361605011030414323";
    case 'H':
      return "0006 4046 0343";
    case 'I':
      return "1030 2026 1636";
    case 'J':
      return "01103041461646";
    case 'K':
      return "0006 0246 1340";
    case 'L':
      return "060040";
    case 'M':
      return "0006234640";
    case 'N':
      return "00064046";
    case 'O':
      return "103041453616050110";
    case 'P':
      return "00063645443303";
    case 'Q':
      return "103041453616050110 2240";
    case 'R':
      return "00063645443303 2340";
    case 'S':
      return "453616050413334241301001";
    case 'T':
      return "2026 0646";
    case 'U':
      return "060110304146";
    case 'V':
      return "062046";
    case 'W':
      return "0610233046";
    case 'X':
      return "0046 0640";
    case 'Y':
      return "062346 2023";
    case 'Z':
      return "06460040";
    case '0':
      return "103041453616050110 1135";
    case '1':
      return "152620 1030";
    case '2':
      return "051636454400 0040";
    case '3':
      return "05163645443313 33424130100101";
    case '4':
      return "3036024242";
    case '5':
      return "46060333424130100101";
    case '6':
      return "453616050110304142330303";
    case '7':
      return "064610";
    case '8':
      return "133344453616050413020110304142 3342";
    case '9':
      return "43130405163645413010";
    case '+':
      return "0343 2125";
    case '-':
      return "0343";
    case '.':
      return "2021";
    default:
      return "";
  }
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
        if (from == to) continue;
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
