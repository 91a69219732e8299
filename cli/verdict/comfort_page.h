// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// The report of ods comfort as one page that needs nothing else: pictures are within it, and it names no address.
#pragma once
#include "cli/verdict/comfort_job.h"
#include "ods/comfort/video.h"

// Saves the page as ComfortJob::html. Throws ods::Error(kOutput). Precondition: the picture has its light.
void save_page(const ComfortJob& job, const ods::JudgedPicture& judged);
void save_page(const ComfortJob& job, const ods::VideoComfort& video);
