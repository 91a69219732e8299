// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Folders of the user, for files that are kept from run to run.
#pragma once
#include <string>

// $VARIABLE/ods, if the variable is an absolute path; else `in_home`/ods in the home folder, which is HOME or the one
// of the user's account. Empty if there is none. It need not exist: ods::make_own_folder() makes it.
std::string user_folder(const char* variable, const char* in_home);
