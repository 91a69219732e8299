// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Shared by the code that makes test cards: colours, and cards placed in a view. Only ods/compose/testcard*.cpp
// include this.
#pragma once
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "ods/compose/testcard.h"
#include "ods/image/tone.h"

namespace ods {

inline vec3 code(int r, int g, int b) {
  const auto linear = [](int value) { return srgb_decode(static_cast<float>(value) / 255.0f); };
  return vec3(linear(r), linear(g), linear(b));
}

inline const vec3 kWhite(1.0f), kBlack(0.0f), kPlateColor = code(24, 26, 32);
inline const vec3 kLeftColor = code(90, 190, 255), kRightColor = code(255, 120, 90);
inline const vec3 kSafe = code(110, 220, 120), kNotSafe = code(255, 80, 70), kAmber = code(255, 200, 80);

constexpr double kCapital = 0.6;  // the height of a capital letter relative to its plate

// The view in one direction. Positions and sizes are degrees in it.
class CardView {
 public:
  CardView(std::vector<Card>& cards, float yaw, float pitch)
      : cards_(cards), frame_(orientation(glm::radians(yaw), glm::radians(pitch), 0.0)) {}

  Card& add(CardPattern pattern, float x, float y, float width, float height) {
    const double theta = glm::radians(x), phi = glm::radians(y);
    const auto world = [&](double right, double up, double ahead) {
      return vec3(frame_[0] * right + frame_[1] * up - frame_[2] * ahead);
    };
    Card& card = cards_.emplace_back();
    card.pattern = pattern;
    card.middle = world(std::sin(theta) * std::cos(phi), std::sin(phi), std::cos(theta) * std::cos(phi));
    card.right = world(std::cos(theta), 0.0, -std::sin(theta));
    card.up = cross(card.right, card.middle);
    card.half = vec2(std::tan(0.5f * glm::radians(width)), std::tan(0.5f * glm::radians(height)));
    return card;
  }

  // Scales the letters to the plate's height, or to its width if they would be wider.
  Card& letter(std::string_view text, float x, float y, float width, float height, vec3 color = kWhite) {
    Card& card = add(CardPattern::kPlate, x, y, width, height);
    const float letters = 6.0f * static_cast<float>(text.size());
    const float unit = std::min(2.0f * static_cast<float>(kCapital) * card.half.y / 6.0f, 1.8f * card.half.x / letters);
    std::string capitals(text);
    for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    card.strokes = text_strokes(capitals);
    for (Stroke& stroke : card.strokes) stroke = {stroke.from * unit, stroke.to * unit};
    card.stroke = 0.45f * unit;
    card.color = color;
    return card;
  }

 private:
  std::vector<Card>& cards_;
  std::array<glm::dvec3, 3> frame_;  // right, up, back
};

}  // namespace ods
