// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Says which frames of other processes are waited for (ods/sequence/shared_frames.h). noun: "frame", or what they are.
#pragma once
#include <string>
#include <vector>

#include "ods/sequence/shared_frames.h"

ods::OnWaiting say_waiting(const std::string& noun);

// As ods::wait_for_frames().
void wait_for_frames(const std::vector<ods::SharedFrame>& frames, const std::string& noun, float seconds);
