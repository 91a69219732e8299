// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/page.h"

#include <algorithm>
#include <string>

#include "ods/base/text.h"

namespace ods {

const PageFile* find_page_file(std::string_view name) {
  const auto files = page_files();
  const auto file = std::ranges::find(files, name, &PageFile::name);
  return file == files.end() ? nullptr : &*file;
}

std::string_view media_type(std::string_view name) {
  struct Row {
    std::string_view extension;
    std::string_view type;
  };
  static constexpr Row kRows[] = {
      {".html", "text/html; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".frag", "text/plain; charset=utf-8"},
      {".glsl", "text/plain; charset=utf-8"},
      {".json", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".mpo", "image/jpeg"},
      {".jps", "image/jpeg"},
      {".jpeg", "image/jpeg"},
      {".webp", "image/webp"},
      {".mp4", "video/mp4"},
      {".m4v", "video/mp4"},
      {".mov", "video/mp4"},  // the part that browsers play is the same
      {".webm", "video/webm"},
      {".mkv", "video/x-matroska"},
  };
  const std::string lower = small_letters(std::string(name));
  const auto* const row = std::ranges::find_if(kRows, [&](const Row& each) { return lower.ends_with(each.extension); });
  return row == std::end(kRows) ? "application/octet-stream" : row->type;
}

}  // namespace ods
