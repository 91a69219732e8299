// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The only way to stdout and stderr. Names and texts from files reach terminals here, so control characters other than
// line breaks and tabs, and bytes that are not UTF-8, become '?' (ods::terminal_text()).
#pragma once
#include <string>

#include "ods/base/json_reader.h"

// Text on stdout.
void put_out(const std::string& text);

// A result on stdout as JSON, indented, and a line break.
void put_json(const ods::Json& json);

// A line on stdout with the path of a file. In a pipe it has the name's bytes as they are, for programs, as with ls.
void put_path(const std::string& path);

// Text on stderr. `ours` comes first, as it is: it may set colours.
void put_error(const char* ours, const std::string& text);
