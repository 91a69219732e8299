// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/picture/metadata/name_words.h"

#include <algorithm>
#include <string>
#include <vector>

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

bool is_neutral_token(std::string_view word) {
  constexpr std::string_view kSilent[] = {"injected", "alpha", "3d",   "vr",  "hdr",  "sdr",
                                          "h264",     "h265",  "hevc", "av1", "x264", "x265"};
  if (std::ranges::find(kSilent, word) != std::end(kSilent)) return true;
  const size_t digits = word.find_first_not_of("0123456789xX");
  if (digits == std::string_view::npos) return true;
  const std::string_view unit = word.substr(digits);
  return digits > 0 && (unit == "k" || unit == "p" || unit == "fps" || unit == "hz");
}

}  // namespace ods
