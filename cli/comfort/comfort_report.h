// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The report of ods comfort, for people and for programs.
#pragma once
#include <string>

#include "ods/comfort/comfort.h"

// name: of the input; camera: of what was judged.
void print_text(const std::string& name, const ods::StereoCamera& camera, const ods::ComfortOptions& options,
                const ods::ComfortReport& report);
void print_json(const std::string& name, const ods::StereoCamera& camera, const ods::ComfortOptions& options,
                const ods::ComfortReport& report);
