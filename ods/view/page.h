// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The files of the viewer's page: the contents of web/, which the build puts into the program (cmake/page.sh).
#pragma once
#include <span>
#include <string_view>

namespace ods {

struct PageFile {
  std::string_view name;  // index.html
  std::string_view data;
};

std::span<const PageFile> page_files();

// Returns null if the page has no such file. Besides the files of web/ there are modules of constants, so that scripts
// need not fetch them: formats.js (ods/view/formats.h), shader.js (SHADER, the text of panorama.glsl), lookup.js (LOOKUP,
// lookup.glsl) and player-style.js (STYLE, player.css).
const PageFile* find_page_file(std::string_view name);

// Returns the media type for a file of this name, by its extension; application/octet-stream if that is unknown.
std::string_view media_type(std::string_view name);

}  // namespace ods
