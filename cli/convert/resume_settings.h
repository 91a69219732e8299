// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Settings that determine a converted video: the command's arguments, and the files that it reads, by size and time.
#pragma once
#include "cli/convert/convert_job.h"
#include "ods/base/settings.h"

ods::Settings resume_settings(const ConvertJob& job);
