// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The machine around ods view: its addresses, its browser, and the folder for files that are kept from run to run.
#pragma once
#include <string>
#include <vector>

// The IPv4 addresses under which other machines of the local network reach this one.
std::vector<std::string> network_addresses();

// Shows the page in the user's browser, if there is a desktop; else does nothing. Other users of this machine can read
// the address.
void open_in_browser(const std::string& address);

// Makes ~/.local/state/ods, or the folder by XDG_STATE_HOME, for the user alone. Returns an empty path if there is no
// home.
std::string state_folder();

// The secret of this user's addresses, the same every time, so that a page finds its server again: from the folder, or
// new. folder: state_folder().
std::string kept_secret(const std::string& folder);
