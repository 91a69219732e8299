// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A certificate of our own for https in the local network, because browsers do not give pages a headset without it. It
// is self-signed, so browsers warn once; it is kept, so that they do not warn again. Through OpenSSL.
#pragma once
#include <string>
#include <vector>

struct Certificate {
  std::string path;  // PEM, and so is the key's
  std::string key;
};

// The certificate in a folder, made there if it is missing, lacks one of these names (host names and IPv4 addresses) or
// ends within a month. Only the user can read the key. Throws Error(kOutput).
Certificate keep_certificate(const std::string& folder, const std::vector<std::string>& names);

// Random letters and digits, 128 bits.
std::string random_secret();
