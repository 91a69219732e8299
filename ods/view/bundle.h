// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The page as one script: browsers load no ES modules from disk, and load them one by one from servers. A module and
// all that it imports become one script (web/bundle.js).
#pragma once
#include <string>
#include <string_view>

namespace ods {

// The host that answers the page. Code that only other hosts need is left out of the script.
enum class PageHost { kFolder, kView, kStudio };

// The way in which a page loads the script: <script src>, or import.
enum class ScriptKind { kClassic, kModule };

// entry: a module of the page, main.js. A folder's script has everything but what kLaterScripts have; a server's script
// has the code for the first view. Both load kLaterScripts when they need more; a script of kModule imports
// files of the same names with .mjs instead, and exports what its entry exports.
std::string bundle(const std::string& entry, PageHost host = PageHost::kFolder, ScriptKind kind = ScriptKind::kClassic);

// In a folder, later.js has what only layered scenes need; a server's has all but the code for the first view. The
// others have hotspots and tours, the texts in other languages than English, objects in pictures, films of layered
// scenes, and the layers of a headset's browser. Objects and films import from later.js, which the page loads first.
inline constexpr std::string_view kLaterScripts[] = {"later.js",         "later-tour.js", "later-words.js",
                                                     "later-objects.js", "later-film.js", "later-layers.js"};

// Returns the text of one of kLaterScripts, which the scripts of a host load; empty for any other name.
std::string bundle_later(std::string_view name, PageHost host, ScriptKind kind = ScriptKind::kClassic);

// The script FILE.js that an export writes beside FILE: it holds the file's bytes in base64, 4/3 of their size. A page
// that is opened from disk loads it, because browsers do not let such a page read files.
std::string script_of_file(std::string_view name, std::string_view bytes);

}  // namespace ods
