// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles Ctrl-C, kill and a terminal that goes away.
#pragma once

// From now on such a signal removes unfinished files, prints the last words and ends the process at once with 128 + its
// number, even while loading, rendering or saving. `last_words` runs in the signal handler: it must only return a
// literal.
void end_on_interrupts(LastWords last_words = plain_last_words);
