// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
//
// Handles Ctrl-C, kill and a terminal that goes away.
#pragma once

// Returns the text for stderr when a signal of this number ends the process.
using FinalMessage = const char* (*)(int signal);
const char* plain_final_message(int signal);  // "ods: interrupted"

// From now on such a signal removes unfinished files, prints the final message and ends the process at once with 128 +
// its number, even while loading, rendering or saving. `final_message` runs in the signal handler: it must only return
// a literal.
void end_on_interrupts(FinalMessage final_message = plain_final_message);

// While one of these exists, the first such signal requests a stop; only the second ends the process. At most
// one at a time.
class GentleStop {
 public:
  // words: a literal, printed on stderr at the first signal.
  explicit GentleStop(const char* words);
  ~GentleStop();
  GentleStop(const GentleStop&) = delete;
  GentleStop& operator=(const GentleStop&) = delete;

  bool requested() const;

  // Ends the process as the signal would have. Precondition: requested().
  [[noreturn]] void end() const;
};
