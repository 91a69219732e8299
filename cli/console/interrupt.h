// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Ctrl-C, kill and a terminal that goes away.
#pragma once

// What is said on stderr when a signal of this number ends the process.
using LastWords = const char* (*)(int signal);
const char* plain_last_words(int signal);  // "ods: interrupted"

// From here on such a signal removes what is not complete, says the last words and ends the process at once with
// 128 + its number, whatever is being loaded, rendered or saved. `last_words` runs in a signal handler: it must only
// return a literal.
void end_on_interrupts(LastWords last_words = plain_last_words);
