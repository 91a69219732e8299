// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The page without ES modules, which browsers load from no disk, and one by one elsewhere: a module and all that it
// imports as one classic script, with the files that they fetch in it (web/bundle.js).
#pragma once
#include <map>
#include <string>

namespace ods {

// Who answers the page. What only others answer is left out of the script.
enum class PageHost { kFolder, kView, kStudio };

// entry: a module of the page, main.js. files: by their names, besides those of the page: view.json. A folder's script
// has everything; that of a server has what first sight needs, and loads later.js when it wants more.
std::string bundle(const std::string& entry, std::map<std::string, std::string> files,
                   PageHost host = PageHost::kFolder);

// later.js, of a server's main.js.
std::string bundle_later(PageHost host);

// The script FILE.js that an export writes beside FILE: it holds the file's bytes in base64, 4/3 of their size. A page
// that is opened from disk loads it, because browsers let such a page read no file.
std::string script_of_file(std::string_view name, std::string_view bytes);

}  // namespace ods
