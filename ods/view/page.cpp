// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "ods/view/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "ods/base/json_reader.h"
#include "ods/base/quote.h"
#include "ods/base/text.h"
#include "ods/view/formats.h"

namespace ods {

static const PageFile* find_in(std::span<const PageFile> files, std::string_view name) {
  const auto file = std::ranges::find(files, name, &PageFile::name);
  return file == files.end() ? nullptr : &*file;
}

static std::string text_module(const char* constant, std::string_view file) {
  const std::string text(find_in(page_files(), file)->data);
  return fmt::format("export const {} = {};\n", constant, json_document(text));
}

const PageFile* find_page_file(std::string_view name) {
  static const std::string formats = formats_module(), shader = text_module("SHADER", "panorama.glsl"),
                           lookup = text_module("LOOKUP", "lookup.glsl"), style = text_module("STYLE", "player.css");
  static const PageFile kMade[] = {
      {"formats.js", formats}, {"shader.js", shader}, {"lookup.js", lookup}, {"player-style.js", style}};
  const PageFile* const made = find_in(kMade, name);
  return made ? made : find_in(page_files(), name);
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
      {".mjs", "text/javascript; charset=utf-8"},
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
      {".heic", "image/heic"},
      {".glb", "model/gltf-binary"},
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
