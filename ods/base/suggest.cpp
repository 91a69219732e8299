// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/base/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace ods {

// Levenshtein distance: insertions, deletions and replacements.
static size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); i++) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); j++) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string did_you_mean(const std::string& typed, const std::vector<std::string>& words) {
  size_t nearest = words.size(), distance = 0;
  for (size_t i = 0; i < words.size(); i++) {
    const size_t d = edit_distance(typed, words[i]);
    if (d > 1 + words[i].size() / 4 || (nearest != words.size() && d >= distance)) continue;
    nearest = i;
    distance = d;
  }
  return nearest == words.size() ? "" : "; did you mean '" + words[nearest] + "'?";
}

using namespace std::string_view_literals;

static constexpr std::pair<std::string_view, std::string_view> kForeign[] = {
    {"GIF8"sv, "a GIF picture"sv},
    {"BM"sv, "a BMP picture"sv},
    {"8BPS"sv, "a Photoshop picture"sv},
    {"\0\0\0\x0cJXL "sv, "a JPEG XL picture"sv},
    {"\xff\x0a"sv, "a JPEG XL picture"sv},
    {"\0\0\0\x0cjP  "sv, "a JPEG 2000 picture"sv},
    {"\0\0\0\x18"
     "ftypcrx "sv,
     "a raw photo of a Canon camera (CR3)"sv},
    {"%PDF"sv, "a PDF document"sv},
};

// Formats that name or contain files which ods reads.
static constexpr std::pair<std::string_view, std::string_view> kLeading[] = {
    {"#EXTM3U"sv,
     "a playlist (HLS), which names the pieces of a video: 'ffmpeg -i FILE -c copy FILE.mp4' makes one video of them"sv},
    {"PK\3\4"sv, "an archive (zip): unpack it; of numpy's npz, ods takes each .npy as depth"sv},
};

static constexpr std::string_view kTransport = "an MPEG transport stream";

static constexpr std::pair<std::string_view, std::string_view> kForeignVideos[] = {
    {"OggS"sv, "an Ogg"sv},
    {"G@"sv, kTransport},
    {"\0\0\1\xba"sv, "an MPEG program stream"sv},
    {"FLV\1"sv, "an FLV"sv},
    {"\x06\x0e\x2b\x34"sv, "an MXF"sv},
    {"\x30\x26\xb2\x75"sv, "a Windows Media"sv},
};

// The name of a video container that ods does not read. Its streams may well be readable in another container.
static std::string_view foreign_video(std::string_view start) {
  if (start.starts_with("RIFF") && start.size() >= 12 && start.substr(8, 4) == "AVI ") return "an AVI";
  for (const auto& [bytes, what] : kForeignVideos) {
    if (start.starts_with(bytes)) return what;
  }
  constexpr size_t kTimecode = 4;  // before each packet of m2ts and mts
  if (start.size() > kTimecode && start.substr(kTimecode).starts_with("G@")) return kTransport;
  return {};
}

std::string taken_by(std::string_view start) {
  const auto begins = [&](std::string_view bytes) { return start.starts_with(bytes); };
  if (start.size() >= 12 && start.substr(4, 4) == "ftyp") {
    for (const std::string_view brand : {"heic", "heix", "mif1", "msf1", "avif", "avis", "hevc"}) {
      if (start.substr(8, 4) == brand)
        return "; it is a picture: ods probe, lint, convert, comfort and view take pictures";
    }
  }
  for (const auto& [bytes, what] : kForeign) {
    if (begins(bytes)) return fmt::format("; it is {}, which ods does not read", what);
  }
  for (const auto& [bytes, what] : kLeading) {
    if (begins(bytes)) return fmt::format("; it is {}", what);
  }
  if (start.substr(std::min<size_t>(4, start.size())).starts_with("ftyp") || begins("\x1a\x45\xdf\xa3"sv)) {
    return "; it is a video: ods probe, lint, convert, comfort, inject, view and over take videos";
  }
  if (const std::string_view what = foreign_video(start); !what.empty()) {
    return fmt::format(
        "; it is {} file: ods reads mp4, mov, mkv and webm, and 'ffmpeg -i FILE -map 0 -c copy FILE.mkv' makes one "
        "of it, without a loss{}",
        what, what == kTransport ? ", except the right eye of 3D cameras (MVC), which FFmpeg does not decode" : "");
  }
  if (begins("glTF")) return "; it is a scene: ods render, video, info, comfort and view take scenes";
  const bool is_webp = begins("RIFF") && start.substr(std::min<size_t>(8, start.size())).starts_with("WEBP");
  for (const std::string_view picture :
       {"\x89PNG"sv, "\xff\xd8\xff"sv, "II*\0"sv, "MM\0*"sv, "#?R"sv, "\x76\x2f\x31\x01"sv}) {
    if (is_webp || begins(picture))
      return "; it is a picture: ods probe, lint, convert, comfort, inject and view take pictures";
  }
  return {};
}

}  // namespace ods
