// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The page without ES modules, which browsers do not load from disk, and load one by one from servers: a module and all
// that it imports as one classic script, with the files that they fetch in it (web/bundle.js).
#pragma once
#include <map>
#include <string>

namespace ods {

// The host that answers the page. Code that only other hosts need is left out of the script.
enum class PageHost { kFolder, kView, kStudio };

// entry: a module of the page, main.js. files: by their names, besides the page's own files: view.json. A folder's
// script has everything; a server's script has the code for the first view, and loads later.js when it needs more.
std::string bundle(const std::string& entry, std::map<std::string, std::string> files,
                   PageHost host = PageHost::kFolder);

// Returns later.js, which a server's main.js loads.
std::string bundle_later(PageHost host);

// The script FILE.js that an export writes beside FILE: it holds the file's bytes in base64, 4/3 of their size. A page
// that is opened from disk loads it, because browsers do not let such a page read files.
std::string script_of_file(std::string_view name, std::string_view bytes);

}  // namespace ods
