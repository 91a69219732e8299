// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The report of ods comfort, for people and for programs.
#pragma once
#include <string>
#include <vector>

#include "cli/verdict/comfort_job.h"
#include "ods/comfort/judge_picture.h"

void print_text(const ComfortJob& job, const ods::JudgedPicture& judged);
void print_json(const ComfortJob& job, const ods::JudgedPicture& judged);

// "23 degrees right, 12 down"; "'Lamp'" or "an area"; "<0.1 %".
std::string direction_text(const ods::StrainedPlace& place);
std::string thing_text(const ods::StrainedPlace& place);
std::string share_text(double share);

// The remedy of a place; empty for a caution, which may stay.
std::string remedy_text(const ods::StrainedPlace& place);
// The remedies of the whole picture.
std::vector<std::string> remedy_lines(const ComfortJob& job, const ods::JudgedPicture& judged);
// Describes the placement of a picture's eyes as measured from its pixels.
std::string measured_text(const ods::MeasuredEyes& eyes);
