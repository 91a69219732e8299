// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// A machine whose memory runs out. A program that links failing_memory.cpp has its operator new, in every thread and in
// every library.
#pragma once
#include <cstddef>

// After `count` more allocations that succeed, one fails; where it lasts, all that follow too. Those of fewer bytes
// always succeed and do not count.
void fail_allocations(long count, bool lasts, size_t bytes = 0);

// All succeed again. Returns how many have failed.
size_t allow_allocations();
