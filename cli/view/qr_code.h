// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A QR code in a terminal, for cameras of phones and headsets. Through libqrencode.
#pragma once
#include <string>

// Lines of half blocks, dark on light whatever the terminal's colours, with the margin that readers need. Empty if the
// text is too long.
std::string qr_code(const std::string& text);
