// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// What the page says of a picture, a scene or a video.
#pragma once
#include "cli/comfort/comfort_job.h"
#include "cli/comfort/comfort_page.h"
#include "cli/comfort/judged.h"
#include "ods/comfort/video.h"

ComfortPage page_of(const ComfortJob& job, const Looked& looked, const ods::ComfortReport& report);
ComfortPage page_of(const ComfortJob& job, const ods::VideoComfort& video);
