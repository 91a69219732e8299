// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/view/qr_code.h"

#include <qrencode.h>

#include <memory>

std::string qr_code(const std::string& text) {
  constexpr int kMargin = 2;
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_L),
                                                             &QRcode_free);
  if (!code) return "";
  const auto is_dark = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= code->width || y >= code->width) return false;
    return (code->data[y * code->width + x] & 1) != 0;
  };
  std::string lines;
  for (int y = -kMargin; y < code->width + kMargin; y += 2) {
    lines += "\x1b[30;47m";  // black on white
    for (int x = -kMargin; x < code->width + kMargin; x++) {
      const bool above = is_dark(x, y), below = is_dark(x, y + 1);
      lines += above && below ? "█" : above ? "▀" : below ? "▄" : " ";
    }
    lines += "\x1b[0m\n";
  }
  return lines;
}
