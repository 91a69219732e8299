// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console/print.h"

#include <unistd.h>

#include <cstdio>

#include "ods/base/quote.h"
#include "ods/base/text.h"

void put_out(const std::string& text) {
  std::fputs(ods::terminal_text(text).c_str(), stdout);
}

void put_json(const ods::Json& json) {
  put_out(ods::json_document(json, 2) + "\n");
}

void put_path(const std::string& path) {
  std::puts(isatty(STDOUT_FILENO) ? ods::terminal_text(path).c_str() : path.c_str());
  std::fflush(stdout);  // a program may be waiting for it
}

void put_error(const char* ours, const std::string& text) {
  std::fprintf(stderr, "%s%s", ours, ods::terminal_text(text).c_str());
}
