// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "ods/compose/testcard_painter.h"

namespace ods {

int first_frame_of(int second, double fps) {
  return static_cast<int>(std::ceil(second * fps - 1e-6));
}

int flash_frames(double fps) {
  return std::max(1, static_cast<int>(std::lround(fps / 15.0)));
}

std::vector<Card> testcard_marks(const StereoCamera& camera, Extent eye, int frame, double fps) {
  const int second = static_cast<int>(std::floor(frame / fps + 1e-6)), since = frame - first_frame_of(second, fps);
  std::vector<Card> cards;
  for (const float yaw : {0.0f, 90.0f, 180.0f, -90.0f}) {
    CardView view(cards, yaw, -46.0f);
    view.letter(fmt::format("L {:04}", frame), -9.0f, 7.5f, 24.0f, 5.4f, kLeftColor).eye = kLeft;
    view.letter(fmt::format("R {:04}", frame), -9.0f, 1.7f, 24.0f, 5.4f, kRightColor).eye = kRight;
    Card& flash = view.add(CardPattern::kCells, 12.5f, 4.6f, 11.2f, 11.2f);
    flash.lit = since < flash_frames(fps) ? 0 : -1;
    Card& cells = view.add(CardPattern::kCells, 0.0f, -4.4f, 42.0f, 3.2f);
    cells.count = std::clamp(static_cast<int>(std::ceil(fps - 1e-6)), 1, 60);
    cells.lit = since * cells.count / std::max(cells.count, static_cast<int>(std::ceil(fps - 1e-6)));
    Card& sweep = view.add(CardPattern::kSweep, 0.0f, -9.0f, 42.0f, 3.2f);
    sweep.phase = static_cast<float>(frame / fps - std::floor(frame / fps));
  }
  set_reach(cards, camera, eye);
  return cards;
}

}  // namespace ods
