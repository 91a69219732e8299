// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/compose/lettering.h"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <pango/pangofc-fontmap.h>
#include <pango/pangoft2.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include "ods/base/error.h"
#include "ods/base/text.h"

namespace ods {

namespace {

struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <class T>
using Object = std::unique_ptr<T, Unref>;

struct Fontconfig {
  FcConfig* config = FcInitLoadConfigAndFonts();
  Fontconfig() = default;
  Fontconfig(const Fontconfig&) = delete;
  Fontconfig& operator=(const Fontconfig&) = delete;
  ~Fontconfig() { FcConfigDestroy(config); }
};

// A mistyped file name must not count as a font name, which would be silently substituted.
bool is_font_file(const std::string& font) {
  const std::string extension = small_letters(std::filesystem::path(font).extension().native());
  for (const char* known : {".ttf", ".otf", ".ttc", ".otc", ".pfb", ".woff", ".woff2"}) {
    if (extension == known) return true;
  }
  std::error_code ignored;
  return font.find('/') != std::string::npos || std::filesystem::is_regular_file(font, ignored);
}

// The name of the file's first font, after adding it to fontconfig.
std::string add_font_file(const Fontconfig& fonts, const std::string& path) {
  const auto* name = reinterpret_cast<const FcChar8*>(path.c_str());
  const bool added = FcConfigAppFontAddFile(fonts.config, name);
  const FcFontSet* own = added ? FcConfigGetFonts(fonts.config, FcSetApplication) : nullptr;
  if (!own || own->nfont == 0)
    throw Error(ErrorKind::kInput, fmt::format("`font`: '{}' is missing or not a font file", path));
  PangoFontDescription* description = pango_fc_font_description_from_pattern(own->fonts[0], FALSE);
  char* text = pango_font_description_to_string(description);
  const std::string found = text;
  g_free(text);
  pango_font_description_free(description);
  return found;
}

// A Pango layout and the objects it depends on.
class Text {
 public:
  Text(const std::string& text, const LetteringOptions& options) : map_(pango_ft2_font_map_new()) {
    const FcFontSet* installed = FcConfigGetFonts(fonts_.config, FcSetSystem);
    const bool has_fonts = installed && installed->nfont > 0;
    if (!has_fonts && !is_font_file(options.font)) {
      throw Error(ErrorKind::kInput, "this machine has no fonts: install some (fonts-dejavu), or give a font file");
    }
    const std::string font = is_font_file(options.font) ? add_font_file(fonts_, options.font) : options.font;
    pango_fc_font_map_set_config(PANGO_FC_FONT_MAP(map_.get()), fonts_.config);
    context_.reset(pango_font_map_create_context(map_.get()));
    layout_.reset(pango_layout_new(context_.get()));
    description_ = pango_font_description_from_string(font.c_str());
    pango_layout_set_text(layout_.get(), text.c_str(), static_cast<int>(text.size()));
    pango_layout_set_alignment(layout_.get(), alignment(options.align));
    pango_layout_set_line_spacing(layout_.get(), options.spacing);
  }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  ~Text() { pango_font_description_free(description_); }

  void set_em(float em) {
    pango_font_description_set_absolute_size(description_, static_cast<double>(em) * PANGO_SCALE);
    pango_layout_set_font_description(layout_.get(), description_);
  }

  // The bounds of everything drawn, in pixels.
  PangoRectangle ink() const {
    PangoRectangle ink;
    pango_layout_get_pixel_extents(layout_.get(), &ink, nullptr);
    return ink;
  }

  std::string family() const {
    const Object<PangoFont> font(pango_context_load_font(context_.get(), description_));
    if (!font) return {};
    PangoFontDescription* found = pango_font_describe(font.get());
    const char* name = pango_font_description_get_family(found);
    const std::string family = name ? name : "";
    pango_font_description_free(found);
    return family;
  }

  int characters_lost() const { return pango_layout_get_unknown_glyphs_count(layout_.get()); }

  Image draw() const {
    const PangoRectangle at = ink();
    std::vector<unsigned char> bytes(static_cast<size_t>(at.width) * static_cast<size_t>(at.height));
    FT_Bitmap bitmap = {};
    bitmap.width = static_cast<unsigned>(at.width);
    bitmap.rows = static_cast<unsigned>(at.height);
    bitmap.pitch = at.width;
    bitmap.buffer = bytes.data();
    bitmap.num_grays = 256;
    bitmap.pixel_mode = FT_PIXEL_MODE_GRAY;
    pango_ft2_render_layout(&bitmap, layout_.get(), -at.x, -at.y);
    Image image(at.width, at.height, 1);
    std::transform(bytes.begin(), bytes.end(), image.pixels.begin(),
                   [](unsigned char value) { return static_cast<float>(value) / 255.0f; });
    return image;
  }

 private:
  static PangoAlignment alignment(TextAlign align) {
    switch (align) {
      case TextAlign::kFlushLeft:
        return PANGO_ALIGN_LEFT;
      case TextAlign::kCentered:
        return PANGO_ALIGN_CENTER;
      case TextAlign::kFlushRight:
        break;
    }
    return PANGO_ALIGN_RIGHT;
  }

  Fontconfig fonts_;
  Object<PangoFontMap> map_;
  Object<PangoContext> context_;
  Object<PangoLayout> layout_;
  PangoFontDescription* description_ = nullptr;
};

}  // namespace

Lettering draw_lettering(const std::string& text, float em, const LetteringOptions& options) {
  assert(em > 0.0f);
  const double kMaxPixels = 1 << 26;
  if (!g_utf8_validate(text.data(), static_cast<gssize>(text.size()), nullptr)) {
    throw Error(ErrorKind::kUsage, "the text is not valid UTF-8");
  }
  Text drawn(text, options);
  Lettering lettering;
  lettering.em = em;
  drawn.set_em(em);
  PangoRectangle ink = drawn.ink();
  const double pixels = 1.0 * ink.width * ink.height;
  if (pixels > kMaxPixels) {
    lettering.em *= static_cast<float>(std::sqrt(kMaxPixels / pixels));
    drawn.set_em(lettering.em);
    ink = drawn.ink();
  }
  if (ink.width < 1 || ink.height < 1) throw Error(ErrorKind::kUsage, "the text has no visible characters");
  lettering.coverage = drawn.draw();
  lettering.font = drawn.family();
  const bool is_any = options.font.starts_with("Sans");  // a generic name, not a family
  lettering.stands_in = !is_any && !is_font_file(options.font) && !options.font.starts_with(lettering.font);
  lettering.characters_lost = drawn.characters_lost();
  return lettering;
}

}  // namespace ods
