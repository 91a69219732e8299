// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Text in any script as a picture: Pango lays it out (HarfBuzz shapes it, fontconfig finds what a font lacks in others)
// and FreeType draws it. lettering.cpp alone knows them.
#pragma once
#include <string>
#include <string_view>

#include "ods/base/names.h"
#include "ods/image/image.h"

namespace ods {

enum class TextAlign { kFlushLeft, kCentered, kFlushRight };
inline constexpr NameRow<TextAlign> kTextAlignTable[] = {
    {TextAlign::kFlushLeft, "left"},
    {TextAlign::kCentered, "center"},
    {TextAlign::kFlushRight, "right"},
};
static_assert(has_every_member(kTextAlignTable));
inline constexpr auto kTextAligns = members_of(kTextAlignTable);
constexpr std::string_view text_align_name(TextAlign align) {
  return name_in(kTextAlignTable, align);
}

struct LetteringOptions {
  std::string font = "Sans";  // as fontconfig knows it ("DejaVu Serif Bold Italic"), or a file (.ttf, .otf, .ttc ...)
  TextAlign align = TextAlign::kCentered;
  float spacing = 1.0f;  // between lines, of what the font asks for
};

struct Lettering {
  Image coverage;           // 1 channel, 0..1, just large enough
  float em = 0.0f;          // pixels: the font's size, about the distance of two lines
  std::string font;         // the family that is the first choice
  bool stands_in = false;   // for one of the name asked for, which is not here
  int characters_lost = 0;  // no font on this machine has a sign for them
};

// Lines are parted by newlines. The font's size is `em` pixels, or less where the picture would have more than 2^26.
// Throws Error(kUsage): text that is not UTF-8 or has no visible characters; Error(kInput): a file that is no font, a
// machine without fonts.
Lettering draw_lettering(const std::string& text, float em, const LetteringOptions& options = {});

}  // namespace ods
