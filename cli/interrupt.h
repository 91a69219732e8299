// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Ctrl-C and kill: the first asks the work to stop and clean up, the second ends the process at once.
#pragma once

void catch_interrupts();

// SIGINT or SIGTERM once one has come, 0 until then.
int interrupt_signal();
