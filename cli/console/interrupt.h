// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Ctrl-C, kill and a terminal that goes away.
#pragma once

// From here on such a signal removes what is not complete, says last_words on stderr and ends the process at once with
// 128 + its number, whatever is being loaded, rendered or saved. last_words must outlive the process.
void end_on_interrupts(const char* last_words);
