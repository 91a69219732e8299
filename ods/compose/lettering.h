// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Renders text in any script to a picture: Pango does the layout (HarfBuzz shapes, fontconfig finds fallback fonts) and
// FreeType draws. Only lettering.cpp uses these libraries.
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
  std::string font = "Sans";  // a fontconfig name ("DejaVu Serif Bold Italic"), or a file (.ttf, .otf, .ttc ...)
  TextAlign align = TextAlign::kCentered;
  float spacing = 1.0f;  // line spacing, as a multiple of the font's own
};

struct Lettering {
  Image coverage;           // 1 channel, 0..1, cropped to the text
  float em = 0.0f;          // pixels: the font size, about the distance between two lines
  std::string font;         // the family used first
  bool stands_in = false;   // the requested font is missing, and this is a substitute
  int characters_lost = 0;  // characters without a glyph in any font on this machine
};

// Lines are separated by newlines. The font size is `em` pixels, or less if the picture would exceed 2^26 pixels.
// Throws Error(kUsage) for text that is not UTF-8 or has no visible characters; Error(kInput) for an invalid font file
// or a machine without fonts.
Lettering draw_lettering(const std::string& text, float em, const LetteringOptions& options = {});

}  // namespace ods
