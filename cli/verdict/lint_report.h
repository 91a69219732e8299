// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the results of ods lint.
#pragma once
#include <string>

#include "ods/lint/lint.h"

void print_text(const std::string& path, const ods::LintReport& report);
void print_json(const std::string& path, const ods::LintReport& report);
