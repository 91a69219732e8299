// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles Ctrl-C, kill and a terminal that goes away.
#pragma once

// From now on such a signal removes unfinished files, prints last_words on stderr and ends the process at once with 128
// + its number, even while loading, rendering or saving. last_words must outlive the process.
void end_on_interrupts(const char* last_words);
