// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The viewer as a folder of files, for any web host.
#pragma once
#include <string>
#include <vector>

#include "ods/view/view_item.h"

// Writes the page, view.json and the items' files into the folder, which is made. A file that browsers read is copied,
// all else becomes a JPEG of each eye. Files of an earlier export are replaced, others stay. view.json comes last: with
// it the folder is complete. Returns view.json's path. Throws Error(kInput), Error(kOutput).
std::string export_site(const std::vector<ods::ViewItem>& items, const std::string& folder);
