// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The report of a video, for people and for programs.
#pragma once
#include <string>

#include "cli/verdict/comfort_job.h"
#include "ods/comfort/video.h"

void print_text(const ComfortJob& job, const ods::VideoComfort& video);
void print_json(const ComfortJob& job, const ods::VideoComfort& video);

std::string sampled_frames_text(const ods::VideoComfort& video);  // at how many frames
std::string times_text(const ods::VideoStrain& strain);           // "from 3.0 to 5.0 s"
std::string strain_text(const ods::VideoStrain& strain);          // "the horizon rolls: 12 degrees a second"
