// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Notes which frames of other processes are waited for (ods/sequence/shared_frames.h). noun: "frame", or another
// product.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ods/sequence/shared_frames.h"

ods::OnWaiting note_waiting(const std::string& noun);

// Returns a callback for ods::wait_for_frames() that notes how many files are waited for.
std::function<void(size_t missing)> note_late(const std::string& noun, float seconds);
