// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/name_words.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "ods/base/text.h"
#include "ods/camera/file_names.h"
#include "ods/picture/metadata/stereo_format.h"

namespace ods {

static NameWordRow eyes(std::string_view word, std::string_view text, Layout layout) {
  return {word, text, layout};
}

static NameWordRow sphere(std::string_view word, std::string_view text, std::string_view projection) {
  return {word, text, {}, *find_projection(projection)};
}

static NameWordRow lens(std::string_view word, std::string_view text, float fov) {
  NamedProjection projection = *find_projection("fisheye");
  projection.setting.fov = fov;
  return {word, text, {}, projection};
}

std::span<const NameWordRow> name_words() {
  static const std::vector<NameWordRow> rows = {
      eyes("3dh", "side by side", Layout::kSideBySide),
      eyes("fsbs", "side by side", Layout::kSideBySide),
      eyes("3dv", "top-bottom", Layout::kTopBottom),
      eyes("tab", "top-bottom", Layout::kTopBottom),
      eyes("fou", "top-bottom", Layout::kTopBottom),
      eyes("ftab", "top-bottom", Layout::kTopBottom),
      eyes("htab", "top-bottom, squeezed", Layout::kTopBottomHalf),
      sphere("360", "the whole sphere", "lat-long"),
      sphere("360x180", "the whole sphere", "lat-long"),
      sphere("180", "the front half", "vr180"),
      sphere("180x180", "the front half", "vr180"),
      sphere("eac360", "an equi-angular cube", "eac"),
      lens("f180", "a fisheye of 180 degrees", 180.0f),
      lens("fisheye180", "a fisheye of 180 degrees", 180.0f),
      lens("fisheye190", "a fisheye of 190 degrees", 190.0f),
      lens("rf52", "Canon's dual fisheye, 190 degrees", 190.0f),
      lens("fisheye200", "a fisheye of 200 degrees", 200.0f),
      lens("mkx200", "iZugar's MKX200, 200 degrees", 200.0f),
      lens("mkx220", "iZugar's MKX220, 220 degrees", 220.0f),
      lens("vrca220", "Entaniya's VRCA220, 220 degrees", 220.0f),
  };
  return rows;
}

bool is_packing(Layout layout) {
  const EyePacking how = arrangement_of(layout).how;
  return how != EyePacking::kMixed && how != EyePacking::kAlone;
}

bool is_neutral_token(std::string_view word) {
  constexpr std::string_view kSilent[] = {"injected", "alpha", "3d",   "vr",   "hdr",   "sdr",   "h264",   "h265",
                                          "hevc",     "av1",   "x264", "x265", "final", "quest", "quest2", "quest3"};
  if (std::ranges::find(kSilent, word) != std::end(kSilent)) return true;
  const size_t digits = word.find_first_not_of("0123456789xX");
  if (digits == std::string_view::npos) return true;
  const std::string_view unit = word.substr(digits);
  return digits > 0 && (unit == "k" || unit == "p" || unit == "fps" || unit == "hz");
}

// --- a whole name ----------------------------------------------------------------------------------------------------

// A layout's name or abbreviation. A file named checkerboard usually shows a checkerboard pattern.
static std::optional<Layout> layout_token(const std::string& word) {
  for (const NameWordRow& row : name_words()) {
    if (row.word == word && row.layout) return row.layout;
  }
  const std::optional<Layout> layout = layout_of(word);
  const bool is_word = layout && is_packing(*layout) && arrangement_of(*layout).how != EyePacking::kCheckerboard;
  return is_word ? layout : std::nullopt;
}

// After a hyphen only players' own words count, unless the eyes follow: a-dome may be any dome.
static const NamedProjection* projection_token(const std::string& word, bool is_doubtful) {
  for (const NameWordRow& row : name_words()) {
    if (row.word == word && row.projection) return &*row.projection;
  }
  return is_doubtful ? nullptr : find_projection(word);
}

// Reads two words in one: 360tb, 180sbs.
static bool read_joined_word(const std::string& marked, NameWords& words) {
  constexpr size_t kDigits = 3;
  const std::string word = small_letters(marked.substr(1));
  const std::string angle = word.substr(0, kDigits);
  if (word.size() <= kDigits || (angle != "180" && angle != "360")) return false;
  const std::optional<Layout> layout = layout_token(word.substr(kDigits));
  if (!layout || !words.layout_token.empty() || words.projection != nullptr) return false;
  words.layout = layout, words.layout_token = marked;
  words.projection = projection_token(angle, false);
  return true;
}

// Takes the last word of a name into account. Returns false if the words before it do not matter.
static bool read_word(const std::string& marked, NameWords& words) {
  const std::string word = small_letters(marked.substr(1));
  const std::optional<Layout> layout = layout_token(word);
  const bool has_layout = !words.layout_token.empty();
  // After a dot a number is a frame number, unless a word about the eyes follows.
  const bool is_frame = marked[0] == '.' && !has_layout && is_neutral_token(word);
  const NamedProjection* projection = is_frame ? nullptr : projection_token(word, marked[0] == '-' && !has_layout);
  if (read_joined_word(marked, words)) return false;
  if (layout || word == "mono") {
    if (has_layout) return words.layout == layout;  // twice: _3dh_LR
    words.layout = layout;
    words.is_mono = word == "mono";
    words.layout_token = marked;
  } else if (projection != nullptr) {
    words.projection = projection;
    words.projection_token = marked;
  } else if (!is_neutral_token(word)) {
    return false;
  }
  return words.layout_token.empty() || words.projection == nullptr;
}

NameWords read_name(const std::string& path) {
  NameWords words;
  std::string name = std::filesystem::path(without_words(path)).stem().native();
  while (true) {
    while (name.ends_with(')') || name.ends_with(']')) name.pop_back();
    size_t at = name.find_last_of("_. ([");
    const size_t hyphen = name.rfind('-');
    const bool has_hyphen = hyphen != std::string::npos && (at == std::string::npos || hyphen > at);
    const auto is_known = [&](const std::string& word) {
      return layout_token(word).has_value() || projection_token(word, false) != nullptr;
    };
    // Names such as top-bottom have hyphens of their own: the longest name wins.
    if (has_hyphen && (at == std::string::npos || !is_known(small_letters(name.substr(at + 1))))) {
      at = name.find('-', at == std::string::npos ? 0 : at + 1);
      while (at != hyphen && !is_known(small_letters(name.substr(at + 1)))) at = name.find('-', at + 1);
    }
    if (at == std::string::npos || !read_word(name.substr(at), words)) return words;
    name.resize(at);
  }
}

}  // namespace ods
