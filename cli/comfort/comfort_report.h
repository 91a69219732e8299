// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The report of ods comfort, for people and for programs.
#pragma once
#include <string>
#include <vector>

#include "cli/comfort/comfort_job.h"
#include "cli/comfort/judged.h"

// Of everything that was looked at; of the difference in height of eyes that were matched.
ods::ComfortLevel verdict(const ComfortJob& job, const Looked& looked, const ods::ComfortReport& report);
ods::ComfortLevel apart_level(const ComfortJob& job, const MatchQuality& match);

void print_text(const ComfortJob& job, const Looked& looked, const ods::ComfortReport& report);
void print_json(const ComfortJob& job, const Looked& looked, const ods::ComfortReport& report);

// Of a place, in words: "23 degrees right, 12 down"; "'Lamp'" or "an area"; "<0.1 %".
std::string direction_text(const ods::StrainedPlace& place);
std::string thing_text(const ods::StrainedPlace& place);
std::string share_text(double share);

// What would help against it: empty for a caution, which may stay; against all of it.
std::string cure_text(const ods::StrainedPlace& place);
// How a picture's eyes were placed, as its pixels tell.
std::string measured_text(const ods::MeasuredEyes& eyes);
std::vector<std::string> cure_lines(const ComfortJob& job, const Looked& looked, const ods::ComfortReport& report);
