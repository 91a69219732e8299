// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The viewer as a folder of files, for any web host.
#pragma once
#include <string>
#include <vector>

#include "ods/view/view_item.h"

// The texts of an exported page.
struct PageTexts {
  std::string title;  // of the page and of links to it; by default the first item's caption, or its file's name
  std::string language = "en";  // of the page's own texts: web/translations-*.js
};

// Returns the languages of the page, sorted.
std::vector<std::string> page_languages();

// Writes the page, view.json and the items' files into the folder, as a whole or not at all
// (ods/files/atomic_folder.h). A file that browsers read is copied, all else becomes a JPEG of each eye. Files of an
// earlier export are replaced, others stay. tour: the items are its panoramas. Returns view.json's path. Throws
// Error(kInput), Error(kOutput); then the folder is as it was.
std::string export_site(const std::vector<ods::ViewItem>& items, const std::string& folder, const PageTexts& texts = {},
                        const ods::Tour* tour = nullptr);
